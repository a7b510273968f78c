# SPDX-License-Identifier: Apache-2.0
"""Classical curves and surfaces from recipes."""
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
"""A recipe: the path of a file, the text of a JSON object, or such an object as a dictionary."""


class Construction:
    """Curves and surfaces made from recipes, or read from a free-form .obj. `construct` makes it. It never changes.

    Attributes
    ----------
    names : list of str, the name of each recipe, or of each element of the .obj, as in messages
    notes : list of str, warnings about accepted input
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
        """Returns all surfaces as one set of patches.

        Raises
        ------
        UnsupportedTopology
            There are none, or there are triangular patches besides others.
        InvalidMesh
            The product of a coordinate and its weight overflows.
        """
        return Patches._of(self._core.surfaces())

    def curves(self) -> Curves:
        """Returns all curves as one set of curves.

        Raises
        ------
        UnsupportedTopology
            There are none.
        InvalidMesh
            The product of a coordinate and its weight overflows.
        """
        return Curves._of(self._core.curves())

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the exact control nets as free-form .obj: ``bezier``, ``bspline``, with ``rat`` if rational.

        The file appears whole or not at all.

        Parameters
        ----------
        path : path that ends in .obj

        Raises
        ------
        UnsupportedTopology
            A curve or surface has no exact net, or one that OBJ cannot hold; the message says which and why.
        InvalidOption
            Another extension than .obj.
        IoError
            The file cannot be written.
        ResourceError
            The disk is full.
        """
        self._core.write(os.fspath(path))

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Construction does not pickle; pickle its recipe")

    def __repr__(self) -> str:
        return f"<sublimit.Construction: {', '.join(self.names)}>"


def construct(recipe: Recipe) -> Construction:
    """Makes the curves and surfaces of a recipe or of a free-form .obj. ``sublimit construct --help`` describes recipes.

    Parameters
    ----------
    recipe : path of a .json or a free-form .obj; or the JSON itself, a str that begins with ``{``; or a dictionary
        Numbers in a dictionary may also be Fraction, which stays exact, and NumPy arrays.

    Raises
    ------
    FormatError
        The recipe cannot be parsed; the message names recipe and field, and what would be right.
    InvalidMesh
        Curves do not meet where they must; the message has the gap.
    IoError
        The file is missing or unreadable.
    InvalidParameter
        A dictionary has NaN or infinite numbers.
    TypeError
        The recipe is of another type, or a dictionary has a value that JSON cannot hold.

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
    """Returns a recipe as the compiled part takes it: the bytes of its path or of its JSON.

    Parameters
    ----------
    recipe : path, text of a JSON object, or dictionary
    name : name of the argument, for messages
    """
    if isinstance(recipe, Mapping):
        try:
            return json.dumps(dict(recipe), allow_nan=False, default=_plain).encode()
        except ValueError as error:  # JSON has neither NaN nor infinity
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
    """Returns a value of another type as one that the json module can write; for ``json.dumps(default=...)``."""
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, Fraction):
        return str(value)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a {type(value).__name__} is no JSON")
