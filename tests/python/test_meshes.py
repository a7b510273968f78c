# SPDX-License-Identifier: Apache-2.0
"""Meshes: what they take in whatever form, what they refuse in which words, and that nothing is copied on the way out."""
from __future__ import annotations

import copy
import gc
import inspect
import pathlib
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import sublimit

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


def parts(mesh: sublimit.Mesh) -> list[Any]:
    return [mesh.points, *mesh.faces, *mesh.creases, *mesh.corners, mesh.holes, mesh.uv, mesh.uv_faces, mesh.normals, mesh.face_normals,
            mesh.face_ids, *mesh.vertex_values.values(), *mesh.face_values.values()]


def words(mesh: sublimit.Mesh) -> list[Any]:
    return [mesh.boundary, mesh.face_names, mesh.groups, mesh.objects, mesh.materials, mesh.smoothing_groups, mesh.material_files,
            [(name, array.dtype) for values in (mesh.vertex_values, mesh.face_values) for name, array in values.items()]]


def same(a: sublimit.Mesh, b: sublimit.Mesh) -> bool:
    alike = all(x is None if y is None else x is not None and np.array_equal(x, y) for x, y in zip(parts(a), parts(b)))
    return alike and words(a) == words(b)


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64])
def test_faces_of_any_integer_type(dtype: Any) -> None:
    faces = np.array([[0, 1, 2], [0, 2, 3]], dtype=dtype)
    expected = ([3, 3], [0, 1, 2, 0, 2, 3])
    for given in (faces, np.asfortranarray(faces), faces[:, ::-1][:, ::-1], faces.tolist(),
                  (np.array([3, 3], dtype), faces.ravel())):
        mesh = sublimit.Mesh(SQUARE, given)
        assert [part.tolist() for part in mesh.faces] == list(expected)


def test_faces_of_several_sizes() -> None:
    for faces in ([[0, 1, 2, 3], [0, 1, 2]], ((0, 1, 2, 3), (0, 1, 2)), (np.array([4, 3]), np.array([0, 1, 2, 3, 0, 1, 2])),
                  np.array([[0, 1, 2, 3], [0, 1, 2]], dtype=object)):
        sizes, corners = sublimit.Mesh(SQUARE, faces).faces
        assert sizes.tolist() == [4, 3] and corners.tolist() == [0, 1, 2, 3, 0, 1, 2]
    # A tuple of two triangles is no (sizes, corners).
    assert sublimit.Mesh(SQUARE, ((0, 1, 2), (0, 2, 3))).face_array.tolist() == [[0, 1, 2], [0, 2, 3]]
    with pytest.raises(sublimit.Error, match=r"\[3, 4\] corners"):
        sublimit.Mesh(SQUARE, [[0, 1, 2, 3], [0, 1, 2]]).face_array


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.float16, np.int64, ">f8"])
def test_points_of_any_real_type_and_order(dtype: Any) -> None:
    points = np.array(SQUARE, dtype=dtype)
    wide = np.zeros((8, 6), dtype=dtype)
    wide[::2, ::2] = points
    for given in (points, np.asfortranarray(points), points[::-1][::-1], wide[::2, ::2]):
        given.setflags(write=False)
        mesh = sublimit.Mesh(given, [[0, 1, 2, 3]])
        assert mesh.points.dtype == np.float64 and mesh.points.tolist() == points.tolist()


def test_arrays_are_the_meshs_own(tagged: sublimit.Mesh) -> None:
    arrays: list[Any] = [tagged.points, *tagged.faces, tagged.holes, tagged.uv, tagged.uv_faces]
    for array in arrays:
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError):
            array[...] = 0
    assert tagged.points.ctypes.data == tagged.points.ctypes.data
    points = sublimit.Mesh(SQUARE, [[0, 1, 2, 3]]).points
    gc.collect()
    assert points.tolist() == SQUARE  # though its mesh is gone


