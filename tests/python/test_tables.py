# SPDX-License-Identifier: Apache-2.0
"""Tables: what they make, where they read and write, files and pickles, and arrays that they refuse."""
from __future__ import annotations

import gc
import pathlib
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tolerance import long_sums, products, rounding, searched, single

import sublimit

Program = Callable[..., str]


@pytest.fixture(params=["float", "double"])
def table(request: pytest.FixtureRequest, tagged: sublimit.Mesh) -> sublimit.Table:
    return sublimit.bake(tagged, "catmull-clark", levels=2, precision=request.param)


@pytest.mark.parametrize("asked", [
    dict(levels=3), dict(levels=2, limit=True, derivatives=2), dict(grid=4, derivatives=1),
    dict(at=(np.arange(6), 0.25, 0.75), derivatives=1)])
def test_tables_are_their_matrices(asked: Any, cube: sublimit.Mesh) -> None:
    table = sublimit.bake(cube, "catmull-clark", precision="double", **asked)
    matrix = table.matrix()
    made = table.apply(cube.points)
    assert matrix.shape == (table.quantities * table.num_points, 8)
    np.testing.assert_allclose(matrix @ cube.points, made.reshape(-1, 3), rtol=0, atol=products)
    values = np.random.default_rng(1).random(made.shape)
    np.testing.assert_allclose(table.apply_transpose(values), matrix.T @ values.reshape(-1, 3), rtol=0, atol=long_sums)
    operator = table.operator()
    x, y = np.random.default_rng(2).random(8), np.random.default_rng(3).random(len(matrix.data[:0]) + matrix.shape[0])
    np.testing.assert_allclose(operator @ x, matrix @ x, atol=products)
    np.testing.assert_allclose(operator.T @ y, matrix.T @ y, atol=long_sums)


def test_levels_are_those_of_refine(cube: sublimit.Mesh) -> None:
    table = sublimit.bake(cube, "catmull-clark", levels=2, precision="double")
    made, fine = table.apply(cube.points), sublimit.refine(cube, "catmull-clark", 2)
    sizes, corners = table.faces
    assert sizes.tolist() == [4] * 96 and len(made) == len(fine.points)

    def faces(points: Any, vertices: Any) -> Any:
        middle = points[vertices.reshape(-1, 4)].mean(axis=1).round(9) + 0.0
        return middle[np.lexsort(middle.T)]

    np.testing.assert_allclose(faces(made, corners), faces(fine.points, fine.faces[1]), atol=searched)


def test_rules_are_followed(tagged: sublimit.Mesh) -> None:
    """As `refine` has them: those of the mesh and those that are asked for."""
    for options in (dict(boundary="edge-only"), dict(creasing="chaikin"), dict(triangles="smooth"), dict(no_creases=True),
                    dict(triangulate=True), dict(threads=1)):
        table = sublimit.bake(tagged, "catmull-clark", levels=2, precision="double", **options)  # type: ignore[arg-type]
        made, fine = table.apply(tagged.points), sublimit.refine(tagged, "catmull-clark", 2, **options)  # type: ignore[arg-type]
        np.testing.assert_allclose(np.sort(made.round(9), axis=0), np.sort(fine.points.round(9), axis=0), atol=searched)


