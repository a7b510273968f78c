# SPDX-License-Identifier: Apache-2.0
"""Small pictures of meshes, for notebooks."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ._meshes import Mesh

_MOST_FACES = 2000
_SIZE = 240


def mesh_picture(mesh: Mesh) -> str:
    """Returns a picture of a mesh as the text of an SVG, at most 2000 of its faces, drawn from back to front."""
    sizes, corners = mesh.faces
    if len(sizes) == 0:
        return ""
    view = np.array([[0.86, 0.5, 0], [-0.25, 0.43, 0.87], [0.43, -0.75, 0.5]])  # right, up, towards the eye
    seen = mesh.points @ view.T
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    scale = (_SIZE - 8) / max(float((high - low).max()), 1e-300)
    x = 4 + (seen[:, 0] - low[0]) * scale
    y = 4 + (high[1] - seen[:, 1]) * scale
    faces = np.split(corners, np.cumsum(sizes)[:-1])
    faces = faces[:: -(-len(faces) // _MOST_FACES)]
    faces.sort(key=lambda face: float(seen[face, 2].mean()))
    paths = "".join("M" + "L".join(f"{x[v]:.1f} {y[v]:.1f}" for v in face) + "Z" for face in faces)
    polygons = "".join(f'<path d="{path}Z"/>' for path in paths.split("Z") if path)
    height = 8 + float(high[1] - low[1]) * scale
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{_SIZE}" height="{height:.0f}" fill="#dde6f0" stroke="#37526d" '
            f'stroke-width="0.6" stroke-linejoin="round">{polygons}</svg>')
