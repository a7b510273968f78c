# SPDX-License-Identifier: Apache-2.0
"""GPUs that tables are applied on."""
from __future__ import annotations

import re
from dataclasses import dataclass

from . import _sublimit
from ._errors import InvalidOption


@dataclass(frozen=True)
class GpuInfo:
    """A GPU that `Table.apply` takes.

    Attributes
    ----------
    device : ``"gpu:0"``, ``"gpu:1"``, ...: what `Table.apply` is to be given
    name : as its driver has it
    api : ``"Vulkan"`` or ``"CUDA"``
    kind : ``"discrete"``, ``"integrated"``, ``"virtual"``, or ``"cpu"``: a processor that stands in for a GPU
    memory : bytes
    halves : results can be half floats, in programs in C++
    driver : its name and version
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
    """GPUs of this machine that tables can be applied on, discrete ones first.

    None where there is no driver, or where this module was built without its part for GPUs: `Table.apply` says what is
    missing.

    Examples
    --------
    >>> import sublimit
    >>> for number, gpu in enumerate(sublimit.gpu_devices()):
    ...     assert gpu.device == f"gpu:{number}" and gpu.api in ("Vulkan", "CUDA")
    """
    return [GpuInfo(f"gpu:{number}", *told) for number, told in enumerate(_sublimit.gpu_devices())]


def number_of(device: str) -> int | None:
    """Of a GPU; None: the CPU."""
    if device == "cpu":
        return None
    found = re.fullmatch("gpu(?::([0-9]{1,4}))?", device) if isinstance(device, str) else None
    if found is None:
        raise InvalidOption(f"device is {device!r}; 'cpu', 'gpu' or 'gpu:1' are right")
    return int(found[1] or 0)
