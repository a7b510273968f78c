# SPDX-License-Identifier: Apache-2.0
"""Fits: what they reach, and what they refuse."""
from __future__ import annotations

import numpy as np
import pytest
from tolerance import derivatives, rounding, searched, solved

import sublimit


def test_limits_pass_through_points_with_normals(icosahedron: sublimit.Mesh) -> None:
    directions = icosahedron.points / np.linalg.norm(icosahedron.points, axis=1)[:, None]
    found = sublimit.fit(icosahedron, "loop", np.arange(12), 2 * directions, directions, thin_plate=1e-3)
    assert found.solved and found.why_not == ""
    assert found.position_error.max() < derivatives and found.normal_error.max() < searched
    limit = sublimit.limit(found.mesh, "loop")
    np.testing.assert_allclose(limit.points[:12], 2 * directions, rtol=0, atol=derivatives)
    np.testing.assert_allclose(limit.normals[:12], directions, rtol=0, atol=searched)


def test_some_targets_have_no_normal(icosahedron: sublimit.Mesh) -> None:
    normals = np.full((2, 3), np.nan)
    normals[0] = icosahedron.points[3]
    found = sublimit.fit(icosahedron, "loop", [3, 8], icosahedron.points[[3, 8]], normals)
    assert found.solved and np.isnan(found.normal_error[1]) and found.normal_error[0] < searched


def test_places_are_solved_in_the_least_squares_sense(cube: sublimit.Mesh) -> None:
    """The normal equations of the rows that `stencils` gives."""
    random = np.random.default_rng(1)
    face, u, v = random.integers(0, 6, 60), random.random(60), random.random(60)
    points, weights = random.random((60, 3)), random.random(60)
    found = sublimit.fit_places(cube, "catmull-clark", face, u, v, points, weights=weights)
    rows = sublimit.LimitSurface(cube, "catmull-clark").stencils(face, u, v)[0].toarray()
    expected = np.linalg.lstsq(np.sqrt(weights)[:, None] * rows, np.sqrt(weights)[:, None] * points, rcond=None)[0]
    np.testing.assert_allclose(found.points, expected, rtol=0, atol=solved)
    np.testing.assert_allclose(found.residuals, np.linalg.norm(rows @ expected - points, axis=1), rtol=0, atol=solved)
    pinned = sublimit.fit_places(cube, "catmull-clark", face, u, v, points, pins=[2, 5])
    assert np.array_equal(pinned.points[[2, 5]], cube.points[[2, 5]]) and pinned.rms > 0


def test_clouds_are_approached(cube: sublimit.Mesh) -> None:
    random = np.random.default_rng(2)
    cloud = random.normal(size=(400, 3))
    cloud *= 0.5 / np.linalg.norm(cloud, axis=1)[:, None]
    coarse = sublimit.refine(cube, "catmull-clark", 1)
    found = sublimit.fit_cloud(coarse, "catmull-clark", cloud + 0.5, iterations=20)
    assert found.iterations is not None and (np.diff(found.iterations) <= rounding).all()
    assert found.rms == found.iterations[-1] < found.iterations[0] / 20
    assert len(found.residuals) == 400 and found.largest == pytest.approx(found.residuals.max())


def test_refuses_in_clear_words(cube: sublimit.Mesh) -> None:
    points = cube.points
    with pytest.raises(sublimit.Error, match=r"points has shape \(8, 3\); \(2 targets, 3\) is right"):
        sublimit.fit(cube, "catmull-clark", [0, 1], points)
    with pytest.raises(sublimit.InvalidParameter, match="9"):
        sublimit.fit(cube, "catmull-clark", [9], points[:1])
    with pytest.raises(sublimit.Error, match=r"weights has shape \(3,\); \(1 targets,\) is right"):
        sublimit.fit_places(cube, "catmull-clark", [0], 0, 0, points[:1], weights=[1, 2, 3])
    with pytest.raises(sublimit.InvalidParameter, match="target 0"):
        sublimit.fit_places(cube, "catmull-clark", [0], 2, 0, points[:1])
    with pytest.raises(sublimit.InvalidParameter, match="no points|points"):
        sublimit.fit_cloud(cube, "catmull-clark", np.zeros((0, 3)))
    # The cube's square system is singular: without refinement most points cannot be met, which is said, not raised.
    rigid = sublimit.fit(cube, "catmull-clark", range(8), np.random.default_rng(1).random((8, 3)), refinements=(0, 0))
    assert not rigid.solved and "vert" in rigid.why_not and rigid.position_error.max() > 1e-3
