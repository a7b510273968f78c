# SPDX-License-Identifier: Apache-2.0
"""Finite elements on a limit surface: -div grad u + u = f on a Catmull-Clark sphere.

Rows of `LimitSurface.stencils` are the shape functions and their derivatives, so a Galerkin method is a few sparse
products. The surface does not change when its mesh is refined, only the functions on it get finer. For a function u of
space, f follows from the surface's exact curvature: on a surface with normal n and mean curvature H (positive where it
bends towards n)

    div grad u = trace of the Hessian in the tangent plane + 2 H n . grad u.

Cubics promise an error of h^4. The best approximation in L2 has it away from extraordinary points; the solution feels
those everywhere: around valence 3 the functions are less smooth, and the equation carries their error over the surface.
"""
from __future__ import annotations

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

import sublimit


def sphere(level: int) -> sublimit.Mesh:
    """A cube's limit, a little rounder than that: its corners are extraordinary, of valence 3."""
    points = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    coarse = sublimit.refine(sublimit.Mesh(points, faces), "catmull-clark", 1)
    round_points = coarse.points / np.linalg.norm(coarse.points, axis=1)[:, None]
    return sublimit.refine(sublimit.Mesh(round_points, coarse.faces), "catmull-clark", level)


def exact(x: np.ndarray, samples: sublimit.Samples) -> tuple[np.ndarray, np.ndarray]:
    """u = exp(x) y + z^2 at points, and f."""
    u = np.exp(x[:, 0]) * x[:, 1] + x[:, 2] ** 2
    gradient = np.column_stack([np.exp(x[:, 0]) * x[:, 1], np.exp(x[:, 0]), 2 * x[:, 2]])
    hessian = np.zeros((len(x), 3, 3))
    hessian[:, 0, 0] = np.exp(x[:, 0]) * x[:, 1]
    hessian[:, 0, 1] = hessian[:, 1, 0] = np.exp(x[:, 0])
    hessian[:, 2, 2] = 2
    n = samples.normals
    tangential = np.trace(hessian, axis1=1, axis2=2) - np.einsum("ki,kij,kj->k", n, hessian, n)
    laplacian = tangential + 2 * samples.curvature().mean * np.einsum("ki,ki->k", n, gradient)
    return u, u - laplacian


def solve(level: int, gauss: int = 4) -> tuple[int, np.ndarray]:
    """Unknowns; L2 errors of the solution, everywhere and away from extraordinary points, and of the best approximation there."""
    surface = sublimit.LimitSurface(mesh := sphere(level), "catmull-clark")
    nodes, weights = np.polynomial.legendre.leggauss(gauss)
    nodes, weights = (nodes + 1) / 2, weights / 2
    face, u, v, w = (part.reshape(-1) for part in np.broadcast_arrays(
        np.arange(surface.num_faces)[:, None, None], nodes, nodes[:, None], weights * weights[:, None]))
    N, Nu, Nv = surface.stencils(face, u, v, derivatives=1)
    at = surface.evaluate(face, u, v, derivatives=2)
    guu, guv, gvv = (np.einsum("ki,ki->k", a, b) for a, b in ((at.du, at.du), (at.du, at.dv), (at.dv, at.dv)))
    area = np.sqrt(guu * gvv - guv**2)
    wanted, f = exact(at.points, at)

    def weighted(factor: np.ndarray) -> scipy.sparse.dia_array:
        return scipy.sparse.diags(w * factor)

    M = scipy.sparse.csc_matrix(N.T @ weighted(area) @ N)
    K = (Nu.T @ weighted(gvv / area) @ Nu - Nu.T @ weighted(guv / area) @ Nv - Nv.T @ weighted(guv / area) @ Nu
         + Nv.T @ weighted(guu / area) @ Nv)
    solution = N @ scipy.sparse.linalg.spsolve(scipy.sparse.csc_matrix(K + M), N.T @ (w * area * f))
    best = N @ scipy.sparse.linalg.spsolve(M, N.T @ (w * area * wanted))
    corners = sublimit.limit(sphere(0), "catmull-clark").points[:8]
    away = np.min(np.linalg.norm(at.points[:, None] - corners, axis=2), axis=1) > 0.4

    def error(values: np.ndarray, where: np.ndarray) -> float:
        return float(np.sqrt((w * area * (values - wanted) ** 2)[where].sum()))

    return len(mesh.points), np.array([error(solution, away | True), error(solution, away), error(best, away)])


if __name__ == "__main__":
    print("unknowns   solution            away from corners   best approximation there")
    before = None
    for level in range(5):
        unknowns, errors = solve(level)
        rates = np.full(3, np.nan) if before is None else np.log2(before / errors)
        print(f"{unknowns:8}   " + "   ".join(f"{e:.2e} (rate {r:4.1f})" for e, r in zip(errors, rates)))
        before = errors
    assert rates[2] > 3.8 and (rates > 2.5).all()