def test_tags_in_their_forms() -> None:
    for creases in ({(0, 1): 2, (1, 2): 10}, [(0, 1, 2), (1, 2, 10)], np.array([[0, 1, 2], [1, 2, 10]])):
        for corners in ({3: 1.5}, [(3, 1.5)], np.array([[3, 1.5]])):
            mesh = sublimit.Mesh(SQUARE, [[0, 1, 2, 3]], creases=creases, corners=corners, boundary="edge-only")
            edges, sharpness = mesh.creases
            assert edges.tolist() == [[0, 1], [1, 2]] and sharpness.tolist() == [2, 10]
            assert [part.tolist() for part in mesh.corners] == [[3], [1.5]]
            assert mesh.boundary == "edge-only"


def with_every_tag() -> list[sublimit.Mesh]:
    """Meshes with all tags, some of them, and none; one tag of a kind, two, and as many as columns."""
    everything: dict[str, Any] = dict(creases={(0, 1): 2.5, (1, 2): np.inf, (2, 3): 10}, corners={3: 1.5, 0: np.inf},
                                      holes=[1], boundary="edge-only", uv=np.arange(8).reshape(4, 2), normals=np.eye(4, 3),
                                      face_ids=[7, 5], groups=["left", ""], objects=["", "M\udcfcller"], materials=["a b", "a b"],
                                      smoothing_groups=["1", "off"], material_files=["first.mtl", "second file.mtl"],
                                      vertex_values={"red": np.array([0, 255, 7, 1], np.uint8), "heat": [0, 0.5, np.inf, 1]},
                                      face_values={"part": np.array([-3, 70000], np.int32), "area": [0.25, 0.1]})
    meshes = [sublimit.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]], **everything)]
    meshes += [sublimit.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]], **{name: value}) for name, value in everything.items() if name != "uv"]
    meshes.append(sublimit.Mesh(SQUARE, [[0, 1, 2, 3]], uv=everything["uv"]))
    meshes += [sublimit.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]], normals=np.eye(3), face_normals=[[0, 1, 2], [2, -1, 0]]),
               sublimit.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]], normals=np.eye(6, 3))]
    for count in range(5):
        edges = [(0, 1), (1, 2), (2, 3), (3, 0)][:count]
        meshes.append(sublimit.Mesh(SQUARE, [[0, 1, 2, 3]], creases={edge: 2 for edge in edges}, corners=dict.fromkeys(range(count), 1)))
    return [*meshes, sublimit.Mesh(SQUARE, [[0, 1, 2, 3], [0, 1, 2]], holes=[1]), sublimit.Mesh([], [])]


@pytest.mark.parametrize("mesh", with_every_tag())
def test_is_made_of_its_own_attributes(mesh: sublimit.Mesh) -> None:
    """Whatever the constructor takes is an attribute, and it takes it as that."""
    names = [name for name in inspect.signature(sublimit.Mesh.__init__).parameters if name != "self"]
    assert {"points", "faces", "creases", "corners", "holes", "boundary", "uv", "uv_faces", "normals", "face_normals", "face_ids",
            "face_names", "groups", "objects", "materials", "smoothing_groups", "material_files", "vertex_values",
            "face_values"} == set(names)
    everything: dict[str, Any] = {name: getattr(mesh, name) for name in names if name != "face_names"}  # groups again
    again = sublimit.Mesh(**everything)
    assert same(again, mesh)
    if len(mesh.faces[0]) > 0 and len(set(mesh.faces[0])) == 1:
        assert same(sublimit.Mesh(**dict(everything, faces=mesh.face_array)), mesh)
    with_it = {"uv_faces": "uv", "face_normals": "normals", "normals": "face_normals"}
    for name in names[2:]:  # each by itself, or with what it is an index of
        sublimit.Mesh(mesh.points, mesh.faces, **{one: getattr(mesh, one) for one in (name, with_it.get(name, name))})


