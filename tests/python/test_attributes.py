# SPDX-License-Identifier: Apache-2.0
"""What vertices and faces carry, how it is refined, and what is done to a mesh first: winding, creases, a fixed boundary."""
from __future__ import annotations

import inspect
import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from conftest import SHARED_MESHES
from tolerance import rounding, single

import sublimit

COLOURS = ("red", "green", "blue")
GRID = "".join(f"v {x} {y} {x * y / 4:g} {x / 3:g} {y / 3:g} 0.25\n" for y in range(4) for x in range(4)) + "".join(
    f"usemtl m{x}\nf {4 * y + x + 1} {4 * y + x + 2} {4 * y + x + 6} {4 * y + x + 5}\n" for y in range(3) for x in range(3))
FLIPPED = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 3 2 5 6\n"


@pytest.fixture
def grid(tmp_path: pathlib.Path) -> sublimit.Mesh:
    """4 x 4 vertices with colours, 3 x 3 quadrilaterals with materials."""
    (tmp_path / "grid.obj").write_text(GRID)
    return sublimit.read(tmp_path / "grid.obj")


def columns(mesh: sublimit.Mesh) -> npt.NDArray[np.float64]:
    return np.column_stack([mesh.vertex_values[name] for name in COLOURS]).astype(np.float64)


@pytest.mark.parametrize("scheme", ["catmull-clark", "bilinear", "doo-sabin", "kobbelt"])
def test_colours_are_refined_as_points_are(scheme: str, grid: sublimit.Mesh) -> None:
    assert list(grid.vertex_values) == list(COLOURS)
    S = sublimit.subdivision_matrix(grid, scheme, 2)
    fine = sublimit.refine(grid, scheme, 2)
    np.testing.assert_allclose(columns(fine), S @ columns(grid), atol=single)
    doubles = sublimit.Mesh(grid.points, grid.faces, vertex_values=dict(zip(COLOURS, columns(grid).T)))
    np.testing.assert_allclose(columns(sublimit.refine(doubles, scheme, 2)), S @ columns(grid), atol=rounding)


def edges(mesh: sublimit.Mesh) -> npt.NDArray[np.int32]:
    """Edges by their first appearance in the faces, (edges, 2)."""
    faces = mesh.face_array
    pairs = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    return np.array(list(dict.fromkeys(map(tuple, pairs.tolist()))), np.int32)


def test_linear_attributes_are_means(cube: sublimit.Mesh) -> None:
    heat = np.random.default_rng(1).random(8)
    mesh = sublimit.Mesh(cube.points, cube.faces, creases={(0, 1): 2}, vertex_values={"heat": heat})
    fine = sublimit.refine(mesh, "catmull-clark", attributes="linear")
    means = np.concatenate([heat, heat[cube.face_array].mean(axis=1), heat[edges(cube)].mean(axis=1)])
    np.testing.assert_allclose(fine.vertex_values["heat"], means, atol=rounding)
    smooth = sublimit.refine(mesh, "catmull-clark", attributes="smooth")
    assert np.abs(smooth.vertex_values["heat"] - means).max() > 0.01 and np.array_equal(smooth.points, fine.points)
    with pytest.raises(sublimit.InvalidOption, match="does not keep"):
        sublimit.refine(mesh, "doo-sabin", attributes="linear", no_creases=True)
    with pytest.raises(sublimit.InvalidOption, match="attributes 'flat' is no rule; there are smooth, linear, drop"):
        sublimit.refine(mesh, "catmull-clark", attributes="flat")


def test_fits_keep_what_meshes_carry(grid: sublimit.Mesh) -> None:
    found = sublimit.fit(grid, "catmull-clark", [0], grid.points[:1] + 1, refinements=(1, 1)).mesh
    fine = sublimit.refine(grid, "catmull-clark", 1)
    assert found.materials == fine.materials and found.groups == fine.groups
    assert {name: values.tolist() for name, values in found.vertex_values.items()} == \
        {name: values.tolist() for name, values in fine.vertex_values.items()}
    dropped = sublimit.fit(grid, "catmull-clark", [0], grid.points[:1] + 1, attributes="drop").mesh
    assert dropped.materials is None and not dropped.vertex_values


