# SPDX-License-Identifier: Apache-2.0
"""Exact limit surfaces at any place: points, derivatives, normals, curvature, stencils, closest points, rays, triangles."""
from __future__ import annotations

import math
import operator
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, TypeVar, overload

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._errors import InvalidParameter
from ._levels import core_of, csr, warn_of
from ._meshes import Mesh, tag_rows, whole
from ._schemes import OptionValue, Scheme, request

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from ._patches import Patches


@dataclass(frozen=True)
class Curvature:
    """Curvature of a surface at places, per unit of length; NaN where undefined. `Samples.curvature` makes it.

    Attributes
    ----------
    gauss, mean : (...), Gaussian and mean curvature; mean > 0 where the surface bends towards its normal
    k1, k2 : (...), principal curvatures, k1 >= k2
    direction1, direction2 : (..., 3), principal directions of k1 and k2: unit length, in the tangent plane
    """

    __module__ = "sublimit"
    gauss: arrays.Floats
    mean: arrays.Floats
    k1: arrays.Floats
    k2: arrays.Floats
    direction1: arrays.Floats
    direction2: arrays.Floats


class SampledParts:
    """Base class of samples of surfaces and curves: arrays whose first axes are those of the places."""

    statuses: tuple[str, ...] = _sublimit.statuses

    def __init__(self, parts: Mapping[str, Any], shape: tuple[int, ...]) -> None:
        self._parts = {name: part.reshape((*shape, part.shape[1])) for name, part in parts.items() if part.ndim == 2}
        self.points: arrays.Floats = self._parts["points"]
        self.status: npt.NDArray[np.int8] = parts["status"].reshape(shape)
        self.order: npt.NDArray[np.int8] = parts["order"].reshape(shape)

    def _part(self, name: str, derivatives: int) -> arrays.Floats:
        if name not in self._parts:
            raise AttributeError(f"{name} was not asked for: evaluate(..., derivatives={derivatives}) has it")
        part: arrays.Floats = self._parts[name]
        return part

    def __repr__(self) -> str:
        return f"<sublimit.{type(self).__name__}: shape {self.status.shape}>"


class Samples(SampledParts):
    """Points, derivatives and normals at places of a surface, in arrays whose first axes are those of the places.

    Quantities that do not exist at a place are zero; `order` and `status` say which exist.

    Attributes
    ----------
    points : (..., 3), positions
    du, dv, duu, duv, dvv : (..., 3), derivatives per unit of u and v; AttributeError if `evaluate` was called with fewer
    normals : (..., 3), unit normals, zero where undefined; AttributeError if `evaluate` was called without derivatives
    status : (...), int8; ``statuses[number]`` is its name
    order : (...), int8, number of derivatives that exist: 0, 1 or 2
    """

    __module__ = "sublimit"

    @property
    def du(self) -> arrays.Floats:
        """First derivative along u, (..., 3). AttributeError if `evaluate` was called without derivatives."""
        return self._part("du", 1)

    @property
    def dv(self) -> arrays.Floats:
        """First derivative along v, (..., 3). AttributeError if `evaluate` was called without derivatives."""
        return self._part("dv", 1)

    @property
    def duu(self) -> arrays.Floats:
        """Second derivative along u, (..., 3). AttributeError if `evaluate` was called with fewer than 2 derivatives."""
        return self._part("duu", 2)

    @property
    def duv(self) -> arrays.Floats:
        """Mixed second derivative, (..., 3). AttributeError if `evaluate` was called with fewer than 2 derivatives."""
        return self._part("duv", 2)

    @property
    def dvv(self) -> arrays.Floats:
        """Second derivative along v, (..., 3). AttributeError if `evaluate` was called with fewer than 2 derivatives."""
        return self._part("dvv", 2)

    @property
    def normals(self) -> arrays.Floats:
        """Unit normals, (..., 3). AttributeError if `evaluate` was called without derivatives."""
        return self._part("normals", 1)

    def curvature(self) -> Curvature:
        """Returns the curvature; NaN at places without second derivatives, or whose first derivatives do not span a plane.

        Raises
        ------
        InvalidParameter
            `evaluate` was called with fewer than 2 derivatives.
        """
        if "duu" not in self._parts:
            raise InvalidParameter("curvature needs second derivatives: evaluate(..., derivatives=2)")
        shape = self.status.shape
        du, dv, duu, duv, dvv, normals = (np.ascontiguousarray(part, dtype=np.float64).reshape(-1, 3) for part in (
            self.du, self.dv, self.duu, self.duv, self.dvv, self.normals))
        all_of_it = _sublimit.curvatures(du, dv, duu, duv, dvv, normals, np.ascontiguousarray(self.status).reshape(-1),
                                         np.ascontiguousarray(self.order).reshape(-1))
        gauss, mean, k1, k2 = (all_of_it[:, i].reshape(shape) for i in range(4))
        return Curvature(gauss, mean, k1, k2, all_of_it[:, 4:7].reshape((*shape, 3)), all_of_it[:, 7:].reshape((*shape, 3)))