@pytest.mark.parametrize("made", ["refined", "read", "tessellated", "fitted"])
def test_meshes_that_are_made_are_made_again(made: str, tagged: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "mesh.obj")
    meshes: dict[str, Callable[[], sublimit.Mesh]] = {
        "refined": lambda: sublimit.refine(tagged, "catmull-clark", 2, face_varying="boundaries"),
        "read": lambda: sublimit.read(tmp_path / "mesh.obj"),
        "tessellated": lambda: sublimit.tessellate(tagged, "catmull-clark", chord=0.05, normals=True),
        "fitted": lambda: sublimit.fit(tagged, "catmull-clark", [3], tagged.points[3:4]).mesh}
    mesh = meshes[made]()
    names = [name for name in inspect.signature(sublimit.Mesh.__init__).parameters if name not in ("self", "face_names")]
    assert same(sublimit.Mesh(**{name: getattr(mesh, name) for name in names}), mesh)


@pytest.mark.parametrize("mesh", with_every_tag())
def test_other_points_keep_all_else(mesh: sublimit.Mesh) -> None:
    moved = mesh.with_points(mesh.points + 1)
    assert np.array_equal(moved.points, mesh.points + 1) and same(moved.with_points(mesh.points), mesh)
    assert moved.points.ctypes.data != mesh.points.ctypes.data or len(mesh.points) == 0


def test_other_points_keep_the_tags_of_files(tmp_path: pathlib.Path) -> None:
    """Those that are no attributes, too: knot intervals, rules."""
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nt knotinterval 2/1/0 0 1 3\n"
                                       "t creasemethod 0/0/1 chaikin\n")
    mesh = sublimit.read(tmp_path / "mesh.obj")
    mesh.with_points(mesh.points).write(tmp_path / "again.obj")
    mesh.write(tmp_path / "first.obj")
    text = (tmp_path / "first.obj").read_text()
    assert text == (tmp_path / "again.obj").read_text() and "knotinterval" in text and "chaikin" in text


@pytest.mark.parametrize("points, words", [
    (np.zeros((3, 3)), r"points has shape \(3, 3\); \(4 vertices, 3\) is right"), (np.zeros((4, 2)), r"shape \(4, 2\)"),
    (np.full((4, 3), np.nan), r"points\[0, 0\] is nan"), (np.full((4, 3), np.inf), "is inf"), (np.full((4, 3), "a"), "dtype <U1"),
    ([[0, 0, 0]], r"shape \(1, 3\)"), (None, "objects")])
def test_refuses_other_points(points: Any, words: str) -> None:
    with pytest.raises(sublimit.Error, match=words):
        sublimit.Mesh(SQUARE, [[0, 1, 2, 3]]).with_points(points)


def test_normals_in_their_forms() -> None:
    faces = [[0, 1, 2], [0, 2, 3]]
    of_vertices = sublimit.Mesh(SQUARE, faces, normals=np.eye(4, 3))
    assert of_vertices.normals is not None and of_vertices.normals.shape == (4, 3) and of_vertices.face_normals is None
    assert not of_vertices.normals.flags.writeable
    of_corners = sublimit.Mesh(SQUARE, faces, normals=np.eye(6, 3))
    assert of_corners.face_normals is not None and of_corners.face_normals.tolist() == [0, 1, 2, 3, 4, 5]
    for given in ([[0, 1, 2], [2, -1, 0]], np.array([0, 1, 2, 2, -1, 0])):
        named = sublimit.Mesh(SQUARE, faces, normals=np.eye(3), face_normals=given)
        assert named.face_normals is not None and named.face_normals.tolist() == [0, 1, 2, 2, -1, 0]
    plain = sublimit.Mesh(SQUARE, faces)
    assert plain.normals is plain.face_normals is plain.face_ids is plain.face_names is None


def test_names_of_faces(tmp_path: pathlib.Path) -> None:
    """Of groups and objects, in whatever bytes."""
    (tmp_path / "mesh.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\no M\xfcller\nf 1 2 3\n"
                                        b"g \xc3\xbc\nf 2 4 3\n")
    mesh = sublimit.read(tmp_path / "mesh.obj")
    assert mesh.face_names == ["", "M\udcfcller", "\u00fc"]
    assert mesh.groups == ["", "", "\u00fc"] and mesh.objects == ["", "M\udcfcller", "M\udcfcller"]
    again = sublimit.Mesh(mesh.points, mesh.faces, face_names=mesh.face_names)
    assert again.groups == mesh.face_names and again.objects is None
    assert again.face_names == pickle.loads(pickle.dumps(again)).face_names == mesh.face_names


