# SPDX-License-Identifier: Apache-2.0
"""Classical surfaces from free-form .obj files (Bezier, B-spline, NURBS, ...) and from recipes."""
from __future__ import annotations

import operator
import os
from typing import NoReturn

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._surfaces import Source, Tessellation
from ._tables import Table, bake_options


class Patches(Source):
    """A set of classical surfaces with their control points. It never changes: threads may share it.

    `Construction.surfaces` and ``Patches.read`` make it. Faces are the knot spans of all patches, patch by patch. Places are
    (face, u, v), with u and v in [0, 1] from one knot to the next; derivatives are per unit of the patch's own parameters.
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
        """Reads the surfaces of a file, without curves and trimming loops; the same as ``construct(path).surfaces()``.

        Parameters
        ----------
        path : path of a free-form .obj, or of recipes, .json

        Raises
        ------
        UnsupportedTopology
            The file has no surfaces.
        InvalidMesh
            The file has neither curves nor surfaces, or curves of a recipe do not meet where they must.
        FormatError
            The file cannot be parsed.
        IoError
            The file is missing or unreadable.
        """
        return cls._of(_sublimit.Construction(os.fsencode(path)).surfaces())

    @property
    def points(self) -> arrays.Floats:
        """Control points, (control points, 3); of rational surfaces (control points, 4): (w x, w y, w z, w). Read-only."""
        return self._core.columns

    def with_points(self, points: npt.ArrayLike) -> Patches:
        """Returns the surfaces with other control points, as in another frame.

        Parameters
        ----------
        points : array of the shape of `Patches.points`, homogeneous if they are

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
        """Weights of rational surfaces, (control points,): the last column of `points`. None if they are not rational."""
        columns = self._core.columns
        return columns[:, 3] if columns.shape[1] == 4 else None

    @property
    def first_faces(self) -> arrays.Ints:
        """First face of each patch, then the number of all faces: (patches + 1,)."""
        return self._core.first_faces

    def tessellate(self, chord: float, *, angle: float = 0, max_triangles: int = 1 << 24, normals: bool = False,
                   threads: int = 0) -> Tessellation:
        """Returns triangles within a proved distance of the surfaces.

        Sides of patches are joined if they are the same curve in the same parameter, up to a thousandth of the chord or a
        millionth of the diagonal, and poles are single points. A side that lies on a part of another one may leave a crack of
        up to twice the chord. Triangles have the orientation of their patches.

        Parameters
        ----------
        chord : largest distance between a point of a triangle and the point of the surface with the same parameters, a
            length > 0
        angle : largest angle between two normals of a cell, in radians; not enforced in cells at a pole that are smaller than
            the chord (default: 0, any)
        max_triangles : largest number of triangles (default: 2**24)
        normals : compute normals at the corners of triangles (default: False)
        threads : largest number of threads (default: all)

        Raises
        ------
        InvalidParameter
            A chord that is not positive, or a negative angle; one that is smaller than rounding.
        UnsupportedTopology
            A face that is no polynomial and no quotient of polynomials, or one with a denominator that vanishes.
        ResourceError
            More than `max_triangles` triangles.

        Examples
        --------
        >>> import sublimit
        >>> plane = {"kind": "bezier_surface", "degree": [1, 1], "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}
        >>> len(sublimit.construct(plane).surfaces().tessellate(0.1).triangles)
        2
        """
        none = np.zeros((0, 2), np.int32), np.zeros(0, np.int32)
        return Tessellation(**self._core.tessellate(float(chord), float(angle), operator.index(max_triangles), none, bool(normals),
                                                    threads))

    def bake(self, levels: int | None = None, *, grid: int | None = None,
             at: tuple[npt.ArrayLike, ...] | None = None, derivatives: int = 0,
             precision: str = "float", threads: int = 0) -> Table:
        """Bakes a table of the patches, for control points of every frame. Give one of `levels`, `grid` and `at`.

        The table of rational patches takes homogeneous control points, such as `points`, or points with weights; see
        `Table.apply`.

        Parameters
        ----------
        levels : k for the control nets after halving every knot span k times
        grid : N for N x N places on each face, sides included
        at : places (face, u, v), arrays that broadcast to one shape; or (face, (u, v)), as `Table.addresses` returns
        derivatives : number of derivatives at the places of `grid` or `at`: 0, 1 or 2 (default: 0)
        precision : of the weights, ``"float"`` or ``"double"`` (default: ``"float"``)
        threads : largest number of threads (default: all)

        Raises
        ------
        InvalidParameter
            None of levels, grid and at, or several; no places, places on no face, numbers outside their range.
        InvalidOption
            Another word for `precision`.
        UnsupportedTopology
            Levels of patches that have no control nets.
        ResourceError
            Not enough memory, predicted before it is taken.
        """
        options = bake_options(levels, False, grid, at, derivatives, precision, "levels, grid and at")
        return Table._of(_sublimit.bake_patches(self._core, options, threads))

    def __reduce__(self) -> NoReturn:
        raise TypeError("Patches do not pickle; read their file again")
