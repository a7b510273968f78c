# SPDX-License-Identifier: Apache-2.0
"""Control meshes of fields, and files of CAD programs: by OpenVDB and OpenCASCADE, which are loaded when they are wanted."""
from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from . import _sublimit
from ._constructions import Recipe, recipe_bytes
from ._meshes import Mesh, names_of
from ._patches import Patches
from ._schemes import OptionValue, Scheme, request
from ._surfaces import LimitSurface


@dataclass(frozen=True)
class ImplicitMesh:
    """A control mesh whose limit is near to the level set of a field.

    Attributes
    ----------
    mesh : closed, with creases and corners where the field has sharp edges
    met : whether the limit is within the tolerance, and no face is folded
    tolerance : that was asked for, or was taken
    largest_distance, mean_distance : of the limit from the surface, of samples
    notes : what should be known
    """

    __module__ = "sublimit"
    mesh: Mesh
    met: bool
    tolerance: float
    largest_distance: float
    mean_distance: float
    notes: list[str]


@dataclass(frozen=True)
class StepFile:
    """What a CAD file has.

    Attributes
    ----------
    solids, shells : closed and open
    faces : in the file
    caps : around extraordinary vertices, before packing
    deviation : of caps from the limit, measured
    met : whether the tolerance is
    is_valid : by OpenCASCADE's own check
    """

    __module__ = "sublimit"
    solids: int
    shells: int
    faces: int
    caps: int
    deviation: float
    met: bool
    is_valid: bool


def implicit(field: Recipe, scheme: Scheme | str = "catmull-clark", *, cells: int = 0, tolerance: float = 0,
             option: Mapping[str, OptionValue] | None = None, threads: int = 0) -> ImplicitMesh:
    """A control mesh whose limit is the level set 0 of a field, as ``sublimit implicit --help`` describes them.

    Parameters
    ----------
    field : a path, .json; or the JSON itself, a str that begins with ``{``; or a dictionary. Negative inside
    scheme : whose limit is fitted: a name, as in `schemes`, or what `scheme` makes
    cells : along the longest side of the box, 4 or more; 0: as the recipe says, else as few as do
    tolerance : largest distance of the limit from the surface, a length; 0: 1e-4 of the box's diagonal
    option : options of the scheme by name
    threads : at most so many (default: all)

    Raises
    ------
    FormatError
        What cannot be understood: names recipe and field, and says what would be right.
    InvalidMesh
        A surface that nearly touches itself.
    InvalidParameter
        A tolerance that is negative or not finite, cells below 4.
    InvalidOption
        The part with OpenVDB is not here: the message has its package, and how to build it. A scheme that there is not.
    IoError
        A missing file; a part that cannot be loaded, or is of another version.
    ResourceError
        A grid beyond memory.
    """
    asked = request(scheme, option=option)
    made = _sublimit.implicit(recipe_bytes(field, "field"), asked, operator.index(cells), float(tolerance), threads)
    made["mesh"] = Mesh._of(made["mesh"])
    return ImplicitMesh(**made)


def step(surface: LimitSurface | Patches, path: str | os.PathLike[str], *, tolerance: float | None = None,
         join: str = "g0", pack: bool = True, face_names: Iterable[str] | None = None, threads: int = 0) -> StepFile:
    """Writes a surface for CAD programs: exact B-spline faces with shared edges, solids where it is closed.

    Holes are left out. Of `Patches` each is a face.

    Parameters
    ----------
    path : .step, .stp or .brep. The file appears whole or not at all
    tolerance : largest distance of the caps around extraordinary vertices from the limit, a length (default: 1e-5 of the
        diagonal of the control points). Of patches: of sides that are one edge (default: 1e-9 of it)
    join : ``"g0"``, or ``"g1"``: caps meet their neighbours with a common tangent plane, under schemes of quadrilaterals
    pack : regular faces become the largest B-splines that keep knots and smoothness
    face_names : a name for each face of the mesh, empty for none, such as `Mesh.face_names`; only faces of one name are packed
    threads : at most so many (default: all)

    Raises
    ------
    InvalidOption
        Another extension, another word for `join`. The part with OpenCASCADE is not here: the message has its package, and how to build it.
    InvalidParameter
        A tolerance that is not positive; names that are not one for each face.
    InvalidMesh
        No faces, or no extent.
    UnsupportedTopology
        A scheme without polynomials; a patch that is no B-spline: which, and why.
    IoError
        Unwritable; a part that cannot be loaded, or is of another version.
    ResourceError
        More faces than a file may have; a full disk.
    """
    if not isinstance(surface, (LimitSurface, Patches)):
        raise TypeError(f"surface is a {type(surface).__name__}; a sublimit.LimitSurface or sublimit.Patches is right")
    return StepFile(**_sublimit.step(surface._core, os.fspath(path), None if tolerance is None else float(tolerance),
                                     join, bool(pack), names_of(face_names), threads))
