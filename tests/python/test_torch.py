# SPDX-License-Identifier: Apache-2.0
"""Tables in PyTorch: values, first and second derivatives, and arrays of other packages by DLPack."""
from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tolerance import derivatives

import sublimit

torch = pytest.importorskip("torch", reason="NO PYTORCH: python3-torch is not installed")


@pytest.mark.parametrize("asked", [dict(levels=2, limit=True), dict(grid=3, derivatives=1)])
@pytest.mark.parametrize("frames", [None, 2])
def test_gradients(asked: dict[str, Any], frames: int | None, cube: sublimit.Mesh) -> None:
    import sublimit.torch

    table = sublimit.bake(cube, "catmull-clark", precision="double", **asked)
    points = torch.tensor(cube.points if frames is None else np.stack([cube.points, 2 * cube.points]), requires_grad=True)
    made = sublimit.torch.apply(table, points)
    assert np.array_equal(made.detach().numpy(), table.apply(points.detach().numpy()))
    small = points[..., :1].detach().requires_grad_()
    assert torch.autograd.gradcheck(lambda x: sublimit.torch.apply(table, x), small)
    assert torch.autograd.gradgradcheck(lambda x: sublimit.torch.apply(table, x), small)
    made.square().sum().backward()
    rows = table.matrix().toarray()
    for frame, gradient in zip(points.detach().reshape(-1, 8, 3), points.grad.reshape(-1, 8, 3)):
        np.testing.assert_allclose(gradient, 2 * rows.T @ rows @ frame.numpy(), rtol=0, atol=derivatives)


def test_keeps_the_dtype_and_refuses_the_rest(cube: sublimit.Mesh) -> None:
    import sublimit.torch

    table = sublimit.bake(cube, "catmull-clark", levels=1)
    for dtype in (torch.float32, torch.float64):
        assert sublimit.torch.apply(table, torch.tensor(cube.points, dtype=dtype)).dtype == dtype
    with pytest.raises(ValueError, match="points has shape"):
        sublimit.torch.apply(table, torch.zeros(3, 3))
    with pytest.raises(ValueError, match="on meta; points.cpu"):
        sublimit.torch.apply(table, torch.zeros(8, 3, device="meta"))


class Foreign:
    """An array that speaks DLPack alone."""

    def __init__(self, array: Any) -> None:
        self._array = array

    def __dlpack__(self, **options: Any) -> Any:
        return self._array.__dlpack__(**options)

    def __dlpack_device__(self) -> Any:
        return self._array.__dlpack_device__()


def test_arrays_by_dlpack(cube: sublimit.Mesh) -> None:
    points = np.array(cube.points)
    mesh = sublimit.Mesh(Foreign(points), Foreign(np.array(cube.face_array)))  # type: ignore[arg-type]
    assert np.array_equal(mesh.points, cube.points) and mesh.face_array.tolist() == cube.face_array.tolist()
    table = sublimit.bake(mesh, "catmull-clark", levels=1, precision="double")
    assert np.array_equal(table.apply(Foreign(points)), table.apply(points))  # type: ignore[arg-type]
    made = torch.from_dlpack(table.apply(points))
    assert made.shape == (table.num_points, 3) and made.dtype == torch.float64


def test_the_docstring_says_what_happens() -> None:
    import doctest

    import sublimit.torch

    found = doctest.testmod(sublimit.torch)
    assert found.attempted > 4 and found.failed == 0