def test_two_arrays_are_tags_or_rows() -> None:
    face = [[0, 1, 2, 3]]
    rows = sublimit.Mesh(SQUARE, face, corners=(np.array([3, 1.5]), np.array([0, 2.5])))
    assert [part.tolist() for part in rows.corners] == [[3, 0], [1.5, 2.5]]
    pair = sublimit.Mesh(SQUARE, face, corners=(np.array([3, 0]), np.array([1.5, 2.5])))
    assert same(pair, rows)
    with pytest.raises(sublimit.Error, match="which may be"):
        sublimit.Mesh(SQUARE, face, corners=(np.array([3, 2]), np.array([0, 2])))
    two = sublimit.Mesh(SQUARE, face, creases=(np.array([0, 1, 2]), np.array([1, 2, 3])))
    assert [part.tolist() for part in two.creases] == [[[0, 1], [1, 2]], [2, 3]]


def test_texture_coordinates_in_their_forms() -> None:
    uv = [[0, 0], [1, 0], [1, 1], [0, 1]]
    faces = [[0, 1, 2], [0, 2, 3]]
    of_corners = [uv[v] for face in faces for v in face]
    for given, value_of in ((dict(uv=uv), [0, 1, 2, 0, 2, 3]), (dict(uv=of_corners), [0, 1, 2, 3, 4, 5]),
                            (dict(uv=uv, uv_faces=faces), [0, 1, 2, 0, 2, 3]),
                            (dict(uv=uv, uv_faces=np.array([3, 2, 1, 0, 0, 0])), [3, 2, 1, 0, 0, 0])):
        mesh = sublimit.Mesh(SQUARE, faces, **given)  # type: ignore[arg-type]
        assert mesh.uv_faces is not None and mesh.uv_faces.tolist() == value_of
    assert sublimit.Mesh(SQUARE, faces).uv is None


MASKED: Any = np.ma.masked_array(np.zeros((4, 3)), mask=np.eye(4, 3))  # type: ignore[no-untyped-call]
SEVERAL_COLUMNS = np.zeros((4, 4))


