# SPDX-License-Identifier: Apache-2.0
"""Tables and surfaces as functions of PyTorch tensors, with exact gradients.

>>> import torch, sublimit, sublimit.torch
>>> cube = sublimit.Mesh(
...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
...     [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
>>> table = sublimit.bake(cube, "catmull-clark", levels=2, limit=True)
>>> points = torch.tensor(cube.points, dtype=torch.float32, requires_grad=True)
>>> sublimit.torch.apply(table, points).square().sum().backward()
>>> points.grad.shape
torch.Size([8, 3])
>>> surface = sublimit.LimitSurface(cube, "catmull-clark")
>>> u = torch.tensor([0.25, 0.5], requires_grad=True)
>>> sublimit.torch.evaluate(surface, 1, u, 0.5)[:, 2].sum().backward()
>>> u.grad.shape
torch.Size([2])
"""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import torch

from ._errors import InvalidParameter
from ._surfaces import Source, surface_of
from ._tables import Table

__all__ = ["apply", "evaluate"]


def apply(table: Table, points: torch.Tensor) -> torch.Tensor:
    """Makes the points of a table from control points, differentiable any number of times.

    Parameters
    ----------
    table : a `Table` that is not rational
    points : tensor (..., control points, channels), on the CPU
        Axes before the last two are frames, or batches of frames. Contiguous tensors of the table's dtype are read in place,
        others are copied first.

    Returns
    -------
    Tensor, (..., points, channels), or (..., quantities, points, channels) for tables with derivatives
        It has the dtype of `points`. `Table.apply_transpose` computes its gradient.

    Raises
    ------
    InvalidParameter
        A tensor that is not on the CPU, or has another shape; a rational table, which is not linear in its control points.
    """
    _check_on_cpu(points, "points")
    if table.rational:
        raise InvalidParameter("a rational table divides: it is no linear function of its homogeneous points")
    batches = points.shape[:-2] if points.ndim > 3 else None
    result: torch.Tensor = _Apply.apply(points if batches is None else points.reshape(-1, *points.shape[-2:]), table)
    return result if batches is None else result.reshape(*batches, *result.shape[1:])


def evaluate(surface: Source, face: Any, u: torch.Tensor | float, v: torch.Tensor | float,
             points: torch.Tensor | None = None) -> torch.Tensor:
    """Evaluates places of a surface, differentiable with respect to u, v and the control points.

    Parameters
    ----------
    surface : a `LimitSurface` or `Patches`
    face : integers, an array or a tensor on the CPU
    u, v : tensors on the CPU or numbers; they broadcast with `face` to one shape
    points : tensor (..., control points, channels), on the CPU: control points, or other values of these in any number of
        channels (default: the control points of the surface)
        Axes before the last two are frames, or batches of frames.

    Returns
    -------
    Tensor, (..., *shape of the places, channels)
        It has the dtype of `points`, or that of u and v if `points` is absent. Gradients are exact: derivatives along u and v,
        and the transpose of the stencils. u and v may be differentiated twice.

    Raises
    ------
    InvalidParameter
        A face that does not exist, parameters outside of it or not finite; a tensor that is not on the CPU, or has another
        shape; `points` for rational patches.
    TypeError
        `surface` is neither a `LimitSurface` nor `Patches`.

    Notes
    -----
    Derivatives that do not exist are zero, as in `Samples`, where `Samples.order` says which exist at a place. Places stay on
    their faces: a caller that moves them has to keep u and v inside the face.
    """
    surface = surface_of(surface, Source)
    at = [_real(value, name) for value, name in ((u, "u"), (v, "v"))]
    faces = torch.as_tensor(np.asarray(face)) if not isinstance(face, torch.Tensor) else face
    _check_on_cpu(faces, "face")
    try:
        faces, at_u, at_v = torch.broadcast_tensors(faces, *at)
    except RuntimeError:
        shapes = ", ".join(f"{name} {tuple(part.shape)}" for name, part in zip(("face", "u", "v"), (faces, *at)))
        raise InvalidParameter(f"face, u and v do not broadcast to one shape: {shapes}") from None
    numbers = faces.detach().reshape(-1).numpy()
    if points is None:
        dtype = torch.promote_types(at_u.dtype, at_v.dtype)
        made = _Evaluate.apply(at_u.reshape(-1), at_v.reshape(-1), None, surface, numbers, 0, dtype)
        result: torch.Tensor = made.reshape(*faces.shape, made.shape[-1])
        return result
    _check_on_cpu(points, "points")
    if getattr(surface, "weights", None) is not None:
        raise InvalidParameter("points of rational patches are quotients: they are no linear function of homogeneous points")
    if points.ndim < 2 or points.shape[-2] != surface.num_points:
        raise InvalidParameter(f"points has shape {tuple(points.shape)}; (..., {surface.num_points} control points, channels) is right")
    frames = points.reshape(-1, *points.shape[-2:])
    made = _Evaluate.apply(at_u.reshape(-1), at_v.reshape(-1), frames, surface, numbers, 0, points.dtype)
    result = made.reshape(*points.shape[:-2], *faces.shape, points.shape[-1])
    return result


def _check_on_cpu(tensor: torch.Tensor, name: str) -> None:
    if tensor.device.type != "cpu":
        raise InvalidParameter(f"{name} is on {tensor.device}; {name}.cpu() is right")


