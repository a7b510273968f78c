# SPDX-License-Identifier: Apache-2.0
"""Limit surfaces: the numbers of the program, known surfaces, stencils, curvature, closest points."""
from __future__ import annotations

import csv
import pathlib
import pickle
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tolerance import derivatives, places, products, rounding, searched

import sublimit

Program = Callable[..., str]


def test_samples_are_the_programs(tagged: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "in.obj")
    program("sample", tmp_path / "in.obj", "-s", "catmull-clark", "--random", 200, "--seed", 1, "--derivatives", 2, "-o",
            tmp_path / "out.csv")
    with open(tmp_path / "out.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    column = {name: [row[name] for row in rows] for name in rows[0]}
    numbers = {name: np.array([float(x or 0) for x in column[name]]) for name in column if name != "status"}
    samples = sublimit.LimitSurface(tagged, "catmull-clark").evaluate(
        numbers["face"].astype(int), numbers["u"], numbers["v"], derivatives=2)
    assert [samples.statuses[s] for s in samples.status] == column["status"]
    there = np.array([status != "hole" for status in column["status"]])
    for name, part in (("{}", samples.points), ("{}u", samples.du), ("{}v", samples.dv), ("{}uu", samples.duu),
                       ("{}uv", samples.duv), ("{}vv", samples.dvv), ("n{}", samples.normals)):
        for k, axis in enumerate("xyz"):
            assert np.array_equal(part[there, k], numbers[name.format(axis)][there]), name


def test_numbers_too_large_are_errors(cube: sublimit.Mesh) -> None:
    largest = sublimit.Mesh(cube.points * (1.7e308 / np.abs(cube.points).max()), cube.faces)
    surface = sublimit.LimitSurface(largest, "catmull-clark")
    assert np.isfinite(surface.evaluate(0, 0.5, 0.5).points).all()
    with pytest.raises(sublimit.InvalidMesh, match=r"face 0, u 0\.5, v 0\.75: .* another unit of length"):
        surface.evaluate(0, 0.5, [0.5, 0.75], derivatives=2)


def test_shapes_broadcast(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    u = np.linspace(0, 1, 5)
    grid = surface.evaluate(np.arange(6)[:, None, None], u, u[:, None], derivatives=1)
    assert grid.points.shape == grid.normals.shape == (6, 5, 5, 3) and grid.status.shape == (6, 5, 5)
    one = surface.evaluate(2, u[3], u[1])
    assert one.points.shape == (3,) and np.array_equal(one.points, grid.points[2, 1, 3]) and not hasattr(one, "du")
    assert surface.evaluate([], [], []).points.shape == (0, 3)
    assert surface.evaluate(np.zeros(2, np.uint8), np.float32(0.5), 0).points.shape == (2, 3)


@pytest.mark.parametrize("scheme", [name for name, info in sublimit.schemes().items() if info.kind == "surface" and info.linear])
def test_stencils_make_the_points(scheme: str, request: pytest.FixtureRequest) -> None:
    triangles = sublimit.schemes()[scheme].triangles
    mesh = request.getfixturevalue("icosahedron" if triangles else "cube")
    surface = sublimit.LimitSurface(mesh, scheme)
    random = np.random.default_rng(1)
    u, v = random.random(40) / 2, random.random(40) / 2
    face = random.integers(0, surface.num_faces, 40)
    samples = surface.evaluate(face, u, v, derivatives=2)
    matrices = surface.stencils(face, u, v, derivatives=2)
    parts = (samples.points, samples.du, samples.dv, samples.duu, samples.duv, samples.dvv)
    assert len(matrices) == 6
    for k, (matrix, part) in enumerate(zip(matrices, parts)):
        there = samples.order >= (0, 1, 1, 2, 2, 2)[k]
        assert matrix.shape == (40, surface.num_points)
        size = 1 + abs(matrix).sum(axis=1).max()
        np.testing.assert_allclose((matrix @ mesh.points)[there], part[there], rtol=0, atol=products * size)
        np.testing.assert_allclose(matrix.sum(axis=1)[there], 1 if k == 0 else 0, rtol=0, atol=products * size)


def bicubic_torus(m: int, n: int) -> sublimit.Mesh:
    i, j = np.divmod(np.arange(m * n), n)
    a, b = 2 * np.pi * i / m, 2 * np.pi * j / n
    points = np.column_stack([(3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)])
    faces = np.column_stack([i * n + j, (i + 1) % m * n + j, (i + 1) % m * n + (j + 1) % n, i * n + (j + 1) % n])
    return sublimit.Mesh(points, faces)


def test_curvature_of_a_torus() -> None:
    """The B-spline surface is a torus up to O(h^2) of h = 2 pi / n; its curvatures tend to those of radius 3 and 1."""
    worst = []
    for n in (32, 64):
        surface = sublimit.LimitSurface(bicubic_torus(3 * n, n), "catmull-clark")
        faces = np.arange(0, surface.num_faces, 7)
        c = surface.evaluate(faces, 0.3, 0.6, derivatives=2)
        k = c.curvature()
        assert (k.k1 >= k.k2).all() and (c.order == 2).all()
        np.testing.assert_allclose(k.gauss, k.k1 * k.k2, atol=derivatives)
        np.testing.assert_allclose(k.mean, (k.k1 + k.k2) / 2, atol=derivatives)
        np.testing.assert_allclose(np.einsum("ij,ij->i", k.direction1, k.direction2), 0, atol=searched)
        r = np.hypot(c.points[:, 0], c.points[:, 1])
        across = np.cos(np.arctan2(c.points[:, 2], r - 3))
        worst.append(abs(abs(k.gauss) - abs(across / (3 + across))).max())
    assert worst[1] < worst[0] / 3 < 0.02
    with pytest.raises(sublimit.Error, match="derivatives=2"):
        surface.evaluate(0, 0, 0, derivatives=1).curvature()
    with pytest.raises(AttributeError, match="derivatives=1"):
        surface.evaluate(0, 0, 0).normals


def test_closest_points(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    on = surface.evaluate([0, 3, 5], [0.2, 0.7, 0.5], [0.9, 0.4, 0.5], derivatives=1)
    found = surface.closest(on.points + 0.1 * on.normals)
    np.testing.assert_allclose(found.distance, 0.1, atol=searched)
    np.testing.assert_allclose(found.points, on.points, atol=places)
    np.testing.assert_allclose(surface.evaluate(found.face, found.u, found.v).points, found.points, atol=derivatives)
    assert (found.lower <= found.distance).all() and (found.distance - found.lower < places).all()


def test_nearest_faces_radii_and_signs(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "bilinear")  # [0, 1]^3
    inside, outside = [0.5, 0.4, 0.9], [0.5, 0.5, 3]
    found = surface.closest([inside, outside], nearest=3, radius=1.9)
    assert found.first.tolist() == [0, 3, 3]
    np.testing.assert_allclose(found.distance, [0.1, 0.4, 0.5], atol=searched)
    assert len(set(found.face)) == 3
    np.testing.assert_allclose(surface.closest([inside, outside], signed=True).distance, [-0.1, 2], atol=searched)
    with pytest.raises(sublimit.UnsupportedTopology, match="closed"):
        sublimit.LimitSurface(sublimit.Mesh(cube.points[:4], [[0, 1, 2, 3]]), "bilinear").closest([inside], signed=True)
    with pytest.raises(sublimit.InvalidParameter, match="0 nearest"):
        surface.closest([inside], nearest=0)


def test_rays(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    origins, directions = np.array([[0.5, 0.45, -3], [9, 9, 9], [0.5, 0.45, 0.5]]), [0, 0, 2]
    hits = surface.intersect(origins, directions, all=True)
    assert hits.first.tolist() == [0, 2, 2, 3] and not hits.undecided.any()
    assert hits.kinds == ("crossing", "touching", "given-up") and not hits.kind.any()
    assert hits.words == ["regular"] * 3
    on_rays = origins[[0, 0, 2]] + hits.t[:, None] * directions
    np.testing.assert_allclose(hits.points, on_rays, atol=searched)
    np.testing.assert_allclose(surface.evaluate(hits.face, hits.u, hits.v).points, on_rays, atol=searched)
    assert (np.sign(hits.normals[:, 2]) == [-1, 1, 1]).all()
    assert surface.intersect(origins, directions).first.tolist() == [0, 1, 1, 2]
    later = surface.intersect(origins[0], directions, tmin=hits.t[:1] + 0.1)
    np.testing.assert_allclose(later.t, hits.t[1:2], atol=searched)
    assert len(surface.intersect(origins, directions, tmax=[0.1, 1, 0.1]).t) == 0
    with pytest.raises(sublimit.InvalidParameter, match="direction"):
        surface.intersect(origins, [0, 0, 0])
    with pytest.raises(sublimit.Error, match="do not fit together"):
        surface.intersect(origins, np.zeros((2, 3)))


def test_tessellations_are_the_programs(tagged: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "cage.obj")
    program("tessellate", tmp_path / "cage.obj", "-s", "catmull-clark", "--chord", "0.01", "-o", tmp_path / "out.obj", "--quiet")
    expected = sublimit.read(tmp_path / "out.obj")
    surface = sublimit.LimitSurface(tagged, "catmull-clark")
    near = surface.tessellate(0.01, normals=True)
    assert near.cells > 0 and surface.tessellate(0.01).normals is None
    assert np.array_equal(near.points, expected.points) and np.array_equal(near.triangles, expected.face_array)
    assert 0 < near.bound <= 0.01 and len(near.triangle_face) == len(near.triangles)
    np.testing.assert_allclose(surface.evaluate(near.face, near.u, near.v).points, near.points, rtol=0, atol=rounding)
    at_corners = surface.evaluate(near.triangle_face[:, None], near.corners[..., 0], near.corners[..., 1], derivatives=1)
    np.testing.assert_allclose(at_corners.points, near.points[near.triangles], rtol=0, atol=rounding)
    assert near.normals is not None and np.array_equal(at_corners.normals, near.normals)
    table = sublimit.bake(tagged, "catmull-clark", tessellation=near, precision="double")
    np.testing.assert_allclose(table.apply(tagged.points), near.points, rtol=0, atol=rounding)
    sizes, corners = table.faces
    assert (sizes == 3).all() and np.array_equal(corners, near.triangles.ravel())
    with pytest.raises(sublimit.Error, match="one of levels, grid, at and tessellation"):
        sublimit.bake(tagged, "catmull-clark", 2, tessellation=near)
    assert len(surface.tessellate(0.01, angle=0.1).triangles) > len(near.triangles)
    with pytest.raises(sublimit.InvalidParameter, match="chord"):
        surface.tessellate(0)
    with pytest.raises(sublimit.ResourceError, match="more than"):
        surface.tessellate(1e-6, max_triangles=100)


def test_triangles_as_meshes_are_the_programs(tagged: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "cage.obj")
    program("tessellate", tmp_path / "cage.obj", "-s", "catmull-clark", "--chord", "0.01", "--normals", "--face-ids", "-o",
            tmp_path / "out.obj", "--quiet")
    near = sublimit.tessellate(tagged, "catmull-clark", chord=0.01, normals=True)
    near.write(tmp_path / "ours.obj")
    assert (tmp_path / "ours.obj").read_bytes() == (tmp_path / "out.obj").read_bytes()
    assert near.uv is not None and near.face_ids is not None and near.normals is not None and near.face_normals is not None
    surface = sublimit.LimitSurface(tagged, "catmull-clark")
    by_surface = surface.tessellate(0.01, normals=True)
    assert by_surface.normals is not None
    assert np.array_equal(near.points, by_surface.points) and np.array_equal(near.face_array, by_surface.triangles)
    np.testing.assert_array_equal(near.normals[near.face_normals], by_surface.normals.reshape(-1, 3))
    plain = sublimit.tessellate(tagged, "catmull-clark", chord=0.01)
    assert plain.normals is None
    plain.write(tmp_path / "plain.ply")
    free = sublimit.tessellate(surface, chord=0.01)
    assert np.array_equal(free.points, near.points)
    flat = sublimit.tessellate(tagged, "loop", chord=0.01, triangulate=True, no_creases=True, angle=0.5, threads=1)
    assert set(flat.faces[0]) == {3} and len(flat.points) > 0


def test_texture_coordinates_without_a_limit_are_left_out(cube: sublimit.Mesh) -> None:
    mesh = sublimit.Mesh(cube.points, cube.faces, uv=np.zeros((24, 2)) + np.arange(24)[:, None])
    with pytest.warns(sublimit.MeshWarning, match="texture coordinates are left out"):
        near = sublimit.tessellate(mesh, "doo-sabin", chord=0.1)
    assert near.uv is None and len(near.points) > 0
    with pytest.raises(sublimit.Error):
        sublimit.tessellate(mesh, "doo-sabin", chord=0.1, face_varying="boundaries")


def test_rates_of_edges(cube: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    cube.write(tmp_path / "cube.obj")
    (tmp_path / "rates.csv").write_text("v0,v1,rate\n0,1,5\n6,2,3\n")
    program("tessellate", tmp_path / "cube.obj", "-s", "catmull-clark", "--chord", "0.1", "--rates", tmp_path / "rates.csv", "-o",
            tmp_path / "out.obj", "--quiet")
    expected = sublimit.read(tmp_path / "out.obj")
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    assert len(surface.tessellate(0.1).triangles) < len(expected.face_array)
    forms: list[Any] = [{(1, 0): 5, (2, 6): 3}, [(0, 1, 5), (6, 2, 3)], (np.array([[0, 1], [6, 2]]), np.array([5, 3]))]
    for rates in forms:
        assert np.array_equal(surface.tessellate(0.1, rates=rates).triangles, expected.face_array)
        assert np.array_equal(sublimit.tessellate(cube, "catmull-clark", chord=0.1, rates=rates).points, expected.points)
    for rates, words in (({(0, 6): 2}, r"no face has an edge \(0,6\)"), ({(0, 1): 0}, "the rate 0; 1 or more"),
                         ({(0, 1): -3}, "the rate -3"), ([(0, 1, 2), (1, 0, 2)], "two rates"),
                         ({(0, 1): 1.5}, "the rate 1.5; whole"), ({(0, 1): np.nan}, "the rate nan"),
                         ({(0.5, 1): 2}, "vertex 0.5; whole"), ([(0, 1)], r"rates has shape \(1, 2\)")):
        with pytest.raises(sublimit.Error, match=words):
            surface.tessellate(0.1, rates=rates)


def test_refuses_tessellations(cube: sublimit.Mesh, icosahedron: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    calls: list[Callable[[float], object]] = [surface.tessellate, lambda chord: sublimit.tessellate(surface, chord=chord),
                                              lambda chord: sublimit.tessellate(cube, "catmull-clark", chord=chord)]
    for call in calls:
        for chord in (0, -1, float("nan")):
            with pytest.raises(sublimit.InvalidParameter, match="chord"):
                call(chord)
    with pytest.raises(sublimit.InvalidParameter, match="angle"):
        surface.tessellate(0.1, angle=-1)
    with pytest.raises(TypeError, match="integer"):
        surface.tessellate(0.1, max_triangles=1e6)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="scheme is missing"):
        sublimit.tessellate(cube, chord=0.1)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="a LimitSurface has its scheme"):
        sublimit.tessellate(surface, "loop", chord=0.1)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="mesh is a list"):
        sublimit.tessellate([], "loop", chord=0.1)  # type: ignore[call-overload]
    with pytest.raises(sublimit.UnsupportedTopology, match="polynomial|butterfly|limit -l"):
        sublimit.tessellate(icosahedron, "butterfly", chord=0.1)
    with pytest.raises(sublimit.ResourceError, match="more than"):
        sublimit.tessellate(cube, "catmull-clark", chord=1e-6, max_triangles=100)


def test_searches_are_functions_too(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    points = np.random.default_rng(1).random((5, 3)) * 2
    near: dict[str, Any] = dict(nearest=2, radius=1.5, signed=True)
    rays: dict[str, Any] = dict(all=True, tmax=3)
    pairs: list[tuple[Any, Any]] = [
        (sublimit.closest(surface, points, **near), surface.closest(points, **near)),
        (sublimit.intersect(surface, points, [0, 0, -1], **rays), surface.intersect(points, [0, 0, -1], **rays))]
    for free, own in pairs:
        for name, value in vars(own).items():
            assert np.array_equal(getattr(free, name), value), name
    calls: list[Callable[[Any], object]] = [lambda thing: sublimit.closest(thing, points),
                                            lambda thing: sublimit.intersect(thing, points, [0, 0, 1])]
    for call in calls:
        for thing in (cube, None, "surface"):
            with pytest.raises(TypeError, match=f"surface is a {type(thing).__name__}; a sublimit.LimitSurface or"):
                call(thing)
    wrong: list[tuple[Any, str]] = [(np.zeros((2, 2)), r"points has shape \(2, 2\)"), ([[0, 0, np.nan]], "is nan"),
                                    ([["a", "b", "c"]], "dtype")]
    for bad, words in wrong:
        with pytest.raises(sublimit.Error, match=words):
            sublimit.closest(surface, bad)


def test_surfaces_with_other_points(tagged: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(tagged, "catmull-clark")
    assert np.array_equal(surface.points, tagged.points) and not surface.points.flags.writeable
    moved = surface.with_points(2 * tagged.points)
    face, u, v = [0, 3, 7], 0.25, 0.5
    expected = sublimit.LimitSurface(tagged.with_points(2 * tagged.points), "catmull-clark").evaluate(face, u, v, derivatives=2)
    found = moved.evaluate(face, u, v, derivatives=2)
    assert np.array_equal(found.points, expected.points) and np.array_equal(found.duv, expected.duv)
    assert np.array_equal(surface.points, tagged.points)  # it never changes
    for points, words in ((tagged.points[1:], r"points has shape \(19, 3\); \(20 control points, 3\)"),
                          (tagged.points * np.nan, "is nan"), (tagged.points[:, :2], r"shape \(20, 2\)")):
        with pytest.raises(sublimit.Error, match=words):
            surface.with_points(points)


@pytest.mark.parametrize("place, words", [
    ((6, 0.5, 0.5), "face 6|6 does not exist"), ((-1, 0.5, 0.5), "-1"), ((0, 1.5, 0.5), "1.5"),
    ((0, float("nan"), 0.5), "finite|nan"), ((0.5, 0, 0), "face has dtype float64; whole numbers"),
    (([0, 1], [0, 0, 0], 0), r"do not broadcast to one shape: face \(2,\), u \(3,\), v \(\)"),
    ((0, "a", 0), "u has dtype <U1"), ((0, 1j, 0), "u has dtype complex128")])
def test_refuses_in_clear_words(place: Any, words: str, cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    for call in (surface.evaluate, surface.stencils):
        with pytest.raises(sublimit.Error, match=words):
            call(*place)
    with pytest.raises(sublimit.Error, match="derivatives is 3; 0, 1 or 2"):
        surface.evaluate(0, 0, 0, derivatives=3)
    with pytest.raises(sublimit.Error, match=r"points has shape \(3,\); \(n, 3\) is right"):
        surface.closest([0, 0, 0])


def test_surfaces_say_why_they_do_not_pickle(cube: sublimit.Mesh) -> None:
    with pytest.raises(TypeError, match="pickle the Mesh"):
        pickle.dumps(sublimit.LimitSurface(cube, "catmull-clark"))


def test_threads_share_a_surface(icosahedron: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(icosahedron, "loop")
    random = np.random.default_rng(2)
    u, v, face = random.random(1000) / 2, random.random(1000) / 2, random.integers(0, 20, 1000)
    found: list[Any] = [None] * 8

    def work(k: int) -> None:
        found[k] = surface.evaluate(face, u, v).points

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(points, found[0]) for points in found)
