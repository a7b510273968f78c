# SPDX-License-Identifier: Apache-2.0
"""A cage in motion: a table is baked once, and applied to all frames at once.

    python3 animate.py [DIRECTORY]        writes the last frame, smooth.ply, there
"""
from __future__ import annotations

import pathlib
import sys
import time

import numpy as np

import sublimit

m, n = 40, 16
i, j = np.divmod(np.arange(m * n), n)
faces = np.column_stack([i * n + j, (i + 1) % m * n + j, (i + 1) % m * n + (j + 1) % n, i * n + (j + 1) % n])


def cage(time: float) -> np.ndarray:
    """A ring that waves."""
    a, b = 2 * np.pi * i / m, 2 * np.pi * j / n
    r = 3 + np.cos(b) + 0.2 * np.sin(5 * a + time)
    return np.column_stack([r * np.cos(a), r * np.sin(a), np.sin(b) + 0.3 * np.sin(3 * a - 2 * time)])


mesh = sublimit.Mesh(cage(0), faces)
table = sublimit.bake(mesh, "catmull-clark", levels=3, limit=True)
frames = np.stack([cage(t) for t in np.linspace(0, 2 * np.pi, 48, endpoint=False)]).astype(table.dtype)
begin = time.perf_counter()
points = table.apply(frames)
seconds = time.perf_counter() - begin
print(f"{table}: {len(frames)} frames in {1e3 * seconds:.1f} ms, {1e9 * seconds / points[..., 0].size:.1f} ns a point")

# The same frame without a table.
exact = sublimit.limit(sublimit.Mesh(cage(0), faces), "catmull-clark", levels=3)
assert len(exact.points) == points.shape[1]
assert abs(np.sort(exact.points, axis=0) - np.sort(points[0].astype(float), axis=0)).max() < 1e-5

directory = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
sublimit.Mesh(points[-1], table.faces).write(directory / "smooth.ply")
