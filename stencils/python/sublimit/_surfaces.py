# SPDX-License-Identifier: Apache-2.0
"""The exact limit anywhere: points, derivatives, normals, curvature, stencils, closest points, rays."""
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


@dataclass(frozen=True)
class Curvature:
    """Curvature of a surface; NaN where there is none.

    Attributes
    ----------
    gauss, mean : (...); mean > 0 where the surface bends towards its normal
    k1, k2 : (...), principal curvatures, k1 >= k2
    direction1, direction2 : (..., 3), their directions: of length one, in the tangent plane
    """

    __module__ = "sublimit"
    gauss: arrays.Floats
    mean: arrays.Floats
    k1: arrays.Floats
    k2: arrays.Floats
    direction1: arrays.Floats
    direction2: arrays.Floats


class SampledParts:
    """What samples of surfaces and curves have alike: arrays of the shape of the places."""

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
    """What there is at places of a surface. What does not exist is zero; `order` and `status` say what does.

    Attributes
    ----------
    points : (..., 3)
    du, dv, duu, duv, dvv : (..., 3), per unit of u and v; AttributeError if they were not asked for
    normals : (..., 3), of length one; zero where there is none; likewise
    status : (...), numbers; ``statuses[number]`` is the word
    order : (...), derivatives that there are: 0, 1 or 2
    """

    __module__ = "sublimit"

    @property
    def du(self) -> arrays.Floats:
        """(..., 3): the derivative along u."""
        return self._part("du", 1)

    @property
    def dv(self) -> arrays.Floats:
        """(..., 3): the derivative along v."""
        return self._part("dv", 1)

    @property
    def duu(self) -> arrays.Floats:
        """(..., 3): the second derivative along u."""
        return self._part("duu", 2)

    @property
    def duv(self) -> arrays.Floats:
        """(..., 3): the mixed derivative."""
        return self._part("duv", 2)

    @property
    def dvv(self) -> arrays.Floats:
        """(..., 3): the second derivative along v."""
        return self._part("dvv", 2)

    @property
    def normals(self) -> arrays.Floats:
        """(..., 3): unit normals."""
        return self._part("normals", 1)

    def curvature(self) -> Curvature:
        """Curvature where there are two derivatives and the first ones span a plane.

        Raises
        ------
        InvalidParameter
            The samples were taken with fewer derivatives.
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
    """Nearest points of a surface, a row each: n of n points, unless ``nearest`` or ``radius`` was given.

    Attributes
    ----------
    face, u, v : (n,), where they are
    points : (n, 3)
    normals : (n, 3), there; zero where there is none
    distance : (n,), from the points given; below 0 inside, if signed
    lower : (n,), the surface, less the faces of the rows before, is not nearer, as is proved: the distance but for rounding,
        less where the proof was cut short; 0 where nothing is proved, as of schemes without polynomials
    status : (n,), numbers; ``Samples.statuses[number]`` is the word
    first : (points + 1,), rows of point i are ``first[i]:first[i + 1]``, the nearest first
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
    """Where rays meet a surface, a row each hit.

    Attributes
    ----------
    t : (n,), hits are at ``origin + t * direction``
    face, u, v : (n,), where they are
    points : (n, 3)
    normals : (n, 3), there; zero where there is none
    status : (n,), numbers; ``Samples.statuses[number]`` is the word
    kind : (n,), numbers; ``kinds[number]`` is the word: ``crossing``; ``touching`` where the ray touches the surface or runs
        within it, as near as numbers go; ``given-up`` where the search stopped, with the point of the ray there: what the
        ray meets from this t on may not be all
    first : (rays + 1,), hits of ray i are ``first[i]:first[i + 1]``, by rising t
    undecided : (rays,), how many hits of a ray are no crossings
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
        """The word of each hit, as files have it: of its kind, or of its status where the ray crosses."""
        return [self.kinds[kind] if kind else Samples.statuses[status] for kind, status in zip(self.kind, self.status)]


@dataclass(frozen=True)
class Tessellation:
    """Triangles near a surface, without cracks.

    Attributes
    ----------
    points : (n, 3), of the limit
    triangles : (m, 3), their corners, counter-clockwise
    triangle_face : (m,), the face of the surface that each is on
    corners : (m, 3, 2), (u, v) of its corners there
    normals : (m, 3, 3), of the surface at the corners, of this face's side at creases; zero where there is none. None if they
        were not asked for
    face, u, v : (n,), places of the points: ``bake(mesh, scheme, tessellation=it)`` makes a table that follows a moving mesh
    bound : no point of a triangle is farther from that of the surface with the same parameters
    cells : of triangles, that the bound was proved for
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
    """A surface that is linear in its control points: of a mesh (`LimitSurface`), of patches (`Patches`)."""

    __module__ = "sublimit"
    __slots__ = ("_core", "__weakref__")
    _core: _sublimit.Source

    @property
    def num_faces(self) -> int:
        """Faces that places may be on."""
        return self._core.num_faces

    @property
    def num_points(self) -> int:
        """Control points."""
        return self._core.num_points

    def evaluate(self, face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, derivatives: int = 0, *,
                 threads: int = 0) -> Samples:
        """Points of the surface, exact to rounding.

        Parameters
        ----------
        face, u, v : arrays that broadcast to one shape
        derivatives : 0, 1 or 2

        Returns
        -------
        Samples, of the broadcast shape

        Raises
        ------
        InvalidParameter
            A face that there is not, parameters outside of it or not finite.
        InvalidMesh
            A position or a derivative larger than numbers are (1.8e308).
        """
        faces, at_u, at_v, shape = places(face, u, v)
        return Samples(self._core.evaluate(faces, at_u, at_v, order(derivatives), threads), shape)

    def stencils(self, face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, derivatives: int = 0, *,
                 threads: int = 0) -> list[csr_array]:
        """What `evaluate` multiplies control points with: a row for each place, in the order of the broadcast array.

        Returns
        -------
        list of scipy.sparse.csr_array, (places, control points)
            Position; du, dv; duu, duv, dvv, as many as asked for. Rows of what does not exist are empty.
        """
        faces, at_u, at_v, _ = places(face, u, v)
        return [csr(parts) for parts in self._core.stencils(faces, at_u, at_v, order(derivatives), threads)[0]]

    def closest(self, points: npt.ArrayLike, *, nearest: int = 1, radius: float = math.inf, signed: bool = False,
                threads: int = 0) -> ClosestPoints:
        """Nearest points of the surface.

        Parameters
        ----------
        points : (n, 3)
        nearest : number of nearest faces of each point, with the nearest place on each; fewer where there are no more
        radius : what is farther is left out
        signed : distances of points inside are below 0

        Raises
        ------
        UnsupportedTopology
            Signed distances from a surface that is not closed.

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
        """Where rays meet the surface; none is missed, and a ray through a side that faces share hits once.

        Of schemes without polynomials (``butterfly``, ``kobbelt``, the sqrt3) every hit is one, but that there are no
        others is estimated. A ray that meets too much of the surface is given up, and has a hit that says so
        (`RayHits.kind`).

        Parameters
        ----------
        origins : (n, 3) or (3,)
        directions : (n, 3) or (3,), of any length
        tmin, tmax : (n,) or numbers, of ``origin + t * direction``
        all : all hits, not the nearest alone
        most_parts : to look at within one part of the surface, and 64 times as many in all, before a ray is given up

        Raises
        ------
        InvalidParameter
            A direction of 0, a ray that is not finite or ends before it begins.
        UnsupportedTopology
            Patches that are neither polynomials nor quotients of them (screw surfaces), or have poles.

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
    """The limit surface of a mesh. It never changes; threads may share it.

    Places are (face, u, v): a quadrilateral is one face, [0,1] x [0,1] from its first corner; another polygon is one for
    each corner, numbered as Ptex does; under schemes for triangles each triangle is one, u, v >= 0, u + v <= 1.

    Parameters
    ----------
    mesh, scheme and options : as in `refine`

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
                 no_creases: bool = False, strict: bool = False) -> None:
        asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option,
                        triangulate=triangulate, no_creases=no_creases, strict=strict)
        self._core = _sublimit.Surface(core_of(mesh), asked)
        warn_of(mesh, asked)

    @property
    def points(self) -> arrays.Floats:
        """(control points, 3): those of the mesh, read-only."""
        return self._core.points

    def with_points(self, points: npt.ArrayLike) -> LimitSurface:
        """The surface with other control points, as in another frame: what depends on connectivity is shared, not made again.

        Parameters
        ----------
        points : (control points, 3)

        Raises
        ------
        InvalidParameter
            An array of another shape or type; NaN and infinite points.
        """
        shape = self._core.points.shape
        surface = LimitSurface.__new__(LimitSurface)
        surface._core = self._core.with_points(arrays.floats(points, "points", shape, f"({shape[0]} control points, 3)"))
        return surface

    def tessellate(self, chord: float, *, angle: float = 0, max_triangles: int = 1 << 24, rates: Any = None,
                   normals: bool = False, threads: int = 0) -> Tessellation:
        """As few triangles as a proved bound on their distance from the surface allows.

        Parameters
        ----------
        chord : largest distance, > 0
        angle : largest angle between two normals in the cell of a triangle, in radians, but not at extraordinary vertices;
            0: any
        max_triangles : ResourceError if more are needed
        rates : {(tail, head): segments}, rows (tail, head, segments) or ``(edges, segments)``, two arrays, optional
            Into how many segments an edge of the mesh is cut at least; 1 where there is none
        normals : whether corners of triangles have normals

        Raises
        ------
        InvalidParameter
            A chord that is not positive, a negative angle; rates of what is no edge, below 1, or two of an edge.
        UnsupportedTopology
            A scheme without polynomials: nothing is proved there.
        ResourceError
            More triangles than allowed.

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
    """Nearest points of a `LimitSurface` or of `Patches`: their method `closest`.

    Parameters
    ----------
    surface : a `LimitSurface` or `Patches`
    points : (n, 3)
    nearest : number of nearest faces of each point, with the nearest place on each
    radius : what is farther is left out, a length
    signed : distances of points inside are below 0

    Raises
    ------
    TypeError
        Another surface, such as a `Mesh`, which has one under a scheme.
    InvalidParameter
        Points of another shape or type, NaN and infinite ones; `nearest` below 1, a radius below 0.
    InvalidMesh
        No face that is not a hole.
    UnsupportedTopology
        Signed distances from a surface that is not closed.

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
    """Where rays meet a `LimitSurface` or `Patches`: their method `intersect`.

    Parameters
    ----------
    surface : a `LimitSurface` or `Patches`
    origins, directions : (n, 3) or (3,); directions of any length
    tmin, tmax : (n,) or numbers, of ``origin + t * direction``
    all : all hits, not the nearest alone
    most_parts : to look at within one part of the surface, before a ray is given up

    Raises
    ------
    TypeError
        Another surface, such as a `Mesh`, which has one under a scheme.
    InvalidParameter
        Rays of other shapes or types, or that do not fit together, NaN and infinite ones; a
        direction of 0, a ray that ends before it begins.
    UnsupportedTopology
        Patches that are neither polynomials nor quotients of them, or have poles.

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
def tessellate(mesh: LimitSurface, scheme: None = None, *, chord: float, angle: float = 0, max_triangles: int = 1 << 24,
               rates: Any = None, normals: bool = False, threads: int = 0) -> Tessellation: ...
