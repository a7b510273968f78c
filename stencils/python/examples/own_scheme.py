# SPDX-License-Identifier: Apache-2.0
"""A scheme of one's own, with its report: Loop's edges, and a vertex that is pulled more or less towards its neighbours.

The masks are called once for each type of neighbourhood, with floats for meshes and with exact numbers for the report,
which proves what it says.
"""
from __future__ import annotations

from fractions import Fraction

import numpy as np

import sublimit


class PulledLoop(sublimit.Scheme):
    """Loop's scheme with his weight of the neighbours times `pull`: 1 is his, 0 would keep vertices where they are."""

    source = "Loop 1987, Smooth subdivision surfaces based on triangles, with a vertex weight of our own"
    split = "ptq"

    def __init__(self, pull: Fraction) -> None:
        self.name = f"pulled-loop {pull}"
        self.pull = pull

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        a = v.ratio(3, 8) + v.cos_2pi(1, v.valence) / 4
        b = self.pull * (v.ratio(5, 8) - a * a)
        return (1 - b) * v.center + b * v.neighbor_mean

    def edge(self, e: sublimit.EdgeSite) -> sublimit.Stencil:
        return (3 * (e.tail + e.head) + e.left_face.corner(2) + e.right_face.corner(2)) / 8


golden = (1 + 5**0.5) / 2
plane = [(s, t * golden, 0.0) for s in (-1, 1) for t in (-1, 1)]
points = np.array([*plane, *((z, x, y) for x, y, z in plane), *((y, z, x) for x, y, z in plane)])
near = np.linalg.norm(points[:, None] - points[None], axis=2) < 2.1
faces = [[i, j, k] if np.linalg.det(points[[i, j, k]]) > 0 else [i, k, j] for i in range(12) for j in range(i) for k in range(j)
         if near[i, j] and near[j, k] and near[i, k]]
mesh = sublimit.Mesh(points, faces)

for pull in (Fraction(1, 4), Fraction(1), Fraction(5, 4)):
    own = PulledLoop(pull)
    report = sublimit.analyze(own, valences=[3, 5, 6, 8])
    limit = sublimit.limit(mesh, own, levels=2)
    radius = np.linalg.norm(limit.points, axis=1)
    summary = report["summary"][0]
    print(f"{own}: {summary['notes'] or 'C^1 everywhere'}; the icosahedron's limit has radii {radius.min():.3f} to {radius.max():.3f}")
    report.save_html(f"pulled-loop-{pull.numerator}-{pull.denominator}.html")

# With Loop's own weight it is Loop's scheme.
own = PulledLoop(Fraction(1))
assert np.array_equal(sublimit.refine(mesh, own, 3).points, sublimit.refine(mesh, "loop", 3).points)
