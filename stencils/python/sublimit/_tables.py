# SPDX-License-Identifier: Apache-2.0
"""Tables: weights over the control points of one connectivity, baked once and applied to the points of every frame."""
from __future__ import annotations

import operator
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._errors import InvalidOption, InvalidParameter
from ._gpus import number_of
from ._levels import core_of, csr, warn_of
from ._meshes import Mesh
from ._schemes import OptionValue, Scheme, request
from ._surfaces import Tessellation, order, places_of

if TYPE_CHECKING:
    from scipy.sparse import csr_array
    from scipy.sparse.linalg import LinearOperator


class Table:
    """A table: points of a level, of its limit, or of places on the limit, as weighted sums of control points.

    `bake` and `Patches.bake` make it, `load` reads it. It never changes: threads may share it.

    Attributes
    ----------
    num_points : number of points that it makes
    num_control_points : number of points that it is applied to
    quantities : 1: positions; 3: du and dv too; 6: duu, duv and dvv too
    dtype : numpy.dtype of weights and results, float32 or float64
    rational : True if it is applied to homogeneous points (w x, w y, w z, w), or to points with weights, and divides by the
        weight

    Examples
    --------
    >>> import sublimit
    >>> cube = sublimit.Mesh(
    ...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    ...     [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
    >>> table = sublimit.bake(cube, "catmull-clark", levels=3)
    >>> table
    <sublimit.Table: 386 points of 8 control points, float32>
    >>> table.apply(cube.points.astype("float32")).shape
    (386, 3)
    >>> table.apply(cube.points, device="gpu" if sublimit.gpu_devices() else "cpu").shape
    (386, 3)
    """

    __module__ = "sublimit"
    __slots__ = ("_core", "dtype", "num_points", "num_control_points", "quantities", "rational", "__weakref__")
    _core: _sublimit.FloatTable | _sublimit.DoubleTable
    dtype: np.dtype[Any]
    num_points: int
    num_control_points: int
    quantities: int
    rational: bool

    def __init__(self) -> None:
        raise TypeError("sublimit.bake makes tables, sublimit.load reads them")

    @classmethod
    def _of(cls, core: _sublimit.FloatTable | _sublimit.DoubleTable) -> Table:
        table = cls.__new__(cls)
        table._core = core
        # Copied because every call reads them: a few calls of the compiled part take as long as applying a small table.
        table.dtype = np.dtype(np.float32 if isinstance(core, _sublimit.FloatTable) else np.float64)
        table.num_points = core.num_points
        table.num_control_points = core.num_control_points
        table.quantities = core.quantities
        table.rational = core.info["rational"]
        return table

    @property
    def num_bytes(self) -> int:
        """Memory of the arrays of the table, in bytes."""
        return self._core.num_bytes

    @property
    def info(self) -> dict[str, Any]:
        """Description of the table, a dictionary.

        Keys: ``scheme``; ``options`` of the scheme, with rules; ``rows``, the kind of points (``level``, ``limit``, ``grid`` or
        ``samples``); ``level``; ``grid``; ``triangles``, True if faces of places are triangles; ``topology_hash`` of the
        control mesh; ``tool``, the program that made the table; ``rational``.
        """
        return self._core.info

    @property
    def faces(self) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
        """Faces between the points of the table, ``(sizes, corners)``; holes are left out."""
        return self._core.faces()

    @property
    def refined_points(self) -> npt.NDArray[np.int64] | None:
        """Point of the table for each vertex of `refine`, -1 for vertices without faces: (vertices of the level,).

        None unless the table was baked with ``order=True``; files do not store it.

        Examples
        --------
        >>> import numpy, sublimit
        >>> square = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
        >>> table = sublimit.bake(square, "catmull-clark", levels=2, precision="double", order=True)
        >>> points = table.apply(square.points)[table.refined_points]
        >>> numpy.allclose(points, sublimit.refine(square, "catmull-clark", 2).points)
        True
        """
        return self._core.refined_points()

    @property
    def addresses(self) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.float64]] | None:
        """Place ``(face, (u, v))`` of each point, arrays (points,) and (points, 2); None for tables of levels."""
        return self._core.addresses()

    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """Status of each point, uint8, (points,); ``statuses[number]`` is its name. Empty if all points are regular."""
        return self._core.statuses

    @property
    def statuses(self) -> list[str]:
        """Names of the numbers in `status`."""
        return self._core.status_words

    def _shape(self, channels: int) -> tuple[int, ...]:
        made = channels - 1 if self.rational else channels
        return (self.num_points, made) if self.quantities == 1 else (self.quantities, self.num_points, made)

    def apply(self, points: npt.ArrayLike, out: npt.NDArray[Any] | None = None, *, weights: npt.ArrayLike | None = None,
              threads: int = 0, device: str = "cpu") -> npt.NDArray[Any]:
        """Makes the points of one frame or of several from their control points.

        A rational table divides by the weight, which is left out of the result.

        Parameters
        ----------
        points : (control points, channels) or (frames, control points, channels), 1 to 64 channels
            C-contiguous arrays of the table's `dtype` are used in place, others are copied first. For a rational table
            without `weights` there are 4 channels, (w x, w y, w z, w), as in `Patches.points`.
        out : C-contiguous array for the result, of the shape below and the table's `dtype` (default: a new array)
        weights : (control points,) or (frames, control points), for rational tables: the weights of `points`, which are then
            positions, or other values in any number of channels
        threads : largest number of threads on the CPU (default: all)
        device : ``"cpu"`` (default), ``"gpu"`` for the first GPU, or ``"gpu:1"``, see `gpu_devices`
            GPUs apply float tables, with the same results up to rounding. The table is copied to a GPU when it is first applied
            there, and stays there as long as it exists. Several frames in one call take less time than in several calls.

        Returns
        -------
        (points, channels), or (quantities, points, channels) for tables with derivatives
            For several frames with one more axis at the front.

        Raises
        ------
        InvalidParameter
            An array of another shape or type; numbers too large for the table's `dtype`; an `out` that shares memory with
            `points`.
        InvalidOption
            There is no such GPU: the message says what is missing; or a double table and a GPU. The CPU is not used instead.
        ResourceError
            No memory left on the GPU.
        IoError
            The GPU is lost.
        """
        gpu = number_of(device)
        given = self._input(self._homogeneous(points, weights), "points", self.num_control_points, "control points")
        frames = given.reshape((-1, *given.shape[-2:]))
        if not 1 <= given.shape[-1] <= 64:
            raise InvalidParameter(f"points has {given.shape[-1]} channels; 1 to 64 are right")
        shape = given.shape[:-2] + self._shape(given.shape[-1])
        if out is None:
            out = np.empty(shape, self.dtype)
        self._check_out(out, shape, given, "points")
        if len(frames):
            self._core.apply(frames, out.reshape((len(frames), self.quantities * self.num_points, -1)), threads, gpu, True)
        return out

    def _homogeneous(self, points: npt.ArrayLike, weights: npt.ArrayLike | None) -> npt.ArrayLike:
        """Returns points as the compiled part takes them: if weights are given, homogeneous with the weight as last column.

        Raises
        ------
        InvalidParameter
            Arrays of another shape or type; weights for a table that is not rational.
        """
        if weights is None:
            if not self.rational:
                return points
            points = arrays.of_others(points)
            shape = np.shape(points)
            if len(shape) in (2, 3) and shape[-1] != 4:
                raise InvalidParameter(f"points has {shape[-1]} columns, and the table is rational: 4, (w x, w y, w z, w), as "
                                       "Patches.points has them, are right, or points with weights=")
            return points
        if not self.rational:
            raise InvalidParameter("weights are for rational tables; this one is not")
        values, factors = arrays.any_array(points, "points"), arrays.any_array(weights, "weights")
        if values.ndim not in (2, 3) or factors.shape not in (values.shape[:-1], values.shape[-2:-1]):
            raise InvalidParameter(f"weights has shape {factors.shape}; one for each of the points, which have shape "
                                   f"{values.shape}, is right")
        if factors.dtype.kind not in "fiu" or values.dtype.kind not in "fiu":
            raise InvalidParameter(f"points have dtype {values.dtype} and weights {factors.dtype}; real numbers are right")
        factors = np.broadcast_to(factors.astype(np.float64), values.shape[:-1])[..., None]
        columns: npt.NDArray[np.float64] = np.concatenate([values * factors, factors], axis=-1)
        return columns

    def apply_transpose(self, values: npt.ArrayLike, out: npt.NDArray[Any] | None = None, *,
                        threads: int = 0, device: str = "cpu") -> npt.NDArray[Any]:
        """Applies the transpose of the table: makes gradients by control points from gradients by the points of the table.

        Parameters
        ----------
        values : (points, channels), gradients with respect to the positions, of one frame; for tables with derivatives also
            (quantities, points, channels), or the first quantities alone
            For a rational table they are gradients with respect to the homogeneous points that `matrix` makes, which are not
            divided.
        out : C-contiguous array for the result, of the shape below and the table's `dtype` (default: a new array)
        threads, device : as for `apply`

        Returns
        -------
        (control points, channels)

        Raises
        ------
        InvalidParameter, InvalidOption, ResourceError, IoError
            As `apply`.
        """
        gpu = number_of(device)
        given = arrays.any_array(values, "values")
        if self.quantities > 1 and given.ndim == 3:
            if given.shape[0] > self.quantities:
                raise InvalidParameter(f"values has shape {given.shape}; the table has {self.quantities} quantities")
            flat = self._input(given, "values", self.num_points, "points")
        else:
            if given.ndim != 2:
                raise InvalidParameter(f"values has shape {given.shape}; ({self.num_points} points, channels) is right")
            flat = self._input(given, "values", self.num_points, "points").reshape((1, *given.shape))
        shape = (self.num_control_points, flat.shape[-1])
        if out is None:
            out = np.empty(shape, self.dtype)
        self._check_out(out, shape, flat, "values")
        self._core.apply_transpose(flat, out, threads, gpu)
        return out

    def _input(self, values: npt.ArrayLike, name: str, count: int, what: str) -> npt.NDArray[Any]:
        array = arrays.any_array(values, name)
        if array.dtype.kind not in "fiu":
            raise InvalidParameter(f"{name} has dtype {array.dtype}; real numbers are right")
        if array.ndim not in (2, 3) or array.shape[-2] != count or array.shape[-1] < 1:
            raise InvalidParameter(f"{name} has shape {array.shape}; ({count} {what}, channels) is right, or a first axis before it")
        with np.errstate(over="ignore"):  # reported below, with its place
            taken = np.ascontiguousarray(array, dtype=self.dtype)
        if array.dtype.itemsize > taken.dtype.itemsize and not np.isfinite(taken).all():
            lost = np.argwhere(np.isfinite(array) & ~np.isfinite(taken))
            if len(lost):
                place = tuple(int(i) for i in lost[0])
                raise InvalidParameter(f"{name}[{', '.join(map(str, place))}] is {array[place]}, too large for a table in float; "
                                       "bake one with precision=\"double\"")
        return taken

    def _check_out(self, out: npt.NDArray[Any], shape: tuple[int, ...], given: npt.NDArray[Any], name: str) -> None:
        if not isinstance(out, np.ndarray) or out.dtype != self.dtype:
            raise InvalidParameter(f"out is {getattr(out, 'dtype', type(out).__name__)}; an array of {self.dtype} is right")
        if out.shape != shape:
            raise InvalidParameter(f"out has shape {out.shape}; {shape} is right")
        if not out.flags.c_contiguous or not out.flags.writeable:
            raise InvalidParameter("out is read-only or its rows do not follow each other; np.empty(shape, dtype) is right")
        if np.may_share_memory(out, given) and np.shares_memory(out, given):  # the first test is fast and misses no overlap
            raise InvalidParameter(f"out shares memory with {name}, which is read while out is written")

    def matrix(self) -> csr_array:
        """Returns the weights of the table as a sparse matrix.

        Returns
        -------
        scipy.sparse.csr_array, (quantities x points, control points)
            Rows of all positions come first, then those of all du, and so on. For a rational table it maps homogeneous control
            points to homogeneous points, which are not divided.
        """
        return csr(self._core.matrix())

    def operator(self) -> LinearOperator:
        """Returns `matrix` as a linear operator for SciPy's solvers, which applies the table instead of making the matrix.

        Returns
        -------
        scipy.sparse.linalg.LinearOperator, (quantities x points, control points)
        """
        from scipy.sparse.linalg import LinearOperator

        def forward(x: npt.NDArray[Any]) -> npt.NDArray[Any]:
            columns = self._input(x.reshape(self.num_control_points, -1), "x", self.num_control_points, "control points")
            made = np.empty((self.quantities * self.num_points, columns.shape[1]), self.dtype)
            for first in range(0, columns.shape[1], 64):  # one call applies at most 64 channels
                some = np.ascontiguousarray(columns[:, first:first + 64])
                part = np.empty((1, len(made), some.shape[1]), self.dtype)
                self._core.apply(some[None], part, 0, None, False)
                made[:, first:first + 64] = part[0]
            return made.reshape((-1, *x.shape[1:]))

        def backward(y: npt.NDArray[Any]) -> npt.NDArray[Any]:
            shaped = y.reshape(self.num_points, -1) if self.quantities == 1 else y.reshape(self.quantities, self.num_points, -1)
            return self.apply_transpose(shaped).reshape((-1, *y.shape[1:]))

        return LinearOperator(shape=(self.quantities * self.num_points, self.num_control_points), dtype=self.dtype,
                              matvec=forward, rmatvec=backward, matmat=forward, rmatmat=backward)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the table to a file in the layout of safetensors, which `load`, the program and ``eval/`` read.

        The file appears whole or not at all.

        Raises
        ------
        IoError
            The file cannot be written.
        ResourceError
            The disk is full.
        """
        self._core.save(os.fspath(path))

    def __reduce__(self) -> tuple[Any, ...]:
        import tempfile

        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "table.safetensors")
            self.save(path)
            with open(path, "rb") as file:
                return _unpickled, (file.read(),)

    def __repr__(self) -> str:
        return f"<sublimit.Table: {self.num_points} points of {self.num_control_points} control points, {self.dtype}>"


def _unpickled(data: bytes) -> Table:
    import tempfile

    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "table.safetensors")
        with open(path, "wb") as file:
            file.write(data)
        return load(path)  # the file is mapped, so it may be removed


def bake(mesh: Mesh, scheme: Scheme | str, levels: int | None = None, *, limit: bool = False, grid: int | None = None,
         at: tuple[npt.ArrayLike, ...] | None = None, tessellation: Tessellation | None = None,
         derivatives: int = 0, precision: str = "float", order: bool = False,
         boundary: str | None = None, creasing: str | None = None, triangles: str | None = None,
         option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
         orient: bool = False, crease_angle: float | None = None, crease_smoothing_groups: bool = False, strict: bool = False,
         threads: int = 0) -> Table:
    """Bakes a table: weights over the control points for a connectivity and its tags. Positions do not matter.

    Give one of `levels`, `grid`, `at` and `tessellation`, which select the points. Boundary, creasing and the other keyword
    arguments that are not listed are those of `refine`.
    Parameters
    ----------
    mesh : the control mesh; its faces and tags matter, its points do not
    scheme : name of a scheme, as in `schemes`, or a `Scheme`
    levels : k for the vertices of level k, 1 to 11; 0 to 11 with `limit`
    limit : with `levels`, limits of the vertices instead of their positions on the level (default: False)
    grid : N for N x N places on each face, sides included, N from 2 to 2048
    at : places (face, u, v) on the limit, arrays that broadcast to one shape; or (face, (u, v)), as `Table.addresses` returns
    tessellation : a `Tessellation`, for its points; `Table.faces` returns its triangles
    derivatives : number of derivatives of the limit: 0, 1 (du, dv) or 2 (duu, duv, dvv too); not with `levels` alone
        (default: 0)
    precision : of the weights, ``"float"`` or ``"double"`` (default: ``"float"``)
    order : with `levels`, keep which vertex of `refine` each point is: `Table.refined_points` (default: False)

    Raises
    ------
    InvalidParameter
        None of levels, grid, at and tessellation, or several; no places, places on no face, derivatives of levels, numbers
        outside their range.
    InvalidOption
        Another word for `precision`, or an unknown scheme, option or word.
    UnsupportedTopology, ResourceError
        As `refine`.

    Notes
    -----
    Points of levels are in an order of the table, not in that of `refine`: `Table.faces` has the faces between them, and
    `Table.refined_points` the point of each vertex of `refine` if `order` is set. Points of grids are ordered face by
    face, u fastest; places keep their order.
    """
    choices = "levels, grid, at and tessellation"
    if tessellation is not None:
        if at is not None:
            raise InvalidParameter(f"a table is of one of {choices}")
        at = tessellation.face, tessellation.u, tessellation.v
    options = bake_options(levels, limit, grid, at, derivatives, precision, choices)
    options.order = bool(order)
    if tessellation is not None:
        options.set_triangles(tessellation.triangles)
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    baked = Table._of(_sublimit.bake(core_of(mesh), asked, options, threads))
    warn_of(mesh, asked)
    return baked


def bake_options(levels: int | None, limit: bool, grid: int | None, at: tuple[npt.ArrayLike, ...] | None, derivatives: int,
                 precision: str, choices: str) -> _sublimit.BakeOptions:
    """Returns options of `bake` for the compiled part.

    Parameters
    ----------
    levels, limit, grid, at, derivatives, precision : as in `bake`
    choices : names of the arguments of which one must be given, for messages

    Raises
    ------
    InvalidParameter
        None of levels, grid and at, or several; no places, numbers outside their range.
    InvalidOption
        Another word for `precision`.
    """
    if precision not in ("float", "double"):
        raise InvalidOption(f"precision is {precision!r}; 'float' or 'double' are right")
    if sum(choice is not None for choice in (levels, grid, at)) != 1:
        raise InvalidParameter(f"a table is of one of {choices}")
    if limit and levels is None:
        raise InvalidParameter("limit is of a level; all others are of the limit anyway")
    options = _sublimit.BakeOptions()
    options.levels = None if levels is None else operator.index(levels)
    options.limit = bool(limit)
    options.grid = None if grid is None else operator.index(grid)
    options.derivatives = order(derivatives)
    options.in_double = precision == "double"
    if at is not None:
        where = places_of(at)
        if len(where[0]) == 0:
            raise InvalidParameter("at has no places; a table has one or more")
        options.set_places(where)
    return options


def load(path: str | os.PathLike[str], *, checksums: bool = False) -> Table:
    """Loads a table by mapping its file into memory: pages are read when they are first used.

    Parameters
    ----------
    path : path of the file
    checksums : compare the checksums of all arrays too, which reads all of the file (default: False)

    Raises
    ------
    FormatError
        The file is not a table, or is damaged; the message says what is wrong with it.
    IoError
        The file is missing or unreadable.
    """
    return Table._of(_sublimit.load(os.fspath(path), checksums))
