# SPDX-License-Identifier: Apache-2.0
"""Scenes of USD whose subdivision meshes become triangles."""
from __future__ import annotations

import operator
import os
from dataclasses import dataclass

from . import _sublimit


@dataclass(frozen=True)
class FlatMesh:
    """A mesh of a scene that `flatten` wrote.

    Attributes
    ----------
    path : path of the prim
    triangles : number of triangles; 0 if the mesh is left as it is
    bound : proved bound of the distance of the triangles from the limit, a length in the space of the prim
    why_not : reason why the mesh is left as it is; empty if it is not
    """

    __module__ = "sublimit"
    path: str
    triangles: int
    bound: float
    why_not: str


@dataclass(frozen=True)
class FlattenedScene:
    """Result of `flatten`.

    Attributes
    ----------
    meshes : the meshes of the scene with a scheme, in its order
    warnings : list of str, what is missing or left out, each with its place
    """

    __module__ = "sublimit"
    meshes: list[FlatMesh]
    warnings: list[str]


def flatten(scene: str | os.PathLike[str], path: str | os.PathLike[str], *, chord: float = 0, relative_chord: float = 1e-3,
            angle: float = 0, max_triangles: int = 2**24, threads: int = 0) -> FlattenedScene:
    """Makes triangles near the limit of each subdivision mesh of a USD scene, with exact normals, and writes the scene.

    As USD all else stays byte for byte, and points that move in time move on. As glTF, or another format of meshes, all meshes of
    the scene are one, at the first time, in the space of the world.

    Parameters
    ----------
    scene : path of a .usda or .usdz
    path : path that ends in .usda, .usdz, .glb or another extension of meshes. The file appears whole or not at all.
    chord : largest distance of triangles from the limit, in the unit of the scene (default: 0, by `relative_chord`)
    relative_chord : the same as a part of the diagonal of each mesh's box (default: 1e-3)
    angle : largest angle between normals in the cell of a triangle, in radians (default: 0, any)
    max_triangles : largest number of triangles of a mesh
    threads : largest number of threads (default: all)

    Raises
    ------
    InvalidParameter
        A negative chord or angle.
    FormatError, InvalidMesh
        A layer or a mesh that cannot be read; the message says where.
    InvalidOption
        Another extension.
    ResourceError
        More triangles than allowed, or not enough memory.
    IoError
        A file that cannot be read or written.
    """
    made = _sublimit.flatten(os.fspath(scene), os.fspath(path), float(chord), float(relative_chord), float(angle),
                             operator.index(max_triangles), threads)
    return FlattenedScene([FlatMesh(*mesh) for mesh in made["meshes"]], made["warnings"])
