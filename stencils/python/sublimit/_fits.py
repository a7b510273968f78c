# SPDX-License-Identifier: Apache-2.0
"""Control points whose limit passes through points, or near to them."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._levels import core_of, warn_of
from ._meshes import Mesh
from ._schemes import OptionValue, Scheme, request
from ._surfaces import places


@dataclass(frozen=True)
class Fit:
    """A mesh whose limit passes through points.

    Attributes
    ----------
    mesh : the control mesh; refined where that was needed
    solved : whether all conditions are met to rounding
    why_not : if not, which vertices stand in the way, and what would be right
    refinements : levels that were added
    position_error : (targets,), distances
    normal_error : (targets,), angles in radians; NaN without a normal
    """

    __module__ = "sublimit"
    mesh: Mesh
    solved: bool
    why_not: str
    refinements: int
    position_error: arrays.Floats
    normal_error: arrays.Floats


@dataclass(frozen=True)
class FittedPoints:
    """Control points of a best fit.

    Attributes
    ----------
    points : (control points, channels)
    residuals : (targets,), distances
    rms, largest : of them: root of the weighted mean square, maximum
    iterations : rms of the first guess and after each iteration; None of fits that are linear
    converged : whether the last iteration changed less than the tolerance
    """

    __module__ = "sublimit"
    points: arrays.Floats
    residuals: arrays.Floats
    rms: float
    largest: float
    iterations: arrays.Floats | None = None
    converged: bool = True


def fit(mesh: Mesh, scheme: Scheme | str, vertices: npt.ArrayLike, points: npt.ArrayLike, normals: npt.ArrayLike | None = None,
        *, thin_plate: float = 0, membrane: float = 0, refinements: tuple[int, int] = (0, 2), boundary: str | None = None,
        creasing: str | None = None, triangles: str | None = None, option: Mapping[str, OptionValue] | None = None,
        triangulate: bool = False, no_creases: bool = False, strict: bool = False, threads: int = 0) -> Fit:
    """A mesh whose limit has given vertices at given points, with given normals.

    Parameters
    ----------
    mesh : its points are the first guess
    vertices : (targets,)
    points : (targets, 3)
    normals : (targets, 3), of any length; rows of NaN where there is none
    thin_plate, membrane : weights of fairness; 0 and 0: nearest to the first guess
    refinements : the fewest and the most levels that may be added to meet the conditions

    Notes
    -----
    Halstead, Kass, DeRose 1993, "Efficient, fair interpolation using Catmull-Clark surfaces".

    Examples
    --------
    >>> import sublimit
    >>> cube = sublimit.Mesh(
    ...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    ...     [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
    >>> through = sublimit.fit(cube, "catmull-clark", range(8), cube.points)
    >>> through.solved, bool(through.position_error.max() < 1e-14)
    (True, True)
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    numbers = arrays.ints(np.asarray(vertices), "vertices", (None,), "(targets,)")
    where = arrays.floats(points, "points", (len(numbers), 3), f"({len(numbers)} targets, 3)")
    along = None if normals is None else arrays.floats(normals, "normals", (len(numbers), 3), f"({len(numbers)} targets, 3)",
                                                       finite=False)
    parts = _sublimit.fit(core_of(mesh), asked, numbers, where, along, _sublimit.Fairness(thin_plate, membrane), refinements,
                          threads)
    parts["mesh"] = Mesh._of(parts["mesh"])
    warn_of(mesh, asked)
    return Fit(**parts)


def fit_places(mesh: Mesh, scheme: Scheme | str, face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, points: npt.ArrayLike,
               *, weights: npt.ArrayLike | None = None, thin_plate: float = 0, membrane: float = 0,
               pins: npt.ArrayLike | None = None, boundary: str | None = None, creasing: str | None = None,
               triangles: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
               no_creases: bool = False, strict: bool = False, threads: int = 0) -> FittedPoints:
    """Control points whose limit is nearest to points at given places, in the sense of least squares.

    Parameters
    ----------
    mesh : its points are the first guess, which the result stays near to where the targets do not say
    face, u, v : arrays that broadcast to (targets,)
    points : (targets, 3)
    weights : (targets,), of the squared distances
    thin_plate, membrane : weights of fairness
    pins : control points that stay
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    faces, at_u, at_v, _ = places(face, u, v)
    count = len(faces)
    parts = _sublimit.fit_places(
        core_of(mesh), asked, faces, at_u, at_v, arrays.floats(points, "points", (count, 3), f"({count} targets, 3)"),
        _weights(weights, count), _sublimit.Fairness(thin_plate, membrane), _pins(pins), threads)
    warn_of(mesh, asked)
    return FittedPoints(**parts)


def fit_cloud(mesh: Mesh, scheme: Scheme | str, points: npt.ArrayLike, *, weights: npt.ArrayLike | None = None,
              thin_plate: float = 0, membrane: float = 0, schedule: Sequence[float] = (), pins: npt.ArrayLike | None = None,
              iterations: int = 50, tolerance: float = 1e-6, boundary: str | None = None, creasing: str | None = None,
              triangles: str | None = None, option: Mapping[str, OptionValue] | None = None, triangulate: bool = False,
              no_creases: bool = False, strict: bool = False, threads: int = 0) -> FittedPoints:
    """Control points whose limit is near to points without order.

    Parameters
    ----------
    mesh : its points are the first guess
    points : (n, 3)
    weights : (n,), of the squared distances
    thin_plate, membrane : weights of fairness
    schedule : factors of fairness, one an iteration; falling ones find the way from far off
    pins : control points that stay
    iterations : at most so many
    tolerance : of the energy, relative to it: where it falls by less, the fit has converged
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    cloud = arrays.floats(points, "points", (None, 3), "(n, 3)")
    parts = _sublimit.fit_cloud(
        core_of(mesh), asked, cloud, _weights(weights, len(cloud)), _sublimit.Fairness(thin_plate, membrane), list(schedule),
        _pins(pins), iterations, tolerance, threads)
    warn_of(mesh, asked)
    return FittedPoints(**parts)


def _weights(weights: Any, count: int) -> arrays.Floats | None:
    return None if weights is None else arrays.floats(weights, "weights", (count,), f"({count} targets,)")


def _pins(pins: Any) -> arrays.Ints:
    return arrays.ints([] if pins is None else np.asarray(pins), "pins", (None,), "(pins,)")
