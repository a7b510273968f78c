# SPDX-License-Identifier: Apache-2.0
"""Continuity reports: of schemes, proved; of meshes, measured."""
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
    """A report as a dictionary, in the words of ``stencils/report_format.md``.

    Notebooks show its first figure.
    """

    __module__ = "sublimit"

    def __init__(self, text: str) -> None:
        super().__init__(json.loads(text))
        self._text = text

    def save_html(self, path: str | os.PathLike[str]) -> None:
        """Writes a page that needs nothing but itself. It appears whole or not at all."""
        _sublimit.write_text(os.fspath(path), _sublimit.report_page(self._text))

    def save_json(self, path: str | os.PathLike[str]) -> None:
        """Writes the report as the program does; ``sublimit verify`` checks its proofs."""
        _sublimit.write_text(os.fspath(path), self._text)

    def _repr_html_(self) -> str:
        return _sublimit.report_picture(self._text) or f"<p>{self!r}</p>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Report, (self._text,)

    def __repr__(self) -> str:
        return f"<sublimit.Report: {', '.join(self)}>"


def analyze(scheme: Scheme | str, valences: Iterable[int] = range(3, 13), *, claims: Mapping[str, object] | None = None,
            threads: int = 0) -> Report:
    """What the limits of a scheme are like, decided in exact numbers.

    Parameters
    ----------
    scheme : of meshes or of curves; one of your own as well
    valences : from 3 to 100
    claims : what the scheme is said to do, by name, instead of its own claims, such as ``{"extraordinary": 2}``

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
                 strict: bool = False, threads: int = 0) -> Report:
    """How smooth the limit of a mesh is, where, and why: measured on exact limits.

    Parameters
    ----------
    tolerance : what is allowed across seams, such as ``{"g0": "0.01%", "g1": "0.1deg", "g2": "5%"}``
    name : of the mesh, in the report
    """
    asked = request(scheme, boundary=boundary, creasing=creasing, triangles=triangles, option=option, triangulate=triangulate,
                    no_creases=no_creases, strict=strict)
    words = [f"{key}={value}" for key, value in (tolerance or {}).items()]
    report = Report(_sublimit.mesh_report(core_of(mesh), asked, words, name, threads))
    warn_of(mesh, asked)
    return report
