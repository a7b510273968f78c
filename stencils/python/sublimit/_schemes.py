# SPDX-License-Identifier: Apache-2.0
"""Schemes: those of the library by name, those of your own, and requests to the compiled part."""
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
    """An option of a scheme.

    Attributes
    ----------
    default : value of the option if it is not given
    values : values that the option takes, in words
    meaning : effect of the option, in words
    """

    __module__ = "sublimit"
    default: str
    values: str
    meaning: str


@dataclass(frozen=True)
class SchemeInfo:
    """Properties of a scheme.

    Numbers and `convex_hull` are claims of its authors, which `analyze` checks; None if nothing is claimed.

    Attributes
    ----------
    name : name of the scheme
    kind : ``"surface"`` for schemes of meshes, ``"curve"`` for schemes of polygons
    linear : True if the scheme has masks, and all that is computed from them, such as matrices
    source : author, year and title of the publication
    limit : limit of regular meshes or polygons, in words
    interpolates : True if control points stay where they are
    triangles : True if the scheme takes triangles only
    continuity : k if limits are C^k, for surfaces on regular meshes
    extraordinary_continuity : k if limits of surfaces are C^k at extraordinary vertices
    generates_degree : polynomials up to this degree are limits
    reproduces_degree : polynomials up to this degree are limits of their own values
    convex_hull : True if no weight is negative
    options : {name: OptionInfo}, options that `scheme` accepts
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
    """Returns all schemes of the library, {name: SchemeInfo}, those of surfaces first.

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
    """A subdivision scheme: one of the library, which `scheme` returns, or a subclass that you write.

    A scheme of your own is a subclass with masks as methods. A mask takes a site, the neighbourhood of a new point, and
    returns a stencil, a sum of points of the site with weights. It is called once for each type of neighbourhood and each
    number type: floats for meshes, exact numbers for reports. Weights may be int, Fraction, and the constants
    ``site.ratio(p, q)``, p/q, and ``site.cos_2pi(k, n)``, the cosine of 2 pi k/n, which have the number type of the call.
    An instance of the subclass is used in place of a name by all functions: refine, limit, bake, analyze, ...

    Attributes
    ----------
    name : name of the scheme in messages and files (default: the name of the class)
    source : author, year and title of the publication
    split : connectivity of one refinement step (default: ``"pqq"``)
        ``"pqq"``: an n-gon becomes n quadrilaterals around a face point; ``"ptq"``: a triangle becomes four; ``"dqq"``: a
        point for each corner of a face; ``"mid-edge"``: a point for each edge; ``"sqrt3"``: a triangle becomes three around
        a face point, and old edges flip; ``"quads"``: a point for each face, a quadrilateral for each edge; ``"dual"``: a
        point for each face, a face for each vertex; ``"keep"``: the same connectivity, points move.
    steps : schemes whose masks are applied one after the other in each level, instead of masks of this scheme
    sharpening : elements that may be sharp besides the boundary (default: ``"semi-sharp"``)
        ``"boundary"``: none; ``"sharp"``: edges and vertices of infinite sharpness; ``"semi-sharp"``: any sharpness.
    period : number of levels after which a neighbourhood has its old orientation: 1, or 2 for splits that rotate (mid-edge,
        sqrt3)
    wide_borders : True if `wide_edge` makes the points of border edges too, instead of the crease masks
    corners : number of corners of the faces that the scheme takes, 0 for any; wide masks need faces of one size
    preparation : schemes that turn faces of other sizes into faces with `corners` corners, before level 1
    claims : properties for reports to check, any of ``{"regular": 2, "extraordinary": 1, "generates": 3, "reproduces": 1,
        "convex_hull": True, "interpolates": False}``

    Notes
    -----
    Masks are listed with the members of their sites. Corners and edges of a face count from 0, and -1 is the last one;
    other numbers are errors.

    ``vertex(v)``, Ring
        center, valence, neighbor(i), face(i), diagonal(i) of quadrilaterals, neighbor_mean, face_centroid_mean,
        face_point_mean
    ``edge(e)``, EdgeSite
        tail, head, left_face, right_face; the left face begins with (tail, head), the right one with (head, tail)
    ``face(f)``, and ``corner(f)`` of dqq, FaceSite
        size, corner(i), centroid, point
    ``wide_edge(e)`` instead of edge, WideEdgeSite
        tail, head, tail_ring, head_ring, is_border; both rings count from this edge on, may be open, and have
        has_neighbor(i), is_closed and, if faces are triangles, continued(i)
    ``wide_face(f)`` instead of face, WideFaceSite
        size, corner(i), ring(i), has_across(i), edge_point(i), edge_point_beyond(i)
    ``crease_vertex(v)``, CreaseSite, and ``crease_edge(e)``, CreaseEdgeSite
        center, before, after of the first, tail, head, before, after of the second: points along borders and sharp edges.
        If absent, the splits pqq, ptq and keep take the masks of cubic B-splines

    All sites have level (modulo the period), ratio(p, q) and cos_2pi(k, n). Masks must depend on their site alone: their
    results are cached until an attribute of the scheme is set.

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
        self.__dict__.pop("_known", None)  # the cached results of masks

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
    """A scheme of the library with options, as pairs (name, value); `scheme` returns it."""

    name: str = ""
    options: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return self.name + "".join(f" {name}={value}" for name, value in self.options)


def scheme(name: str, **options: OptionValue) -> Scheme:
    """Returns a scheme of the library with given options.

    Parameters
    ----------
    name : name of the scheme, as in `schemes`
    **options : words or numbers; ``-`` in the name of an option is written ``_``. ``Fraction(3, 4)`` stays exact.

    Raises
    ------
    InvalidOption
        An unknown scheme, an option that the scheme does not have, or a value outside its range.

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
    """Returns options as the compiled part takes them: values as text, and ``-`` in names instead of ``_``."""
    return {name.replace("_", "-"): _text(value) for name, value in options.items()}


