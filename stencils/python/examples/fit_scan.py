# SPDX-License-Identifier: Apache-2.0
"""A cage for a scan, by gradient descent: the gradient of a sum over surface points is `apply_transpose` of theirs.

Any energy of the surface's points can stand where the distances stand here; a limit table makes its gradient exact.
"""
from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

import sublimit

# A scan: points of a bumpy ball, without order.
random = np.random.default_rng(1)
directions = random.normal(size=(3000, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
scan = directions * (1 + 0.15 * np.sin(3 * directions[:, :1]) * np.cos(2 * directions[:, 1:2]))

cube = sublimit.Mesh([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
                     [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
mesh = sublimit.refine(cube, "catmull-clark", 2)
table = sublimit.bake(mesh, "catmull-clark", levels=3, limit=True, precision="double")


def energy(points: np.ndarray) -> tuple[float, np.ndarray]:
    """Half the mean square distance of the scan from the nearest points of the surface, and its gradient."""
    on = table.apply(points)
    nearest = cKDTree(on).query(scan)[1]
    off = on[nearest] - scan
    gradient = np.zeros_like(on)
    np.add.at(gradient, nearest, off / len(scan))
    return 0.5 * float((off**2).sum()) / len(scan), table.apply_transpose(gradient)


x = mesh.points.copy()
first, gradient = energy(x)
# The gradient is that of the energy: differences agree with it.
step = 1e-6 * random.normal(size=x.shape)
assert abs((energy(x + step)[0] - energy(x - step)[0]) / 2 - (step * gradient).sum()) < 1e-5 * abs((step * gradient).sum())

length = 10.0
for k in range(60):
    value, gradient = energy(x)
    while (tried := energy(x - length * gradient)[0]) > value and length > 1e-6:
        length /= 2
    x = x - length * gradient
    length *= 1.3
    if k % 15 == 0:
        print(f"step {k:3}: root mean square distance {np.sqrt(2 * value):.4f}")
last = energy(x)[0]
print(f"        : root mean square distance {np.sqrt(2 * last):.4f}, of {len(scan)} points, {len(x)} control points")
assert last < first / 20

# The same in closed form, with exact closest points.
fitted = sublimit.fit_cloud(mesh, "catmull-clark", scan, thin_plate=1e-6)
print(f"fit_cloud: root mean square distance {fitted.rms:.4f} after {len(fitted.iterations) - 1} iterations")
assert fitted.rms < np.sqrt(2 * last)