@overload
def tessellate(mesh: Mesh, scheme: Scheme | str, *, chord: float, angle: float = 0, max_triangles: int = 1 << 24,
               rates: Any = None, normals: bool = False, boundary: str | None = None, creasing: str | None = None,
               triangles: str | None = None, face_varying: str | None = None, option: Mapping[str, OptionValue] | None = None,
               triangulate: bool = False, no_creases: bool = False, strict: bool = False, threads: int = 0) -> Mesh: ...


def tessellate(mesh: Mesh | LimitSurface, scheme: Scheme | str | None = None, *, chord: float, angle: float = 0,
               max_triangles: int = 1 << 24, rates: Any = None, normals: bool = False, boundary: str | None = None,
               creasing: str | None = None, triangles: str | None = None, face_varying: str | None = None,
               option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
               strict: bool = False, threads: int = 0) -> Mesh | Tessellation:
    """Triangles near the limit of a mesh, as a mesh; or those of a `LimitSurface`, which is its method `tessellate`.

    Parameters
    ----------
    mesh : a `Mesh`, with the scheme and rules as in `refine`; or a `LimitSurface`, without
    chord, angle, max_triangles, rates, normals : as in `LimitSurface.tessellate`

    Returns
    -------
    Mesh or Tessellation
        The mesh has its texture coordinates, normals of corners, if they are wanted, and in `Mesh.face_ids` the face of the
        control mesh that each triangle lies on. Holes are left out.

    Raises
    ------
    InvalidParameter, UnsupportedTopology, ResourceError
        As `LimitSurface.tessellate`.

    Notes
    -----
    Texture coordinates that the scheme has no limit of are left out with a `MeshWarning`; if `face_varying` is given they are
    an error.

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
    core = core_of(mesh)
    if scheme is None:
        raise TypeError("scheme is missing; a mesh has a limit under a scheme")
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, face_varying=face_varying, option=option,
                    triangulate=triangulate, no_creases=no_creases, strict=strict)
    near = Mesh._of(_sublimit.tessellate(core, asked, float(chord), float(angle), operator.index(max_triangles), _rates(rates),
                                         bool(normals), threads))
    warn_of(mesh, asked, near.warnings)
    return near


_AnySource = TypeVar("_AnySource", bound=Source)


def surface_of(surface: Any, kind: type[_AnySource]) -> _AnySource:
    """What a function is to be given."""
    if not isinstance(surface, kind):
        raise TypeError(f"surface is a {type(surface).__name__}; a sublimit.LimitSurface or sublimit.Patches is right")
    return surface


def _rates(rates: Any) -> tuple[arrays.Ints, arrays.Ints]:
    """Edges and their rates, as the compiled part takes them."""
    rows = tag_rows(rates, "rates", 3, "{(tail, head): segments}, rows (tail, head, segments) or (edges, segments)")
    edges = whole(rows[:, :2], "rates", "vertex")
    return edges, whole(rows[:, 2], "rates", "the rate")


def order(derivatives: int) -> int:
    """As the compiled part takes it."""
    if derivatives not in (0, 1, 2):
        raise InvalidParameter(f"derivatives is {derivatives}; 0, 1 or 2 are right")
    return int(derivatives)


def places_of(at: Any) -> tuple[arrays.Ints, arrays.Floats, arrays.Floats]:
    """Flat arrays of (face, u, v), or of (face, (u, v)), as tables have them."""
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
    """Three flat arrays, and the shape that theirs broadcast to."""
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