def test_grids_and_places_are_samples(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    u = np.linspace(0, 1, 4)
    grid = sublimit.bake(cube, "catmull-clark", grid=4, derivatives=1, precision="double")
    samples = surface.evaluate(np.arange(6)[:, None, None], u, u[:, None], derivatives=1)
    position, du, dv = grid.apply(cube.points)
    inside = (samples.order >= 1).reshape(-1)
    for part, expected in ((position, samples.points), (du, samples.du), (dv, samples.dv)):
        np.testing.assert_allclose(part[inside], expected.reshape(-1, 3)[inside], rtol=0, atol=products)
    assert grid.addresses is not None
    face, uv = grid.addresses
    np.testing.assert_allclose(position, surface.evaluate(face, uv[:, 0], uv[:, 1]).points, rtol=0, atol=products)
    assert sublimit.bake(cube, "catmull-clark", 1).addresses is None
    at = sublimit.bake(cube, "catmull-clark", at=([0, 5], 0.25, [0.5, 1]), precision="double")
    assert at.addresses is not None and at.addresses[0].tolist() == [0, 5]
    np.testing.assert_allclose(at.apply(cube.points), surface.evaluate([0, 5], 0.25, [0.5, 1]).points, rtol=0, atol=rounding)


def test_frames_and_channels(table: sublimit.Table) -> None:
    random = np.random.default_rng(1)
    for channels in (1, 2, 3, 4, 7):
        frames = random.random((5, table.num_control_points, channels)).astype(table.dtype)
        made = table.apply(frames)
        assert made.shape == (5, table.num_points, channels) and made.dtype == table.dtype
        for frame, one in zip(frames, made):
            assert np.array_equal(table.apply(frame), one)
    assert table.apply(np.zeros((0, table.num_control_points, 3))).shape == (0, table.num_points, 3)


def test_results_go_where_they_should(table: sublimit.Table, tagged: sublimit.Mesh) -> None:
    points = tagged.points.astype(table.dtype)
    out = np.full((2, table.num_points, 3), 7, table.dtype)
    assert table.apply(points, out[1]).ctypes.data == out[1].ctypes.data
    assert (out[0] == 7).all() and np.array_equal(out[1], table.apply(points))
    # Of any real type and order; of the table's own without a copy.
    for given in (tagged.points, np.asfortranarray(points), np.repeat(points, 2, axis=0)[::2], points[::-1][::-1]):
        assert np.array_equal(table.apply(given), out[1])
    points.setflags(write=False)
    assert np.array_equal(table.apply(points), out[1])


def test_files_are_the_programs(table: sublimit.Table, tagged: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "in.obj")
    precision = "float" if table.dtype == np.float32 else "double"
    program("bake", tmp_path / "in.obj", "-s", "catmull-clark", "-l", 2, "--precision", precision, "-o",
            tmp_path / "program.safetensors")
    table.save(tmp_path / "ours.safetensors")
    assert (tmp_path / "ours.safetensors").read_bytes() == (tmp_path / "program.safetensors").read_bytes()
    loaded = sublimit.load(tmp_path / "program.safetensors", checksums=True)
    assert np.array_equal(loaded.apply(tagged.points), table.apply(tagged.points)) and loaded.info == table.info
    program("apply", tmp_path / "program.safetensors", tmp_path / "in.obj", "-o", tmp_path / "out.npy")
    assert np.array_equal(np.load(tmp_path / "out.npy").reshape(-1, 3), table.apply(tagged.points))
    copy = pickle.loads(pickle.dumps(table))
    assert np.array_equal(copy.apply(tagged.points), table.apply(tagged.points)) and copy.dtype == table.dtype
    (tmp_path / "broken.safetensors").write_bytes((tmp_path / "ours.safetensors").read_bytes()[:-10])
    with pytest.raises(sublimit.FormatError):
        sublimit.load(tmp_path / "broken.safetensors")
    with pytest.raises(sublimit.IoError):
        sublimit.load(tmp_path / "nothing.safetensors")


def test_arrays_outlive_their_table(cube: sublimit.Mesh) -> None:
    matrix = sublimit.bake(cube, "catmull-clark", levels=2).matrix()
    assert not matrix.data.flags.owndata
    gc.collect()
    np.testing.assert_allclose(matrix.sum(axis=1), 1, atol=single)


def test_statuses(tagged: sublimit.Mesh) -> None:
    table = sublimit.bake(tagged, "catmull-clark", grid=3, derivatives=2)
    words = {table.statuses[s] for s in table.status}
    assert {"regular", "hole", "crease"} <= words


MESHLESS: list[tuple[Any, str]] = [
    (np.zeros((4, 3)), r"points has shape \(4, 3\); \(20 control points, channels\) is right"),
    (np.zeros(60), r"points has shape \(60,\)"), (np.zeros((20, 0)), r"points has shape \(20, 0\)"),
    (np.zeros((20, 3), complex), "points has dtype complex128"), (np.zeros((20, 3), object), "points is an array of objects"),
    (np.zeros((20, 65)), "65 channels; 1 to 64"), ([[1, 2], [3]], "inhomogeneous|points"),
    (np.ma.masked_array(np.zeros((20, 3)), mask=np.eye(20, 3)), "masked")]  # type: ignore[no-untyped-call]


@pytest.mark.parametrize("points, words", MESHLESS)
def test_refuses_points(points: Any, words: str, table: sublimit.Table) -> None:
    with pytest.raises(sublimit.Error, match=words):
        table.apply(points)


def test_refuses_numbers_that_its_type_has_no_room_for(cube: sublimit.Mesh) -> None:
    points = cube.points.copy()
    points[2, 1] = 1e200
    with pytest.raises(sublimit.Error, match=r"points\[2, 1\] is 1e\+200, too large for a table in float"):
        sublimit.bake(cube, "catmull-clark", levels=1).apply(points)
    assert np.isfinite(sublimit.bake(cube, "catmull-clark", levels=1, precision="double").apply(points)).all()
    points[2, 1] = np.inf  # the caller's: it comes out where it goes in
    assert not np.isfinite(sublimit.bake(cube, "catmull-clark", levels=1).apply(points)).all()


def test_refuses_results(table: sublimit.Table) -> None:
    points = np.zeros((20, 3), table.dtype)
    n, other = table.num_points, np.float64 if table.dtype == np.float32 else np.float32
    read_only = np.zeros((n, 3), table.dtype)
    read_only.setflags(write=False)
    whole = np.zeros((n + 20, 3), table.dtype)
    attempts: list[tuple[Any, str]] = [
        (np.zeros((n, 3), other), "out is float"), (np.zeros((n, 4), table.dtype), rf"out has shape \({n}, 4\); \({n}, 3\)"),
        (read_only, "read-only"), (np.zeros((3, n), table.dtype).T, "rows do not follow"), ([0], "out is list")]
    for out, words in attempts:
        with pytest.raises(sublimit.Error, match=words):
            table.apply(points, out)
    with pytest.raises(sublimit.Error, match="shares memory with points"):
        table.apply(whole[:20], whole[10:n + 10])
    with pytest.raises(sublimit.Error, match="values has shape"):
        table.apply_transpose(points)
    # NaN in points is the caller's: it comes out where it goes in.
    points[0] = np.nan
    assert np.isnan(table.apply(points)).any()


def test_refuses_requests(cube: sublimit.Mesh) -> None:
    attempts: list[tuple[dict[str, Any], str]] = [
        (dict(), "one of levels, grid, at and tessellation"), (dict(levels=1, grid=3), "one of levels"), (dict(grid=4, limit=True), "limit is of a level"),
        (dict(levels=12), "level 12 of a table; 1 to 11"), (dict(levels=0), "level 0"), (dict(grid=1), "grid 1"),
        (dict(levels=2, derivatives=1), "a level has no derivatives"), (dict(grid=3, derivatives=3), "derivatives is 3"),
        (dict(levels=2, precision="half"), "precision is 'half'"), (dict(at=(9, 0, 0)), "9"), (dict(at=([], [], [])), "at has no places"),
        (dict(at=(0, np.nan, 0)), "nan|finite"), (dict(at=(0, 2, 0)), "2")]
    for asked, words in attempts:
        with pytest.raises(sublimit.Error, match=words):
            sublimit.bake(cube, "catmull-clark", **asked)
    for wrong in (dict(levels=1.5), dict(levels="2"), dict(grid=3.0)):
        with pytest.raises(TypeError, match="integer"):
            sublimit.bake(cube, "catmull-clark", **wrong)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="sublimit.bake makes tables"):
        sublimit.Table()
