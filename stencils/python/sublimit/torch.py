# SPDX-License-Identifier: Apache-2.0
"""Tables as functions of PyTorch tensors, with exact gradients of any order.

>>> import torch, sublimit, sublimit.torch
>>> cube = sublimit.Mesh(
...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
...     [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
>>> table = sublimit.bake(cube, "catmull-clark", levels=2, limit=True)
>>> points = torch.tensor(cube.points, dtype=torch.float32, requires_grad=True)
>>> sublimit.torch.apply(table, points).square().sum().backward()
>>> points.grad.shape
torch.Size([8, 3])
"""
from __future__ import annotations

from typing import Any

import numpy as np
import torch

from ._tables import Table

__all__ = ["apply"]


def apply(table: Table, points: torch.Tensor) -> torch.Tensor:
    """The table times control points, differentiable.

    Parameters
    ----------
    points : (control points, channels) or (frames, control points, channels), on the CPU
        Read where they are if they are of the table's dtype and rows follow each other.

    Returns
    -------
    Tensor as `Table.apply` makes it, of the dtype of `points`; its gradient is that of `Table.apply_transpose`

    Raises
    ------
    ValueError
        A tensor that is not on the CPU, or of another shape; a rational table, whose points are quotients.
    """
    if points.device.type != "cpu":
        raise ValueError(f"points is on {points.device}; points.cpu() is right")
    if table.rational:
        raise ValueError("a rational table divides: it is no linear function of its homogeneous points")
    result: torch.Tensor = _Apply.apply(points, table)
    return result


class _Apply(torch.autograd.Function):  # type: ignore[misc]
    @staticmethod
    def forward(ctx: Any, points: torch.Tensor, table: Table) -> torch.Tensor:
        ctx.table = table
        return torch.from_numpy(table.apply(points.detach().numpy())).to(points.dtype)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, None]:
        return _Transposed.apply(gradient, ctx.table), None


class _Transposed(torch.autograd.Function):  # type: ignore[misc]
    @staticmethod
    def forward(ctx: Any, values: torch.Tensor, table: Table) -> torch.Tensor:
        ctx.table = table
        array = values.detach().numpy()
        has_frames = array.ndim == (3 if table.quantities == 1 else 4)
        made = np.stack([table.apply_transpose(frame) for frame in array]) if has_frames else table.apply_transpose(array)
        return torch.from_numpy(made).to(values.dtype)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, None]:
        return _Apply.apply(gradient, ctx.table), None
