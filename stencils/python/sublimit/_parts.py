# SPDX-License-Identifier: Apache-2.0
"""Control meshes of fields, by OpenVDB, and files for CAD programs, by OpenCASCADE. Both libraries are loaded on first use."""
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
    """Result of `implicit`: a control mesh whose limit is near the zero level set of a field.

    Attributes
    ----------
    mesh : the control mesh: closed, with creases and corners where the field has sharp edges
    met : True if the limit is within the tolerance and no face is folded
    tolerance : tolerance that was given, or its default; a length
    largest_distance, mean_distance : distances of sampled points of the limit from the level set
    notes : list of str, warnings
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
    """Statistics of a file that `step` wrote.

    Attributes
    ----------
    solids, shells : numbers of closed and of open parts
    faces : number of faces in the file
    caps : number of faces around extraordinary vertices, before packing
    deviation : measured distance of the caps from the limit, a length
    met : True if the deviation is within the tolerance
    is_valid : result of OpenCASCADE's own check
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
    """Computes a control mesh whose limit is the zero level set of a field. ``sublimit implicit --help`` describes fields.

    Parameters
    ----------
    field : path of a .json; or the JSON itself, a str that begins with ``{``; or a dictionary. The field is negative inside.
    scheme : scheme of the limit: a name, as in `schemes`, or a `Scheme` (default: ``"catmull-clark"``)
    cells : number of cells along the longest side of the box, 4 or more (default: 0, as the recipe says, else as few as meet
        the tolerance)
    tolerance : largest distance of the limit from the level set, a length (default: 0, 1e-4 of the diagonal of the box)
    option : options of the scheme, {name: value}
    threads : largest number of threads (default: all)

    Raises
    ------
    FormatError
        The recipe cannot be parsed; the message names recipe and field, and what would be right.
    InvalidMesh
        The level set nearly touches itself.
    InvalidParameter
        A tolerance that is negative or not finite, or cells below 4.
    InvalidOption
        An unknown scheme; or the library with OpenVDB is not installed: the message has its package, and how to build it.
    IoError
        The file is missing; or the library with OpenVDB cannot be loaded, or has another version.
    ResourceError
        Not enough memory for the grid.
    """
    asked = request(scheme, option=option)
    made = _sublimit.implicit(recipe_bytes(field, "field"), asked, operator.index(cells), float(tolerance), threads)
    made["mesh"] = Mesh._of(made["mesh"])
    return ImplicitMesh(**made)


def step(surface: LimitSurface | Patches, path: str | os.PathLike[str], *, tolerance: float | None = None,
         join: str = "g0", pack: bool = True, unit: str = "mm", face_names: Iterable[str] | None = None,
         threads: int = 0) -> StepFile:
    """Writes a surface for CAD programs: exact B-spline faces with shared edges, solids where it is closed.

    A limit surface is written without its holes. `Patches` are written as one face for each patch; for them only `tolerance` and
    `unit` matter.

    Parameters
    ----------
    surface : a `LimitSurface` or `Patches`
    path : path that ends in .step, .stp or .brep. The file appears whole or not at all.
    tolerance : largest distance, a length > 0. For limit surfaces: of the caps around extraordinary vertices from the limit
        (default: 1e-5 of the diagonal of the control points). For patches: between sides that become one edge (default: 1e-9 of
        the diagonal).
    join : how caps meet their neighbours: ``"g0"``, at the same points, or ``"g1"``, with the same tangent planes too, which
        needs a scheme of quadrilaterals (default: ``"g0"``)
    pack : join regular faces to the largest B-splines that keep knots and smoothness (default: True)
    unit : unit of the coordinates, written into STEP files: ``"mm"``, ``"m"`` or ``"inch"`` (default: ``"mm"``). Numbers stay.
    face_names : a name for each face of the mesh, empty for none, such as `Mesh.face_names`; faces of different names are not
        packed (default: no names)
    threads : largest number of threads (default: all)

    Raises
    ------
    InvalidOption
        Another extension, another word for `join` or `unit`, or a .brep with another unit than mm; or the library with
        OpenCASCADE is not installed: the message has its package, and how to build it.
    InvalidParameter
        A tolerance that is not positive, or names that are not one for each face.
    InvalidMesh
        No faces, or no extent.
    UnsupportedTopology
        A scheme without polynomials, or a patch that is no B-spline; the message says which and why.
    IoError
        The file cannot be written; or the library with OpenCASCADE cannot be loaded, or has another version.
    ResourceError
        More faces than a file may have, or a full disk.
    TypeError
        `surface` is neither a `LimitSurface` nor `Patches`.
    """
    if not isinstance(surface, (LimitSurface, Patches)):
        raise TypeError(f"surface is a {type(surface).__name__}; a sublimit.LimitSurface or sublimit.Patches is right")
    return StepFile(**_sublimit.step(surface._core, os.fspath(path), None if tolerance is None else float(tolerance),
                                     join, bool(pack), unit, names_of(face_names), threads))
