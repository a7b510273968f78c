# SPDX-License-Identifier: Apache-2.0
"""Schemes written in Python: those of the library once more are the same, and mistakes in masks are told."""
from __future__ import annotations

import functools
import operator
import pathlib
import pickle
import threading
from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from tolerance import derivatives, products, rounding

import sublimit

Program = Callable[..., str]


class CatmullClark(sublimit.Scheme):
    claims = {"regular": 2, "extraordinary": 1, "generates": 3, "reproduces": 1, "convex_hull": True}

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        n = v.valence
        return ((n - 2) * v.center + v.neighbor_mean + v.face_point_mean) / n

    def edge(self, e: sublimit.EdgeSite) -> sublimit.Stencil:
        return (e.tail + e.head) / 4 + (e.left_face.point + e.right_face.point) / 4

    def face(self, f: sublimit.FaceSite) -> sublimit.Stencil:
        return f.centroid


class Loop(sublimit.Scheme):
    split = "ptq"

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        a = v.ratio(3, 8) + v.cos_2pi(1, v.valence) / 4
        b = v.ratio(5, 8) - a * a
        return (1 - b) * v.center + b * v.neighbor_mean

    def edge(self, e: sublimit.EdgeSite) -> sublimit.Stencil:
        return (3 * (e.tail + e.head) + e.left_face.corner(2) + e.right_face.corner(2)) / 8


class DooSabin(sublimit.Scheme):
    split = "dqq"
    sharpening = "boundary"

    def corner(self, f: sublimit.FaceSite) -> sublimit.Stencil:
        n = f.size
        own = f.ratio(n + 5, 4 * n) * f.corner(0)
        return own + sum(((3 + 2 * f.cos_2pi(j, n)) * f.ratio(1, 4 * n) * f.corner(j) for j in range(1, n)), 0 * own)

    def crease_edge(self, e: sublimit.CreaseEdgeSite) -> sublimit.Stencil:
        return (3 * e.tail + e.head) / 4


class MidEdge(sublimit.Scheme):
    split = "mid-edge"
    sharpening = "boundary"
    period = 2

    def edge(self, e: sublimit.EdgeSite) -> sublimit.Stencil:
        return (e.tail + e.head) / 2

    def crease_vertex(self, v: sublimit.CreaseSite) -> sublimit.Stencil:
        return v.center

    def crease_edge(self, e: sublimit.CreaseEdgeSite) -> sublimit.Stencil:
        return (e.tail + e.head) / 2


class Sqrt3(sublimit.Scheme):
    split = "sqrt3"
    sharpening = "boundary"
    period = 2

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        a = (4 - 2 * v.cos_2pi(1, v.valence)) / v.ratio(9, 1)
        return (1 - a) * v.center + a * v.neighbor_mean

    def face(self, f: sublimit.FaceSite) -> sublimit.Stencil:
        return f.centroid

    def crease_vertex(self, v: sublimit.CreaseSite) -> sublimit.Stencil:
        return v.center if v.level == 0 else (4 * v.before + 19 * v.center + 4 * v.after) / 27

    def crease_edge(self, e: sublimit.CreaseEdgeSite) -> sublimit.Stencil:
        return (e.before + 16 * e.tail + 10 * e.head) / 27


class Butterfly(sublimit.Scheme):
    split = "ptq"
    sharpening = "sharp"

    def __init__(self, tension: Fraction = Fraction(1)) -> None:
        self.tension = tension

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        return v.center

    def wide_edge(self, e: sublimit.WideEdgeSite) -> sublimit.Stencil:
        a, b, w = e.tail_ring, e.head_ring, self.tension / 16
        return (e.tail + e.head) / 2 + 2 * w * (a.continued(1) + a.continued(-1)) - w * (
            a.continued(2) + a.continued(-2) + b.continued(2) + b.continued(-2))

    def crease_vertex(self, v: sublimit.CreaseSite) -> sublimit.Stencil:
        return v.center

    def crease_edge(self, e: sublimit.CreaseEdgeSite) -> sublimit.Stencil:
        w = self.tension / 16
        return (Fraction(1, 2) + w) * (e.tail + e.head) - w * (e.before + e.after)