@pytest.mark.parametrize("given, words", [
    (dict(points=np.zeros((4, 2))), r"points has shape \(4, 2\); \(vertices, 3\) is right"),
    (dict(points=np.zeros(12)), r"points has shape \(12,\); \(vertices, 3\)"),
    (dict(points=[[0, 0, 0], [1, 0]]), "points is ragged|points is an array of objects"),
    (dict(points=np.zeros((4, 3), dtype=complex)), "points has dtype complex128; real numbers"),
    (dict(points=np.zeros((4, 3), dtype=object)), "points is an array of objects"),
    (dict(points=np.full((4, 3), "a")), "points has dtype <U1"),
    (dict(points=MASKED), "points has masked entries"),
    (dict(points=[[0, 0, 0], [1, 0, float("nan")], [0, 1, 0], [1, 1, 1]]), r"points\[1, 2\] is nan; finite"),
    (dict(points=[[0, 0, 0], [1, 0, float("inf")], [0, 1, 0], [1, 1, 1]]), r"points\[1, 2\] is inf"),
    (dict(faces=[[0, 1, 4]]), "vertex 4"),
    (dict(faces=[[0, 1, -1]]), "vertex -1"),
    (dict(faces=[[0, 1]]), "2 corners"),
    (dict(faces=[[0, 1, 2.5]]), "faces has dtype float64; whole numbers"),
    (dict(faces=[[0, 1, 2**40]]), "faces has 1099511627776; 32-bit"),
    (dict(faces=(np.array([3, 3]), np.array([0, 1, 2]))), "sizes add up to 6 corners, but there are 3"),
    (dict(creases={(0, 2): 1}), r"crease \(0,2\) is not an edge"),
    (dict(creases={(0, 1): -1}), "sharpness -1"),
    (dict(creases={(0.5, 1): 1}), "creases names vertex 0.5; whole numbers"),
    (dict(creases={(np.nan, 1): 1}), "creases names vertex nan; whole numbers"),
    (dict(creases={(np.inf, 1): 1}), "creases names vertex inf; whole numbers"),
    (dict(creases={(0, 1): np.nan}), r"creases\[0\] has sharpness nan; 0 to infinity"),
    (dict(creases=(np.array([[0, 1]]), np.array([1.0, 2]))), "creases is"),
    (dict(creases=[(0, 1)]), r"creases has shape \(1, 2\); \{\(tail, head\): sharpness\}"),
    (dict(corners={9: 1}), "corner 9 is not a vertex"),
    (dict(holes=[7]), "hole 7 is not a face"),
    (dict(holes=[0.5]), "holes has dtype float64"),
    (dict(boundary="round"), "boundary 'round' is no rule"),
    (dict(uv=np.zeros((3, 2))), "uv has 3 values; 4 of vertices or 4 of corners"),
    (dict(uv=SEVERAL_COLUMNS), r"uv has shape \(4, 4\)"),
    (dict(uv=np.zeros((4, 2)), uv_faces=[[0, 1, 2]]), "uv_faces has 3 corners"),
    (dict(uv=np.zeros((4, 2)), uv_faces=[[0, 1, 2, 4]]), "uv_faces names value 4; uv has 4"),
    (dict(uv_faces=[[0, 1, 2, 3]]), "there is no uv"),
    (dict(normals=np.zeros((3, 3))), "normals has 3 rows; 4 of vertices or 4 of corners"),
    (dict(normals=np.zeros((4, 2))), r"normals has shape \(4, 2\)"),
    (dict(normals=np.full((4, 3), np.nan)), r"normals\[0, 0\] is nan"),
    (dict(normals=np.eye(3), face_normals=[[0, 1, 2]]), "face_normals has 3 corners"),
    (dict(normals=np.eye(3), face_normals=[[0, 1, 2, 3]]), "face_normals names normal 3; normals has 3"),
    (dict(normals=np.eye(3), face_normals=[[0, 1, 2, -2]]), "face_normals names normal -2"),
    (dict(face_normals=[[0, 1, 2, 3]]), "there are no normals"),
    (dict(face_ids=[1, 2]), r"face_ids has shape \(2,\); \(1 faces,\)"),
    (dict(face_ids=[0.5]), "face_ids has dtype float64"),
    (dict(face_names=["a", "b"]), "face_names has 2 names; 1 are right"),
    (dict(materials=["a", "b"]), "materials has 2 names; 1 are right"),
    (dict(face_names=["a"], groups=["a"]), "face_names is another name of groups"),
    (dict(vertex_values={"red": [1, 2]}), r"vertex_values\['red'\] has shape \(2,\); \(4 vertices,\) is right"),
    (dict(face_values={"part": np.eye(1)}), r"face_values\['part'\] has shape \(1, 1\); \(1 faces,\) is right"),
    (dict(vertex_values={"red": ["a"] * 4}), r"vertex_values\['red'\] has dtype <U1; real numbers"),
])
def test_refuses_in_clear_words(given: dict[str, Any], words: str) -> None:
    arguments: dict[str, Any] = {"points": SQUARE, "faces": [[0, 1, 2, 3]], **given}
    with pytest.raises(sublimit.Error, match=words):
        sublimit.Mesh(**arguments)


def test_errors_have_codes(tmp_path: pathlib.Path) -> None:
    with pytest.raises(sublimit.Error) as caught:
        sublimit.Mesh(SQUARE, [[0, 1, 4]])
    assert caught.type is sublimit.InvalidMesh and caught.value.code == "invalid_mesh"
    with pytest.raises(OSError) as missing:
        sublimit.read("no such mesh.obj")
    assert missing.type is sublimit.IoError
    with pytest.raises(sublimit.FormatError, match="mesh.xyz"):
        (tmp_path / "mesh.xyz").write_text("0 0 0")
        sublimit.read(tmp_path / "mesh.xyz")