@dataclass(frozen=True)
class ClosestPoints:
    """Nearest points of a surface, in n rows: one for each query, unless `nearest` or `radius` was given.

    Attributes
    ----------
    face, u, v : (n,), place of each point on the surface
    points : (n, 3), points of the surface
    normals : (n, 3), normals there; zero where undefined
    distance : (n,), distance from the query; if signed, negative inside
    lower : (n,), proved lower bound of the distance of the surface without the faces of the query's rows before
        It is the distance up to rounding, or less if the proof was cut short. 0 if nothing is proved, as for schemes without
        polynomials.
    status : (n,), int8; ``Samples.statuses[number]`` is its name
    first : (queries + 1,), rows of query i are ``first[i]:first[i + 1]``, the nearest first
    """

    __module__ = "sublimit"
    face: arrays.Ints
    u: arrays.Floats
    v: arrays.Floats
    points: arrays.Floats
    normals: arrays.Floats
    distance: arrays.Floats
    lower: arrays.Floats
    status: npt.NDArray[np.int8]
    first: npt.NDArray[np.int64]


@dataclass(frozen=True)
class RayHits:
    """Hits of rays with a surface, in n rows, sorted by ray.

    Attributes
    ----------
    t : (n,), parameter of each hit on its ray: the hit is at ``origin + t * direction``
    face, u, v : (n,), place of each hit on the surface
    points : (n, 3), points of the surface; of the ray, if it was given up
    normals : (n, 3), normals there; zero where undefined
    status : (n,), int8; ``Samples.statuses[number]`` is its name; ``outside`` if the ray was given up
    kind : (n,), int8; ``kinds[number]`` is its name
        ``crossing``: the ray passes from one side of the surface to the other. ``touching``: it meets the surface to rounding,
        but no crossing is seen, as where it touches the surface or runs within it. ``given-up``: no hit, the search stopped at
        this t, and hits beyond it may be missing.
    first : (rays + 1,), hits of ray i are ``first[i]:first[i + 1]``, by increasing t
    undecided : (rays,), number of hits of each ray that are no crossings
    """

    __module__ = "sublimit"
    t: arrays.Floats
    face: arrays.Ints
    u: arrays.Floats
    v: arrays.Floats
    points: arrays.Floats
    normals: arrays.Floats
    status: npt.NDArray[np.int8]
    kind: npt.NDArray[np.int8]
    first: npt.NDArray[np.int64]
    undecided: npt.NDArray[np.int64]
    kinds: ClassVar[tuple[str, ...]] = _sublimit.hit_kinds

    @property
    def words(self) -> list[str]:
        """Name of each hit in files: the name of its status for crossings, else the name of its kind."""
        return [self.kinds[kind] if kind else Samples.statuses[status] for kind, status in zip(self.kind, self.status)]


@dataclass(frozen=True)
class Tessellation:
    """Triangles near a surface. `LimitSurface.tessellate` and `Patches.tessellate` make them.

    ``bake(mesh, scheme, tessellation=...)`` makes a table that moves the points with the control mesh.

    Attributes
    ----------
    points : (n, 3), points of the surface
    triangles : (m, 3), rows of `points`, counter-clockwise
    triangle_face : (m,), face of the surface that each triangle lies on, as in places
    corners : (m, 3, 2), parameters (u, v) of the corners of each triangle in that face
    normals : (m, 3, 3), normals of the surface at the corners, at creases on the side of the triangle; zero where undefined
        None unless they were requested.
    face, u, v : (n,), place of each point, on one of the faces that share it
    bound : proved bound of the distance between a point of a triangle and the point of the surface with the same parameters
    cells : number of cells of the surface that were cut into triangles
    """

    __module__ = "sublimit"
    points: arrays.Floats
    triangles: arrays.Ints
    triangle_face: arrays.Ints
    corners: arrays.Floats
    normals: arrays.Floats | None
    face: arrays.Ints
    u: arrays.Floats
    v: arrays.Floats
    bound: float
    cells: int