class Bilinear(sublimit.Scheme):
    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        return v.center

    def edge(self, e: sublimit.EdgeSite) -> sublimit.Stencil:
        return (e.tail + e.head) / 2

    def face(self, f: sublimit.FaceSite) -> sublimit.Stencil:
        return f.centroid

    def crease_vertex(self, v: sublimit.CreaseSite) -> sublimit.Stencil:
        return v.center


class Smoothed(sublimit.Scheme):
    split = "keep"

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        return v.face_centroid_mean

    def crease_vertex(self, v: sublimit.CreaseSite) -> sublimit.Stencil:
        return (v.before + 2 * v.center + v.after) / 4


class Averaging(sublimit.Scheme):
    steps = (Bilinear(), Smoothed())
    sharpening = "boundary"


def total(stencils: Iterable[sublimit.Stencil]) -> sublimit.Stencil:
    return functools.reduce(operator.add, stencils)


class Kobbelt(sublimit.Scheme):
    sharpening = "sharp"
    corners = 4
    preparation = (Bilinear(),)

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        return v.center

    def beyond(self, v: sublimit.Ring) -> sublimit.Stencil:
        """The point beyond v on the line of the ring's own edge."""
        n, r = v.valence, v.ratio(1, 9)
        if not v.is_closed:
            return 2 * v.center - v.neighbor(0)
        if n == 4:
            return v.neighbor(2)
        edges, diagonals = total(v.neighbor(j) for j in range(n)), total(v.diagonal(j) for j in range(n))
        near = total(v.diagonal(j) for j in (-2, -1, 0, 1))
        return v.ratio(4, n) * (edges - r * diagonals) - total(v.neighbor(j) for j in (-1, 0, 1)) + r * near

    def wide_edge(self, e: sublimit.WideEdgeSite) -> sublimit.Stencil:
        return (9 * (e.tail + e.head) - self.beyond(e.tail_ring) - self.beyond(e.head_ring)) / 16

    def across(self, f: sublimit.WideFaceSite, i: int) -> sublimit.Stencil:
        """From the points of edges i and i + 2."""
        beyond = [f.edge_point_beyond(k) if f.has_across(k) else 2 * f.edge_point(k) - f.edge_point(k - 2) for k in (i, i + 2)]
        return (9 * (f.edge_point(i) + f.edge_point(i + 2)) - total(beyond)) / 16

    def wide_face(self, f: sublimit.WideFaceSite) -> sublimit.Stencil:
        rings = [f.ring(i) for i in range(4)]
        if all(v.is_closed and v.valence == 4 for v in rings):
            return total(81 * v.center - 9 * (v.neighbor(2) + v.neighbor(3)) + v.diagonal(2) for v in rings) / 256
        return (self.across(f, 0) + self.across(f, 1)) / 2

    def crease_vertex(self, v: sublimit.CreaseSite) -> sublimit.Stencil:
        return v.center

    def crease_edge(self, e: sublimit.CreaseEdgeSite) -> sublimit.Stencil:
        return (9 * (e.tail + e.head) - e.before - e.after) / 16


SAME = [(CatmullClark(), "catmull-clark"), (Loop(), "loop"), (DooSabin(), "doo-sabin"), (MidEdge(), "mid-edge"),
        (Sqrt3(), "sqrt3"), (Butterfly(), "butterfly"), (Averaging(), "averaging"), (Kobbelt(), "kobbelt")]
each_scheme = pytest.mark.parametrize("own, name", SAME, ids=[name for _, name in SAME])


def both(own: sublimit.Scheme, name: str) -> list[sublimit.Scheme | str]:
    return [own, name]


