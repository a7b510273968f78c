# SPDX-License-Identifier: Apache-2.0
"""Curves and surfaces by recipes: known curves, the program's files, and what is refused."""
from __future__ import annotations

import json
import os
import pathlib
import pickle
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from tolerance import derivatives, rounding

import sublimit

CUBIC: dict[str, Any] = {"kind": "bezier_curve", "degree": 3, "points": [[0, 0, 0], [1, 2, 0], [3, 0, 1], [4, 1, 0]]}
W = 0.5**0.5
#: A quarter of a circle, and a quarter of a cylinder over it.
ARC: dict[str, Any] = {"kind": "nurbs_curve", "degree": 2, "knots": [0, 0, 0, 1, 1, 1],
                       "homogeneous": [[1, 0, 0, 1], [W, W, 0, W], [0, 1, 0, 1]]}
QUARTER: dict[str, Any] = {
    "kind": "nurbs_surface", "degree": [2, 1], "shape": [3, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 1, 1],
    "homogeneous": [[1, 0, 0, 1], [W, W, 0, W], [0, 1, 0, 1], [1, 0, 1, 1], [W, W, W, W], [0, 1, 1, 1]]}


def test_recipes_in_their_forms(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "cubic.json"
    path.write_text(json.dumps(CUBIC))
    arrays = {**CUBIC, "points": np.array(CUBIC["points"], dtype=np.float32)}
    exact = {**CUBIC, "points": [[Fraction(x) for x in point] for point in CUBIC["points"]]}
    texts = (json.dumps(CUBIC), "\n  " + json.dumps({"recipes": [CUBIC]}))
    forms: list[Any] = [path, str(path), os.fsencode(path), CUBIC, {"recipes": [CUBIC]}, arrays, exact, *texts]
    for recipe in forms:
        made = sublimit.construct(recipe)
        assert made.names == ["recipe 0 (bezier_curve)"] and made.notes == []
        assert made.curves().points.tolist() == CUBIC["points"]
    assert repr(made) == "<sublimit.Construction: recipe 0 (bezier_curve)>"


def test_bezier_curves_are_bernstein_sums() -> None:
    curves = sublimit.construct({"recipes": [CUBIC, {**CUBIC, "points": CUBIC["points"][::-1]}]}).curves()
    assert (curves.num_curves, curves.num_segments) == (2, 2) and not curves.rational and curves.weights is None
    assert not curves.points.flags.writeable
    t = np.linspace(0, 1, 7)
    found = curves.evaluate([[0], [1]], [t, 1 - t], derivatives=2)
    net = np.array(CUBIC["points"])
    expected = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=1) @ net
    np.testing.assert_allclose(found.points, [expected, expected], rtol=0, atol=rounding)
    first = 3 * np.stack([(1 - t) ** 2, 2 * t * (1 - t), t**2], axis=1) @ np.diff(net, axis=0)
    np.testing.assert_allclose(found.first, [first, -first], rtol=0, atol=rounding * 10)
    assert found.second.shape == (2, 7, 3) and (found.order == 2).all()
    with pytest.raises(AttributeError, match="derivatives=1"):
        curves.evaluate(0, t).first


def test_rational_curves() -> None:
    arc = sublimit.construct(ARC).curves()
    assert arc.rational and arc.points.shape == (3, 4)
    assert arc.weights is not None and arc.weights.tolist() == [1, W, 1]
    found = arc.evaluate(0, np.linspace(0, 1, 9), derivatives=2)
    np.testing.assert_allclose(np.linalg.norm(found.points, axis=1), 1, rtol=0, atol=rounding)
    np.testing.assert_allclose(np.einsum("ij,ij->i", found.points, found.first), 0, rtol=0, atol=derivatives)
    # A weight of 0 in the middle: a pole there.
    at = sublimit.construct({**ARC, "homogeneous": [[1, 0, 0, 1], [0, 1, 0, 0], [1, 0, 0, -1]]}).curves().evaluate(0, [0.25, 0.5])
    assert [at.statuses[s] for s in at.status] == ["regular", "pole"] and not at.points[1].any()