class Source:
    """Base class of surfaces that are linear in their control points: `LimitSurface` and `Patches`."""

    __module__ = "sublimit"
    __slots__ = ("_core", "__weakref__")
    _core: _sublimit.Source

    @property
    def num_faces(self) -> int:
        """Number of faces that places may be on."""
        return self._core.num_faces

    @property
    def num_points(self) -> int:
        """Number of control points."""
        return self._core.num_points

    def evaluate(self, face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, derivatives: int = 0, *,
                 threads: int = 0) -> Samples:
        """Evaluates places of the surface, exactly up to rounding.

        Parameters
        ----------
        face, u, v : integers, and parameters in the face; arrays that broadcast to one shape
        derivatives : number of derivatives: 0, 1 (du, dv, normals) or 2 (duu, duv, dvv too)
        threads : largest number of threads (default: all)

        Returns
        -------
        Samples, of the broadcast shape

        Raises
        ------
        InvalidParameter
            A face that does not exist, parameters outside of it or not finite.
        InvalidMesh
            A position or a derivative overflows (1.8e308).
        """
        faces, at_u, at_v, shape = places(face, u, v)
        return Samples(self._core.evaluate(faces, at_u, at_v, order(derivatives), threads), shape)

    def stencils(self, face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, derivatives: int = 0, *,
                 threads: int = 0) -> list[csr_array]:
        """Returns the weights that `evaluate` multiplies the control points with, a row for each place of the flattened arrays.

        Parameters
        ----------
        face, u, v : integers, and parameters in the face; arrays that broadcast to one shape
        derivatives : number of derivatives: 0, 1 or 2
        threads : largest number of threads (default: all)

        Returns
        -------
        list of scipy.sparse.csr_array, (places, control points)
            Matrices of the position, then of du, dv, then of duu, duv, dvv, as far as requested. Rows of derivatives that do
            not exist are empty. For rational patches they map homogeneous control points to homogeneous points.

        Raises
        ------
        InvalidParameter
            A face that does not exist, parameters outside of it or not finite.
        ResourceError
            More weights than 32-bit indices count.
        """
        faces, at_u, at_v, _ = places(face, u, v)
        return [csr(parts) for parts in self._core.stencils(faces, at_u, at_v, order(derivatives), threads)[0]]

    def closest(self, points: npt.ArrayLike, *, nearest: int = 1, radius: float = math.inf, signed: bool = False,
                threads: int = 0) -> ClosestPoints:
        """Returns the nearest points of the surface to given points. Holes are left out.

        Parameters
        ----------
        points : (n, 3), the queries
        nearest : number of nearest faces for each query, each with its nearest point; fewer if there are no more (default: 1)
        radius : points of the surface that are farther away are left out, a length (default: infinity)
        signed : give negative distances to queries inside a closed surface (default: False)
        threads : largest number of threads (default: all)

        Raises
        ------
        InvalidParameter
            An array of another shape or type; NaN and infinite numbers; `nearest` below 1, a radius below 0.
        InvalidMesh
            No face that is not a hole.
        UnsupportedTopology
            Signed distances from a surface that is not closed; the message says where.

        Examples
        --------
        >>> import sublimit
        >>> sheet = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
        >>> sublimit.LimitSurface(sheet, "bilinear").closest([[0.25, 0.5, 2]]).distance
        array([2.])
        """
        return ClosestPoints(**self._core.closest(arrays.floats(points, "points", (None, 3), "(n, 3)"), operator.index(nearest),
                                                  float(radius), bool(signed), threads))

    def intersect(self, origins: npt.ArrayLike, directions: npt.ArrayLike, *, tmin: npt.ArrayLike = 0,
                  tmax: npt.ArrayLike = math.inf, all: bool = False, most_parts: int = 8000, threads: int = 0) -> RayHits:
        """Returns the hits of rays with the surface. Holes are left out.

        No hit is missed, and a ray through a side that several faces share has one hit there. For schemes without polynomials
        (``butterfly``, ``kobbelt``, the sqrt3 schemes) the extent of the surface is estimated, and hits may be missed. A ray
        that needs too many cells of the surface is given up, and has a hit of that kind (`RayHits.kind`).

        Parameters
        ----------
        origins : (n, 3) or (3,)
        directions : (n, 3) or (3,), of any length
        tmin, tmax : (n,) or numbers, range of t on each ray ``origin + t * direction`` (default: 0 to infinity)
        all : return all hits, not only the nearest (default: False)
        most_parts : largest number of cells to search within one part of the surface before a ray is given up, 1 or more; 64
            times as many within all parts (default: 8000)
        threads : largest number of threads (default: all)

        Raises
        ------
        InvalidParameter
            An array of another shape or type; a direction of 0, a ray that is not finite or ends before it begins; `most_parts`
            below 1.
        UnsupportedTopology
            Patches that are neither polynomial nor rational (screw surfaces), or that have poles.

        Examples
        --------
        >>> import sublimit
        >>> sheet = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
        >>> sublimit.LimitSurface(sheet, "bilinear").intersect([[0.25, 0.5, 2], [3, 3, 3]], [0, 0, -1]).first
        array([0, 1, 1])
        """
        from_, along = (np.atleast_2d(arrays.floats(x, name, (None,) * max(1, min(2, np.ndim(x))), "(n, 3) or (3,)"))
                        for x, name in ((origins, "origins"), (directions, "directions")))
        try:
            shape = np.broadcast_shapes(from_.shape, along.shape, (1, 3))
            ends = [np.broadcast_to(arrays.floats(t, name, (None,) * min(1, np.ndim(t)), "(n,) or a number", finite=False), shape[:1])
                    for t, name in ((tmin, "tmin"), (tmax, "tmax"))]
        except ValueError as error:
            raise InvalidParameter(f"rays do not fit together: origins {from_.shape}, directions {along.shape}, tmin {np.shape(tmin)}, "
                                   f"tmax {np.shape(tmax)}; (n, 3) or (3,), and (n,) or numbers, are right") from error
        from_, along = (np.ascontiguousarray(np.broadcast_to(x, shape)) for x in (from_, along))
        first, last = (np.ascontiguousarray(t) for t in ends)
        return RayHits(**self._core.intersect(from_, along, first, last, bool(all), operator.index(most_parts), threads))

    def __repr__(self) -> str:
        return f"<sublimit.{type(self).__name__}: {self.num_faces} faces, {self.num_points} control points>"