def test_attributes_are_dropped(grid: sublimit.Mesh) -> None:
    for made in (sublimit.refine(grid, "catmull-clark", attributes="drop"),
                 sublimit.tessellate(grid, "catmull-clark", chord=0.1, attributes="drop")):
        assert made.vertex_values == {} and made.face_values == {} and made.materials is None and made.material_files == []


def test_names_and_values_follow_faces(tagged: sublimit.Mesh) -> None:
    sizes = tagged.faces[0]
    names = [f"m{face % 4}" if face % 5 else "" for face in range(len(sizes))]
    mesh = sublimit.Mesh(tagged.points, tagged.faces, materials=names, groups=names[::-1], objects=names, smoothing_groups=names,
                         material_files=["a.mtl"], face_values={"part": np.arange(len(sizes), dtype=np.int16)})
    parents = np.repeat(np.arange(len(sizes)), sizes)
    for levels in (1, 2):
        fine = sublimit.refine(mesh, "catmull-clark", levels)
        assert fine.materials == fine.objects == fine.smoothing_groups == [names[parent] for parent in parents]
        assert fine.groups == [names[::-1][parent] for parent in parents] and fine.material_files == ["a.mtl"]
        assert fine.face_values["part"].tolist() == parents.tolist() and fine.face_values["part"].dtype == np.int16
        parents = np.repeat(parents, 4)


def test_triangles_have_what_their_faces_have(grid: sublimit.Mesh) -> None:
    mesh = sublimit.Mesh(grid.points, grid.faces, materials=grid.materials, vertex_values=dict(zip("xyz", grid.points.T)))
    near = sublimit.tessellate(mesh, "catmull-clark", chord=0.01)
    assert mesh.materials is not None and near.face_ids is not None
    assert near.materials == [mesh.materials[face] for face in near.face_ids]
    np.testing.assert_allclose(np.column_stack([near.vertex_values[axis] for axis in "xyz"]), near.points, atol=rounding)


def test_values_keep_their_types(tmp_path: pathlib.Path) -> None:
    square: dict[str, Any] = dict(points=[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], faces=[[0, 1, 2, 3]])
    for dtype in map(np.dtype, ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64")):
        info: Any = np.iinfo(dtype) if dtype.kind in "iu" else np.finfo(dtype)
        extremes = np.array([info.min, info.max, 1, 0], dtype)
        mesh = sublimit.Mesh(**square, vertex_values={"value": extremes}, face_values={"value": extremes[:1]})
        mesh.write(tmp_path / "mesh.ply")
        for one in (mesh, sublimit.read(tmp_path / "mesh.ply"), mesh.with_points(mesh.points + 1)):
            for value, expected in ((one.vertex_values["value"], extremes), (one.face_values["value"], extremes[:1])):
                assert value.dtype == dtype and np.array_equal(value, expected) and not value.flags.writeable
    others: list[Any] = [[1, 2, 3, 4], np.arange(4), np.arange(4, dtype=np.float16), np.arange(4, dtype=np.uint64)]
    for other in others:
        value = sublimit.Mesh(**square, vertex_values={"value": other}).vertex_values["value"]
        assert value.dtype == np.float64 and np.array_equal(value, other)


@pytest.mark.parametrize("given, words", [
    (dict(groups=["a\nf 1 2 3"]), "a name of faces has a character"), (dict(material_files=["a\nb"]), "a file of materials has"),
    (dict(vertex_values={name: [np.nan] * 4 for name in COLOURS}), "nan|not a number")])
def test_files_do_not_hold_everything(given: dict[str, Any], words: str, tmp_path: pathlib.Path) -> None:
    mesh = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]], **given)
    with pytest.raises(sublimit.InvalidMesh if "vertex_values" in given else sublimit.InvalidParameter, match=words):
        mesh.write(tmp_path / "mesh.obj")


