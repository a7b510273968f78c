# SPDX-License-Identifier: Apache-2.0
"""Tables and surfaces in PyTorch: values, first and second derivatives, and arrays of other packages by DLPack."""
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
    with pytest.raises(sublimit.Error, match="points has shape"):
        sublimit.torch.apply(table, torch.zeros(3, 3))
    with pytest.raises(sublimit.Error, match="on meta; points.cpu"):
        sublimit.torch.apply(table, torch.zeros(8, 3, device="meta"))


@pytest.mark.parametrize("asked", [dict(levels=2, limit=True), dict(grid=3, derivatives=1)])
def test_batches_of_batches(asked: dict[str, Any], cube: sublimit.Mesh) -> None:
    import sublimit.torch

    table = sublimit.bake(cube, "catmull-clark", precision="double", **asked)
    points = torch.tensor(cube.points).expand(2, 3, 2, 8, 3).clone() * torch.arange(1, 13).reshape(2, 3, 2, 1, 1)
    points.requires_grad_()
    made = sublimit.torch.apply(table, points)
    one = table.apply(cube.points)
    assert made.shape == (2, 3, 2, *one.shape)
    np.testing.assert_allclose(made[1, 2, 1].detach(), 12 * one, rtol=0, atol=derivatives)
    made.square().sum().backward()
    rows = table.matrix().toarray()
    np.testing.assert_allclose(points.grad[1, 2, 1], 24 * rows.T @ rows @ cube.points, rtol=0, atol=100 * derivatives)
    small = points[:1, :2, :1, :, :1].detach().requires_grad_()
    assert torch.autograd.gradcheck(lambda x: sublimit.torch.apply(table, x), small)
    for empty in ((0, 8, 3), (2, 0, 8, 3)):
        nothing = torch.zeros(empty, dtype=torch.float64, requires_grad=True)
        none = sublimit.torch.apply(table, nothing)
        assert none.shape == (*empty[:-2], *one.shape)
        none.sum().backward()
        assert nothing.grad.shape == empty


def surfaces(cube: sublimit.Mesh) -> list[Any]:
    net = [[u, v, (u - 1) * v * v] for v in range(4) for u in range(4)]
    return [sublimit.LimitSurface(cube, "catmull-clark"),
            sublimit.construct({"kind": "bezier_surface", "degree": [3, 3], "points": net}).surfaces()]


@pytest.mark.parametrize("kind", [0, 1])
def test_gradients_of_places(kind: int, cube: sublimit.Mesh) -> None:
    import sublimit.torch

    surface = surfaces(cube)[kind]
    face = np.array([0, surface.num_faces - 1])
    u = torch.tensor([0.3, 0.7], dtype=torch.float64, requires_grad=True)
    v = torch.tensor([[0.6], [0.2], [0.9]], dtype=torch.float64, requires_grad=True)
    made = sublimit.torch.evaluate(surface, face, u, v)
    expected = surface.evaluate(face, u.detach().numpy(), v.detach().numpy(), derivatives=2)
    assert made.shape == (3, 2, 3) and np.array_equal(made.detach(), expected.points)
    (by_u, by_v) = torch.autograd.grad(made[..., 2].sum(), (u, v))
    np.testing.assert_allclose(by_u, expected.du[..., 2].sum(axis=0), rtol=0, atol=derivatives)
    np.testing.assert_allclose(by_v, expected.dv[..., 2].sum(axis=1, keepdims=True), rtol=0, atol=derivatives)
    assert torch.autograd.gradcheck(lambda u, v: sublimit.torch.evaluate(surface, face, u, v), (u, v))
    assert torch.autograd.gradgradcheck(lambda u, v: sublimit.torch.evaluate(surface, face, u, v), (u, v))
    (first,) = torch.autograd.grad(sublimit.torch.evaluate(surface, face, u, v)[..., 0].sum(), u, create_graph=True)
    (second,) = torch.autograd.grad(first.sum(), u, create_graph=True)
    np.testing.assert_allclose(second.detach(), expected.duu[..., 0].sum(axis=0), rtol=0, atol=10 * derivatives)
    with pytest.raises(RuntimeError, match="there is no third one"):
        torch.autograd.grad(second.sum(), u)


