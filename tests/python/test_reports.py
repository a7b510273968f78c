# SPDX-License-Identifier: Apache-2.0
"""Reports are the program's, byte for byte."""
from __future__ import annotations

import json
import pathlib
import pickle
from collections.abc import Callable

import pytest

import sublimit

Program = Callable[..., str]


def test_schemes_are_the_programs(program: Program, tmp_path: pathlib.Path) -> None:
    program("analyze", "-s", "loop", "--valence", "4,6", "--json", tmp_path / "program.json", "-o", tmp_path / "program.html")
    report = sublimit.analyze("loop", valences=[6, 4])
    report.save_json(tmp_path / "ours.json")
    report.save_html(tmp_path / "ours.html")
    for kind in ("json", "html"):
        assert (tmp_path / f"ours.{kind}").read_bytes() == (tmp_path / f"program.{kind}").read_bytes()
    assert report == json.loads((tmp_path / "program.json").read_text()) and "verify" not in report
    program("verify", tmp_path / "ours.json")
    assert pickle.loads(pickle.dumps(report)) == report


def test_curves_and_claims() -> None:
    report = sublimit.analyze("four-point")
    assert report["summary"][0]["regular"].startswith("C^1")
    claimed = sublimit.analyze("loop", valences=[5], claims={"interpolates": True})
    verdicts = {claim["claim"]: claim["verdict"] for claim in claimed["schemes"][0]["claims"]}
    assert verdicts["interpolates"] == "disproved" and verdicts["convex-hull"] == "proved"


class Staying(sublimit.Scheme):
    """Points of edges are midpoints, and vertices stay."""

    split = "ptq"

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        return v.center

    def edge(self, e: sublimit.EdgeSite) -> sublimit.Stencil:
        return (e.tail + e.head) / 2


class RunningAway(Staying):
    """Vertices are pushed away from their neighbours."""

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        return 3 * v.center - 2 * v.neighbor_mean


def test_types_need_no_claims() -> None:
    report = sublimit.analyze(Staying(), valences=[5])
    assert report["schemes"][0]["interpolates"] is True and report["summary"][0]["type"] == "interpolating"
    for name in ("doo-sabin", "mid-edge"):
        wrong = sublimit.analyze(name, valences=[3], claims={"interpolates": True})
        verdicts = {claim["claim"]: claim["verdict"] for claim in wrong["schemes"][0]["claims"]}
        assert verdicts["interpolates"] == "disproved" and wrong["summary"][0]["type"] == "approximating"


def test_schemes_that_diverge_are_disproved() -> None:
    report = sublimit.analyze(RunningAway(), valences=[5, 6])
    for at in report["schemes"][0]["neighborhoods"]:
        if at["kind"] == "vertex":
            verdicts = {verdict["property"]: verdict for verdict in at["verdicts"]}
            assert verdicts["convergence"]["verdict"] == verdicts["c1"]["verdict"] == "disproved"
            assert "larger than 1" in verdicts["convergence"]["because"]
    octahedron = sublimit.Mesh([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
                               [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]])
    with pytest.raises(sublimit.UnsupportedTopology, match="diverges"):
        sublimit.limit(octahedron, RunningAway())


def test_meshes_are_the_programs(tagged: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    tagged.write(tmp_path / "cage.obj")
    report = sublimit.analyze_mesh(tagged, "catmull-clark", tolerance={"g1": "0.1deg"}, name="cage.obj")
    report.save_json(tmp_path / "ours.json")
    # Creases bend more than the tolerance, and the program says so by its exit status.
    program("analyze", tmp_path / "cage.obj", "-s", "catmull-clark", "--tolerance", "g1=180deg", "--json",
            tmp_path / "program.json", "-o", tmp_path / "program.html")
    theirs = json.loads((tmp_path / "program.json").read_text())
    assert report["mesh"]["inventory"] == theirs["mesh"]["inventory"]
    assert report["mesh"]["curvature"] == theirs["mesh"]["curvature"]
    assert report._repr_html_().lstrip().startswith("<svg")


def test_refuses_in_clear_words(cube: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    with pytest.raises(sublimit.InvalidOption, match="no scheme|unknown scheme"):
        sublimit.analyze("lop")
    with pytest.raises(sublimit.Error, match="2"):
        sublimit.analyze("loop", valences=[2])
    with pytest.raises(sublimit.InvalidOption, match="g7"):
        sublimit.analyze_mesh(cube, "catmull-clark", tolerance={"g7": 1})
    with pytest.raises(sublimit.IoError):
        sublimit.analyze("bilinear", valences=[4]).save_html(tmp_path / "nowhere" / "report.html")
    assert not list(tmp_path.iterdir())
