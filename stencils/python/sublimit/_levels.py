# SPDX-License-Identifier: Apache-2.0
"""Refined meshes, their levels and matrices, and limits of their vertices."""
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
           triangles: str | None = None, face_varying: str | None = None, attributes: str | None = None,
           option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
           orient: bool = False, crease_angle: float | None = None, crease_smoothing_groups: bool = False,
           strict: bool = False, no_tags: bool = False, threads: int = 0, quiet: bool = False) -> Mesh:
    """Returns a level of a mesh, with its texture coordinates, and with the creases, corners and holes that are left on it.

    Refining the result continues the refinement. Faces have the names and values of the faces that they come from.

    Parameters
    ----------
    mesh : the control mesh
    scheme : name of a scheme, as in `schemes`, or a `Scheme`
    levels : number of refinements, 0 or more (default: 1)
    boundary : rule for the boundary: ``"none"``, ``"edge-only"``, ``"edge-and-corner"`` or ``"fixed"`` (default: the rule of the
        mesh, else edge-and-corner)
        ``"fixed"``: vertices of the boundary are infinitely sharp corners, so that it stays the polygon that it is.
    creasing : decay of the sharpness of creases: ``"uniform"`` or ``"chaikin"`` (default: the rule of the mesh, else uniform)
    triangles : weights of Catmull-Clark next to triangles: ``"catmark"`` or ``"smooth"`` (default: the rule of the mesh, else
        catmark)
    face_varying : where texture coordinates are linear, by OpenSubdiv's names (default: the rule of the mesh, else ``"all"``)
    attributes : rule for colours and other values of vertices (default: ``"smooth"``)
        ``"smooth"``: they are refined as points are; ``"linear"``: they are interpolated linearly in faces and along edges;
        ``"drop"``: they are left out, and so are names and values of faces.
    option : options of the scheme, {name: value}
    triangulate : first cut every face into triangles, a fan from its first corner; tags are kept
    no_creases : first drop the crease and corner tags
    orient : first turn faces so that winding is consistent, as few as possible
    crease_angle : first make edges infinitely sharp where the faces beside them bend by more degrees than this, 0 to 180; tags
        of the mesh win (default: none)
    crease_smoothing_groups : first make edges between faces of different `Mesh.smoothing_groups` infinitely sharp; tags of the
        mesh win
    strict : raise InvalidMesh if the mesh is not a clean manifold, or has `Mesh.warnings`
    no_tags : leave the tags out of the result
    threads : largest number of threads (default: all)
    quiet : issue no `MeshWarning`

    Raises
    ------
    InvalidOption
        An unknown scheme, option or word, or a value of an option outside its range; linear attributes of a scheme that does
        not keep vertices and edges.
    InvalidParameter
        Negative levels.
    InvalidMesh
        With `strict`, a mesh that is not a clean manifold, or has warnings; the message names each place. With
        `crease_smoothing_groups`, a mesh without smoothing groups.
    UnsupportedTopology
        A face or a crease that the scheme cannot take; the message says where.
    ResourceError
        Not enough memory, predicted before it is taken.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, face_varying=face_varying,
                    attributes=attributes, option=option, triangulate=triangulate, no_creases=no_creases, orient=orient,
                    crease_angle=crease_angle, crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    fine = Mesh._of(_sublimit.refine(core_of(mesh), asked, levels, not no_tags, threads))
    if not quiet:
        warn_of(mesh, asked, fine.warnings)
    return fine


@dataclass(frozen=True)
class Level:
    """A level of a refined mesh: its connectivity, and the matrix that makes its points.

    Attributes
    ----------
    number : number of the level, 0 for the control mesh
    S : scipy.sparse.csr_array, (vertices of the level, vertices of the previous level), (0, 0) for level 0
        Points of the level are S @ points of the previous level. Its arrays are memory of the library, not copies.
    faces : ``(sizes, corners)``: number of corners of each face, and the vertices of all faces, face by face
    holes : (holes,), numbers of faces that are not part of the surface
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
           no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
           crease_smoothing_groups: bool = False, strict: bool = False, threads: int = 0) -> list[Level]:
    """Returns levels 0 to `levels` of a mesh, each with the matrix that makes its points from those of the previous level.

    Parameters and errors are those of `refine`. `subdivision_matrix` returns the product of the matrices.

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
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    made = _sublimit.levels(core_of(mesh), asked, operator.index(levels), threads)
    warn_of(mesh, asked)
    return [Level(parts["number"], csr(parts["S"]), (parts["sizes"], parts["corners"]), parts["holes"]) for parts in made]


def subdivision_matrix(mesh: Mesh, scheme: Scheme | str, levels: int = 1, *, boundary: str | None = None,
                       creasing: str | None = None, triangles: str | None = None,
                       option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
                       orient: bool = False, crease_angle: float | None = None, crease_smoothing_groups: bool = False,
                       strict: bool = False, threads: int = 0) -> csr_array:
    """Returns the matrix that makes the points of a level from the control points.

    Row i is the stencil of vertex i of ``refine(mesh, scheme, levels)``. Parameters and errors are those of `refine`.

    Returns
    -------
    scipy.sparse.csr_array, (vertices of the level, control points)
        Its arrays are memory of the library, not copies.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    made = _sublimit.subdivision_matrix(core_of(mesh), asked, levels, threads)
    warn_of(mesh, asked)
    return csr(made)


