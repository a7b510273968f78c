# SPDX-License-Identifier: Apache-2.0
"""What goes wrong, with a message that says what, where, and what would be right."""
from __future__ import annotations


class Error(Exception):
    """Base of all errors of this package.

    Attributes
    ----------
    code : str
        ``invalid_mesh``, ``io_error``, ...: the same codes as in C++ and C.
    """

    code: str = ""
    __module__ = "sublimit"


class InvalidMesh(Error, ValueError):
    """Connectivity or positions that no scheme could take: an index out of range, a face with two corners."""

    code = "invalid_mesh"
    __module__ = "sublimit"


class UnsupportedTopology(Error, ValueError):
    """A valid mesh that this scheme cannot take: a quadrilateral given to Loop."""

    code = "unsupported_topology"
    __module__ = "sublimit"


class InvalidOption(Error, ValueError):
    """An unknown scheme, an unknown option or a value outside its range."""

    code = "invalid_option"
    __module__ = "sublimit"


class InvalidParameter(Error, ValueError):
    """An argument outside its range: a negative level."""

    code = "invalid_parameter"
    __module__ = "sublimit"


class FormatError(Error, ValueError):
    """A file that cannot be understood; the message starts with file:line where there is one."""

    code = "format_error"
    __module__ = "sublimit"


class AnalysisError(Error, ArithmeticError):
    """A local matrix whose spectrum has no limit."""

    code = "analysis_error"
    __module__ = "sublimit"


class IoError(Error, OSError):
    """A file that cannot be opened, read or written."""

    code = "io_error"
    __module__ = "sublimit"


class ResourceError(Error, MemoryError):
    """More memory, disk or 32-bit indices than there are, predicted or met."""

    code = "resource_error"
    __module__ = "sublimit"


class MeshWarning(UserWarning):
    """What a scheme accepts of a mesh but you should know: that it is no manifold, tags that are ignored.

    ``warnings.simplefilter("ignore", sublimit.MeshWarning)`` silences these; ``strict=True`` makes errors of those that name
    what is no manifold.
    """

    __module__ = "sublimit"


_TYPES = {t.code: t for t in (InvalidMesh, UnsupportedTopology, InvalidOption, InvalidParameter, FormatError,
                              AnalysisError, IoError, ResourceError)}


def by_code(number: int) -> type[Error]:
    """The type of the compiled part's error of this number."""
    from ._sublimit import error_codes

    return _TYPES[error_codes[number]]
