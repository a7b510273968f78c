# SPDX-License-Identifier: Apache-2.0
"""Classical curves and surfaces by recipes."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, NoReturn, Union

import numpy as np

from . import _sublimit
from ._curves import Curves
from ._errors import InvalidParameter
from ._patches import Patches

Recipe = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""A path, the text of a JSON object, or the object as a dictionary."""


class Construction:
    """What recipes make; `construct` makes it. It never changes.

    Attributes
    ----------
    names : of each recipe, or element of an .obj, as messages name it
    notes : what was accepted, but should be known
    """

    __module__ = "sublimit"
    __slots__ = ("_core", "names", "notes", "__weakref__")
    _core: _sublimit.Construction
    names: list[str]
    notes: list[str]

    def __init__(self) -> None:
        raise TypeError("sublimit.construct(recipe) makes constructions")

    @classmethod
    def _of(cls, core: _sublimit.Construction) -> Construction:
        construction = cls.__new__(cls)
        construction._core = core
        construction.names = core.names
        construction.notes = core.notes
        return construction

    def surfaces(self) -> Patches:
        """All surfaces as one.

        Raises
        ------
        UnsupportedTopology, InvalidMesh
            There are none; triangles beside squares.
        """
        return Patches._of(self._core.surfaces())

    def curves(self) -> Curves:
        """All curves as one.

        Raises
        ------
        UnsupportedTopology, InvalidMesh
            There are none.
        """
        return Curves._of(self._core.curves())

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the exact nets as free-form .obj: ``bezier``, ``bspline``, ``rat`` where rational. The file appears whole or not
        at all.

        Raises
        ------
        UnsupportedTopology
            A curve or surface without an exact net, or with one that OBJ cannot hold: which, and why.
        InvalidOption
            Another extension.
        IoError
            Unwritable.
        ResourceError
            A full disk.
        """
        self._core.write(os.fspath(path))

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Construction does not pickle; pickle its recipe")

    def __repr__(self) -> str:
        return f"<sublimit.Construction: {', '.join(self.names)}>"


def construct(recipe: Recipe) -> Construction:
    """The curves and surfaces of a recipe, as ``sublimit construct --help`` describes them, or of a free-form .obj.

    Parameters
    ----------
    recipe : a path, .json or free-form .obj; or the JSON itself, a str that begins with ``{``; or a dictionary
        Numbers of a dictionary may be Fraction, which stays exact, and arrays of NumPy.

    Raises
    ------
    FormatError
        What cannot be understood: names recipe and field, and says what would be right.
    InvalidMesh
        Curves that do not meet where they must, with the gap.
    IoError
        Missing, unreadable.
    ValueError, TypeError
        A dictionary with NaN or infinite numbers, or with what is no JSON.

    Examples
    --------
    >>> import sublimit
    >>> line = sublimit.construct({"kind": "bezier_curve", "degree": 2, "points": [[0, 0, 0], [1, 2, 0], [3, 0, 0]]})
    >>> line
    <sublimit.Construction: recipe 0 (bezier_curve)>
    >>> line.curves().evaluate(0, 0.5).points
    array([1.25, 1.  , 0.  ])
    """
    return Construction._of(_sublimit.Construction(recipe_bytes(recipe, "recipe")))


def recipe_bytes(recipe: Recipe, name: str) -> bytes:
    """A path, or JSON, as the compiled part takes it."""
    if isinstance(recipe, Mapping):
        try:
            return json.dumps(dict(recipe), allow_nan=False, default=_plain).encode()
        except ValueError as error:  # JSON has no numbers that are not finite
            what = "a number that is not finite" if "JSON compliant" in str(error) else str(error)
            raise InvalidParameter(f"{name} has {what}") from None
        except TypeError as error:
            raise TypeError(f"{name}: {error}") from None
    if isinstance(recipe, str) and recipe.lstrip(" \t\r\n").startswith("{"):
        return recipe.encode()
    try:
        return os.fsencode(recipe)
    except TypeError:
        raise TypeError(f"{name} is a {type(recipe).__name__}; a path, JSON or a dict is right") from None


def _plain(value: Any) -> Any:
    """What JSON has for it."""
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, Fraction):
        return str(value)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a {type(value).__name__} is no JSON")