def test_empty_meshes() -> None:
    mesh = sublimit.Mesh(np.zeros((0, 3)), np.zeros((0, 4), int))
    assert sublimit.refine(mesh, "catmull-clark").points.shape == (0, 3)
    assert sublimit.Mesh([], []).points.shape == (0, 3)
    assert sublimit.Mesh(SQUARE, []).faces[0].tolist() == []


def test_files_and_back(tagged: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "mesh.obj")
    assert same(sublimit.read(tmp_path / "mesh.obj"), tagged)
    tagged.write(str(tmp_path / "mesh.ply"))
    assert np.array_equal(sublimit.read(tmp_path / "mesh.ply").points, tagged.points)
    with pytest.raises(sublimit.InvalidOption, match="obj"):
        tagged.write(tmp_path / "mesh.dae")
    with pytest.raises(sublimit.IoError):
        tagged.write(tmp_path / "nowhere" / "mesh.obj")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mesh.obj", "mesh.ply"]


def test_pickles(tagged: sublimit.Mesh) -> None:
    again = pickle.loads(pickle.dumps(tagged))
    assert same(again, tagged) and again.points.ctypes.data != tagged.points.ctypes.data


@pytest.mark.parametrize("mesh", with_every_tag())
def test_pickles_and_copies_keep_everything(mesh: sublimit.Mesh) -> None:
    for again in (pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh)):
        assert same(again, mesh)


def test_pickles_keep_every_tag_of_a_file(tmp_path: pathlib.Path) -> None:
    (tmp_path / "mesh.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nt crease 2/1/0 0 1 2.5\n"
        "t corner 1/1/0 2 1.5\nt knotinterval 2/1/0 0 1 3\nt creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n"
        "t interpolateboundary 1/0/0 2\nt facevaryinginterpolateboundary 1/0/0 2\nt hole 1/0/0 0\n")
    mesh = sublimit.read(tmp_path / "mesh.obj")
    mesh.write(tmp_path / "first.obj")
    pickle.loads(pickle.dumps(mesh)).write(tmp_path / "second.obj")
    text = (tmp_path / "first.obj").read_text()
    assert text == (tmp_path / "second.obj").read_text()
    for tag in ("crease ", "corner", "knotinterval", "creasemethod", "smoothtriangles", "interpolateboundary", "hole"):
        assert f"t {tag}" in text


def test_pickles_keep_what_files_of_triangles_have(tagged: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    near = sublimit.tessellate(tagged, "catmull-clark", chord=0.05, normals=True)
    again = pickle.loads(pickle.dumps(near))
    assert same(again, near) and again.face_ids is not None and again.normals is not None
    near.write(tmp_path / "first.obj")
    again.write(tmp_path / "second.obj")
    assert (tmp_path / "first.obj").read_bytes() == (tmp_path / "second.obj").read_bytes()


@pytest.mark.parametrize("names, words", [("left", "is one word"), ([1], r"\[0\] is a int"), ([None], "NoneType")])
@pytest.mark.parametrize("kind", ["face_names", "groups", "objects", "materials", "smoothing_groups", "material_files"])
def test_refuses_names_of_faces(kind: str, names: Any, words: str) -> None:
    with pytest.raises(TypeError, match=f"{kind}.*{words}"):
        sublimit.Mesh(SQUARE, [[0, 1, 2, 3]], **{kind: names})


@pytest.mark.parametrize("values, words", [([1, 2, 3, 4], "vertex_values is a list; a mapping"), ({1: [0] * 4}, "a name that is a int")])
def test_refuses_values_without_names(values: Any, words: str) -> None:
    with pytest.raises(TypeError, match=words):
        sublimit.Mesh(SQUARE, [[0, 1, 2, 3]], vertex_values=values)


def test_says_what_is_no_manifold() -> None:
    assert sublimit.Mesh(SQUARE, [[0, 1, 2], [0, 1, 3], [0, 1, 2]]).faults()
    assert not sublimit.Mesh(SQUARE, [[0, 1, 2, 3]]).faults()
