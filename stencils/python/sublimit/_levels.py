# SPDX-License-Identifier: Apache-2.0
"""Refined meshes, their levels and matrices, and the limits of their vertices."""
from __future__ import annotations

import operator
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _arrays as arrays
from . import _sublimit
from ._errors import MeshWarning
from ._meshes import Mesh
from ._schemes import OptionValue, Scheme, request

if TYPE_CHECKING:
    from scipy.sparse import csr_array


def refine(mesh: Mesh, scheme: Scheme | str, levels: int = 1, *, boundary: str | None = None, creasing: str | None = None,
           triangles: str | None = None, face_varying: str | None = None, option: Mapping[str, OptionValue] | None = None,
           triangulate: bool = False, no_creases: bool = False, strict: bool = False, no_tags: bool = False,
           threads: int = 0, quiet: bool = False) -> Mesh:
    """A finer mesh, with the tags that are left, so that refining it goes on where this stopped.

    Parameters
    ----------
    mesh : the control mesh
    scheme : a name, as in `schemes`, or what `scheme` makes
    levels : 0 or more
    boundary : ``"none"``, ``"edge-only"`` or ``"edge-and-corner"`` (default: the mesh's, else edge-and-corner)
    creasing : how sharpness decays, ``"uniform"`` or ``"chaikin"``
    triangles : Catmull-Clark next to triangles, ``"catmark"`` or ``"smooth"``
    face_varying : where texture coordinates are linear, by OpenSubdiv's names (default: ``"all"``)
    option : options of the scheme by name
    triangulate : first cut every face into triangles, a fan from its first corner
    no_creases : first drop creases and corners
    strict : refuse meshes that are no clean manifolds
    no_tags : leave tags out
    threads : at most so many (default: all)
    quiet : no warnings, `MeshWarning`, of what is no manifold or left out

    Raises
    ------
    InvalidOption
        A scheme, an option or a word that there is not.
    InvalidParameter
        Negative levels.
    UnsupportedTopology
        A face or a crease that the scheme cannot take.
    ResourceError
        More memory than there is, predicted before it is taken.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, face_varying=face_varying, option=option,
                    triangulate=triangulate, no_creases=no_creases, strict=strict)
    fine = Mesh._of(_sublimit.refine(core_of(mesh), asked, levels, not no_tags, threads))
    if not quiet:
        warn_of(mesh, asked, fine.warnings)
    return fine


@dataclass(frozen=True)
class Level:
    """A level of a refined mesh: its connectivity, and the matrix that makes its points.

    Attributes
    ----------
    number : 0 of the control mesh, then 1, 2, ...
    S : scipy.sparse.csr_array, (vertices of the level, vertices of the level before): points = S @ points of that one. (0, 0)
        of level 0. Its arrays are the library's, not copies
    faces : ``(sizes, corners)``
    holes : faces that are no part of the surface
    """

    __module__ = "sublimit"
    number: int
    S: csr_array
    faces: tuple[arrays.Ints, arrays.Ints]
    holes: arrays.Ints

    def __repr__(self) -> str:
        return f"<sublimit.Level {self.number}: {len(self.faces[0])} faces>"


def levels(mesh: Mesh, scheme: Scheme | str, levels: int = 1, *, boundary: str | None = None, creasing: str | None = None,
           triangles: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
           no_creases: bool = False, strict: bool = False, threads: int = 0) -> list[Level]:
    """Levels 0 to `levels` of a mesh, each with the matrix that makes its points from those of the level before.

    The parameters are those of `refine`, and so are the errors. `subdivision_matrix` is the product of the matrices.

    Examples
    --------
    >>> import sublimit
    >>> square = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> points = square.points
    >>> for level in sublimit.levels(square, "catmull-clark", 2)[1:]:
    ...     points = level.S @ points
    >>> points.shape
    (25, 3)
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    made = _sublimit.levels(core_of(mesh), asked, operator.index(levels), threads)
    warn_of(mesh, asked)
    return [Level(parts["number"], csr(parts["S"]), (parts["sizes"], parts["corners"]), parts["holes"]) for parts in made]


