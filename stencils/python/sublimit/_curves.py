# SPDX-License-Identifier: Apache-2.0
"""Limit curves of polygons, and classical curves."""
from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._errors import InvalidParameter
from ._levels import csr
from ._schemes import Scheme, curve_scheme
from ._surfaces import SampledParts, order

if TYPE_CHECKING:
    from scipy.sparse import csr_array


class CurveSamples(SampledParts):
    """Points, derivatives and normals at places of a curve, in arrays whose first axes are those of the places.

    Quantities that do not exist at a place are zero; `order` and `status` say which exist.

    Attributes
    ----------
    points : (..., dimension), positions
    first, second : (..., dimension), derivatives: of limit curves per edge of the control polygon, of classical curves per unit
        of t. AttributeError if `evaluate` was called with fewer derivatives
    normals : (..., dimension), unit normals: in the plane to the left of the first derivative, in space towards the centre of
        curvature. AttributeError if `evaluate` was called without derivatives
    status : (...), int8; ``statuses[number]`` is its name
    order : (...), int8, number of derivatives that exist: 0, 1 or 2
    """

    __module__ = "sublimit"

    @property
    def first(self) -> arrays.Floats:
        """First derivatives, (..., dimension).

        Raises
        ------
        AttributeError
            `evaluate` was called without derivatives.
        """
        return self._part("first", 1)

    @property
    def second(self) -> arrays.Floats:
        """Second derivatives, (..., dimension).

        Raises
        ------
        AttributeError
            `evaluate` was called with fewer than 2 derivatives.
        """
        return self._part("second", 2)

    @property
    def normals(self) -> arrays.Floats:
        """Unit normals, (..., dimension); zero where undefined.

        Raises
        ------
        AttributeError
            `evaluate` was called without derivatives.
        """
        return self._part("normals", 1)


class LimitCurve:
    """The limit curve of a polygon under a linear curve scheme. It never changes: threads may share it.

    Segment i goes from point i, t = 0, to point i + 1, t = 1. The last segment of a closed curve goes from the last point to
    the first.

    Parameters
    ----------
    points : (points, dimension), real numbers
    scheme : name of a curve scheme, as in `schemes`, or a result of `scheme`
    closed : join the last point to the first (default: False)
    tangents : (points, dimension), derivative at each point per edge of the polygon; for Hermite schemes, which need it

    Raises
    ------
    InvalidParameter
        An array of another shape or type; NaN and infinite numbers.
    InvalidOption
        No linear curve scheme has this name.
    InvalidMesh
        A Hermite scheme without tangents.
    UnsupportedTopology
        Too few points for the scheme.
    AnalysisError
        The scheme has no limit.

    Examples
    --------
    >>> import sublimit
    >>> curve = sublimit.LimitCurve([[0, 0], [1, 0], [1, 1], [0, 1]], "lane-riesenfeld", closed=True)
    >>> curve.evaluate([0, 1], 0.5).points
    array([[0.5       , 0.04166667],
           [0.95833333, 0.5       ]])
    """

    __module__ = "sublimit"
    __slots__ = ("_core", "__weakref__")
    _core: _sublimit.Curve

    def __init__(self, points: npt.ArrayLike, scheme: Scheme | str, *, closed: bool = False,
                 tangents: npt.ArrayLike | None = None) -> None:
        positions = arrays.floats(points, "points", (None, None), "(points, dimension)")
        ends = None if tangents is None else arrays.floats(tangents, "tangents", positions.shape, "that of points")
        own = curve_scheme(scheme)
        self._core = _sublimit.Curve(positions, ends, own.name, dict(own.options), closed)

    @property
    def num_segments(self) -> int:
        """Number of segments: one for each edge of the polygon."""
        return self._core.num_segments

    def evaluate(self, segment: npt.ArrayLike, t: npt.ArrayLike, derivatives: int = 0, *, threads: int = 0) -> CurveSamples:
        """Evaluates places of the curve, exactly up to rounding.

        Parameters
        ----------
        segment, t : integers, and numbers in [0, 1]; arrays that broadcast to one shape
        derivatives : number of derivatives: 0, 1 or 2
        threads : largest number of threads (default: all)

        Returns
        -------
        CurveSamples, of the broadcast shape

        Raises
        ------
        InvalidParameter
            A segment that does not exist, t outside [0, 1] or not finite.
        InvalidMesh
            A point or a derivative overflows (1.8e308).
        """
        segments, at, shape = _places(segment, t)
        return CurveSamples(self._core.evaluate(segments, at, order(derivatives), threads), shape)

    def stencils(self, segment: npt.ArrayLike, t: npt.ArrayLike, derivatives: int = 0) -> list[csr_array]:
        """Returns the weights that `evaluate` multiplies the points with, a row for each place of the flattened arrays.

        Parameters
        ----------
        segment, t : integers, and numbers in [0, 1]; arrays that broadcast to one shape
        derivatives : number of derivatives: 0, 1 or 2

        Returns
        -------
        list of scipy.sparse.csr_array, (places, points)
            Matrices of the position, the first and the second derivative, as far as asked for. Rows of derivatives that do not
            exist are empty. For Hermite schemes column 2i belongs to point i, and column 2i + 1 to its tangent.

        Raises
        ------
        InvalidParameter
            A segment that does not exist, t outside [0, 1] or not finite.
        """
        segments, at, _ = _places(segment, t)
        return [csr(parts) for parts in self._core.stencils(segments, at, order(derivatives))]

    def __reduce__(self) -> NoReturn:
        raise TypeError("a LimitCurve does not pickle: it is made of its points faster than it is read; pickle these")

    def __repr__(self) -> str:
        return f"<sublimit.LimitCurve: {self.num_segments} segments>"