def test_colours_in_bytes(grid: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    """Those of a refined mesh are rounded in arrays, as they are in files."""
    given = {name: np.random.default_rng(k).integers(0, 256, len(grid.points)).astype(np.uint8) for k, name in enumerate(COLOURS)}
    mesh = sublimit.Mesh(grid.points, grid.faces, vertex_values=given)
    mesh.write(tmp_path / "mesh.ply")
    assert b"property uchar red" in (tmp_path / "mesh.ply").read_bytes()
    again = sublimit.read(tmp_path / "mesh.ply")
    for name, value in again.vertex_values.items():
        assert value.dtype == np.uint8 and np.array_equal(value, given[name])
    fine = sublimit.refine(again, "catmull-clark")
    exact = sublimit.subdivision_matrix(again, "catmull-clark") @ columns(again)
    assert np.abs(columns(fine) - exact).max() <= 0.5 + single
    fine.write(tmp_path / "fine.ply")
    assert np.array_equal(columns(sublimit.read(tmp_path / "fine.ply")), columns(fine))
    twice = sublimit.refine(fine, "catmull-clark")  # of what is not rounded
    np.testing.assert_array_equal(columns(twice), columns(sublimit.refine(again, "catmull-clark", 2)))


def test_faces_are_turned(tmp_path: pathlib.Path) -> None:
    (tmp_path / "flipped.obj").write_text(FLIPPED)
    mesh = sublimit.read(tmp_path / "flipped.obj")
    assert mesh.faults()
    turned = sublimit.refine(mesh, "catmull-clark", 0, orient=True)
    # One of the two faces, around its first corner.
    assert turned.face_array.tolist() in ([[0, 1, 4, 3], [2, 5, 4, 1]], [[0, 3, 4, 1], [2, 1, 4, 5]]) and not turned.faults()
    with pytest.raises(sublimit.InvalidMesh, match="clean manifold"):
        sublimit.refine(mesh, "catmull-clark", strict=True)
    assert len(sublimit.refine(mesh, "catmull-clark", strict=True, orient=True).points) == 15
    with pytest.warns(sublimit.MeshWarning):
        sharp = sublimit.refine(mesh, "catmull-clark")
    assert not np.array_equal(sharp.faces[1], sublimit.refine(mesh, "catmull-clark", orient=True).faces[1])


def test_faces_of_a_report_are_turned() -> None:
    path = SHARED_MESHES.parent / "reports" / "flipped.obj"
    if not path.exists():
        pytest.skip(f"NO SHARED MESHES at {path}: its faces are not turned")
    mesh = sublimit.read(path)
    assert mesh.faults() and not sublimit.refine(mesh, "catmull-clark", 2, orient=True, strict=True).faults()


def test_edges_that_bend_become_sharp(cube: sublimit.Mesh) -> None:
    sharp_edges, sharpness = sublimit.refine(cube, "catmull-clark", 0, crease_angle=89).creases
    assert {frozenset(edge) for edge in sharp_edges.tolist()} == {frozenset(edge) for edge in edges(cube).tolist()}
    assert (sharpness >= 10).all()
    assert len(sublimit.refine(cube, "catmull-clark", 0, crease_angle=91).creases[0]) == 0
    tagged = sublimit.Mesh(cube.points, cube.faces, creases={(0, 1): 1.5})
    assert sorted(sublimit.refine(tagged, "catmull-clark", 0, crease_angle=89).creases[1].tolist())[0] == 1.5
    for angle in (-1, 181, np.nan):
        with pytest.raises(sublimit.InvalidOption, match="0 to 180 degrees"):
            sublimit.refine(cube, "catmull-clark", crease_angle=angle)


def test_edges_between_smoothing_groups_become_sharp(cube: sublimit.Mesh) -> None:
    mesh = sublimit.Mesh(cube.points, cube.faces, smoothing_groups=["1", "2", "2", "2", "2", "2"])
    sharp_edges, _ = sublimit.refine(mesh, "catmull-clark", 0, crease_smoothing_groups=True).creases
    assert {frozenset(edge) for edge in sharp_edges.tolist()} == {frozenset(edge) for edge in [(0, 1), (1, 2), (2, 3), (3, 0)]}
    with pytest.raises(sublimit.InvalidMesh, match="smoothing group"):
        sublimit.refine(cube, "catmull-clark", crease_smoothing_groups=True)


def test_a_fixed_boundary_stays_the_polygon_that_it_is(grid: sublimit.Mesh) -> None:
    border = np.array([0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4])
    points = grid.points.copy()
    points[border, 2] = np.random.default_rng(2).random(len(border))
    mesh = grid.with_points(points)
    fine = sublimit.refine(mesh, "catmull-clark", 2, boundary="fixed")
    on_border = np.unique(edges(fine)[[np.isin(fine.face_array, edge).sum(axis=1).tolist().count(2) == 1 for edge in edges(fine)]])
    assert len(on_border) == 48
    tail, side = points[border], np.roll(points[border], -1, axis=0) - points[border]
    to = fine.points[on_border, None] - tail
    along = np.clip((to * side).sum(-1) / (side * side).sum(-1), 0, 1)
    assert np.linalg.norm(to - along[..., None] * side, axis=-1).min(axis=1).max() < 10 * rounding
    assert np.array_equal(sublimit.limit(mesh, "catmull-clark", boundary="fixed").points[border], points[border])
    assert not np.array_equal(sublimit.limit(mesh, "catmull-clark").points[border], points[border])
    with pytest.raises(sublimit.InvalidOption, match="there are none, edge-only, edge-and-corner, fixed"):
        sublimit.refine(mesh, "catmull-clark", boundary="round")


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "refine": lambda mesh, **words: sublimit.refine(mesh, "catmull-clark", 2, **words).points,
    "levels": lambda mesh, **words: sublimit.levels(mesh, "catmull-clark", 2, **words)[2].S.toarray(),
    "subdivision_matrix": lambda mesh, **words: sublimit.subdivision_matrix(mesh, "catmull-clark", 2, **words).toarray(),
    "limit": lambda mesh, **words: sublimit.limit(mesh, "catmull-clark", **words).points,
    "LimitSurface": lambda mesh, **words: sublimit.LimitSurface(mesh, "catmull-clark", **words).evaluate([0, 4], 0.25, 0.5).points,
    "tessellate": lambda mesh, **words: sublimit.tessellate(mesh, "catmull-clark", chord=0.1, **words).points,
    "bake": lambda mesh, **words: sublimit.bake(mesh, "catmull-clark", 2, **words).apply(mesh.points),
    "fit": lambda mesh, **words: sublimit.fit(mesh, "catmull-clark", [0], mesh.points[:1] + 1, **words).mesh.points,
    "fit_places": lambda mesh, **words: sublimit.fit_places(mesh, "catmull-clark", [0], 0.5, 0.5, [[9, 9, 9]], **words).points,
    "fit_cloud": lambda mesh, **words: sublimit.fit_cloud(mesh, "catmull-clark", 2 * mesh.points, thin_plate=1e-3, **words).points,
    "analyze_mesh": lambda mesh, **words: np.array([len(str(dict(sublimit.analyze_mesh(mesh, "catmull-clark", **words))))])}


