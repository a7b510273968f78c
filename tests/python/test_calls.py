# SPDX-License-Identifier: Apache-2.0
"""How calls behave beside other threads, signals, forks and many objects."""
from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import sublimit


def torus(n: int) -> sublimit.Mesh:
    i, j = np.divmod(np.arange(n * n), n)
    a, b = 2 * np.pi * i / n, 2 * np.pi * j / n
    points = np.column_stack([(3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)])
    return sublimit.Mesh(points, np.column_stack([i * n + j, (i + 1) % n * n + j, (i + 1) % n * n + (j + 1) % n, i * n + (j + 1) % n]))


def test_ctrl_c_leaves_long_calls() -> None:
    """Of samples that take many seconds; how soon is measured elsewhere, that it is long before the end here."""
    mesh = torus(60)
    surface = sublimit.LimitSurface(mesh, "modified-butterfly", triangulate=True)
    random = np.random.default_rng(1)
    many = 1_000_000
    face, u, v = random.integers(0, surface.num_faces, many), random.random(many) / 2, random.random(many) / 2
    surface.evaluate(face[:1000], u[:1000], v[:1000], derivatives=2)
    begin = time.perf_counter()
    surface.evaluate(face[:20000], u[:20000], v[:20000], derivatives=2)
    all_of_it = (time.perf_counter() - begin) * many / 20000
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.perf_counter()
    try:
        with pytest.raises(KeyboardInterrupt):
            surface.evaluate(face, u, v, derivatives=2)
            time.sleep(5)
    finally:
        timer.cancel()
    assert time.perf_counter() - begin < max(0.5 * all_of_it, 2)
    assert np.isfinite(surface.evaluate(0, 0.25, 0.25).points).all()  # what was left is usable


def test_calls_let_other_threads_run() -> None:
    mesh, counted, done = torus(200), 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    for _ in range(3):
        sublimit.refine(mesh, "catmull-clark", 2)
    after = counted
    done.set()
    thread.join()
    assert after - before > 1000


def test_forks_after_threads() -> None:
    """Other processes are begun anew: TBB's threads are not there after a fork."""
    code = ("import multiprocessing, sublimit, test_calls\n"
            "def work(n): return len(sublimit.refine(test_calls.torus(n), 'catmull-clark').points)\n"
            "if __name__ == '__main__':\n"
            "    work(50)\n"
            "    with multiprocessing.get_context('spawn').Pool(2) as pool: print(pool.map(work, [10, 20]))\n")
    path = os.pathsep.join([os.path.dirname(__file__), *sys.path])
    script = os.path.join(os.environ.get("TMPDIR", "/tmp"), f"sublimit_spawn_{os.getpid()}.py")
    try:
        with open(script, "w") as file:
            file.write(code)
        done = subprocess.run([sys.executable, script], env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True)
    finally:
        os.unlink(script)
    assert done.stdout.strip() == "[400, 1600]", done.stderr


def resident_bytes() -> int:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer keeps what is freed: growth is not looked at")
@pytest.mark.parametrize("kind, count, allowed", [("mesh", 100_000, 8), ("table", 2000, 400), ("surface", 500, 1500)])
def test_many_objects_leave_no_memory_behind(kind: str, count: int, allowed: int, cube: sublimit.Mesh) -> None:
    """Bytes that a cycle may leave, of some thousand that each has: heaps break into pieces."""
    points, faces = cube.points, cube.face_array

    def cycles(number: int) -> None:
        for _ in range(number):
            if kind == "mesh":
                sublimit.Mesh(points, faces)
            elif kind == "table":
                sublimit.bake(cube, "bilinear", levels=1).apply(points)
            else:
                sublimit.LimitSurface(cube, "catmull-clark").evaluate(0, 0.5, 0.5)

    cycles(count // 10)
    before = resident_bytes()
    cycles(count)
    assert resident_bytes() - before <= allowed * count


def test_mesh_views_keep_their_mesh(cube: sublimit.Mesh) -> None:
    views = [sublimit.refine(cube, "catmull-clark", 3).points for _ in range(50)]
    for points in views[1:]:
        assert np.array_equal(points, views[0])
