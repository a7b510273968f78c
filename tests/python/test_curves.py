# SPDX-License-Identifier: Apache-2.0
"""Limit curves: known splines, stencils, and what is refused."""
from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BSpline
from tolerance import derivatives, long_sums, products, rounding

import sublimit

CURVES = [name for name, info in sublimit.schemes().items() if info.kind == "curve" and info.linear]
POLYGON = np.random.default_rng(1).random((11, 3))


@pytest.mark.parametrize("degree", [2, 3, 4, 5])
def test_lane_riesenfeld_is_the_b_spline(degree: int) -> None:
    """Closed, so that knots are whole numbers; segment i of odd degrees begins at the i-th knot, of even ones between two."""
    n = len(POLYGON)
    curve = sublimit.LimitCurve(POLYGON, sublimit.scheme("lane-riesenfeld", degree=degree), closed=True)
    t = np.linspace(0, 1, 9)
    found = curve.evaluate(np.arange(n)[:, None], t, derivatives=2)
    spline = BSpline(np.arange(-degree, n + 2 * degree + 1) - (degree + 1) / 2, np.take(POLYGON, np.arange(-degree, n + degree), axis=0,
                                                                                     mode="wrap"), degree)
    x = np.arange(n)[:, None] + t
    inside = (x > 1) & (x < n - 1)
    np.testing.assert_allclose(found.points[inside], spline(x)[inside], rtol=0, atol=products)
    np.testing.assert_allclose(found.first[inside & (t > 0) & (t < 1)], spline(x, 1)[inside & (t > 0) & (t < 1)], rtol=0, atol=derivatives)


@pytest.mark.parametrize("name", CURVES)
def test_stencils_make_the_points(name: str) -> None:
    tangents = np.random.default_rng(2).random(POLYGON.shape) if "hermite" in name else None
    curve = sublimit.LimitCurve(POLYGON, name, closed=True, tangents=tangents)
    segment, t = np.arange(curve.num_segments), np.random.default_rng(3).random(curve.num_segments)
    samples, matrices = curve.evaluate(segment, t, derivatives=2), curve.stencils(segment, t, derivatives=2)
    unknowns = POLYGON if tangents is None else np.stack([POLYGON, tangents], axis=1).reshape(-1, 3)
    for k, part in enumerate((samples.points, samples.first, samples.second)):
        there = samples.order >= k
        assert matrices[k].shape == (len(t), len(unknowns))
        np.testing.assert_allclose((matrices[k] @ unknowns)[there], part[there], rtol=0, atol=long_sums)


def test_refined_polygons_tend_to_the_limit() -> None:
    fine = sublimit.refine_curve(POLYGON, "four-point", 8, closed=True)
    assert len(fine) == 256 * len(POLYGON) and np.array_equal(fine[::256], POLYGON)
    curve = sublimit.LimitCurve(POLYGON, "four-point", closed=True)
    np.testing.assert_allclose(curve.evaluate(3, np.arange(256) / 256).points, fine[768:1024], rtol=0, atol=rounding)
    tight = sublimit.LimitCurve(POLYGON, sublimit.scheme("four-point", tension=Fraction(3, 4)), closed=True)
    assert not np.allclose(tight.evaluate(3, 0.5).points, curve.evaluate(3, 0.5).points)


@pytest.mark.parametrize("arguments, words", [
    ((POLYGON, "loop"), "no linear scheme of curves is called 'loop'"), ((POLYGON[0], "chaikin"), r"points has shape \(3,\)"),
    ((POLYGON[:1], "chaikin"), "1 point"), ((POLYGON * np.nan, "chaikin"), "is nan"), ((POLYGON, "hermite-merrien"), "tangents|derivatives")])
def test_refuses_polygons(arguments: Any, words: str) -> None:
    with pytest.raises(sublimit.Error, match=words):
        sublimit.LimitCurve(*arguments)


def test_refuses_places() -> None:
    curve = sublimit.LimitCurve(POLYGON, "chaikin")
    for place, words in (((10, 0), "10"), ((0, 1.5), "1.5"), (([0, 1], [0, 0, 0]), "do not broadcast"), ((0.5, 0), "segment has dtype float64")):
        with pytest.raises(sublimit.Error, match=words):
            curve.evaluate(*place)  # type: ignore[arg-type]
