# SPDX-License-Identifier: Apache-2.0
"""Arguments as arrays of the types and shapes that the compiled part takes: what is one already is not copied."""
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import InvalidParameter

Floats = npt.NDArray[np.float64]
Floats32 = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int32]


def of_others(values: Any) -> Any:
    """Arrays of other packages that say where they are (DLPack), looked at there."""
    return np.from_dlpack(values) if hasattr(values, "__dlpack__") and not isinstance(values, np.ndarray) else values


def _array(values: Any, name: str) -> npt.NDArray[Any]:
    values = of_others(values)
    if isinstance(values, np.ma.MaskedArray):
        if np.any(values.mask):
            raise InvalidParameter(f"{name} has masked entries; fill them, or leave them out")
        values = values.data
    try:
        array = np.asarray(values)
    except ValueError:
        raise InvalidParameter(f"{name} is ragged: its rows are not of one length") from None
    if array.dtype == object:
        raise InvalidParameter(f"{name} is an array of objects: its rows are not of one length, or no numbers")
    return array


def _shape(array: npt.NDArray[Any], name: str, shape: tuple[int | None, ...], what: str) -> None:
    right = array.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, array.shape))
    if not right:
        raise InvalidParameter(f"{name} has shape {array.shape}; {what} is right")


def floats(values: Any, name: str, shape: tuple[int | None, ...], what: str, *, finite: bool = True) -> Floats:
    """Real numbers in double, rows one after the other.

    Parameters
    ----------
    shape : of each axis its length, None for any
    what : the shape in words, for errors
    """
    array = _array(values, name)
    if array.size == 0 and array.ndim == 1 and len(shape) > 1:
        array = array.reshape((0, *(n or 0 for n in shape[1:])))  # of an empty list nobody knows how wide it is
    if array.dtype.kind not in "fiu":
        raise InvalidParameter(f"{name} has dtype {array.dtype}; real numbers are right")
    _shape(array, name, shape, what)
    array = np.ascontiguousarray(array, dtype=np.float64)
    if finite and not np.isfinite(array).all():
        row = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InvalidParameter(f"{name}[{', '.join(map(str, row))}] is {array[row]}; finite numbers are right")
    return array


def ints(values: Any, name: str, shape: tuple[int | None, ...], what: str) -> Ints:
    """Whole numbers in 32 bits, rows one after the other; of any integer type."""
    array = _array(values, name)
    if array.size == 0:
        array = array.astype(np.int32)
        if array.ndim == 1 and len(shape) > 1:
            array = array.reshape((0, *(n or 0 for n in shape[1:])))
    if array.dtype.kind not in "iu":
        raise InvalidParameter(f"{name} has dtype {array.dtype}; whole numbers are right")
    _shape(array, name, shape, what)
    if array.dtype.itemsize > 4 or array.dtype == np.uint32:
        limits = np.iinfo(np.int32)
        outside = (array > limits.max) | (array < limits.min) if array.size else np.zeros(0, bool)
        if outside.any():
            raise InvalidParameter(f"{name} has {array[outside][0]}; 32-bit numbers are right")
    return np.ascontiguousarray(array, dtype=np.int32)


def faces(values: Any, name: str = "faces") -> tuple[Ints, Ints]:
    """Sizes and corners of faces: of an array (n, 3) or (n, 4), of a list of lists, of (sizes, corners)."""
    values = of_others(values)
    if isinstance(values, tuple) and len(values) == 2:
        sizes, corners = (np.asarray(part) if _is_flat(part) else None for part in values)
        # Two triangles are a tuple of two as well.
        certain = all(isinstance(part, np.ndarray) for part in values)
        if sizes is not None and corners is not None and (certain or (sizes.sum() == len(corners) and (sizes >= 3).all())):
            return ints(sizes, f"{name}[0]", (None,), "(faces,)"), ints(corners, f"{name}[1]", (None,), "(corners,)")
    if isinstance(values, np.ndarray) and values.dtype != object or not _is_ragged(values):
        array = ints(values, name, (None, None), "(faces, corners of each), (sizes, corners) or a list of lists")
        return np.full(len(array), array.shape[1], np.int32), array.reshape(-1)
    lists = [ints(face, f"{name}[{i}]", (None,), "(corners,)") for i, face in enumerate(values)]
    return np.fromiter(map(len, lists), np.int32, len(lists)), np.concatenate(lists)


def _is_flat(values: Any) -> bool:
    if isinstance(values, np.ndarray):
        return values.ndim == 1 and values.dtype.kind in "iu"
    return isinstance(values, Iterable) and all(isinstance(v, (int, np.integer)) for v in values)


def _is_ragged(values: Any) -> bool:
    return len({len(face) for face in values}) > 1
