# SPDX-License-Identifier: Apache-2.0
"""Schemes by name, and what is asked of them."""
from __future__ import annotations

from collections.abc import Mapping
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
    faces : ``"any"`` or ``"triangles"``; empty for curves
    continuity : C^k on regular meshes; None where nothing is claimed
    extraordinary_continuity : at extraordinary points
    generates_degree : polynomials up to this degree are limits
    reproduces_degree : they are the limits of their own values
    source : author, year, title
    """

    __module__ = "sublimit"
    name: str
    kind: str
    linear: bool
    source: str
    limit: str
    interpolates: bool
    options: Mapping[str, OptionInfo]
    faces: str = ""
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
    >>> sublimit.schemes()["loop"].faces
    'triangles'
    >>> [name for name, info in sublimit.schemes().items() if info.kind == "surface" and info.interpolates]
    ['bilinear', 'butterfly', 'modified-butterfly', 'interpolatory-sqrt3', 'kobbelt', 'torus-pieces', 'nielson', 'piper']
    """
    return dict(_all())


@dataclass(frozen=True)
class Scheme:
    """A scheme with its options; `sublimit.scheme` makes them."""

    __module__ = "sublimit"
    name: str
    options: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return self.name + "".join(f" {name}={value}" for name, value in self.options)


def scheme(name: str, **options: OptionValue) -> Scheme:
    """A scheme with options of its own.

    Parameters
    ----------
    name : as in `schemes`
    **options : words or numbers; ``Fraction(3, 4)`` stays exact

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
    texts = {key: _text(value) for key, value in options.items()}
    _sublimit.check_scheme(name, texts)
    return Scheme(name, tuple(sorted(texts.items())))


def _text(value: OptionValue) -> str:
    return repr(value) if isinstance(value, float) else str(value)


def as_scheme(scheme: Scheme | str) -> Scheme:
    """A name as a scheme with its default options."""
    if not isinstance(scheme, (str, Scheme)):
        raise TypeError(f"scheme is a {type(scheme).__name__}; a name, or what sublimit.scheme makes, is right")
    return Scheme(scheme) if isinstance(scheme, str) else scheme


def request(scheme: Scheme | str, *, boundary: str | None = None, creasing: str | None = None, triangles: str | None = None,
            face_varying: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
            no_creases: bool = False, strict: bool = False) -> _sublimit.MeshRequest:
    """What is asked of a mesh, for the compiled part."""
    own = as_scheme(scheme)
    asked = _sublimit.MeshRequest()
    asked.scheme = own.name
    asked.options = {**dict(own.options), **{key: _text(value) for key, value in (option or {}).items()}}
    words: dict[str, Any] = {"boundary": boundary, "creasing": creasing, "triangles": triangles, "face_varying": face_varying}
    for name, word in words.items():
        setattr(asked, name, word or "")
    asked.triangulate = triangulate
    asked.no_creases = no_creases
    asked.strict = strict
    return asked
