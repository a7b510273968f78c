# SPDX-License-Identifier: Apache-2.0
"""Errors and warnings. Messages of errors say what is wrong, where, and what would be right."""
from __future__ import annotations


class Error(Exception):
    """Base class of all errors of sublimit.

    Attributes
    ----------
    code : str
        Kind of the error, the same word as in C++ and C: ``invalid_mesh``, ``io_error``, ...
    """

    code: str = ""
    __module__ = "sublimit"


class InvalidMesh(Error, ValueError):
    """Raised for connectivity or positions that no scheme can take: an index out of range, a face with two corners."""

    code = "invalid_mesh"
    __module__ = "sublimit"


class UnsupportedTopology(Error, ValueError):
    """Raised for a valid mesh that this scheme cannot take: a quadrilateral given to Loop."""

    code = "unsupported_topology"
    __module__ = "sublimit"


class InvalidOption(Error, ValueError):
    """Raised for an unknown scheme, an unknown option, or a value of an option outside its range."""

    code = "invalid_option"
    __module__ = "sublimit"


class InvalidParameter(Error, ValueError):
    """Raised for an argument outside its range: a negative level, an array of the wrong shape."""

    code = "invalid_parameter"
    __module__ = "sublimit"


class FormatError(Error, ValueError):
    """Raised for a file that cannot be parsed. For text files the message starts with file:line."""

    code = "format_error"
    __module__ = "sublimit"


class AnalysisError(Error, ArithmeticError):
    """Raised for a local matrix whose powers have no limit: eigenvalue 1 is not simple and dominant."""

    code = "analysis_error"
    __module__ = "sublimit"


class IoError(Error, OSError):
    """Raised for a file that cannot be opened, read or written, and for a GPU that is lost."""

    code = "io_error"
    __module__ = "sublimit"


class ResourceError(Error, MemoryError):
    """Raised if memory, disk space or 32-bit indices do not suffice; often predicted before memory is taken."""

    code = "resource_error"
    __module__ = "sublimit"


class MeshWarning(UserWarning):
    """Warns of a mesh that is accepted with reservations: it is not a manifold, or some of its tags are ignored.

    Functions that take a mesh and a scheme issue it. ``warnings.simplefilter("ignore", sublimit.MeshWarning)`` silences it.
    With ``strict=True`` these functions raise `InvalidMesh` for meshes that are not manifolds.
    """

    __module__ = "sublimit"


_TYPES = {t.code: t for t in (InvalidMesh, UnsupportedTopology, InvalidOption, InvalidParameter, FormatError,
                              AnalysisError, IoError, ResourceError)}


def by_code(number: int) -> type[Error]:
    """Returns the class of an error of the compiled part.

    Parameters
    ----------
    number : number of its code in C++, an index into ``_sublimit.error_codes``
    """
    from ._sublimit import error_codes

    return _TYPES[error_codes[number]]
