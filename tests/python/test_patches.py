# SPDX-License-Identifier: Apache-2.0
"""Classical surfaces: the numbers of the program, a sphere, and tables."""
from __future__ import annotations

import json
import pathlib
from typing import Any

import numpy as np
import pytest
from tolerance import derivatives, products, rounding

import sublimit

BICUBIC = """v 0 0 0\nv 1 0 1\nv 2 0 -1\nv 3 0 0\nv 0 1 0\nv 1 1 2\nv 2 1 1\nv 3 1 0\nv 0 2 1\nv 1 2 0\nv 2 2 -1\nv 3 2 0
v 0 3 0\nv 1 3 1\nv 2 3 0\nv 3 3 -1\ncstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\nparm u 0 1\nparm v 0 1\nend\n"""


@pytest.fixture
def bicubic(tmp_path: pathlib.Path) -> sublimit.Patches:
    (tmp_path / "patch.obj").write_text(BICUBIC)
    return sublimit.Patches.read(tmp_path / "patch.obj")


def test_bezier_patches_are_bernstein_sums(bicubic: sublimit.Patches) -> None:
    u, v = np.random.default_rng(1).random((2, 30))
    net = bicubic.points.reshape(4, 4, 3)

    def bernstein(t: Any) -> Any:
        return np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])

    expected = np.einsum("jk,ik,jic->kc", bernstein(v), bernstein(u), net)
    samples = bicubic.evaluate(0, u, v, derivatives=2)
    np.testing.assert_allclose(samples.points, expected, rtol=0, atol=rounding)
    N, Nu, Nv = bicubic.stencils(0, u, v, derivatives=1)
    np.testing.assert_allclose(Nu @ bicubic.points, samples.du, rtol=0, atol=products)
    table = bicubic.bake(grid=5, derivatives=1, precision="double")
    t = np.linspace(0, 1, 5)
    np.testing.assert_allclose(table.apply(bicubic.points)[2], bicubic.evaluate(0, np.tile(t, 5), np.repeat(t, 5), derivatives=1).dv,
                               rtol=0, atol=products)
    assert len(bicubic.bake(levels=1).apply(bicubic.points)) > 16


def test_a_sphere_by_a_recipe(tmp_path: pathlib.Path) -> None:
    """It is rational: homogeneous columns, a table that divides, and Gauss curvature 1 / r^2."""
    w = 0.5**0.5
    profile = {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 2],
               "homogeneous_xzw": [[0, -2, 1], [2 * w, -2 * w, w], [2, 0, 1], [2 * w, 2 * w, w], [0, 2, 1]]}
    recipe = tmp_path / "sphere.json"
    recipe.write_text(json.dumps({"kind": "revolution", "profile": profile, "start_degrees": 0, "sweep_degrees": 360}))
    sphere = sublimit.Patches.read(recipe)
    assert sphere.points.shape[1] == 4 and sphere.first_faces.tolist() == [0, sphere.num_faces]
    random = np.random.default_rng(2)
    face, u, v = random.integers(0, sphere.num_faces, 50), *(0.1 + 0.8 * random.random((2, 50)))
    samples = sphere.evaluate(face, u, v, derivatives=2)
    np.testing.assert_allclose(np.linalg.norm(samples.points, axis=1), 2, rtol=0, atol=rounding)
    np.testing.assert_allclose(samples.curvature().gauss, 1 / 4, rtol=0, atol=derivatives)
    table = sphere.bake(at=(face, u, v), derivatives=1, precision="double")
    made = table.apply(sphere.points)
    assert made.shape == (3, 50, 3) and table.info["rational"]
    np.testing.assert_allclose(made[0], samples.points, rtol=0, atol=rounding)
    np.testing.assert_allclose(made[1], samples.du, rtol=0, atol=products)
    near = sphere.closest(4 * random.random((50, 3)), signed=True)
    np.testing.assert_allclose(np.abs(near.distance), near.lower, rtol=0, atol=derivatives)
    np.testing.assert_allclose(np.linalg.norm(near.points, axis=1), 2, rtol=0, atol=rounding)
    assert sphere.closest([[0.5, 0, 1]], signed=True).distance[0] < 0
    hits = sphere.intersect([[0, 0.5, -9]], [0, 0, 2], all=True)
    np.testing.assert_allclose(hits.t, [(9 - 3.75**0.5) / 2, (9 + 3.75**0.5) / 2], rtol=0, atol=derivatives)


@pytest.fixture
def quarter(tmp_path: pathlib.Path) -> sublimit.Patches:
    """A quarter of a cylinder of radius 1."""
    w = 0.5**0.5
    (tmp_path / "quarter.json").write_text(json.dumps({
        "kind": "nurbs_surface", "degree": [2, 1], "shape": [3, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 1, 1],
        "homogeneous": [[1, 0, 0, 1], [w, w, 0, w], [0, 1, 0, 1], [1, 0, 1, 1], [w, w, w, w], [0, 1, 1, 1]]}))
    return sublimit.Patches.read(tmp_path / "quarter.json")


