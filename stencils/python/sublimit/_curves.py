# SPDX-License-Identifier: Apache-2.0
"""Limit curves, and classical curves."""
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
    """What there is at places of a curve. What does not exist is zero; `order` and `status` say what does.

    Attributes
    ----------
    points : (..., dimension)
    first, second : (..., dimension), derivatives per edge of the control polygon, of classical curves by t; AttributeError if
        they were not asked for
    normals : (..., dimension), of length one: in the plane to the left, in space towards the centre of curvature
    status : (...), numbers; ``statuses[number]`` is the word
    order : (...), derivatives that there are
    """

    __module__ = "sublimit"

    @property
    def first(self) -> arrays.Floats:
        """(..., dimension): first derivatives."""
        return self._part("first", 1)

    @property
    def second(self) -> arrays.Floats:
        """(..., dimension): second derivatives."""
        return self._part("second", 2)

    @property
    def normals(self) -> arrays.Floats:
        """(..., dimension): unit normals."""
        return self._part("normals", 1)


class LimitCurve:
    """The limit of a polygon under a linear scheme of curves. It never changes; threads may share it.

    Segment i goes from point i, t = 0, to point i + 1, t = 1; a closed curve has one from the last point to the first.

    Parameters
    ----------
    points : (points, dimension)
    scheme : a name, as in `schemes`, or what `scheme` makes
    closed : whether the last point is joined to the first
    tangents : (points, dimension), for Hermite schemes

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
        """Segments of the curve: edges of the polygon."""
        return self._core.num_segments

    def evaluate(self, segment: npt.ArrayLike, t: npt.ArrayLike, derivatives: int = 0, *, threads: int = 0) -> CurveSamples:
        """Points of the curve, exact to rounding.

        Parameters
        ----------
        segment, t : arrays that broadcast to one shape
        derivatives : 0, 1 or 2
        """
        segments, at, shape = _places(segment, t)
        return CurveSamples(self._core.evaluate(segments, at, order(derivatives), threads), shape)

    def stencils(self, segment: npt.ArrayLike, t: npt.ArrayLike, derivatives: int = 0) -> list[csr_array]:
        """What `evaluate` multiplies the points with: position, first and second derivative; a row for each place.

        Columns are the points; in Hermite schemes 2i is point i, and 2i + 1 its tangent.
        """
        segments, at, _ = _places(segment, t)
        return [csr(parts) for parts in self._core.stencils(segments, at, order(derivatives))]

    def __reduce__(self) -> NoReturn:
        raise TypeError("a LimitCurve does not pickle: it is made of its points faster than it is read; pickle these")

    def __repr__(self) -> str:
        return f"<sublimit.LimitCurve: {self.num_segments} segments>"


class Curves:
    """Classical curves as one: the segments (spans of knots) of one curve after the other. They never change.

    `Construction.curves` makes them. Places are (segment, t), with t in [0, 1] from one knot to the next; derivatives are by
    this t.

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
        """(control points, dimension); of rational curves a column more, homogeneous: (w x, ..., w). Read-only."""
        return self._core.columns

    @property
    def weights(self) -> arrays.Floats | None:
        """(control points,): the weights of rational curves, the last column of `points`; None of others."""
        return self._core.columns[:, -1] if self._core.rational else None

    @property
    def rational(self) -> bool:
        """Whether points are homogeneous."""
        return self._core.rational

    @property
    def num_curves(self) -> int:
        """Curves."""
        return self._core.num_curves

    @property
    def num_segments(self) -> int:
        """Segments of all curves."""
        return self._core.num_segments

    def evaluate(self, segment: npt.ArrayLike, t: npt.ArrayLike, derivatives: int = 0, *, threads: int = 0) -> CurveSamples:
        """Points of the curves, exact to rounding.

        Parameters
        ----------
        segment, t : arrays that broadcast to one shape
        derivatives : 0, 1 or 2

        Returns
        -------
        CurveSamples, of the broadcast shape
            A place where the weight is 0 has the status ``pole`` and nothing else.

        Raises
        ------
        InvalidParameter
            A segment that there is not, t outside [0, 1] or not finite.
        """
        segments, at, shape = _places(segment, t)
        return CurveSamples(self._core.evaluate(segments, at, order(derivatives), threads), shape)

    def __reduce__(self) -> NoReturn:
        raise TypeError("Curves do not pickle; construct them again")

    def __repr__(self) -> str:
        return f"<sublimit.Curves: {self.num_curves} curves, {self.num_segments} segments, {len(self.points)} control points>"


def refine_curve(points: npt.ArrayLike, scheme: Scheme | str, levels: int = 1, *, closed: bool = False) -> arrays.Floats:
    """Points of a level of a polygon, in order.

    Parameters
    ----------
    points : (points, dimension)
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
