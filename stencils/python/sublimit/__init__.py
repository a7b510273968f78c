# SPDX-License-Identifier: Apache-2.0
"""Subdivision surfaces and curves: refined meshes, the sparse matrices that refine, and exact limits at any place.

>>> import sublimit
>>> cube = sublimit.Mesh(
...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
...     [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
>>> sublimit.refine(cube, "catmull-clark", levels=2)
<sublimit.Mesh: 98 vertices, 96 faces>
>>> S = sublimit.subdivision_matrix(cube, "catmull-clark")
>>> S.shape
(26, 8)
>>> sublimit.limit(cube, "catmull-clark").points[0].round(4)
array([0.25, 0.25, 0.25])
"""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._sublimit import CreaseEdgeSite as CreaseEdgeSite
    from ._sublimit import CreaseSite as CreaseSite
    from ._sublimit import EdgeSite as EdgeSite
    from ._sublimit import FaceSite as FaceSite
    from ._sublimit import Ring as Ring
    from ._sublimit import Stencil as Stencil
    from ._sublimit import WideEdgeSite as WideEdgeSite
    from ._sublimit import WideFaceSite as WideFaceSite
    from ._sublimit import __version__ as __version__
    from ._sublimit import version as version
    from ._constructions import Construction as Construction
    from ._constructions import construct as construct
    from ._curves import Curves as Curves
    from ._curves import CurveSamples as CurveSamples
    from ._curves import LimitCurve as LimitCurve
    from ._curves import refine_curve as refine_curve
    from ._errors import AnalysisError as AnalysisError
    from ._errors import Error as Error
    from ._errors import FormatError as FormatError
    from ._errors import InvalidMesh as InvalidMesh
    from ._errors import InvalidOption as InvalidOption
    from ._errors import InvalidParameter as InvalidParameter
    from ._errors import IoError as IoError
    from ._errors import MeshWarning as MeshWarning
    from ._errors import ResourceError as ResourceError
    from ._errors import UnsupportedTopology as UnsupportedTopology
    from ._fits import Fit as Fit
    from ._fits import FittedPoints as FittedPoints
    from ._fits import fit as fit
    from ._fits import fit_cloud as fit_cloud
    from ._fits import fit_places as fit_places
    from ._gpus import GpuInfo as GpuInfo
    from ._gpus import gpu_devices as gpu_devices
    from ._levels import Level as Level
    from ._levels import Limit as Limit
    from ._levels import levels as levels
    from ._levels import limit as limit
    from ._levels import refine as refine
    from ._levels import subdivision_matrix as subdivision_matrix
    from ._meshes import Mesh as Mesh
    from ._meshes import info as info
    from ._meshes import read as read
    from ._parts import ImplicitMesh as ImplicitMesh
    from ._parts import StepFile as StepFile
    from ._parts import implicit as implicit
    from ._parts import step as step
    from ._patches import Patches as Patches
    from ._reports import Report as Report
    from ._reports import analyze as analyze
    from ._reports import analyze_mesh as analyze_mesh
    from ._scenes import FlatMesh as FlatMesh
    from ._scenes import FlattenedScene as FlattenedScene
    from ._scenes import flatten as flatten
    from ._schemes import OptionInfo as OptionInfo
    from ._schemes import Scheme as Scheme
    from ._schemes import SchemeInfo as SchemeInfo
    from ._schemes import scheme as scheme
    from ._schemes import schemes as schemes
    from ._surfaces import ClosestPoints as ClosestPoints
    from ._surfaces import Curvature as Curvature
    from ._surfaces import LimitSurface as LimitSurface
    from ._surfaces import RayHits as RayHits
    from ._surfaces import Samples as Samples
    from ._surfaces import Source as Source
    from ._surfaces import Tessellation as Tessellation
    from ._surfaces import closest as closest
    from ._surfaces import intersect as intersect
    from ._surfaces import tessellate as tessellate
    from ._tables import Table as Table
    from ._tables import bake as bake
    from ._tables import load as load

# Modules and their public names. A module is imported when one of its names is first used: importing NumPy alone takes longer
# than importing this file.
_PARTS = {
    "_sublimit": ("__version__", "CreaseEdgeSite", "CreaseSite", "EdgeSite", "FaceSite", "Ring", "Stencil", "WideEdgeSite",
                  "WideFaceSite", "version"),
    "_constructions": ("Construction", "construct"),
    "_curves": ("CurveSamples", "Curves", "LimitCurve", "refine_curve"),
    "_errors": ("AnalysisError", "Error", "FormatError", "InvalidMesh", "InvalidOption", "InvalidParameter", "IoError",
                "MeshWarning", "ResourceError", "UnsupportedTopology"),
    "_fits": ("Fit", "FittedPoints", "fit", "fit_cloud", "fit_places"),
    "_gpus": ("GpuInfo", "gpu_devices"),
    "_levels": ("Level", "Limit", "levels", "limit", "refine", "subdivision_matrix"),
    "_meshes": ("Mesh", "info", "read"),
    "_parts": ("ImplicitMesh", "StepFile", "implicit", "step"),
    "_patches": ("Patches",),
    "_reports": ("Report", "analyze", "analyze_mesh"),
    "_scenes": ("FlatMesh", "FlattenedScene", "flatten"),
    "_schemes": ("OptionInfo", "Scheme", "SchemeInfo", "scheme", "schemes"),
    "_surfaces": ("ClosestPoints", "Curvature", "LimitSurface", "RayHits", "Samples", "Source", "Tessellation", "closest",
                  "intersect", "tessellate"),
    "_tables": ("Table", "bake", "load"),
}
_PLACE = {name: part for part, names in _PARTS.items() for name in names}
__all__ = sorted(_PLACE)


def __getattr__(name: str) -> object:
    if name == "torch":  # the only module that needs PyTorch
        import importlib

        return importlib.import_module(f"{__name__}.torch")
    if name not in _PLACE:
        raise AttributeError(f"module 'sublimit' has no attribute '{name}'")
    import importlib

    found = getattr(importlib.import_module(f"{__name__}.{_PLACE[name]}"), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return __all__
