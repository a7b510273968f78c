# SPDX-License-Identifier: Apache-2.0
"""Tables on GPUs: the numbers of the CPU, and errors where there is none."""
from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import threading
from typing import Any

import numpy as np
import pytest
from tolerance import single, single_sums

import sublimit

#: No driver of Vulkan or CUDA is found.
NOWHERE = {**os.environ, "VK_DRIVER_FILES": "/nonexistent.json", "VK_ICD_FILENAMES": "/nonexistent.json", "CUDA_VISIBLE_DEVICES": ""}


@pytest.fixture
def gpu() -> str:
    """The first one, or the one that SUBLIMIT_TEST_GPU numbers, as for the tests in C++."""
    found = sublimit.gpu_devices()
    if not found:
        missing = "NO GPU, and no mesa-vulkan-drivers that stand in for one: tables are not applied on any"
        if os.environ.get("CI"):  # .ci/install-deps --all has installed them there
            pytest.fail(missing)
        pytest.skip(missing)
    return f"gpu:{os.environ.get('SUBLIMIT_TEST_GPU', '0')}"


def test_lists_gpus(gpu: str) -> None:
    found = sublimit.gpu_devices()
    for number, info in enumerate(found):
        assert info.device == f"gpu:{number}" and info.name and info.driver and info.memory > 0
        assert info.api in ("Vulkan", "CUDA") and info.kind in ("discrete", "integrated", "virtual", "cpu")
        assert isinstance(info.halves, bool)
    assert found == sublimit.gpu_devices()


@pytest.mark.parametrize("asked", [
    dict(levels=3), dict(levels=2, limit=True, derivatives=2), dict(grid=4, derivatives=1),
    dict(at=(np.arange(6), 0.25, 0.75), derivatives=1)])
def test_makes_the_numbers_of_the_cpu(asked: Any, gpu: str, cube: sublimit.Mesh) -> None:
    table = sublimit.bake(cube, "catmull-clark", **asked)
    frames = np.stack([cube.points, cube.points[::-1] + 1, 2 * cube.points]).astype(np.float32)
    for points in (frames, frames[0], frames[0, :, :1], frames[0][::-1]):
        made, right = table.apply(points, device=gpu), table.apply(points)
        assert made.shape == right.shape and made.dtype == np.float32
        np.testing.assert_allclose(made, right, rtol=0, atol=4 * single)  # numbers up to 4, derivatives as large
    out = np.empty_like(right)
    assert table.apply(points, out, device=gpu) is out and np.array_equal(out, made)
    values = np.random.default_rng(1).random(made.shape).astype(np.float32)
    for part in (values, values[0] if table.quantities > 1 else values):
        transposed, right = table.apply_transpose(part, device=gpu), table.apply_transpose(part)
        np.testing.assert_allclose(transposed, right, rtol=0, atol=single_sums)


def test_divides_on_the_gpu(gpu: str, tmp_path: pathlib.Path) -> None:
    w = 0.5**0.5
    (tmp_path / "arc.obj").write_text(f"v 1 0 0 1\nv 1 1 0 {w}\nv 0 1 0 1\nv 1 0 1 1\nv 1 1 1 {w}\nv 0 1 1 1\ncstype rat bezier\ndeg 2 1\n"
                                      "surf 0 1 0 1 1 2 3 4 5 6\nparm u 0 1\nparm v 0 1\nend\n")
    cylinder = sublimit.Patches.read(tmp_path / "arc.obj")
    table = cylinder.bake(grid=5, derivatives=1)
    assert table.rational
    made = table.apply(cylinder.points, device=gpu)
    np.testing.assert_allclose(made, table.apply(cylinder.points), rtol=0, atol=4 * single)
    np.testing.assert_allclose(np.linalg.norm(made[0][:, :2], axis=1), 1, rtol=0, atol=4 * single)


def test_threads_share_tables_and_tables_share_devices(gpu: str, cube: sublimit.Mesh) -> None:
    tables = [sublimit.bake(cube, "catmull-clark", levels=level) for level in (1, 2, 3)]
    right = [table.apply(cube.points, device=gpu) for table in tables]
    fresh = [sublimit.bake(cube, "catmull-clark", levels=level) for level in (1, 2, 3)]
    failed: list[int] = []

    def work() -> None:
        for i, table in enumerate(fresh):
            if not np.array_equal(table.apply(cube.points, device=gpu), right[i]):
                failed.append(i)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failed


def test_refuses_what_gpus_do_not_take(gpu: str, cube: sublimit.Mesh) -> None:
    double = sublimit.bake(cube, "catmull-clark", levels=1, precision="double")
    calls: list[tuple[Any, int]] = [(double.apply, 8), (double.apply_transpose, double.num_points)]
    for apply, count in calls:
        with pytest.raises(sublimit.InvalidOption, match="tables in float.*precision='float'.*device='cpu'"):
            apply(np.zeros((count, 3)), device=gpu)
    single_table = sublimit.bake(cube, "catmull-clark", levels=1)
    with pytest.raises(sublimit.InvalidOption, match="no GPU 999;.*device='cpu'"):
        single_table.apply(cube.points, device="gpu:999")
    assert single_table.apply(cube.points, device=gpu).shape == (26, 3)


@pytest.mark.parametrize("device", ["", "GPU", "cuda", "gpu:", "gpu:-1", "gpu:x", "gpu:99999", 0, None])
def test_refuses_other_devices(device: Any, cube: sublimit.Mesh) -> None:
    table = sublimit.bake(cube, "catmull-clark", levels=1)
    with pytest.raises(sublimit.Error, match="device is .*'cpu', 'gpu' or 'gpu:1' are right"):
        table.apply(cube.points, device=device)
    with pytest.raises(sublimit.Error, match="device is"):
        table.apply_transpose(np.zeros((26, 3)), device=device)


def test_says_what_is_missing_where_there_is_none() -> None:
    code = ("import numpy, sublimit\n"
            "assert sublimit.gpu_devices() == []\n"
            "mesh = sublimit.Mesh(numpy.eye(4, 3), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])\n"
            "table = sublimit.bake(mesh, 'loop', levels=1)\n"
            "for call in (table.apply, table.apply_transpose):\n"
            "    try: call(numpy.zeros((4 if call == table.apply else 10, 3)), device='gpu')\n"
            "    except sublimit.InvalidOption as error: print(error)\n"
            "print(table.apply(mesh.points).shape)\n")
    done = subprocess.run([sys.executable, "-c", code], env=NOWHERE, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    first, second, shape = done.stdout.splitlines()
    assert first == second and shape == "(10, 3)"
    assert "GPU" in first and "device='cpu' applies tables on the CPU" in first
    assert any(word in first for word in ("driver", "libvulkan", "SUBLIMIT_BUILD_GPU")), first