def test_rational_tables_take_columns_or_points_with_weights(quarter: sublimit.Patches, bicubic: sublimit.Patches) -> None:
    weights = quarter.weights
    assert weights is not None and bicubic.weights is None
    xyz = quarter.points[:, :3] / weights[:, None]
    table = quarter.bake(grid=5, derivatives=1, precision="double")
    made = table.apply(quarter.points)
    np.testing.assert_allclose(np.hypot(made[0, :, 0], made[0, :, 1]), 1, rtol=0, atol=rounding)
    np.testing.assert_allclose(table.apply(xyz, weights=weights), made, rtol=0, atol=products)
    frames = np.stack([xyz, 2 * xyz])
    for given in (weights, np.stack([weights, weights])):
        np.testing.assert_allclose(table.apply(frames, weights=given), np.stack([made, 2 * made]), rtol=0, atol=products)
    one = table.apply(xyz[:, 2:], weights=weights)  # any values
    np.testing.assert_allclose(one, made[:, :, 2:], rtol=0, atol=products)
    for values, given, words in (
            (xyz, None, r"points has 3 columns, and the table is rational: 4, \(w x"), (xyz[:, :2], None, "2 columns"),
            (xyz, weights[:3], r"weights has shape \(3,\); one for each"), (xyz, weights[:, None], "weights has shape"),
            (xyz, np.full(len(xyz), "a"), "weights <U1; real numbers")):
        with pytest.raises(sublimit.Error, match=words):
            table.apply(values, weights=given)
    with pytest.raises(sublimit.Error, match="weights are for rational tables"):
        bicubic.bake(grid=3).apply(bicubic.points, weights=np.ones(16))


def test_operators_of_rational_tables_are_their_matrices(quarter: sublimit.Patches) -> None:
    table = quarter.bake(grid=5, derivatives=1, precision="double")
    matrix, operator = table.matrix(), table.operator()
    x = np.random.default_rng(1).random((matrix.shape[1], 70))  # more than are applied at once
    np.testing.assert_allclose(operator @ x, matrix @ x, rtol=0, atol=products)
    np.testing.assert_allclose(operator @ x[:, 0], matrix @ x[:, 0], rtol=0, atol=products)
    y = np.random.default_rng(2).random(matrix.shape[0])
    np.testing.assert_allclose(operator.T @ y, matrix.T @ y, rtol=0, atol=products)


def test_tables_are_baked_at_the_addresses_of_others(quarter: sublimit.Patches, bicubic: sublimit.Patches) -> None:
    for patches in (quarter, bicubic):
        grid = patches.bake(grid=4, precision="double")
        again = patches.bake(at=grid.addresses, precision="double")
        np.testing.assert_allclose(again.apply(patches.points), grid.apply(patches.points), rtol=0, atol=rounding)
    with pytest.raises(sublimit.Error, match="at is not"):
        bicubic.bake(at=(0,))
    with pytest.raises(sublimit.Error, match=r"at has \(u, v\) of shape \(3,\)"):
        bicubic.bake(at=(0, [1, 2, 3]))


def test_refuses_in_clear_words(bicubic: sublimit.Patches, tmp_path: pathlib.Path) -> None:
    with pytest.raises(TypeError, match="Patches.read"):
        sublimit.Patches()
    with pytest.raises(sublimit.IoError):
        sublimit.Patches.read(tmp_path / "nothing.obj")
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.raises(sublimit.InvalidMesh, match="no surfaces, but a mesh"):
        sublimit.Patches.read(tmp_path / "mesh.obj")
    with pytest.raises(sublimit.Error, match="1"):
        bicubic.evaluate(1, 0, 0)
    with pytest.raises(sublimit.Error, match="one of levels, grid and at"):
        bicubic.bake()


def test_triangles_are_within_the_chord_and_closed(tmp_path: pathlib.Path, bicubic: sublimit.Patches) -> None:
    near = bicubic.tessellate(0.01, normals=True)
    assert near.bound <= 0.01 * 1.001 and near.normals is not None and near.normals.shape == (len(near.triangles), 3, 3)
    again = bicubic.evaluate(near.face, near.u, near.v).points
    np.testing.assert_allclose(near.points, again, rtol=0, atol=rounding)
    function = sublimit.tessellate(bicubic, chord=0.01)
    np.testing.assert_array_equal(function.triangles, near.triangles)
    with pytest.raises(TypeError, match="neither a scheme nor rates"):
        sublimit.tessellate(bicubic, chord=0.01, rates={(0, 1): 2})
    w = 0.5**0.5
    profile = {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 2],
               "homogeneous_xzw": [[0, -1, 1], [w, -w, w], [1, 0, 1], [w, w, w], [0, 1, 1]]}
    sphere = sublimit.construct({"kind": "revolution", "profile": profile, "start_degrees": 0, "sweep_degrees": 360}).surfaces()
    triangles = sphere.tessellate(0.01).triangles
    edges = {(int(a), int(b)) for t in triangles for a, b in zip(t, np.roll(t, -1))}
    assert all((b, a) in edges for a, b in edges)
    assert len(np.unique(triangles)) - len(edges) // 2 + len(triangles) == 2
