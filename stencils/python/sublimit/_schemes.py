# SPDX-License-Identifier: Apache-2.0
"""Schemes by name, and what is asked of them."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any, Union

from . import _sublimit

OptionValue = Union[str, int, float, Fraction]


@dataclass(frozen=True)
class OptionInfo:
    """An option of a scheme: its default, the values it takes and what it means, in words."""

    __module__ = "sublimit"
    default: str
    values: str
    meaning: str


@dataclass(frozen=True)
class SchemeInfo:
    """What a scheme is said to do.

    Attributes
    ----------
    kind : ``"surface"`` or ``"curve"``
    linear : whether it has matrices
    source : author, year, title
    limit : what it is, in words
    interpolates : whether control points stay
    triangles : whether it takes triangles only
    continuity : C^k on regular meshes; None where nothing is claimed
    extraordinary_continuity : at extraordinary points
    generates_degree : polynomials up to this degree are limits
    reproduces_degree : they are the limits of their own values
    convex_hull : whether no weight is negative
    options : by name, as `scheme` takes them
    """

    __module__ = "sublimit"
    name: str
    kind: str
    linear: bool
    source: str
    limit: str
    interpolates: bool
    options: Mapping[str, OptionInfo]
    triangles: bool = False
    continuity: int | None = None
    extraordinary_continuity: int | None = None
    generates_degree: int | None = None
    reproduces_degree: int | None = None
    convex_hull: bool | None = None


@lru_cache(maxsize=1)
def _all() -> dict[str, SchemeInfo]:
    infos = {}
    for one in _sublimit.schemes():
        one["options"] = {name: OptionInfo(*option) for name, option in one["options"].items()}
        infos[one["name"]] = SchemeInfo(**one)
    return infos


def schemes() -> dict[str, SchemeInfo]:
    """Every scheme by its name.

    Examples
    --------
    >>> import sublimit
    >>> sublimit.schemes()["loop"].triangles
    True
    >>> [name for name, info in sublimit.schemes().items() if info.kind == "surface" and info.interpolates]
    ['bilinear', 'butterfly', 'modified-butterfly', 'interpolatory-sqrt3', 'kobbelt', 'torus-pieces', 'nielson', 'piper']
    """
    return dict(_all())


class Scheme:
    """A scheme: one by name, as `scheme` makes them, or one of your own.

    A scheme of your own is a class with its masks as methods. A mask takes a site, the neighbourhood of the new point,
    and returns a stencil, a sum of the site's points with weights. It is called once for each type of neighbourhood and
    of number: with floats for meshes, with exact numbers for reports, where weights may be int, Fraction, and
    ``site.ratio(p, q)`` and ``site.cos_2pi(k, n)`` (the cosine of k/n of a turn), which are what the site computes with.
    An instance is used like a name: refine, limit, tables, reports.

    Attributes
    ----------
    name : of the scheme in messages and files (default: that of the class)
    source : author, year, title
    split : ``"pqq"`` faces become quadrilaterals around a point of their own, ``"ptq"`` triangles become four, ``"dqq"``
        a point for each corner of a face, ``"mid-edge"`` a point for each edge, ``"sqrt3"`` triangles around points of
        faces, ``"quads"`` an edge becomes a quadrilateral, ``"dual"`` faces become points, ``"keep"`` points move
    steps : schemes whose masks make a level, one after the other, instead of masks of its own
    sharpening : what may be sharp, ``"boundary"`` alone, what is ``"sharp"`` for ever, or ``"semi-sharp"``
    period : levels after which masks and neighbourhoods repeat: 2 where the split turns (mid-edge, sqrt3)
    wide_borders : `wide_edge` makes points of borders too
    corners : of the faces that it takes, 0 for any; wide masks need faces of one size
    preparation : schemes that make such faces of others, at level 0
    claims : what it is said to do, for reports: ``{"regular": 2, "extraordinary": 1, "generates": 3, "reproduces": 1,
        "convex_hull": True, "interpolates": False}``, any of them

    Notes
    -----
    The masks, and what their sites have (corners and edges of a face count from 0, and -1 is the last one; others are
    errors):

    ``vertex(v)``, Ring
        center, valence, neighbor(i), face(i), diagonal(i) of quadrilaterals, neighbor_mean, face_centroid_mean,
        face_point_mean
    ``edge(e)``, EdgeSite
        tail, head, left_face, right_face; the left face begins with (tail, head), the right one with (head, tail)
    ``face(f)``, and ``corner(f)`` of dqq, FaceSite
        size, corner(i), centroid, point
    ``wide_edge(e)`` instead of edge, WideEdgeSite
        tail, head, tail_ring, head_ring, is_border; rings, also of vertices at borders, count from this edge on, and
        have has_neighbor(i), is_closed and, of triangles, continued(i)
    ``wide_face(f)`` instead of face, WideFaceSite
        size, corner(i), ring(i), has_across(i), edge_point(i), edge_point_beyond(i)
    ``crease_vertex(v)``, CreaseSite, and ``crease_edge(e)``, CreaseEdgeSite
        center, before, after; tail, head, before, after: along borders and sharp edges. Where a scheme with split pqq,
        ptq or keep has none, it has those of cubic B-splines

    All sites have level (modulo the period), ratio(p, q) and cos_2pi(k, n). Masks must depend on nothing else: what one
    has returned is kept until an attribute of the scheme is set.

    Examples
    --------
    >>> import sublimit
    >>> class Corners(sublimit.Scheme):
    ...     split = "dqq"
    ...     def corner(self, f):
    ...         return (9 * f.corner(0) + 3 * f.corner(1) + 3 * f.corner(-1) + f.corner(2)) / 16
    ...     def crease_edge(self, e):
    ...         return (3 * e.tail + e.head) / 4
    >>> square = sublimit.Mesh([[0, 0, 0], [16, 0, 0], [16, 16, 0], [0, 16, 0]], [[0, 1, 2, 3]])
    >>> sublimit.refine(square, Corners()).points[0]
    array([4., 4., 0.])
    """

    __module__ = "sublimit"
    name: str = ""
    source: str = ""
    split: str = "pqq"
    steps: Sequence[Scheme] = ()
    sharpening: str = "semi-sharp"
    period: int = 1
    wide_borders: bool = False
    corners: int = 0
    preparation: Sequence[Scheme] = ()
    claims: Mapping[str, int | bool] = {}

    def __setattr__(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)
        self.__dict__.pop("_known", None)  # what masks returned before

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_known"}

    def __str__(self) -> str:
        return self.name or type(self).__name__

    def _step(self) -> _sublimit.OwnStep:
        known = self.__dict__.setdefault("_known", _sublimit.KnownMasks())
        return _sublimit.OwnStep(self, known, self.split, self.wide_borders)

    def _masks(self) -> _sublimit.OwnScheme:
        claims = [f"{name.replace('_', '-')}={claim_word(value)}" for name, value in self.claims.items()]
        steps = [step._step() for step in (self.steps or (self,))]
        preparation = [step._step() for step in self.preparation]
        return _sublimit.OwnScheme(steps, str(self), self.source, self.sharpening, self.period, self.corners, preparation, claims)


@dataclass(frozen=True)
class NamedScheme(Scheme):
    """A scheme of the library with its options."""

    name: str = ""
    options: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return self.name + "".join(f" {name}={value}" for name, value in self.options)


def scheme(name: str, **options: OptionValue) -> Scheme:
    """A scheme with options of its own.

    Parameters
    ----------
    name : as in `schemes`
    **options : words or numbers, ``-`` of a name written ``_``; ``Fraction(3, 4)`` stays exact

    Raises
    ------
    InvalidOption
        No such scheme; an option that it does not know, or a value outside its range.

    Examples
    --------
    >>> from fractions import Fraction
    >>> import sublimit
    >>> print(sublimit.scheme("kobbelt", tension=Fraction(3, 4)))
    kobbelt tension=3/4
    """
    texts = _texts(options)
    _sublimit.check_scheme(name, texts)
    return NamedScheme(name, tuple(sorted(texts.items())))


def _texts(options: Mapping[str, OptionValue]) -> dict[str, str]:
    """As the compiled part takes them: names have ``-`` where arguments have ``_``."""
    return {name.replace("_", "-"): _text(value) for name, value in options.items()}


def _text(value: OptionValue) -> str:
    return repr(value) if isinstance(value, float) else str(value)


def claim_word(value: object) -> str:
    """A claim as the program takes it."""
    return ("yes" if value else "no") if isinstance(value, bool) else str(value)


def as_scheme(scheme: Scheme | str) -> Scheme:
    """A name as a scheme with its default options."""
    if isinstance(scheme, type) and issubclass(scheme, Scheme):
        raise TypeError(f"scheme is the class {scheme.__name__}; an instance, {scheme.__name__}(), is right")
    if not isinstance(scheme, (str, Scheme)):
        raise TypeError(f"scheme is a {type(scheme).__name__}; a name, what sublimit.scheme makes or a sublimit.Scheme of your "
                        "own is right")
    return NamedScheme(scheme) if isinstance(scheme, str) else scheme


def curve_scheme(scheme: Scheme | str) -> NamedScheme:
    """A scheme of curves, which are the library's."""
    named = as_scheme(scheme)
    if not isinstance(named, NamedScheme):
        raise TypeError(f"{named} refines meshes; schemes of curves go by their names (sublimit.schemes())")
    return named


def request(scheme: Scheme | str, *, boundary: str | None = None, creasing: str | None = None, triangles: str | None = None,
            face_varying: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
            no_creases: bool = False, strict: bool = False) -> _sublimit.MeshRequest:
    """What is asked of a mesh, for the compiled part."""
    own = as_scheme(scheme)
    asked = _sublimit.MeshRequest()
    asked.options = _texts(option or {})
    if isinstance(own, NamedScheme):
        asked.scheme = own.name
        asked.options = {**dict(own.options), **asked.options}
    else:
        asked.use(own._masks())
    words: dict[str, Any] = {"boundary": boundary, "creasing": creasing, "triangles": triangles, "face_varying": face_varying}
    for name, word in words.items():
        setattr(asked, name, word or "")
    asked.triangulate = triangulate
    asked.no_creases = no_creases
    asked.strict = strict
    return asked
