# SPDX-License-Identifier: Apache-2.0
"""Refined meshes, matrices and limits: the bits of the program's files, and the laws that they obey."""
from __future__ import annotations

import functools
import inspect
import pathlib
import warnings
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from conftest import shared_mesh
from tolerance import derivatives, products, rounding

import sublimit

Program = Callable[..., str]
SURFACES = [name for name, info in sublimit.schemes().items() if info.kind == "surface" and info.linear]


def mesh_for(scheme: str, request: pytest.FixtureRequest) -> sublimit.Mesh:
    triangles = sublimit.schemes()[scheme].triangles
    mesh: sublimit.Mesh = request.getfixturevalue("icosahedron" if triangles else "cube")
    return mesh


@pytest.mark.parametrize("scheme", SURFACES)
def test_refined_meshes_are_the_programs(scheme: str, program: Program, tmp_path: pathlib.Path,
                                         request: pytest.FixtureRequest) -> None:
    mesh = mesh_for(scheme, request)
    mesh.write(tmp_path / "in.obj")
    program("refine", tmp_path / "in.obj", "-s", scheme, "-l", 2, "-o", tmp_path / "out.obj")
    expected, fine = sublimit.read(tmp_path / "out.obj"), sublimit.refine(mesh, scheme, 2)
    assert np.array_equal(fine.points, expected.points)
    for part, other in zip(fine.faces, expected.faces):
        assert np.array_equal(part, other)


@pytest.mark.parametrize("options", [
    dict(), dict(boundary="edge-only"), dict(creasing="chaikin"), dict(triangles="smooth"), dict(no_creases=True),
    dict(face_varying="boundaries"), dict(no_tags=True), dict(triangulate=True), dict(threads=1), dict(boundary="fixed"),
    dict(attributes="linear"), dict(attributes="drop"), dict(orient=True), dict(crease_angle=30),
    dict(crease_smoothing_groups=True)])
def test_options_are_the_programs(options: dict[str, object], dressed: sublimit.Mesh, program: Program,
                                  tmp_path: pathlib.Path) -> None:
    mesh = dressed
    mesh.write(tmp_path / "in.obj")
    words = [word for name, value in options.items()
             for word in (["--" + name.replace("_", "-")] + ([] if value is True else [value]))]
    program("refine", tmp_path / "in.obj", "-s", "catmull-clark", "-l", 2, "-o", tmp_path / "out.obj", *words)
    fine = sublimit.refine(mesh, "catmull-clark", levels=2, **options)  # type: ignore[arg-type]
    fine.write(tmp_path / "ours.obj")
    assert (tmp_path / "ours.obj").read_bytes() == (tmp_path / "out.obj").read_bytes()


@pytest.mark.parametrize("scheme", SURFACES)
def test_matrices_make_the_points(scheme: str, request: pytest.FixtureRequest) -> None:
    mesh = mesh_for(scheme, request)
    for levels in (0, 1, 2):
        S = sublimit.subdivision_matrix(mesh, scheme, levels)
        fine = sublimit.refine(mesh, scheme, levels)
        assert S.shape == (len(fine.points), len(mesh.points))
        np.testing.assert_allclose(S @ mesh.points, fine.points, rtol=0, atol=rounding)
        np.testing.assert_allclose(S.sum(axis=1), 1, rtol=0, atol=rounding)


@pytest.mark.parametrize("scheme", SURFACES)
def test_levels_are_steps_of_refined_meshes(scheme: str, request: pytest.FixtureRequest) -> None:
    mesh = mesh_for(scheme, request)
    levels = sublimit.levels(mesh, scheme, 2)
    assert [level.number for level in levels] == [0, 1, 2] and levels[0].S.shape == (0, 0)
    points = mesh.points
    for level in levels:
        fine = sublimit.refine(mesh, scheme, level.number)
        points = level.S @ points if level.number > 0 else points
        np.testing.assert_allclose(points, fine.points, rtol=0, atol=rounding)
        assert all(np.array_equal(a, b) for a, b in zip(level.faces, fine.faces)) and len(level.holes) == 0
    assert abs(levels[2].S @ levels[1].S - sublimit.subdivision_matrix(mesh, scheme, 2)).max() <= rounding
    assert repr(levels[1]) == f"<sublimit.Level 1: {len(levels[1].faces[0])} faces>"


def test_levels_have_holes_and_follow_rules(tagged: sublimit.Mesh) -> None:
    assert sublimit.levels(tagged, "catmull-clark")[1].holes.tolist() == sublimit.refine(tagged, "catmull-clark").holes.tolist()
    assert len(sublimit.levels(tagged, "catmull-clark", 0, boundary="none")[0].holes) > 1
    plain = sublimit.levels(tagged, "catmull-clark", no_creases=True, triangulate=True, threads=1)
    creased = sublimit.levels(tagged, "catmull-clark", triangulate=True)
    assert set(plain[0].faces[0]) == {3} and not np.array_equal(plain[1].S.toarray(), creased[1].S.toarray())


