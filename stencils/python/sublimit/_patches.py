# SPDX-License-Identifier: Apache-2.0
"""Classical surfaces: Bezier, B-spline, NURBS and the rest of free-form OBJ files, and those of recipes."""
from __future__ import annotations

import os
from typing import NoReturn

import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._surfaces import Source, order, places_of
from ._tables import Table


class Patches(Source):
    """Free-form surfaces as one: the faces (spans of knots) of one patch after the other. They never change.

    ``Patches.read`` makes them. Places are (face, u, v) with u, v in [0, 1] from one knot to the next; derivatives are by
    the patch's own parameters.
    """

    __module__ = "sublimit"
    __slots__ = ()
    _core: _sublimit.PatchSet

    def __init__(self) -> None:
        raise TypeError("sublimit.Patches.read(path) reads patches")

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Patches:
        """Surfaces of a free-form .obj, or of recipes (.json). Curves are left out, and trimming loops.

        Raises
        ------
        InvalidMesh, UnsupportedTopology
            The file has no surfaces.
        FormatError, IoError
            As `read` does.
        """
        patches = cls.__new__(cls)
        patches._core = _sublimit.PatchSet(os.fspath(path))
        return patches

    @property
    def points(self) -> arrays.Floats:
        """(control points, 3); of rational surfaces (control points, 4), homogeneous: (w x, w y, w z, w). Read-only."""
        return self._core.columns

    @property
    def weights(self) -> arrays.Floats | None:
        """(control points,): the weights of rational surfaces, the last column of `points`."""
        columns = self._core.columns
        return columns[:, 3] if columns.shape[1] == 4 else None

    @property
    def first_faces(self) -> arrays.Ints:
        """(patches + 1,): the first face of each patch, and the end."""
        return self._core.first_faces

    def bake(self, levels: int | None = None, *, grid: int | None = None,
             at: tuple[npt.ArrayLike, ...] | None = None, derivatives: int = 0,
             precision: str = "float", threads: int = 0) -> Table:
        """A table of grids, of places, or of the nets that halving every span so often gives. To be applied to `points`; where
        they are rational, to other ones of the same form, or with weights (`Table.apply`).

        Parameters
        ----------
        levels, grid, at, derivatives, precision : as in `bake`
        """
        if precision not in ("float", "double"):
            raise ValueError(f"precision is {precision!r}; 'float' or 'double' are right")
        if sum(choice is not None for choice in (levels, grid, at)) != 1:
            raise ValueError("a table is of one of levels, grid and at")
        asked = _sublimit.TableRequest()
        asked.rows = "samples" if at is not None else "grid" if grid is not None else "level"
        asked.level = levels or 0
        asked.grid = grid or 0
        asked.derivatives = order(derivatives)
        asked.in_float = precision == "float"
        where = None if at is None else places_of(at)
        return Table._of(_sublimit.bake_patches(self._core, asked, where, threads))

    def __reduce__(self) -> NoReturn:
        raise TypeError("Patches do not pickle; read their file again")