def test_surfaces_are_those_of_patches(tmp_path: pathlib.Path) -> None:
    made = sublimit.construct({"recipes": [{**QUARTER, "name": "wall"}, ARC]})
    assert made.names == ["recipe 0 'wall' (nurbs_surface)", "recipe 1 (nurbs_curve)"]
    surfaces = made.surfaces()
    assert isinstance(surfaces, sublimit.Patches) and surfaces.num_faces == 1
    at = surfaces.evaluate(0, [0, 0.3, 1], 0.5)
    np.testing.assert_allclose(np.hypot(at.points[:, 0], at.points[:, 1]), 1, rtol=0, atol=rounding)
    made.write(tmp_path / "net.obj")
    again = sublimit.construct(tmp_path / "net.obj")
    assert again.names[0].startswith("line ") and len(again.names) == 2
    for patches in (again.surfaces(), sublimit.Patches.read(tmp_path / "net.obj")):
        np.testing.assert_allclose(patches.evaluate(0, [0, 0.3, 1], 0.5).points, at.points, rtol=0, atol=rounding)
    moved = surfaces.with_points(surfaces.points * [2, 2, 2, 1])
    np.testing.assert_allclose(moved.evaluate(0, [0, 0.3, 1], 0.5).points, 2 * at.points, rtol=0, atol=rounding)
    for points, words in ((surfaces.points[:, :3], r"points has shape \(6, 3\); \(6, 4\)"), (surfaces.points * np.nan, "is nan")):
        with pytest.raises(sublimit.Error, match=words):
            surfaces.with_points(points)


def test_nets_are_the_programs(program: Callable[..., str], tmp_path: pathlib.Path) -> None:
    (tmp_path / "quarter.json").write_text(json.dumps({"recipes": [QUARTER, ARC]}))
    program("construct", tmp_path / "quarter.json", "-o", tmp_path / "program.obj", "--quiet")
    sublimit.construct(tmp_path / "quarter.json").write(tmp_path / "ours.obj")
    assert (tmp_path / "ours.obj").read_bytes() == (tmp_path / "program.obj").read_bytes()


@pytest.mark.parametrize("recipe, error, words", [
    ({"kind": "bezier_curv", "points": []}, sublimit.FormatError, "recipe.*bezier_curv"),
    ({"kind": "bezier_curve", "degree": 2}, sublimit.FormatError, "points"),
    ({"kind": "bezier_curve", "degree": 0, "points": [[0, 0, "a"]]}, sublimit.FormatError, "points"),
    ({"kind": "bezier_curve", "points": [[0, 0, np.nan]]}, ValueError, "recipe has a number that is not finite"),
    ({"kind": "bezier_curve", "points": np.full((2, 3), np.inf)}, ValueError, "recipe has a number that is not finite"),
    ({"kind": {1, 2}}, TypeError, "recipe: a set is no JSON"),
    ('{"kind": ', sublimit.FormatError, "recipe"),
    ("nothing.json", sublimit.IoError, "nothing.json"),
    ("nothing.obj", sublimit.IoError, "nothing.obj"),
    (3, TypeError, "recipe is a int; a path, JSON or a dict is right"),
    (None, TypeError, "recipe is a NoneType"),
    ([CUBIC], TypeError, "recipe is a list")])
def test_refuses_recipes(recipe: Any, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        sublimit.construct(recipe)


def test_refuses_in_clear_words(tmp_path: pathlib.Path) -> None:
    line, wall = sublimit.construct(CUBIC), sublimit.construct(QUARTER)
    with pytest.raises(sublimit.UnsupportedTopology, match="none of a surface"):
        line.surfaces()
    with pytest.raises(sublimit.UnsupportedTopology, match="none of a curve"):
        wall.curves()
    with pytest.raises(sublimit.InvalidOption, match="obj"):
        line.write(tmp_path / "net.step")
    with pytest.raises(sublimit.IoError):
        line.write(tmp_path / "nowhere" / "net.obj")
    for kind in (sublimit.Construction, sublimit.Curves):
        with pytest.raises(TypeError, match="sublimit.construct"):
            kind()
    curves = line.curves()
    for place, words in (((1, 0), "1"), ((0, 1.5), "1.5"), ((0, np.nan), "nan|finite"), ((0.5, 0), "segment has dtype float64"),
                         (([0, 0], [0, 0, 0]), "do not broadcast")):
        with pytest.raises(sublimit.Error, match=words):
            curves.evaluate(*place)  # type: ignore[arg-type]
    with pytest.raises(sublimit.Error, match="derivatives is 3"):
        curves.evaluate(0, 0, derivatives=3)
    for thing in (line, curves):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(thing)