def test_matrices_are_not_copied(cube: sublimit.Mesh) -> None:
    S = sublimit.subdivision_matrix(cube, "catmull-clark", 2)
    assert not S.data.flags.owndata and not S.indices.flags.owndata and not S.indptr.flags.owndata
    assert S.has_sorted_indices
    last = sublimit.levels(cube, "catmull-clark", 2)[2].S
    assert not last.data.flags.owndata and last.has_sorted_indices


@pytest.mark.parametrize("scheme", SURFACES)
def test_limits_are_the_programs(scheme: str, program: Program, tmp_path: pathlib.Path,
                                 request: pytest.FixtureRequest) -> None:
    mesh = mesh_for(scheme, request)
    mesh.write(tmp_path / "in.obj")
    for level in (0, 2):
        program("limit", tmp_path / "in.obj", "-s", scheme, "-l", level, "-o", tmp_path / "out.obj")
        limit = sublimit.limit(mesh, scheme, levels=level)
        # The program goes level by level, matrices all at once.
        np.testing.assert_allclose(limit.points, sublimit.read(tmp_path / "out.obj").points, rtol=0, atol=rounding)
        np.testing.assert_allclose(limit.matrix @ mesh.points, limit.points, rtol=0, atol=products)
        for tangents, matrix in zip(limit.tangents, limit.tangent_matrices):
            np.testing.assert_allclose(matrix @ mesh.points, tangents, rtol=0, atol=derivatives)
        assert limit.side_vertex.tolist() == list(range(len(limit.points)))
        if scheme == "bilinear":
            continue
        assert "undefined_normal" not in {limit.statuses[s] for s in limit.status}
        np.testing.assert_allclose(np.linalg.norm(limit.normals, axis=1), 1, atol=rounding)
        centre = mesh.points.mean(axis=0)
        assert (np.einsum("ij,ij->i", limit.normals, limit.points - centre) > 0).all()  # outwards


def test_sides_of_creases(tagged: sublimit.Mesh) -> None:
    limit = sublimit.limit(tagged, "catmull-clark", 1)
    assert len(limit.normals) > len(limit.points) and len(limit.side_vertex) == len(limit.normals)
    sizes, corners = limit.faces
    assert (limit.side_vertex[limit.corner_side] == corners).all() and sizes.sum() == len(corners)


def test_limits_of_known_masks(cube: sublimit.Mesh) -> None:
    """Catmull-Clark at valence n: (n^2 v + 4 sum e + sum f) / (n (n + 5)) (Halstead, Kass, DeRose 1993)."""
    rows = sublimit.limit(cube, "catmull-clark").matrix.toarray()
    for v, row in enumerate(rows):
        shared = np.abs(cube.points - cube.points[v]).sum(axis=1)  # 1: an edge away, 2: across a face, 3: across the cube
        expected = np.choose(shared.astype(int), [9 / 24, 4 / 24, 1 / 24, 0])
        np.testing.assert_allclose(row, expected, rtol=0, atol=rounding)


def test_the_same_bits_for_any_number_of_threads(icosahedron: sublimit.Mesh) -> None:
    one, all_of_them = (sublimit.refine(icosahedron, "loop", 5, threads=n) for n in (1, 0))
    assert np.array_equal(one.points, all_of_them.points)


def test_refuses_in_clear_words(cube: sublimit.Mesh) -> None:
    attempts: list[tuple[Callable[[], object], str]] = [
        (lambda: sublimit.refine(cube, "lop"), "unknown scheme 'lop'; the nearest are loop"),
        (lambda: sublimit.refine(cube, "chaikin"), "chaikin refines curves"),
        (lambda: sublimit.refine(cube, "catmull-clark", option={"tension": 1}), "tension"),
        (lambda: sublimit.refine(cube, "catmull-clark", boundary="round"), "boundary 'round' is no rule"),
        (lambda: sublimit.scheme("kobbelt", tension=1000), "tension"),
        (lambda: sublimit.scheme("kobbelt", slope=1), "slope")]
    for refused, words in attempts:
        with pytest.raises(sublimit.InvalidOption, match=words):
            refused()
    by_levels: list[Callable[..., object]] = [sublimit.levels, sublimit.limit, sublimit.refine, sublimit.subdivision_matrix]
    for by_level in by_levels:
        with pytest.raises(sublimit.InvalidParameter, match="-1"):
            by_level(cube, "catmull-clark", -1)
    for by_level in by_levels[:2]:
        for number in (1.5, "1", None):
            with pytest.raises(TypeError, match="integer"):
                by_level(cube, "catmull-clark", number)
    with pytest.raises(sublimit.UnsupportedTopology, match="triangles"):
        sublimit.refine(cube, "loop")
    with pytest.raises(sublimit.ResourceError, match="memory"):
        sublimit.refine(cube, "catmull-clark", 14)
    faulty = sublimit.Mesh(cube.points, [[0, 1, 2], [0, 1, 3]])
    functions: list[Callable[..., object]] = [sublimit.refine, sublimit.levels, sublimit.subdivision_matrix, sublimit.limit, sublimit.analyze_mesh,
                                              sublimit.LimitSurface]
    for function in functions:
        with pytest.raises(sublimit.InvalidMesh, match="not a clean manifold"):
            function(faulty, "catmull-clark", strict=True)
    with pytest.raises(TypeError, match="mesh is a list; a sublimit.Mesh is right"):
        sublimit.refine([], "loop")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="scheme is a int"):
        sublimit.refine(cube, 3)  # type: ignore[arg-type]