@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.parametrize("frames", [(), (2,), (2, 3), (0,)])
def test_gradients_of_places_and_points(kind: int, frames: tuple[int, ...], cube: sublimit.Mesh) -> None:
    import sublimit.torch

    surface = surfaces(cube)[kind]
    random = torch.Generator().manual_seed(1)
    face = torch.tensor([0, surface.num_faces - 1])
    u = torch.rand(2, dtype=torch.float64, generator=random, requires_grad=True)
    v = torch.rand(2, dtype=torch.float64, generator=random, requires_grad=True)
    points = torch.rand(*frames, surface.num_points, 2, dtype=torch.float64, generator=random, requires_grad=True)
    made = sublimit.torch.evaluate(surface, face, u, v, points)
    (rows,) = surface.stencils(face.numpy(), u.detach().numpy(), v.detach().numpy())
    assert made.shape == (*frames, 2, 2)
    np.testing.assert_allclose(made.detach(), rows.toarray() @ points.detach().numpy(), rtol=0, atol=derivatives)
    made.sum().backward()
    assert points.grad.shape == points.shape and u.grad.shape == (2,)
    if 0 not in frames:
        assert torch.autograd.gradcheck(lambda *x: sublimit.torch.evaluate(surface, face, *x), (u, v, points))
        assert torch.autograd.gradgradcheck(lambda *x: sublimit.torch.evaluate(surface, face, *x), (u, v, points))
        own = surface.points if kind == 0 else surface.points[:, :3]
        same = sublimit.torch.evaluate(surface, face, u, v, torch.tensor(own))
        np.testing.assert_allclose(same.detach(), sublimit.torch.evaluate(surface, face, u, v).detach(), rtol=0, atol=derivatives)


def test_rational_patches_move_along_u_and_v() -> None:
    import sublimit.torch

    w = 0.5**0.5
    arc = sublimit.construct({"kind": "nurbs_surface", "degree": [2, 1], "shape": [3, 2], "knots_u": [0, 0, 0, 1, 1, 1],
                              "knots_v": [0, 0, 1, 1], "homogeneous": [[1, 0, 0, 1], [w, w, 0, w], [0, 1, 0, 1], [1, 0, 1, 1],
                                                                       [w, w, w, w], [0, 1, 1, 1]]}).surfaces()
    u = torch.tensor([0.25, 0.5], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(lambda u: sublimit.torch.evaluate(arc, 0, u, 0.5), (u,))
    assert torch.autograd.gradgradcheck(lambda u: sublimit.torch.evaluate(arc, 0, u, 0.5), (u,))
    with pytest.raises(sublimit.Error, match="points of rational patches are quotients"):
        sublimit.torch.evaluate(arc, 0, u, 0.5, torch.tensor(arc.points))


def test_dtypes_of_places(cube: sublimit.Mesh) -> None:
    import sublimit.torch

    surface = sublimit.LimitSurface(cube, "catmull-clark")
    u = torch.tensor([0.25], requires_grad=True)
    made = sublimit.torch.evaluate(surface, 0, u, 0.5)
    made.sum().backward()
    assert made.dtype == u.grad.dtype == torch.float32
    assert sublimit.torch.evaluate(surface, 0, u.double(), 0.5).dtype == torch.float64
    assert sublimit.torch.evaluate(surface, [0, 1], 0.5, 0).shape == (2, 3)
    points = torch.tensor(cube.points, dtype=torch.float32, requires_grad=True)
    sublimit.torch.evaluate(surface, 0, u.double(), 0.5, points).sum().backward()
    assert points.grad.dtype == torch.float32


def test_refuses_places(cube: sublimit.Mesh) -> None:
    import sublimit.torch

    surface, half = sublimit.LimitSurface(cube, "catmull-clark"), torch.tensor(0.5)
    attempts: list[tuple[tuple[Any, ...], str]] = [
        ((6, half, half), "6"), ((0, 1.5, half), "1.5"), ((0, half, torch.tensor(float("nan"))), "nan|finite"),
        ((0.5, half, half), "face has dtype float64"),
        (([0, 1], torch.zeros(3), half), r"do not broadcast to one shape: face \(2,\), u \(3,\), v \(\)"),
        ((0, half.to("meta"), half), "u is on meta; u.cpu"),
        ((0, half, half, torch.zeros(8, 3, device="meta")), "points is on meta"),
        ((0, half, half, torch.zeros(7, 3)), r"points has shape \(7, 3\); \(..., 8 control points, channels\)"),
        ((0, half, half, torch.zeros(8)), r"points has shape \(8,\)")]
    for arguments, words in attempts:
        with pytest.raises(sublimit.Error, match=words):
            sublimit.torch.evaluate(surface, *arguments)
    with pytest.raises(TypeError, match="surface is a Mesh"):
        sublimit.torch.evaluate(cube, 0, half, half)  # type: ignore[arg-type]


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
    assert found.attempted > 8 and found.failed == 0