class LimitSurface(Source):
    """The limit surface of a mesh with its control points. It never changes: threads may share it.

    Places are (face, u, v). A quadrilateral is one face, with u, v in [0, 1] from its first corner. Any other polygon has one
    such face for each corner, numbered as in Ptex. Under schemes for triangles each triangle is one face, with u, v >= 0 and
    u + v <= 1.

    Parameters and errors are those of `refine`.

    Examples
    --------
    >>> import sublimit
    >>> square = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> surface = sublimit.LimitSurface(square, "bilinear")
    >>> surface.evaluate(0, [0, 0.5], 0.25).points
    array([[0.  , 0.25, 0.  ],
           [0.5 , 0.25, 0.  ]])
    """

    __module__ = "sublimit"
    __slots__ = ()
    _core: _sublimit.Surface

    def __init__(self, mesh: Mesh, scheme: Scheme | str, *, boundary: str | None = None, creasing: str | None = None,
                 triangles: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
                 no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
                 crease_smoothing_groups: bool = False, strict: bool = False) -> None:
        asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option,
                        triangulate=triangulate, no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                        crease_smoothing_groups=crease_smoothing_groups, strict=strict)
        self._core = _sublimit.Surface(core_of(mesh), asked)
        warn_of(mesh, asked)

    @property
    def points(self) -> arrays.Floats:
        """Control points, (control points, 3), read-only."""
        return self._core.points

    def with_points(self, points: npt.ArrayLike) -> LimitSurface:
        """Returns the surface with other control points, as in another frame. All that depends on connectivity is shared.

        Parameters
        ----------
        points : (control points, 3), real numbers

        Raises
        ------
        InvalidParameter
            An array of another shape or type; NaN and infinite points.
        """
        shape = self._core.points.shape
        surface = LimitSurface.__new__(LimitSurface)
        surface._core = self._core.with_points(arrays.floats(points, "points", shape, f"({shape[0]} control points, 3)"))
        return surface

    def explain(self, face: int, u: float, v: float) -> dict[str, Any]:
        """Returns how the limit at a place comes about, as `sublimit sample --explain` prints it.

        Parameters
        ----------
        face, u, v : number of a face, and parameters in it

        Returns
        -------
        dict
            ``steps``, a list of pieces from level to level: ``level``, ``piece``, ``u``, ``v``, ``num_points`` that it
            depends on, ``child`` that has the place (-1 for the last piece), ``times`` that the step is repeated; ``end``:
            ``"polynomial"`` of ``degree`` in each parameter (in both together if ``is_total``), or ``"corner"``, an
            eigenvector of a neighbourhood that repeats itself, with its ``spectrum``; ``vertex``, whose limit gives the
            position (-1: none), and its ``rule``; ``status``; ``vertices`` and ``weights`` of the position.

        Raises
        ------
        InvalidParameter
            A face that does not exist, parameters outside of it or not finite.

        Examples
        --------
        >>> import sublimit
        >>> square = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
        >>> sublimit.LimitSurface(square, "bilinear").explain(0, 0.5, 0.25)["weights"]
        array([0.375, 0.375, 0.125, 0.125])
        """
        return self._core.explain(face, u, v)

    def tessellate(self, chord: float, *, angle: float = 0, max_triangles: int = 1 << 24, rates: Any = None,
                   normals: bool = False, threads: int = 0) -> Tessellation:
        """Returns triangles within a proved distance of the surface, without cracks. Holes are left out.

        Parameters
        ----------
        chord : largest distance between a point of a triangle and the point of the surface with the same parameters, a
            length > 0
        angle : largest angle between two normals of a cell, in radians; not enforced around extraordinary vertices (default: 0,
            any)
        max_triangles : largest number of triangles (default: 2**24)
        rates : {(tail, head): segments}, rows (tail, head, segments) or two arrays ``(edges, segments)``, optional
            Least number of segments for an edge of the mesh, >= 1; 1 for edges that are not given.
        normals : compute normals at the corners of triangles (default: False)
        threads : largest number of threads (default: all)

        Raises
        ------
        InvalidParameter
            A chord that is not positive, or a negative angle; a rate of a pair of vertices that is no edge, below 1, or given
            twice.
        UnsupportedTopology
            A scheme whose distances to triangles cannot be proved: without polynomials, or with negative weights at
            extraordinary vertices.
        ResourceError
            More than `max_triangles` triangles.

        Examples
        --------
        >>> import sublimit
        >>> roof = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]], [[0, 1, 2, 3]])
        >>> near = sublimit.LimitSurface(roof, "catmull-clark").tessellate(0.01)
        >>> bool(near.bound <= 0.01)
        True
        """
        return Tessellation(**self._core.tessellate(float(chord), float(angle), operator.index(max_triangles), _rates(rates),
                                                    bool(normals), threads))

    def __reduce__(self) -> NoReturn:
        raise TypeError("a LimitSurface does not pickle: it is made of its mesh faster than it is read; pickle the Mesh")