def test_warns_of_what_is_left_out(cube: sublimit.Mesh) -> None:
    mesh = sublimit.Mesh(cube.points, cube.faces, uv=np.zeros((24, 2)) + np.arange(24)[:, None])
    with pytest.warns(UserWarning, match="texture coordinates are left out"):
        sublimit.refine(mesh, "doo-sabin")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sublimit.refine(mesh, "doo-sabin", quiet=True)
    assert sublimit.refine(mesh, "catmull-clark").uv is not None


def parameters(thing: Any) -> set[str]:
    """Names of parameters; none of what has no signature in Python."""
    try:
        return set(inspect.signature(thing).parameters)
    except (TypeError, ValueError):
        return set()


def test_what_takes_a_mesh_and_a_scheme_warns_of_it(cube: sublimit.Mesh) -> None:
    """Once, where it was called; with `strict` it is an error, and a filter silences it."""
    faulty = sublimit.Mesh(cube.points, [[0, 1, 2, 3], [1, 0, 5, 4], [0, 1, 6, 7]])
    assert 1 <= len(faulty.faults()) <= 5
    places = np.zeros(1, int), np.array([0.25]), np.array([0.5])
    more: dict[str, tuple[Any, ...]] = {"fit": ([2], cube.points[2:3]), "fit_places": (*places, cube.points[:1]), "bake": (1,),
                                        "fit_cloud": (cube.points,)}
    options = {"tessellate": {"chord": 0.1}}
    functions = [name for name in sublimit.__all__ if {"mesh", "scheme"} <= parameters(getattr(sublimit, name))]
    functions.remove("info")  # its result has all warnings and faults
    others = {"refine", "levels", "limit", "bake", "LimitSurface", "subdivision_matrix", "analyze_mesh", "tessellate"}
    assert others | set(more) == set(functions)
    for name in functions:
        call = functools.partial(getattr(sublimit, name), faulty, "catmull-clark", *more.get(name, ()), **options.get(name, {}))
        with pytest.warns(sublimit.MeshWarning) as caught:
            call()
        assert [str(one.message) for one in caught] == faulty.faults(), name
        assert caught[0].filename == __file__, name
        with pytest.raises(sublimit.InvalidMesh, match="not a clean manifold"):
            call(strict=True)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", sublimit.MeshWarning)
            call()


def test_many_faults_are_a_few_warnings(cube: sublimit.Mesh) -> None:
    faulty = sublimit.Mesh(cube.points, [[0, 1, 2], [1, 0, 3], [0, 1, 4]] + [[i, (i + 1) % 8, (i + 3) % 8] for i in range(8)] * 2)
    assert len(faulty.faults()) > 6
    with pytest.warns(sublimit.MeshWarning) as caught:
        sublimit.refine(faulty, "loop")
    assert len(caught) == 6 and str(caught[-1].message).startswith(f"and {len(faulty.faults()) - 5} more")


def test_defaults_of_options_are_values_of_theirs() -> None:
    for name, info in sublimit.schemes().items():
        sublimit.scheme(name, **{option: one.default for option, one in info.options.items()})


def test_schemes_with_options(cube: sublimit.Mesh) -> None:
    half = sublimit.scheme("kobbelt", tension=Fraction(1, 2))
    assert str(half) == "kobbelt tension=1/2"
    virtual = sublimit.scheme("modified-butterfly", boundary_rule="virtual-vertex")  # - of a name is written _
    assert virtual == sublimit.scheme("modified-butterfly", **{"boundary-rule": "virtual-vertex"})
    by_option = sublimit.refine(cube, "kobbelt", option={"tension": 0.5})
    assert np.array_equal(sublimit.refine(cube, half).points, by_option.points)
    assert not np.array_equal(sublimit.refine(cube, "kobbelt").points, by_option.points)


@pytest.mark.parametrize("name", ["catmark_car", "catmark_bishop", "catmark_nonman_edge100"])
def test_shared_meshes(name: str, program: Program, tmp_path: pathlib.Path) -> None:
    path = shared_mesh(name)
    mesh = sublimit.read(path)
    program("refine", path, "-s", "catmull-clark", "-l", 1, "-o", tmp_path / "out.obj", "--quiet")
    assert np.array_equal(sublimit.refine(mesh, "catmull-clark", quiet=True).points, sublimit.read(tmp_path / "out.obj").points)
