# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python module share. ctest says where the program and the shared meshes are."""
from __future__ import annotations

import os
import pathlib
import subprocess
from collections.abc import Callable

import numpy as np
import pytest

import sublimit

SHARED_MESHES = pathlib.Path(os.environ.get("SUBLIMIT_SHARED_MESHES", "no meshes"))


@pytest.fixture
def cube() -> sublimit.Mesh:
    return sublimit.Mesh(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
        [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])


@pytest.fixture
def icosahedron() -> sublimit.Mesh:
    phi = (1 + 5**0.5) / 2
    points = [[-1, phi, 0], [1, phi, 0], [-1, -phi, 0], [1, -phi, 0], [0, -1, phi], [0, 1, phi], [0, -1, -phi], [0, 1, -phi],
              [phi, 0, -1], [phi, 0, 1], [-phi, 0, -1], [-phi, 0, 1]]
    faces = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
             [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]]
    return sublimit.Mesh(points, faces)


@pytest.fixture
def tagged() -> sublimit.Mesh:
    """An open grid of quadrilaterals and a triangle, with creases, a corner and a hole, and texture coordinates."""
    x, y = np.meshgrid(np.arange(5.0), np.arange(4.0))
    points = np.column_stack([x.ravel(), y.ravel(), np.sin(x + 2 * y).ravel()])
    faces = [[5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5] for j in range(3) for i in range(4)]
    faces[0:1] = [[0, 1, 6], [0, 6, 5]]
    return sublimit.Mesh(points, faces, creases={(6, 7): 2.5, (7, 8): 10}, corners={12: 1.25}, holes=[9], uv=points[:, :2])


@pytest.fixture
def dressed(tagged: sublimit.Mesh) -> sublimit.Mesh:
    """The same, with colours, materials and smoothing groups."""
    colours = np.random.default_rng(5).random((3, len(tagged.points))).astype(np.float32)
    num_faces = len(tagged.faces[0])
    return sublimit.Mesh(tagged.points, tagged.faces, creases=tagged.creases, corners=tagged.corners, holes=tagged.holes, uv=tagged.uv,
                         uv_faces=tagged.uv_faces, vertex_values=dict(zip(("red", "green", "blue"), colours)),
                         materials=[f"m{face % 3}" for face in range(num_faces)], material_files=["all.mtl"],
                         smoothing_groups=[str(1 + face // 5) for face in range(num_faces)])


@pytest.fixture(scope="session")
def program() -> Callable[..., str]:
    """Runs the program; what it prints."""

    def run(*arguments: object, status: int = 0) -> str:
        done = subprocess.run([os.environ["SUBLIMIT_PROGRAM"], *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return done.stdout

    return run


def shared_mesh(name: str) -> pathlib.Path:
    path = SHARED_MESHES / f"{name}.obj"
    if not path.exists():
        pytest.skip(f"NO SHARED MESHES at {SHARED_MESHES}: {name} is not compared")
    return path