def closest(surface: Source, points: npt.ArrayLike, *, nearest: int = 1, radius: float = math.inf, signed: bool = False,
            threads: int = 0) -> ClosestPoints:
    """Returns the nearest points of a surface to given points, by its method `closest`.

    Parameters
    ----------
    surface : a `LimitSurface` or `Patches`
    points : (n, 3), the queries
    nearest : number of nearest faces for each query, each with its nearest point; fewer if there are no more (default: 1)
    radius : points of the surface that are farther away are left out, a length (default: infinity)
    signed : give negative distances to queries inside a closed surface (default: False)
    threads : largest number of threads (default: all)

    Raises
    ------
    TypeError
        `surface` is neither, such as a `Mesh`, which has a limit surface only under a scheme.
    InvalidParameter
        An array of another shape or type; NaN and infinite numbers; `nearest` below 1, a radius below 0.
    InvalidMesh
        No face that is not a hole.
    UnsupportedTopology
        Signed distances from a surface that is not closed; the message says where.

    Examples
    --------
    >>> import sublimit
    >>> sheet = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> sublimit.closest(sublimit.LimitSurface(sheet, "bilinear"), [[0.25, 0.5, 2]]).distance
    array([2.])
    """
    return surface_of(surface, Source).closest(points, nearest=nearest, radius=radius, signed=signed, threads=threads)