def open_mesh(triangles: bool) -> sublimit.Mesh:
    """A bent strip with vertices of valence 3 and 5 inside."""
    disc = [[np.cos(t), np.sin(t), 0.3 * np.cos(2 * t)] for t in np.arange(5) * 2 * np.pi / 5]
    outer = [[2 * x, 2 * y, z - 0.5] for x, y, z in disc]
    points = np.array([[0, 0, 1], *disc, *outer])
    if triangles:
        faces: list[list[int]] = [[0, 1 + i, 1 + (i + 1) % 5] for i in range(5)]
        for i in range(5):
            a, b, c, d = 1 + i, 6 + i, 6 + (i + 1) % 5, 1 + (i + 1) % 5
            faces += [[a, b, c], [a, c, d]]
    else:
        points = points[1:]
        faces = [[0, 1, 2, 3, 4]] + [[i, 5 + i, 5 + (i + 1) % 5, (i + 1) % 5] for i in range(5)]
    return sublimit.Mesh(points, faces, creases={(1, 2): 1.5} if triangles else {(0, 5): 1.5, (0, 1): 1.5})


def meshes(own: sublimit.Scheme, cube: sublimit.Mesh, icosahedron: sublimit.Mesh) -> list[sublimit.Mesh]:
    triangles = own.split in ("ptq", "sqrt3")
    closed = icosahedron if triangles else cube
    mesh = open_mesh(triangles)
    if own.sharpening != "semi-sharp":
        mesh = sublimit.Mesh(mesh.points, mesh.faces)
    return [closed, mesh]


@each_scheme
def test_ours_once_more(own: sublimit.Scheme, name: str, cube: sublimit.Mesh, icosahedron: sublimit.Mesh) -> None:
    for mesh in meshes(own, cube, icosahedron):
        fine, expected = (sublimit.refine(mesh, scheme, 3) for scheme in both(own, name))
        np.testing.assert_allclose(fine.points, expected.points, rtol=0, atol=rounding)
        assert all(np.array_equal(a, b) for a, b in zip(fine.faces, expected.faces))
        limits, other = (sublimit.limit(mesh, scheme, 1) for scheme in both(own, name))
        np.testing.assert_allclose(limits.points, other.points, rtol=0, atol=products)
        np.testing.assert_allclose(limits.normals, other.normals, rtol=0, atol=derivatives)
        table, table_of_ours = (sublimit.bake(mesh, scheme, 2, precision="double") for scheme in both(own, name))
        np.testing.assert_allclose(table.apply(mesh.points), table_of_ours.apply(mesh.points), rtol=0, atol=rounding)
        faces = np.arange(sublimit.LimitSurface(mesh, name).num_faces)
        a, b = (sublimit.LimitSurface(mesh, scheme).evaluate(faces, 0.3, 0.45, derivatives=1) for scheme in both(own, name))
        np.testing.assert_allclose(a.points, b.points, rtol=0, atol=products)
        np.testing.assert_allclose(a.du, b.du, rtol=0, atol=derivatives)
        assert np.array_equal(a.status, b.status)


@each_scheme
def test_verdicts_are_exact(own: sublimit.Scheme, name: str) -> None:
    ours, theirs = (sublimit.analyze(scheme, valences=[3, 4, 5]) for scheme in both(own, name))
    kept = [[(point["kind"], point["n"], point["spectrum"], [{**verdict, "witness": None} for verdict in point["verdicts"]])
             for point in report["schemes"][0]["neighborhoods"]] for report in (ours, theirs)]
    assert len(kept[0]) >= 3
    assert kept[0] == kept[1]  # pictures are in floats, and differ by roundings
    assert ours["schemes"][0]["regular"] == theirs["schemes"][0]["regular"]


def test_the_same_operations_give_the_same_bits(icosahedron: sublimit.Mesh) -> None:
    assert np.array_equal(sublimit.refine(icosahedron, Loop(), 4).points, sublimit.refine(icosahedron, "loop", 4).points)


def test_reports_know_names_sources_and_claims(program: Program, tmp_path: pathlib.Path) -> None:
    report = sublimit.analyze(CatmullClark(), valences=[3, 5])
    assert report["summary"][0]["scheme"] == "CatmullClark"
    verdicts = {claim["claim"]: claim["verdict"] for claim in report["schemes"][0]["claims"]}
    assert verdicts["regular"] == "proved" and verdicts["convex-hull"] == "proved"
    report.save_html(tmp_path / "report.html")
    assert "CatmullClark" in (tmp_path / "report.html").read_text()
    report.save_json(tmp_path / "report.json")
    program("verify", tmp_path / "report.json")


