# SPDX-License-Identifier: Apache-2.0
"""GPUs of this machine that can apply tables."""
from __future__ import annotations

import re
from dataclasses import dataclass

from . import _sublimit
from ._errors import InvalidOption


@dataclass(frozen=True)
class GpuInfo:
    """Properties of a GPU that can apply tables.

    Attributes
    ----------
    device : ``"gpu:0"``, ``"gpu:1"``, ...: the argument `device` of `Table.apply`
    name : name of the GPU, as reported by its driver
    api : interface, ``"Vulkan"`` or ``"CUDA"``
    kind : ``"discrete"``, ``"integrated"``, ``"virtual"``, or ``"cpu"`` for a CPU that emulates a GPU
    memory : bytes of the largest heap on the device
    halves : True if results can be half floats, which only the C++ interface makes
    driver : name and version of the driver
    """

    __module__ = "sublimit"
    device: str
    name: str
    api: str
    kind: str
    memory: int
    halves: bool
    driver: str


def gpu_devices() -> list[GpuInfo]:
    """Returns the GPUs of this machine that can apply tables, discrete ones first.

    The list is empty if there is no driver, or if this module was built without its part for GPUs. The error that `Table.apply`
    raises for ``device="gpu"`` says what is missing.

    Examples
    --------
    >>> import sublimit
    >>> for number, gpu in enumerate(sublimit.gpu_devices()):
    ...     assert gpu.device == f"gpu:{number}" and gpu.api in ("Vulkan", "CUDA")
    """
    return [GpuInfo(f"gpu:{number}", *told) for number, told in enumerate(_sublimit.gpu_devices())]


def number_of(device: str) -> int | None:
    """Returns the number of a GPU, or None for the CPU.

    Parameters
    ----------
    device : ``"cpu"``, ``"gpu"`` (GPU 0) or ``"gpu:N"``

    Raises
    ------
    InvalidOption
        Another word.
    """
    if device == "cpu":
        return None
    found = re.fullmatch("gpu(?::([0-9]{1,4}))?", device) if isinstance(device, str) else None
    if found is None:
        raise InvalidOption(f"device is {device!r}; 'cpu', 'gpu' or 'gpu:1' are right")
    return int(found[1] or 0)