def test_every_function_of_meshes_takes_the_same_words() -> None:
    all_words = {}
    for name in set(sublimit.__all__) - {"Mesh"}:
        thing = getattr(sublimit, name)
        if inspect.isfunction(thing) or (inspect.isclass(thing) and inspect.isfunction(thing.__init__)):
            all_words[name] = set(inspect.signature(thing).parameters)
    assert {name for name, words in all_words.items() if "boundary" in words} == set(FUNCTIONS)
    for name in FUNCTIONS:
        words = all_words[name]
        assert {"orient", "crease_angle", "crease_smoothing_groups", "triangulate", "no_creases", "strict"} <= words, name
        assert ("attributes" in words) == (name in ("refine", "tessellate", "fit")), name


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_does_what_its_words_say(name: str, cube: sublimit.Mesh) -> None:
    mesh = sublimit.Mesh(cube.points * [1, 2, 3], cube.faces, smoothing_groups=list("122222"))
    run = FUNCTIONS[name]
    ring = {(0, 1): 10, (1, 2): 10, (2, 3): 10, (3, 0): 10}
    faces = mesh.face_array.copy()
    faces[5] = faces[5][[0, 3, 2, 1]]
    flipped = sublimit.Mesh(mesh.points, faces)
    every = {(int(a), int(b)): 10 for a, b in edges(cube)}
    cases: list[tuple[dict[str, Any], sublimit.Mesh, dict[tuple[int, int], int]]] = [
        (dict(crease_angle=60), mesh, every), (dict(orient=True), flipped, {}), (dict(crease_smoothing_groups=True), mesh, ring)]
    for words, changed, given in cases:
        expected = run(sublimit.Mesh(mesh.points, mesh.faces, creases=given))
        np.testing.assert_allclose(run(changed, **words), expected, atol=single, err_msg=f"{name} {words}")