def _real(value: Any, name: str) -> torch.Tensor:
    tensor = value if isinstance(value, torch.Tensor) else torch.as_tensor(value, dtype=torch.get_default_dtype())
    _check_on_cpu(tensor, name)
    return tensor if tensor.is_floating_point() else tensor.to(torch.get_default_dtype())


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
        if array.ndim == (2 if table.quantities == 1 else 3):
            made = table.apply_transpose(array)
        else:
            made = np.empty((len(array), table.num_control_points, array.shape[-1]), table.dtype)
            for frame, result in zip(array, made):
                table.apply_transpose(frame, result)
        return torch.from_numpy(made).to(values.dtype)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, None]:
        return _Apply.apply(gradient, ctx.table), None


#: Quantities: position, first and second derivatives. _ORDER: number of derivatives that `evaluate` needs for each.
#: _DERIVATIVES: for the position, du and dv the numbers of their derivatives along u and along v.
_PARTS = ("points", "du", "dv", "duu", "duv", "dvv")
_ORDER = (0, 1, 1, 2, 2, 2)
_DERIVATIVES = ((1, 2), (3, 4), (4, 5))


def _matrix(surface: Source, face: npt.NDArray[Any], u: torch.Tensor, v: torch.Tensor, part: int) -> Any:
    return surface.stencils(face, _numbers(u), _numbers(v), derivatives=_ORDER[part])[part]


def _numbers(values: torch.Tensor) -> npt.NDArray[np.float64]:
    numbers: npt.NDArray[np.float64] = values.detach().to(torch.float64).numpy()
    return numbers


def _times(matrix: Any, frames: torch.Tensor) -> torch.Tensor:
    """Returns a matrix (rows, columns) times frames (frames, columns, channels): (frames, rows, channels), in float64."""
    given = _numbers(frames)
    count, _, channels = given.shape
    made = matrix @ given.transpose(1, 0, 2).reshape(matrix.shape[1], count * channels)
    return torch.from_numpy(np.ascontiguousarray(made.reshape(matrix.shape[0], count, channels).transpose(1, 0, 2)))


def _along(gradient: torch.Tensor, u: torch.Tensor, v: torch.Tensor, points: torch.Tensor | None, ctx: Any,
           needed: tuple[bool, bool]) -> list[torch.Tensor | None]:
    """Returns the gradients with respect to u and v: the gradient times the derivatives, summed over channels and frames.

    Parameters
    ----------
    needed : compute the gradient with respect to u, to v; None is returned for one that is not needed
    """
    if any(needed) and ctx.part >= len(_DERIVATIVES):
        raise RuntimeError("a surface has two derivatives along u and v; there is no third one")
    made: list[torch.Tensor | None] = [None, None]
    for i, x in enumerate((u, v)):
        if needed[i]:
            derivative = _Evaluate.apply(u, v, points, ctx.surface, ctx.face, _DERIVATIVES[ctx.part][i], gradient.dtype)
            product = gradient * derivative
            made[i] = (product.sum(-1) if points is None else product.sum((0, 2))).to(x.dtype)
    return made


class _Evaluate(torch.autograd.Function):  # type: ignore[misc]
    """Evaluation of a quantity at places as a function of PyTorch.

    Maps u (places,), v (places,) and control points (frames, control points, channels) to (frames, places, channels). If the
    control points are None, those of the surface are taken, and the result is (places, 3).
    """

    @staticmethod
    def forward(ctx: Any, u: torch.Tensor, v: torch.Tensor, points: torch.Tensor | None, surface: Source,
                face: npt.NDArray[Any], part: int, dtype: torch.dtype) -> torch.Tensor:
        ctx.surface, ctx.face, ctx.part = surface, face, part
        ctx.has_points = points is not None
        ctx.save_for_backward(u, v, *(() if points is None else (points,)))
        if points is not None:
            return _times(_matrix(surface, face, u, v, part), points).to(dtype)
        samples = surface.evaluate(face, _numbers(u), _numbers(v), derivatives=_ORDER[part])
        return torch.from_numpy(getattr(samples, _PARTS[part])).to(dtype)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[Any, ...]:
        u, v, *points = ctx.saved_tensors
        of = points[0] if ctx.has_points else None
        by_u, by_v = _along(gradient, u, v, of, ctx, ctx.needs_input_grad[:2])
        by_points = None
        if ctx.needs_input_grad[2]:
            by_points = _Spread.apply(gradient, u, v, ctx.surface, ctx.face, ctx.part, points[0].dtype)
        return by_u, by_v, by_points, None, None, None, None


class _Spread(torch.autograd.Function):  # type: ignore[misc]
    """The transpose of `_Evaluate` with respect to its control points, as a function of PyTorch.

    Maps (frames, places, channels) to (frames, control points, channels).
    """

    @staticmethod
    def forward(ctx: Any, values: torch.Tensor, u: torch.Tensor, v: torch.Tensor, surface: Source, face: npt.NDArray[Any],
                part: int, dtype: torch.dtype) -> torch.Tensor:
        ctx.surface, ctx.face, ctx.part = surface, face, part
        ctx.save_for_backward(values, u, v)
        return _times(_matrix(surface, face, u, v, part).T, values).to(dtype)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[Any, ...]:
        values, u, v = ctx.saved_tensors
        by_values = None
        if ctx.needs_input_grad[0]:
            by_values = _Evaluate.apply(u, v, gradient, ctx.surface, ctx.face, ctx.part, values.dtype)
        by_u, by_v = _along(values, u, v, gradient, ctx, ctx.needs_input_grad[1:3])
        return by_values, by_u, by_v, None, None, None, None
