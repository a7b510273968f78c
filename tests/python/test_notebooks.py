# SPDX-License-Identifier: Apache-2.0
"""What notebooks show, and meshes of other packages."""
from __future__ import annotations

import json
import pathlib
import sys
import xml.etree.ElementTree
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tolerance import products, rounding

import sublimit


def test_info_is_the_programs(tagged: sublimit.Mesh, program: Callable[..., str], tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "mesh.obj")
    for scheme in (None, "catmull-clark", "loop"):
        status = 1 if scheme == "loop" else 0  # which does not take quadrilaterals
        theirs = json.loads(program("info", tmp_path / "mesh.obj", "--json", *(["-s", scheme] if scheme else []), status=status))
        ours = tagged.info(scheme)
        assert ours == sublimit.info(tagged, scheme)
        assert theirs.pop("mesh") and ours.pop("mesh") == "mesh" and ours == theirs


def test_integrals_of_the_limit(cube: sublimit.Mesh) -> None:
    box = cube.info("bilinear", limit=True)["limit"]
    assert abs(box["area"] - 6) < rounding * 100 and abs(box["solid"]["volume"] - 1) < rounding * 100
    np.testing.assert_allclose(box["solid"]["centroid"], [0.5] * 3, rtol=0, atol=products)
    np.testing.assert_allclose(box["solid"]["inertia"], np.eye(3) / 6, rtol=0, atol=products)
    kobbelt = cube.info("kobbelt", limit=True)["limit"]
    assert 0 < kobbelt["area_error"] < 1e-5 * kobbelt["area"] and 0 < kobbelt["solid"]["volume_error"] < 1e-5
    with pytest.raises(sublimit.InvalidOption, match="name one"):
        cube.info(limit=True)
    assert sublimit.info(cube, "bilinear", limit=True)["limit"] == box
    with pytest.raises(sublimit.InvalidOption, match="unknown scheme 'lop'"):
        sublimit.info(cube, "lop")
    with pytest.raises(sublimit.UnsupportedTopology, match="triangles"):
        sublimit.info(cube, "loop", limit=True)
    with pytest.raises(TypeError, match="mesh is a list"):
        sublimit.info([])  # type: ignore[arg-type]


def test_meshes_are_pictures(tagged: sublimit.Mesh) -> None:
    shown = xml.etree.ElementTree.fromstring(tagged._repr_html_())
    picture = next(iter(shown))
    assert picture.tag.endswith("svg") and len(picture) == 13
    assert "20 vertices" in "".join(shown.itertext())
    assert len(sublimit.refine(tagged, "catmull-clark", 5)._repr_html_()) < 500_000
    assert "0 vertices" in sublimit.Mesh([], [])._repr_html_()


def test_triangles(tagged: sublimit.Mesh) -> None:
    expected = [[c[0], c[i], c[i + 1]] for c in np.split(tagged.faces[1], np.cumsum(tagged.faces[0])[:-1]) for i in range(1, len(c) - 1)]
    assert tagged.triangles().tolist() == np.array(expected).tolist()


def test_meshes_of_others(cube: sublimit.Mesh) -> None:
    like_trimesh = SimpleNamespace(vertices=cube.points, faces=cube.triangles())
    assert sublimit.Mesh.from_trimesh(like_trimesh).face_array.shape == (12, 3)
    cells = [SimpleNamespace(type="vertex", data=np.array([[0]])), SimpleNamespace(type="quad", data=cube.face_array),
             SimpleNamespace(type="triangle", data=cube.triangles()[:2])]
    sizes, corners = sublimit.Mesh.from_trimesh(SimpleNamespace(points=cube.points, cells=cells)).faces
    assert sizes.tolist() == [4] * 6 + [3] * 2 and len(corners) == 30
    with pytest.raises(TypeError, match="neither vertices and faces nor points and cells"):
        sublimit.Mesh.from_trimesh(3)


def test_meshes_for_others(cube: sublimit.Mesh, monkeypatch: pytest.MonkeyPatch) -> None:
    """trimesh is not in Debian: what stands for it takes what its constructor takes."""

    class Trimesh:
        def __init__(self, vertices: Any, faces: Any, *, process: bool = True) -> None:
            self.vertices, self.faces, self.process = vertices, faces, process

    modules: dict[str, Any] = sys.modules
    monkeypatch.setitem(modules, "trimesh", SimpleNamespace(Trimesh=Trimesh))
    theirs = cube.to_trimesh()
    assert np.shares_memory(theirs.vertices, cube.points) and not theirs.process  # which would merge and reorder vertices
    again = sublimit.Mesh.from_trimesh(theirs)
    assert np.array_equal(again.points, cube.points) and np.array_equal(again.face_array, cube.triangles())
    monkeypatch.setitem(modules, "trimesh", None)
    with pytest.raises(ImportError):
        cube.to_trimesh()