def test_tables_know_where_they_are_from(cube: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    table = sublimit.bake(cube, CatmullClark(), 2)
    table.save(tmp_path / "table.safetensors")
    assert sublimit.load(tmp_path / "table.safetensors").info["scheme"] == "CatmullClark"


class Counted(CatmullClark):
    def __init__(self) -> None:
        self.calls: dict[tuple[str, int], int] = {}

    def vertex(self, v: sublimit.Ring) -> sublimit.Stencil:
        self.calls["vertex", v.valence] = self.calls.get(("vertex", v.valence), 0) + 1
        return super().vertex(v)


def test_masks_are_called_once_for_each_type(cube: sublimit.Mesh) -> None:
    own = Counted()
    for _ in range(3):
        sublimit.refine(cube, own, 4)
        sublimit.bake(cube, own, 3)
        sublimit.limit(cube, own)
    assert own.calls == {("vertex", 3): 1, ("vertex", 4): 1}


def test_masks_are_called_again_when_attributes_change(icosahedron: sublimit.Mesh) -> None:
    own = Butterfly()
    first = sublimit.refine(icosahedron, own).points
    own.tension = Fraction(1, 2)
    half = sublimit.refine(icosahedron, own).points
    assert not np.array_equal(first, half)
    np.testing.assert_allclose(half, sublimit.refine(icosahedron, sublimit.scheme("butterfly", tension="1/2")).points, rtol=0,
                               atol=rounding)


def test_threads_share_a_scheme(cube: sublimit.Mesh) -> None:
    own, expected, found = CatmullClark(), sublimit.refine(cube, "catmull-clark", 5).points, []
    threads = [threading.Thread(target=lambda: found.append(sublimit.refine(cube, own, 5).points)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8
    for points in found:
        np.testing.assert_allclose(points, expected, rtol=0, atol=rounding)


def test_pickles(icosahedron: sublimit.Mesh) -> None:
    own = Butterfly(Fraction(1, 2))
    expected = sublimit.refine(icosahedron, own).points
    again = pickle.loads(pickle.dumps(own))
    assert again.tension == Fraction(1, 2) and np.array_equal(sublimit.refine(icosahedron, again).points, expected)


def test_surfaces_outlive_their_scheme(cube: sublimit.Mesh) -> None:
    surface = sublimit.LimitSurface(cube, CatmullClark())  # nothing else keeps the scheme
    expected = sublimit.LimitSurface(cube, "catmull-clark").evaluate(range(6), 0.5, 0.5)
    np.testing.assert_allclose(surface.evaluate(range(6), 0.5, 0.5).points, expected.points, rtol=0, atol=products)


def with_edge(mask: Callable[[Any], Any], **attributes: object) -> sublimit.Scheme:
    class Own(CatmullClark):
        def edge(self, e: sublimit.EdgeSite) -> Any:
            return mask(e)

    own = Own()
    for name, value in attributes.items():
        setattr(own, name, value)
    return own


kept: list[Any] = []


def kept_first(site: Any) -> Any:
    kept.append(site)
    return kept[0]


MISTAKES: list[tuple[Callable[[Any], Any], type[Exception], str]] = [
    (lambda e: (e.tail + e.head) / 3, sublimit.InvalidParameter, r"Own.edge: the weights add up to (0\.66|2/3).*sum of 1"),
    (lambda e: 0 * e.tail, sublimit.InvalidParameter, "add up to 0"),
    (lambda e: 3, TypeError, "Own.edge returns a int; a mask returns a stencil"),
    (lambda e: None, TypeError, "returns a NoneType"),
    (lambda e: e.tail + 1, TypeError, "unsupported operand"),
    (lambda e: 1 + e.tail, TypeError, "unsupported operand"),
    (lambda e: e.tail * e.head, TypeError, "unsupported operand"),
    (lambda e: e.tail / 0, ZeroDivisionError, "division by zero"),
    (lambda e: e.tail * (1 / (e.cos_2pi(1, 3) - e.cos_2pi(2, 3))), ZeroDivisionError, "division by zero"),
    (lambda e: e.middle, AttributeError, "middle"),
    (lambda e: 1 / 0, ZeroDivisionError, "division by zero"),
    (lambda e: e.ratio(1, 0) * e.tail, sublimit.InvalidParameter, "q that is not 0"),
    (lambda e: e.left_face.corner(1) * e.cos_2pi(1, 0), sublimit.InvalidParameter, "n of at least 1"),
    (lambda e: e.left_face.corner(4), sublimit.InvalidParameter, "corner 4 of a face of [34]; 0 to [23] exist"),
    (lambda e: e.left_face.corner(-5), sublimit.InvalidParameter, "corner -5 of a face"),
    (lambda e: (kept_first(e).tail + e.head) / 2, sublimit.InvalidParameter, "kept from another call"),
]


@pytest.mark.parametrize("mask, error, words", MISTAKES)
def test_mistakes_in_masks(mask: Callable[[Any], Any], error: type[Exception], words: str) -> None:
    kept.clear()
    prism = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
                          [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]])  # edges of three types
    with pytest.raises(error, match=words):
        sublimit.refine(prism, with_edge(mask), 2)
    with pytest.raises(error, match=words):
        sublimit.LimitSurface(prism, with_edge(mask)).evaluate(range(9), 0.5, 0.5)
    with pytest.raises(error, match=words):
        sublimit.analyze(with_edge(mask), valences=[3, 5])


def test_weights_that_are_no_numbers(cube: sublimit.Mesh) -> None:
    with pytest.raises(sublimit.InvalidParameter, match="add up to nan"):
        sublimit.refine(cube, with_edge(lambda e: e.tail * float("nan")))


@pytest.mark.parametrize("mask", [lambda e: 0.5 * (e.tail + e.head), lambda e: (e.tail + e.head) * np.float64(0.5)])
def test_floats_are_for_meshes_alone(mask: Callable[[Any], Any], cube: sublimit.Mesh) -> None:
    own = with_edge(mask)
    assert len(sublimit.refine(cube, own).points) == 26
    with pytest.raises(TypeError, match="the weight .*0.5.* is a float, and reports need exact ones"):
        sublimit.analyze(own, valences=[3])


@pytest.mark.parametrize("attributes, error, words", [
    (dict(split="pqr"), sublimit.InvalidOption, "split 'pqr' is none of pqq"),
    (dict(sharpening="very"), sublimit.InvalidOption, "sharpening 'very' is none of boundary, sharp, semi-sharp"),
    (dict(period=0), sublimit.InvalidParameter, "period is 0"),
    (dict(corners=2), sublimit.InvalidParameter, "corners is 2"),
    (dict(preparation=(Bilinear(),)), sublimit.InvalidParameter, "faces of how many corners"),
    (dict(name="loop"), sublimit.InvalidOption, "'loop' is one of sublimit's schemes"),
    (dict(split="dqq"), sublimit.InvalidParameter, "lacks the mask corner, which its split dqq needs"),
    (dict(claims={"smooth": 3}), sublimit.InvalidOption, "no such claim"),
])
def test_mistakes_in_attributes(attributes: dict[str, object], error: type[Exception], words: str, cube: sublimit.Mesh) -> None:
    with pytest.raises(error, match=words):
        sublimit.refine(cube, with_edge(lambda e: (e.tail + e.head) / 2, **attributes))


def test_what_is_not_for_own_schemes(cube: sublimit.Mesh) -> None:
    with pytest.raises(sublimit.InvalidOption, match="tension"):
        sublimit.refine(cube, CatmullClark(), option={"tension": 1})
    with pytest.raises(TypeError, match="CatmullClark refines meshes"):
        sublimit.LimitCurve([[0, 0], [1, 0], [1, 1]], CatmullClark(), closed=True)
    with pytest.raises(TypeError, match=r"an instance, CatmullClark\(\), is right"):
        sublimit.refine(cube, CatmullClark)  # type: ignore[arg-type]
    with pytest.raises(sublimit.InvalidParameter, match="lacks the mask vertex"):
        sublimit.refine(cube, sublimit.Scheme())
    with pytest.raises(sublimit.UnsupportedTopology, match="triangles"):
        sublimit.refine(cube, Loop())
