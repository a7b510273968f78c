# SPDX-License-Identifier: Apache-2.0
"""Converts arguments to arrays of the types and shapes that the compiled part takes. Arrays that fit are not copied."""
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
    """Returns an array of another package (DLPack) as a NumPy array of the same memory, and anything else as it is."""
    return np.from_dlpack(values) if hasattr(values, "__dlpack__") and not isinstance(values, np.ndarray) else values


def any_array(values: Any, name: str) -> npt.NDArray[Any]:
    """Returns an array of any shape and type, without a copy if it is one.

    Raises
    ------
    InvalidParameter
        Rows of different lengths, objects, masked entries.
    """
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
    """Returns real numbers as a C-contiguous array of float64.

    Parameters
    ----------
    values : array of any real type, or nested lists
    name : name of the argument, for messages
    shape : required length of each axis, None for any
    what : required shape in words, for messages
    finite : refuse NaN and infinity (default)

    Raises
    ------
    InvalidParameter
        An array of another shape or type, with masked entries or, if `finite`, with NaN or infinity.
    """
    array = any_array(values, name)
    if array.size == 0 and array.ndim == 1 and len(shape) > 1:
        array = array.reshape((0, *(n or 0 for n in shape[1:])))  # an empty list has no number of columns
    if array.dtype.kind not in "fiu":
        raise InvalidParameter(f"{name} has dtype {array.dtype}; real numbers are right")
    _shape(array, name, shape, what)
    array = np.ascontiguousarray(array, dtype=np.float64)
    if finite and not np.isfinite(array).all():
        row = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InvalidParameter(f"{name}[{', '.join(map(str, row))}] is {array[row]}; finite numbers are right")
    return array


def ints(values: Any, name: str, shape: tuple[int | None, ...], what: str) -> Ints:
    """Returns integers of any type as a C-contiguous array of int32. The parameters are those of `floats`.

    Raises
    ------
    InvalidParameter
        An array of another shape or type, with masked entries, or with numbers beyond 32 bits.
    """
    array = any_array(values, name)
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
    """Returns the sizes and the corners of faces, two arrays of int32.

    Parameters
    ----------
    values : array (faces, corners of each), list of lists, or ``(sizes, corners)``
    name : name of the argument, for messages

    Raises
    ------
    InvalidParameter
        An array of another shape or type, or with numbers beyond 32 bits.
    """
    values = of_others(values)
    if isinstance(values, tuple) and len(values) == 2:
        sizes, corners = (np.asarray(part) if _is_flat(part) else None for part in values)
        # A tuple of two may also be a list of two faces.
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