def test_strict_refuses_what_the_reader_warns_of(tmp_path: pathlib.Path) -> None:
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nt crease 2/1/0 0 2 3\n")
    mesh = sublimit.read(tmp_path / "mesh.obj")
    assert len(mesh.warnings) == 1 and "mesh.obj:6: crease ignored" in mesh.warnings[0]
    with pytest.warns(sublimit.MeshWarning, match="crease ignored"):
        sublimit.refine(mesh, "catmull-clark")
    with pytest.raises(sublimit.InvalidMesh, match="it has warnings:\n.*crease ignored"):
        sublimit.refine(mesh, "catmull-clark", strict=True)


def test_sidecars(tmp_path: pathlib.Path) -> None:
    path, beside, other = tmp_path / "grid.obj", tmp_path / "grid.json", tmp_path / "other.json"
    path.write_text(GRID)
    other.write_text('{"holeIndices": [2, 3]}')
    assert len(sublimit.read(path).holes) == 0
    beside.write_text('{"holeIndices": [4]}')
    assert sublimit.read(path).holes.tolist() == sublimit.read(path, sidecar=None).holes.tolist() == [4]
    assert sublimit.read(path, sidecar="none").holes.tolist() == []
    assert sublimit.read(path, sidecar=other).holes.tolist() == sublimit.read(path, sidecar=str(other)).holes.tolist() == [2, 3]
    for text in ('[{"holeIndex": 1}]', "no JSON"):
        beside.write_text(text)
        assert sublimit.read(path).holes.tolist() == []
        with pytest.raises(sublimit.FormatError, match="grid.json"):
            sublimit.read(path, sidecar=beside)
    with pytest.raises(sublimit.IoError, match="missing.json"):
        sublimit.read(path, sidecar=tmp_path / "missing.json")


@pytest.mark.parametrize("name", ["grid.glb", "grid.gltf"])
def test_gltf_keeps_faces_colours_and_materials(name: str, grid: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    """The file groups faces by material: those of one material are in the order that they had."""
    grid.write(tmp_path / name)
    again = sublimit.read(tmp_path / name)
    assert np.array_equal(again.points, grid.points)
    named = [{tuple(sorted(face)): material for face, material in zip(mesh.face_array, mesh.materials or [])} for mesh in (again, grid)]
    assert named[0] == named[1] and set(named[0].values()) == {"m0", "m1", "m2"}
    for colour in COLOURS:
        assert np.array_equal(again.vertex_values[colour], np.asarray(grid.vertex_values[colour], np.float32))
    fine, expected = sublimit.refine(again, "catmull-clark"), sublimit.refine(grid, "catmull-clark")
    assert len(fine.face_array) == len(expected.face_array) == 36