def subdivision_matrix(mesh: Mesh, scheme: Scheme | str, levels: int = 1, *, boundary: str | None = None,
                       creasing: str | None = None, triangles: str | None = None,
                       option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
                       strict: bool = False, threads: int = 0) -> csr_array:
    """The points of a level as a matrix times the control points.

    Row i is the stencil of vertex i of ``refine(mesh, scheme, levels)``. The parameters are those of `refine`.

    Returns
    -------
    scipy.sparse.csr_array, (vertices of the level, control points)
        Its arrays are the library's, not copies.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    made = _sublimit.subdivision_matrix(core_of(mesh), asked, levels, threads)
    warn_of(mesh, asked)
    return csr(made)


class Limit:
    """Limits of the vertices of a level.

    A vertex has one side, unless sharp edges or several fans of faces cut the surface apart there: then each side has a
    normal and tangents of its own.

    Attributes
    ----------
    points : (vertices, 3)
    normals : (sides, 3), of length one; zero where there is none
    tangents : two (sides, 3), characteristic tangents; normals are along their cross product
    status : (sides,) numbers; ``statuses[number]`` is the word
    side_vertex : (sides,) the vertex of each
    corner_side : (corners,) the side of each corner of a face
    faces : ``(sizes, corners)`` of the level
    """

    __module__ = "sublimit"
    statuses: tuple[str, ...] = _sublimit.statuses

    def __init__(self, parts: dict[str, Any]) -> None:
        self._parts = parts
        self.points: arrays.Floats = parts["points"]
        self.normals: arrays.Floats = parts["normals"]
        self.tangents: tuple[arrays.Floats, arrays.Floats] = parts["tangents"]
        self.status = parts["status"]
        self.side_vertex: arrays.Ints = parts["side_vertex"]
        self.corner_side: arrays.Ints = parts["corner_side"]
        self.faces: tuple[arrays.Ints, arrays.Ints] = (parts["sizes"], parts["corners"])

    @cached_property
    def matrix(self) -> csr_array:
        """(vertices, control points): limit points = matrix @ control points."""
        return csr(self._parts["matrix"])

    @cached_property
    def tangent_matrices(self) -> tuple[csr_array, csr_array]:
        """Two (sides, control points): tangents = matrix @ control points."""
        first, second = self._parts["tangent_matrices"]
        return csr(first), csr(second)

    def __repr__(self) -> str:
        return f"<sublimit.Limit of {len(self.points)} vertices, {len(self.normals)} sides>"


def limit(mesh: Mesh, scheme: Scheme | str, levels: int = 0, *, boundary: str | None = None, creasing: str | None = None,
          triangles: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
          no_creases: bool = False, strict: bool = False, threads: int = 0) -> Limit:
    """Exact limits, tangents and normals of the vertices of a level. The parameters are those of `refine`.

    Parameters
    ----------
    levels : refinements whose vertices are meant, 0 or more: 0 is the mesh itself

    Raises
    ------
    UnsupportedTopology
        As `refine`; or the scheme has no limit at a vertex.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    made = _sublimit.limit(core_of(mesh), asked, operator.index(levels), threads)
    warn_of(mesh, asked)
    return Limit(made)


def warn_of(mesh: Mesh, asked: _sublimit.MeshRequest, further: Sequence[str] = ()) -> None:
    """Warns, where a function of the package was called, of what its scheme accepts of a mesh: five of them.

    Parameters
    ----------
    further : other warnings, which come first
    """
    found = [*further, *(message for message in _sublimit.warnings(mesh._core, asked) if message not in further)]
    most = 5
    if len(found) > most:
        found[most:] = [f"and {len(found) - most} more (Mesh.warnings and Mesh.faults() have all)"]
    for message in found:
        warnings.warn(message, MeshWarning, stacklevel=3)


def core_of(mesh: Mesh) -> _sublimit.Mesh:
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh is a {type(mesh).__name__}; a sublimit.Mesh is right")
    return mesh._core


def csr(parts: tuple[Any, ...]) -> csr_array:
    from scipy.sparse import csr_array

    weights, columns, starts, shape = parts
    return csr_array((weights, columns, starts), shape=shape, copy=False)
