# SPDX-License-Identifier: Apache-2.0
"""Fits: control points whose limit passes through given points, or near them."""
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
    """Result of `fit`: a mesh whose limit meets targets at vertices.

    Attributes
    ----------
    mesh : the fitted control mesh, refined `refinements` times
    solved : True if all targets are met to rounding
    why_not : which targets are not met, in words; empty if solved
    refinements : number of refinements of the given mesh
    position_error : (targets,), distance of each target from the limit
    normal_error : (targets,), angle to the normal of each target, in radians; NaN for targets without a normal
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
    """Result of `fit_places` and `fit_cloud`: control points of a fit by least squares.

    Attributes
    ----------
    points : (control points, 3)
    residuals : (targets,), distance of each target from its point of the fitted limit
    rms, largest : of the residuals: root of the weighted mean square, and maximum
    iterations : (iterations + 1,), `rms` of the first guess, then after each iteration; None for `fit_places`, which is linear
    converged : True if the energy became stationary to the tolerance; always True for `fit_places`
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
        creasing: str | None = None, triangles: str | None = None, attributes: str | None = None,
        option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
        orient: bool = False, crease_angle: float | None = None, crease_smoothing_groups: bool = False, strict: bool = False,
        threads: int = 0) -> Fit:
    """Computes a mesh whose limit has given positions and normals at given vertices.

    Boundary, creasing and the other keyword arguments that are not listed are those of `refine`.

    Parameters
    ----------
    mesh : the mesh to start from; its points are the first guess
    scheme : name of a scheme, as in `schemes`, or a `Scheme`
    vertices : (targets,), numbers of vertices of the mesh
    points : (targets, 3), limit position of each of these vertices
    normals : (targets, 3), normal of the limit at each, of any length; NaN in a row for no normal (default: none)
    thin_plate, membrane : weights of fairness energies, >= 0 (default: 0, the result stays near the first guess)
    refinements : least and largest number of refinements before the fit, each of which adds control points (default: (0, 2))
        The least number that meets all targets is taken.

    Raises
    ------
    InvalidParameter
        No targets, a vertex that does not exist or has two targets; an array of another shape or type, NaN and infinite
        numbers.
    InvalidMesh, UnsupportedTopology
        The scheme cannot refine the mesh; the message says where.

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
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, attributes=attributes, option=option,
                    triangulate=triangulate, no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    numbers = arrays.ints(vertices, "vertices", (None,), "(targets,)")
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
               no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
               crease_smoothing_groups: bool = False, strict: bool = False, threads: int = 0) -> FittedPoints:
    """Computes control points whose limit is as near as possible to given points at given places, by least squares.

    Boundary, creasing and the other keyword arguments that are not listed are those of `refine`.

    Parameters
    ----------
    mesh : the control mesh; its points are the first guess, which decides what the targets leave free
    scheme : name of a scheme, as in `schemes`, or a `Scheme`
    face, u, v : places of the targets, as in `LimitSurface`; arrays that broadcast to (targets,)
    points : (targets, 3), point that the limit should have at each place
    weights : (targets,), weights >= 0 of the squared distances (default: all 1)
    thin_plate, membrane : weights of fairness energies, >= 0 (default: 0)
    pins : (pins,), numbers of control points that keep their positions (default: none)

    Raises
    ------
    InvalidParameter
        No targets, a place on no face or on a hole, a pin that is no vertex or is given twice, negative weights; an array of
        another shape or type, NaN and infinite numbers.
    InvalidMesh, UnsupportedTopology
        The scheme cannot refine the mesh; the message says where.
    ResourceError
        More memory than there is.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
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
              no_creases: bool = False, orient: bool = False, crease_angle: float | None = None,
              crease_smoothing_groups: bool = False, strict: bool = False, threads: int = 0) -> FittedPoints:
    """Computes control points whose limit is near a cloud of points, by repeated projection and least squares.

    Boundary, creasing and the other keyword arguments that are not listed are those of `refine`.

    Parameters
    ----------
    mesh : the control mesh; its points are the first guess
    scheme : name of a scheme, as in `schemes`, or a `Scheme`
    points : (n, 3), the cloud, in any order
    weights : (n,), weights >= 0 of the squared distances (default: all 1)
    thin_plate, membrane : weights of fairness energies, >= 0 (default: 0)
    schedule : factors of fairness, one for each iteration; the last one is kept (default: 1)
        A decreasing schedule converges from a distant first guess.
    pins : (pins,), numbers of control points that keep their positions (default: none)
    iterations : largest number of iterations (default: 50)
    tolerance : the fit has converged when the energy decreases by less, relative to it (default: 1e-6)

    Raises
    ------
    InvalidParameter
        No points, a pin that is no vertex or is given twice, negative weights or factors; an array of another shape or type,
        NaN and infinite numbers.
    InvalidMesh, UnsupportedTopology
        No face that is not a hole, or the scheme cannot refine the mesh; the message says where.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    cloud = arrays.floats(points, "points", (None, 3), "(n, 3)")
    parts = _sublimit.fit_cloud(
        core_of(mesh), asked, cloud, _weights(weights, len(cloud)), _sublimit.Fairness(thin_plate, membrane), list(schedule),
        _pins(pins), iterations, tolerance, threads)
    warn_of(mesh, asked)
    return FittedPoints(**parts)


def _weights(weights: Any, count: int) -> arrays.Floats | None:
    return None if weights is None else arrays.floats(weights, "weights", (count,), f"({count} targets,)")


def _pins(pins: Any) -> arrays.Ints:
    return arrays.ints([] if pins is None else pins, "pins", (None,), "(pins,)")
