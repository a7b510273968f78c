# SPDX-License-Identifier: Apache-2.0
"""Scenes of USD."""
from __future__ import annotations

import pathlib

import numpy as np
import pytest

import sublimit

CUBE_POINTS = [[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
CUBE_FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


@pytest.mark.parametrize("extension", [".usda", ".usdz"])
def test_meshes_come_back_with_their_scheme(tmp_path: pathlib.Path, extension: str) -> None:
    mesh = sublimit.Mesh(CUBE_POINTS, CUBE_FACES, creases={(0, 1): 2.5}, materials=["a", "b", "a", "b", "a", "b"])
    refined = sublimit.refine(mesh, "catmull-clark", 1)
    assert refined.scheme == "catmull-clark" and mesh.scheme == ""
    path = tmp_path / ("cage" + extension)
    refined.write(path)
    back = sublimit.read(path)
    assert back.scheme == "catmull-clark"
    assert np.array_equal(back.points, refined.points)
    assert all(np.array_equal(a, b) for a, b in zip(back.creases, refined.creases))
    assert back.materials == refined.materials


def test_flatten_makes_triangles_of_a_scene(tmp_path: pathlib.Path) -> None:
    cage, flat = tmp_path / "cage.usda", tmp_path / "flat.usda"
    mesh = sublimit.Mesh(CUBE_POINTS, CUBE_FACES)
    sublimit.refine(mesh, "catmull-clark", 0).write(cage)
    made = sublimit.flatten(cage, flat, relative_chord=0.01)
    assert isinstance(made, sublimit.FlattenedScene) and made.warnings == []
    (told,) = made.meshes
    assert isinstance(told, sublimit.FlatMesh) and told.path == "/mesh" and told.why_not == ""
    triangles = sublimit.read(flat)
    assert triangles.scheme == "" and len(triangles.face_array) == told.triangles
    surface = sublimit.LimitSurface(mesh, "catmull-clark")
    near = surface.closest(triangles.points)
    assert np.max(near.distance) < 1e-6  # floats of the file
    assert told.bound <= 0.01 * np.sqrt(12)
    coarse = sublimit.flatten(cage, tmp_path / "coarse.ply", chord=0.2)
    assert coarse.meshes[0].triangles < told.triangles
    with pytest.raises(sublimit.InvalidParameter, match="negative"):
        sublimit.flatten(cage, flat, chord=-1)
    with pytest.raises(sublimit.IoError, match="none.usda"):
        sublimit.flatten(tmp_path / "none.usda", flat)