def intersect(surface: Source, origins: npt.ArrayLike, directions: npt.ArrayLike, *, tmin: npt.ArrayLike = 0,
              tmax: npt.ArrayLike = math.inf, all: bool = False, most_parts: int = 8000, threads: int = 0) -> RayHits:
    """Returns the hits of rays with a surface, by its method `intersect`.

    Parameters
    ----------
    surface : a `LimitSurface` or `Patches`
    origins, directions : (n, 3) or (3,); directions of any length
    tmin, tmax : (n,) or numbers, range of t on each ray ``origin + t * direction`` (default: 0 to infinity)
    all : return all hits, not only the nearest (default: False)
    most_parts : largest number of cells to search within one part of the surface before a ray is given up, 1 or more; 64 times
        as many within all parts (default: 8000)
    threads : largest number of threads (default: all)

    Raises
    ------
    TypeError
        `surface` is neither, such as a `Mesh`, which has a limit surface only under a scheme.
    InvalidParameter
        Arrays of other shapes or types, or that do not fit together; a direction of 0, a ray that is not finite or ends before
        it begins; `most_parts` below 1.
    UnsupportedTopology
        Patches that are neither polynomial nor rational (screw surfaces), or that have poles.

    Examples
    --------
    >>> import sublimit
    >>> sheet = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> sublimit.intersect(sublimit.LimitSurface(sheet, "bilinear"), [0.25, 0.5, 2], [0, 0, -1]).t
    array([2.])
    """
    return surface_of(surface, Source).intersect(origins, directions, tmin=tmin, tmax=tmax, all=all, most_parts=most_parts,
                                                 threads=threads)


@overload
def tessellate(mesh: LimitSurface | Patches, scheme: None = None, *, chord: float, angle: float = 0,
               max_triangles: int = 1 << 24, rates: Any = None, normals: bool = False, threads: int = 0) -> Tessellation: ...
@overload
def tessellate(mesh: Mesh, scheme: Scheme | str, *, chord: float, angle: float = 0, max_triangles: int = 1 << 24,
               rates: Any = None, normals: bool = False, boundary: str | None = None, creasing: str | None = None,
               triangles: str | None = None, face_varying: str | None = None, attributes: str | None = None,
               option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
               orient: bool = False, crease_angle: float | None = None, crease_smoothing_groups: bool = False,
               strict: bool = False, threads: int = 0) -> Mesh: ...


def tessellate(mesh: Mesh | LimitSurface | Patches, scheme: Scheme | str | None = None, *, chord: float, angle: float = 0,
               max_triangles: int = 1 << 24, rates: Any = None, normals: bool = False, boundary: str | None = None,
               creasing: str | None = None, triangles: str | None = None, face_varying: str | None = None,
               attributes: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
               no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
               crease_smoothing_groups: bool = False, strict: bool = False, threads: int = 0) -> Mesh | Tessellation:
    """Returns triangles within a proved distance of a limit surface, without cracks, or of patches.

    The triangles are a `Mesh` if a mesh and a scheme are given, and a `Tessellation` if a `LimitSurface` or `Patches` are given.
    Boundary, creasing and the other keyword arguments that are not listed are those of `refine`; only a `Mesh` takes them.

    Parameters
    ----------
    mesh : a `Mesh`; or a `LimitSurface` or `Patches`, whose method `tessellate` is called
    scheme : for a `Mesh`: name of a scheme, as in `schemes`, or a `Scheme`
    chord, angle, max_triangles, rates, normals, threads : as in `LimitSurface.tessellate`

    Returns
    -------
    Mesh or Tessellation
        A `Mesh` has the texture coordinates of the control mesh, values of vertices by the rule `attributes`, normals at
        corners if `normals` is set, and in `Mesh.face_ids` the face of the control mesh that each triangle lies on, whose names
        and values it has. Holes are left out.

    Raises
    ------
    TypeError
        A `Mesh` without a scheme, or a surface with one; `rates` for `Patches`, which have no edges of a mesh.
    InvalidParameter, UnsupportedTopology, ResourceError
        As `LimitSurface.tessellate` and `Patches.tessellate`.

    Notes
    -----
    Texture coordinates that the scheme cannot refine are left out with a `MeshWarning`. If `face_varying` is given, they raise
    an error instead.

    Examples
    --------
    >>> import sublimit
    >>> roof = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> near = sublimit.tessellate(roof, "catmull-clark", chord=0.01, normals=True)
    >>> bool((near.faces[0] == 3).all()), len(near.normals) == len(near.faces[1])
    (True, True)
    """
    if isinstance(mesh, LimitSurface):
        if scheme is not None:
            raise TypeError("a LimitSurface has its scheme; leave scheme out, or give a Mesh")
        return mesh.tessellate(chord, angle=angle, max_triangles=max_triangles, rates=rates, normals=normals, threads=threads)
    if isinstance(mesh, Source):
        if scheme is not None or rates is not None:
            raise TypeError("patches have neither a scheme nor rates of edges; leave them out")
        from ._patches import Patches
        patches = surface_of(mesh, Patches)
        return patches.tessellate(chord, angle=angle, max_triangles=max_triangles, normals=normals, threads=threads)
    core = core_of(mesh)
    if scheme is None:
        raise TypeError("scheme is missing; a mesh has a limit under a scheme")
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, face_varying=face_varying,
                    attributes=attributes, option=option, triangulate=triangulate, no_creases=no_creases, orient=orient,
                    crease_angle=crease_angle, crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    near = Mesh._of(_sublimit.tessellate(core, asked, float(chord), float(angle), operator.index(max_triangles), _rates(rates),
                                         bool(normals), threads))
    warn_of(mesh, asked, near.warnings)
    return near