def _text(value: OptionValue) -> str:
    return repr(value) if isinstance(value, float) else str(value)


def claim_word(value: object) -> str:
    """Returns the value of a claim as the program writes it: ``yes`` or ``no`` for a bool, else its text."""
    return ("yes" if value else "no") if isinstance(value, bool) else str(value)


def as_scheme(scheme: Scheme | str) -> Scheme:
    """Returns the scheme of a name with its default options; a `Scheme` is returned as it is.

    Raises
    ------
    TypeError
        Neither a name nor an instance of `Scheme`.
    """
    if isinstance(scheme, type) and issubclass(scheme, Scheme):
        raise TypeError(f"scheme is the class {scheme.__name__}; an instance, {scheme.__name__}(), is right")
    if not isinstance(scheme, (str, Scheme)):
        raise TypeError(f"scheme is a {type(scheme).__name__}; a name, what sublimit.scheme makes or a sublimit.Scheme of your "
                        "own is right")
    return NamedScheme(scheme) if isinstance(scheme, str) else scheme


def curve_scheme(scheme: Scheme | str) -> NamedScheme:
    """Returns a curve scheme, which must be one of the library; whether there is one of this name is not checked.

    Raises
    ------
    TypeError
        A scheme of your own, which refines meshes; or neither a name nor a `Scheme`.
    """
    named = as_scheme(scheme)
    if not isinstance(named, NamedScheme):
        raise TypeError(f"{named} refines meshes; schemes of curves go by their names (sublimit.schemes())")
    return named


def request(scheme: Scheme | str, *, boundary: str | None = None, creasing: str | None = None, triangles: str | None = None,
            face_varying: str | None = None, attributes: str | None = None, option: Mapping[str, OptionValue] | None = None,
            triangulate: bool = False, no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
            crease_smoothing_groups: bool = False, strict: bool = False) -> _sublimit.MeshRequest:
    """Returns scheme, rules and flags as a request to the compiled part. The parameters are those of `refine`."""
    own = as_scheme(scheme)
    asked = _sublimit.MeshRequest()
    asked.options = _texts(option or {})
    if isinstance(own, NamedScheme):
        asked.scheme = own.name
        asked.options = {**dict(own.options), **asked.options}
    else:
        asked.use(own._masks())
    words: dict[str, Any] = {"boundary": boundary, "creasing": creasing, "triangles": triangles, "face_varying": face_varying,
                             "attributes": attributes}
    for name, word in words.items():
        setattr(asked, name, word or "")
    asked.triangulate = triangulate
    asked.no_creases = no_creases
    asked.orient = orient
    asked.crease_angle = None if crease_angle is None else float(crease_angle)
    asked.crease_smoothing_groups = crease_smoothing_groups
    asked.strict = strict
    return asked
