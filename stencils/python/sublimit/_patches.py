# SPDX-License-Identifier: Apache-2.0
"""Classical surfaces: Bezier, B-spline, NURBS and the rest of free-form .obj files, and those of recipes."""
from __future__ import annotations

import os
from typing import NoReturn

import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._surfaces import Source
from ._tables import Table, bake_options


class Patches(Source):
    """Free-form surfaces as one: the faces (spans of knots) of one patch after the other. They never change.

    `Construction.surfaces` makes them, and ``Patches.read``. Places are (face, u, v) with u, v in [0, 1] from one knot to the
    next; derivatives are by the patch's own parameters.
    """

    __module__ = "sublimit"
    __slots__ = ()
    _core: _sublimit.Patches

    def __init__(self) -> None:
        raise TypeError("sublimit.Patches.read(path) reads patches, sublimit.construct(recipe).surfaces() makes them")

    @classmethod
    def _of(cls, core: _sublimit.Patches) -> Patches:
        patches = cls.__new__(cls)
        patches._core = core
        return patches

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Patches:
        """Surfaces of a free-form .obj, or of recipes (.json): ``construct(path).surfaces()``. Curves are left out, and trimming
        loops.

        Raises
        ------
        InvalidMesh, UnsupportedTopology
            The file has no surfaces.
        FormatError, IoError
            As `construct` does.
        """
        return cls._of(_sublimit.Construction(os.fsencode(path)).surfaces())

    @property
    def points(self) -> arrays.Floats:
        """(control points, 3); of rational surfaces (control points, 4), homogeneous: (w x, w y, w z, w). Read-only."""
        return self._core.columns

    def with_points(self, points: npt.ArrayLike) -> Patches:
        """The surfaces with other control points, as in another frame.

        Parameters
        ----------
        points : of the shape of `points`

        Raises
        ------
        InvalidParameter
            An array of another shape or type; NaN and infinite points.
        """
        shape = self._core.columns.shape
        columns = arrays.floats(points, "points", shape, f"{shape} as Patches.points")
        return Patches._of(self._core.with_points(columns))

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
        options = bake_options(levels, False, grid, at, derivatives, precision, "levels, grid and at")
        return Table._of(_sublimit.bake_patches(self._core, options, threads))

    def __reduce__(self) -> NoReturn:
        raise TypeError("Patches do not pickle; read their file again")