_AnySource = TypeVar("_AnySource", bound=Source)


def surface_of(surface: Any, kind: type[_AnySource]) -> _AnySource:
    """Returns `surface` if it is of a given kind.

    Raises
    ------
    TypeError
        A value of another kind.
    """
    if not isinstance(surface, kind):
        raise TypeError(f"surface is a {type(surface).__name__}; a sublimit.LimitSurface or sublimit.Patches is right")
    return surface


def _rates(rates: Any) -> tuple[arrays.Ints, arrays.Ints]:
    """Returns edges, (edges, 2), and their rates, (edges,), as the compiled part takes them."""
    rows = tag_rows(rates, "rates", 3, "{(tail, head): segments}, rows (tail, head, segments) or (edges, segments)")
    edges = whole(rows[:, :2], "rates", "vertex")
    return edges, whole(rows[:, 2], "rates", "the rate")


def order(derivatives: int) -> int:
    """Returns a number of derivatives as an int.

    Raises
    ------
    InvalidParameter
        Another number than 0, 1 and 2.
    """
    if derivatives not in (0, 1, 2):
        raise InvalidParameter(f"derivatives is {derivatives}; 0, 1 or 2 are right")
    return int(derivatives)


def places_of(at: Any) -> tuple[arrays.Ints, arrays.Floats, arrays.Floats]:
    """Returns places as three flat arrays: face, u, v.

    Parameters
    ----------
    at : (face, u, v), arrays that broadcast to one shape; or (face, (u, v)), as `Table.addresses` returns

    Raises
    ------
    InvalidParameter
        Another form; arrays of other types, or that do not broadcast.
    """
    if not isinstance(at, (tuple, list)) or len(at) not in (2, 3):
        raise InvalidParameter("at is not (face, u, v) or (face, (u, v)), as Table.addresses has it")
    if len(at) == 2:
        both = arrays.any_array(at[1], "at")
        if both.ndim < 1 or both.shape[-1] != 2:
            raise InvalidParameter(f"at has (u, v) of shape {both.shape}; (..., 2) is right")
        return places(at[0], both[..., 0], both[..., 1])[:3]
    return places(*at)[:3]


def places(face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike) -> tuple[arrays.Ints, arrays.Floats, arrays.Floats,
                                                                            tuple[int, ...]]:
    """Returns places as three flat arrays, face, u and v, and the shape that the given arrays broadcast to.

    Raises
    ------
    InvalidParameter
        Arrays of other types, or that do not broadcast.
    """
    names = ("face", "u", "v")
    given = [arrays.any_array(part, name) for part, name in ((face, "face"), (u, "u"), (v, "v"))]
    try:
        wide = np.broadcast_arrays(*given)
    except ValueError:
        shapes = ", ".join(f"{name} {part.shape}" for name, part in zip(names, given))
        raise InvalidParameter(f"face, u and v do not broadcast to one shape: {shapes}") from None
    flat = [part.reshape(-1) for part in wide]
    return (arrays.ints(flat[0], "face", (None,), "whole numbers"),
            arrays.floats(flat[1], "u", (None,), "real numbers", finite=False),
            arrays.floats(flat[2], "v", (None,), "real numbers", finite=False), wide[0].shape)