class Limit:
    """Limit positions of all vertices of a level, with normals and tangents of their sides. `limit` makes it.

    A vertex has one side, unless sharp edges, or sheets that meet there, separate its faces: then each side has its own normal
    and tangents.

    Attributes
    ----------
    points : (vertices, 3), limit positions
    normals : (sides, 3), unit normals by the winding of faces; zero where undefined
    tangents : two arrays (sides, 3), characteristic tangents, not of unit length; their cross product is along the normal
    status : (sides,), int8; ``statuses[number]`` is its name
    side_vertex : (sides,), vertex of each side, ascending
    corner_side : (corners,), side of each corner of each face, face by face
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
        """Weights of `points`, a csr_array (vertices, control points): points = matrix @ control points."""
        return csr(self._parts["matrix"])

    @cached_property
    def tangent_matrices(self) -> tuple[csr_array, csr_array]:
        """Weights of both `tangents`, two csr_arrays (sides, control points): tangent = matrix @ control points."""
        first, second = self._parts["tangent_matrices"]
        return csr(first), csr(second)

    def __repr__(self) -> str:
        return f"<sublimit.Limit of {len(self.points)} vertices, {len(self.normals)} sides>"


def limit(mesh: Mesh, scheme: Scheme | str, levels: int = 0, *, boundary: str | None = None, creasing: str | None = None,
          triangles: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
          no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
          crease_smoothing_groups: bool = False, strict: bool = False, threads: int = 0) -> Limit:
    """Computes exact limit positions, tangents and normals of the vertices of a level.

    Parameters and errors are those of `refine`, but for these.

    Parameters
    ----------
    levels : level whose vertices get limits, 0 or more (default: 0, the mesh itself)

    Raises
    ------
    UnsupportedTopology
        The scheme cannot refine the mesh, or does not converge at a vertex; the message says which.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    made = _sublimit.limit(core_of(mesh), asked, operator.index(levels), threads)
    warn_of(mesh, asked)
    return Limit(made)


def warn_of(mesh: Mesh, asked: _sublimit.MeshRequest, further: Sequence[str] = ()) -> None:
    """Issues a `MeshWarning` for each reservation of a scheme about a mesh, for the caller of the calling function.

    At most five are issued, then one with the number of all others.

    Parameters
    ----------
    mesh : the mesh
    asked : the request, with scheme and rules
    further : messages of other warnings, which are issued first
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
