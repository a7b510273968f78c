# SPDX-License-Identifier: Apache-2.0
"""Continuity reports: on schemes, with proofs, and on limits of meshes, by measurement."""
from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from typing import Any

from . import _sublimit
from ._levels import core_of, warn_of
from ._meshes import Mesh
from ._schemes import NamedScheme, OptionValue, Scheme, as_scheme, claim_word, request, schemes


class Report(dict[str, Any]):
    """A continuity report: a dictionary in the format of ``stencils/report_format.md``. `analyze` and `analyze_mesh` make it.

    A notebook displays its first figure.
    """

    __module__ = "sublimit"

    def __init__(self, text: str) -> None:
        super().__init__(json.loads(text))
        self._text = text

    def save_html(self, path: str | os.PathLike[str]) -> None:
        """Writes the report as one HTML file that refers to no other file. The file appears whole or not at all.

        Raises
        ------
        IoError
            The file cannot be written.
        ResourceError
            The disk is full.
        """
        _sublimit.write_text(os.fspath(path), _sublimit.report_page(self._text))

    def save_json(self, path: str | os.PathLike[str]) -> None:
        """Writes the report as JSON; ``sublimit verify`` checks its proofs. The file appears whole or not at all.

        Raises
        ------
        IoError
            The file cannot be written.
        ResourceError
            The disk is full.
        """
        _sublimit.write_text(os.fspath(path), self._text)

    def _repr_html_(self) -> str:
        return _sublimit.report_picture(self._text) or f"<p>{self!r}</p>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Report, (self._text,)

    def __repr__(self) -> str:
        return f"<sublimit.Report: {', '.join(self)}>"


def analyze(scheme: Scheme | str, valences: Iterable[int] = range(3, 13), *, claims: Mapping[str, object] | None = None,
            threads: int = 0) -> Report:
    """Returns a report on a scheme, computed in exact numbers.

    It has the smoothness of limits on regular meshes and at extraordinary vertices, and whether the claims of the scheme are
    proved, disproved or observed.

    Parameters
    ----------
    scheme : name of a scheme for meshes or a linear one for curves, as in `schemes`, or a `Scheme`
    valences : valences of vertices to analyse, 3 to 100 (default: 3 to 12)
    claims : claims to check instead of the scheme's own, {name: value}, such as ``{"extraordinary": 2}``; ignored for curve
        schemes
    threads : largest number of threads (default: all)

    Raises
    ------
    InvalidOption
        An unknown scheme, option or claim.
    InvalidParameter
        A valence outside its range; masks that are missing or not affine.

    Examples
    --------
    >>> import sublimit
    >>> report = sublimit.analyze("loop", valences=[6])
    >>> report["summary"][0]["regular"]
    'C^2'
    """
    wanted = as_scheme(scheme)
    words = [f"{name}={claim_word(value)}" for name, value in (claims or {}).items()]
    numbers = sorted({int(n) for n in valences})
    if not isinstance(wanted, NamedScheme):
        return Report(_sublimit.scheme_report(str(wanted), {}, numbers, words, False, wanted._masks(), threads))
    info = schemes().get(wanted.name)
    curve = info is not None and info.kind == "curve" and info.linear
    return Report(_sublimit.scheme_report(wanted.name, dict(wanted.options), numbers, words, curve, None, threads))


def analyze_mesh(mesh: Mesh, scheme: Scheme | str, *, tolerance: Mapping[str, object] | None = None, name: str = "mesh",
                 boundary: str | None = None, creasing: str | None = None, triangles: str | None = None,
                 option: Mapping[str, OptionValue] | None = None, triangulate: bool = False, no_creases: bool = False,
                 orient: bool = False, crease_angle: float | None = None, crease_smoothing_groups: bool = False,
                 strict: bool = False, threads: int = 0) -> Report:
    """Returns a report on the limit of a mesh: how smooth it is at which points and why, measured on exact limits.

    Boundary, creasing and the other keyword arguments that are not listed are those of `refine`.

    Parameters
    ----------
    mesh : the control mesh
    scheme : name of a scheme, as in `schemes`, or a `Scheme`
    tolerance : largest gaps, angles and differences of curvature across seams, such as
        ``{"g0": "0.01%", "g1": "0.1deg", "g2": "5%"}``. The report has no verdict on those that are absent (default: none).
    name : name of the mesh in the report (default: ``"mesh"``)

    Raises
    ------
    InvalidOption
        A tolerance that cannot be parsed, or an unknown scheme, option or word.
    UnsupportedTopology
        The scheme cannot refine the mesh; the message says where.
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, orient=orient, crease_angle=crease_angle,
                    crease_smoothing_groups=crease_smoothing_groups, strict=strict)
    words = [f"{key}={value}" for key, value in (tolerance or {}).items()]
    report = Report(_sublimit.mesh_report(core_of(mesh), asked, words, name, threads))
    warn_of(mesh, asked)
    return report