class Curves:
    """A set of classical curves. `Construction.curves` makes it. It never changes: threads may share it.

    Segments are the knot spans of all curves, curve by curve. Places are (segment, t), with t in [0, 1] from one knot to the
    next; derivatives are per unit of this t.

    Examples
    --------
    >>> import sublimit
    >>> line = sublimit.construct({"kind": "bezier_curve", "degree": 2, "points": [[0, 0, 0], [1, 2, 0], [3, 0, 0]]}).curves()
    >>> line.evaluate(0, 0.5, derivatives=1).first
    array([3., 0., 0.])
    """

    __module__ = "sublimit"
    __slots__ = ("_core", "__weakref__")
    _core: _sublimit.Curves

    def __init__(self) -> None:
        raise TypeError("sublimit.construct(recipe).curves() makes curves")

    @classmethod
    def _of(cls, core: _sublimit.Curves) -> Curves:
        curves = cls.__new__(cls)
        curves._core = core
        return curves

    @property
    def points(self) -> arrays.Floats:
        """Control points, (control points, dimension); if `rational`, with one more column: (w x, ..., w). Read-only."""
        return self._core.columns

    @property
    def weights(self) -> arrays.Floats | None:
        """Weights of rational curves, (control points,): the last column of `points`. None if they are not rational."""
        return self._core.columns[:, -1] if self._core.rational else None

    @property
    def rational(self) -> bool:
        """True if `points` are homogeneous."""
        return self._core.rational

    @property
    def num_curves(self) -> int:
        """Number of curves."""
        return self._core.num_curves

    @property
    def num_segments(self) -> int:
        """Number of segments of all curves: one for each span of knots."""
        return self._core.num_segments

    def evaluate(self, segment: npt.ArrayLike, t: npt.ArrayLike, derivatives: int = 0, *, threads: int = 0) -> CurveSamples:
        """Evaluates places of the curves, exactly up to rounding.

        Parameters
        ----------
        segment, t : integers, and numbers in [0, 1]; arrays that broadcast to one shape
        derivatives : number of derivatives: 0, 1 or 2
        threads : largest number of threads (default: all)

        Returns
        -------
        CurveSamples, of the broadcast shape
            At a place where the weight is 0 the status is ``pole`` and all numbers are zero.

        Raises
        ------
        InvalidParameter
            A segment that does not exist, t outside [0, 1] or not finite.
        InvalidMesh
            A point or a derivative overflows (1.8e308).
        """
        segments, at, shape = _places(segment, t)
        return CurveSamples(self._core.evaluate(segments, at, order(derivatives), threads), shape)

    def __reduce__(self) -> NoReturn:
        raise TypeError("Curves do not pickle; construct them again")

    def __repr__(self) -> str:
        return f"<sublimit.Curves: {self.num_curves} curves, {self.num_segments} segments, {len(self.points)} control points>"


def refine_curve(points: npt.ArrayLike, scheme: Scheme | str, levels: int = 1, *, closed: bool = False) -> arrays.Floats:
    """Returns the points of a refined polygon, in order along the curve.

    Parameters
    ----------
    points : (points, dimension), real numbers
    scheme : name of a linear curve scheme, as in `schemes`, or a result of `scheme`
    levels : number of refinements, 0 or more (default: 1)
    closed : join the last point to the first (default: False)

    Returns
    -------
    (points of the level, dimension)

    Raises
    ------
    InvalidParameter
        An array of another shape or type; NaN and infinite numbers; negative levels.
    InvalidOption
        No linear curve scheme has this name.
    InvalidMesh
        A Hermite scheme, which needs tangents.
    UnsupportedTopology
        Too few points for the scheme.
    """
    own = curve_scheme(scheme)
    return _sublimit.refine_curve(arrays.floats(points, "points", (None, None), "(points, dimension)"), own.name,
                                  dict(own.options), closed, levels)


def _places(segment: npt.ArrayLike, t: npt.ArrayLike) -> tuple[arrays.Ints, arrays.Floats, tuple[int, ...]]:
    try:
        segments, at = np.broadcast_arrays(np.asarray(segment), np.asarray(t))
    except ValueError:
        raise InvalidParameter(f"segment and t do not broadcast to one shape: {np.shape(segment)}, {np.shape(t)}") from None
    return (arrays.ints(segments.reshape(-1), "segment", (None,), "whole numbers"),
            arrays.floats(at.reshape(-1), "t", (None,), "real numbers", finite=False), segments.shape)
