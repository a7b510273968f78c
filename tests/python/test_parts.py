# SPDX-License-Identifier: Apache-2.0
"""Control meshes of fields and files of CAD programs: the program's bytes, and its words where their parts are missing."""
from __future__ import annotations

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import sublimit

Program = Callable[..., str]
SPHERE: dict[str, Any] = {"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1}


def need(part: str, library: str) -> None:
    if not (pathlib.Path(os.environ["SUBLIMIT_PROGRAM"]).parent / f"libsublimit_{part}.so").exists():
        missing = f"NO {library}: its part is not built"
        if os.environ.get("CI"):  # .ci/install-deps --all has installed it there
            pytest.fail(missing)
        pytest.skip(missing)


@pytest.fixture
def openvdb() -> None:
    need("openvdb", "OPENVDB")


@pytest.fixture
def opencascade() -> None:
    need("opencascade", "OPENCASCADE")


@pytest.mark.usefixtures("openvdb")
def test_control_meshes_of_fields_are_the_programs(program: Program, tmp_path: pathlib.Path) -> None:
    (tmp_path / "sphere.json").write_text(json.dumps(SPHERE))
    for scheme, options in (("catmull-clark", dict(tolerance=1e-2)), ("loop", dict(cells=8, tolerance=5e-2))):
        words = [word for name, value in options.items() for word in (f"--{name}", value)]
        program("implicit", tmp_path / "sphere.json", "-s", scheme, *words, "-o", tmp_path / "program.obj", "--report",
                tmp_path / "report.json", "--quiet")
        report = json.loads((tmp_path / "report.json").read_text())
        for field in (tmp_path / "sphere.json", json.dumps(SPHERE), SPHERE):
            made = sublimit.implicit(field, scheme, **options)  # type: ignore[arg-type]
            made.mesh.write(tmp_path / "ours.obj")
            assert (tmp_path / "ours.obj").read_bytes() == (tmp_path / "program.obj").read_bytes()
            assert made.met and made.tolerance == report["tolerance"] and made.notes == report["notes"]
            assert made.largest_distance == report["result"]["largest_distance"] <= made.tolerance
            assert made.mean_distance == report["result"]["mean_distance"]
    limit = sublimit.limit(made.mesh, "loop")
    assert abs(np.linalg.norm(limit.points, axis=1) - 1).max() <= 5e-2


@pytest.mark.usefixtures("openvdb")
def test_fields_with_options_of_schemes() -> None:
    tight = sublimit.implicit(SPHERE, sublimit.scheme("kobbelt", tension=0.5), cells=5, tolerance=0.2)
    assert len(tight.mesh.points) > 8
    by_option = sublimit.implicit(SPHERE, "kobbelt", option={"tension": 0.5}, cells=5, tolerance=0.2)
    assert np.array_equal(by_option.mesh.points, tight.mesh.points)


@pytest.mark.parametrize("arguments, error, words", [
    (dict(field={"kind": "implicit", "field": "spheer"}), sublimit.FormatError, "spheer"),
    (dict(field={"kind": "implicit", "field": "sphere", "center": [0, 0, 0]}), sublimit.FormatError, "radius"),
    (dict(field={**SPHERE, "radius": np.nan}), ValueError, "field has a number that is not finite"),
    (dict(field="nothing.json"), sublimit.IoError, "nothing.json"),
    (dict(field=7), TypeError, "field is a int; a path, JSON or a dict is right"),
    (dict(scheme="lop"), sublimit.InvalidOption, "unknown scheme 'lop'"),
    (dict(scheme="chaikin"), sublimit.InvalidOption, "refines curves"),
    (dict(option={"tension": 1}), sublimit.InvalidOption, "tension"),
    (dict(cells=3), sublimit.InvalidParameter, "cells is 3; it should be 4 or more"),
    (dict(cells=-1), sublimit.InvalidParameter, "cells is -1"),
    (dict(cells=5.5), TypeError, "integer"),
    (dict(tolerance=-1), sublimit.InvalidParameter, "tolerance is -1"),
    (dict(tolerance=float("nan")), sublimit.InvalidParameter, "tolerance is nan"),
    (dict(tolerance=float("inf")), sublimit.InvalidParameter, "tolerance is inf"),
    (dict(tolerance="a"), ValueError, "could not convert")])
def test_refuses_fields(arguments: dict[str, Any], error: type[Exception], words: str) -> None:
    """Also where OpenVDB is not: it is loaded after these are looked at."""
    given: dict[str, Any] = {"field": SPHERE, **arguments}
    with pytest.raises(error, match=words):
        sublimit.implicit(**given)


@pytest.mark.usefixtures("opencascade")
def test_cad_files_are_the_programs(cube: sublimit.Mesh, program: Program, tmp_path: pathlib.Path) -> None:
    cube.write(tmp_path / "cube.obj")
    surface = sublimit.LimitSurface(cube, "catmull-clark")
    requests: list[tuple[list[str], dict[str, Any]]] = [
        ([], {}), (["--tolerance", "0.01", "--no-packing"], dict(tolerance=0.01, pack=False)),
        (["--join", "g1"], dict(join="g1"))]
    for words, options in requests:
        program("step", tmp_path / "cube.obj", "-s", "catmull-clark", *words, "-o", tmp_path / "program.brep", "--report",
                tmp_path / "report.json", "--quiet")
        report = json.loads((tmp_path / "report.json").read_text())
        written = sublimit.step(surface, tmp_path / "ours.brep", **options)
        assert (tmp_path / "ours.brep").read_bytes() == (tmp_path / "program.brep").read_bytes()
        for name in ("solids", "shells", "faces", "caps", "deviation"):
            assert getattr(written, name) == report[name], name
        assert (written.solids, written.shells) == (1, 0)
        assert written.met is report["tolerance_met"] is True and written.is_valid is report["valid"] is True
    assert sublimit.step(surface, str(tmp_path / "cube.step")).solids == 1
    assert (tmp_path / "cube.step").read_text().startswith("ISO-10303-21")
    for unit, written_as in (("mm", "SI_UNIT(.MILLI.,.METRE.)"), ("m", "SI_UNIT($,.METRE.)"), ("inch", "'INCH'")):
        sublimit.step(surface, tmp_path / "cube.step", unit=unit)
        text = (tmp_path / "cube.step").read_text()
        assert re.search(r"SI_UNIT\([^)]*METRE\.\)|'INCH'", text)[0] == written_as  # type: ignore[index]


@pytest.mark.usefixtures("opencascade")
def test_faces_have_the_names_of_their_groups(program: Program, tmp_path: pathlib.Path) -> None:
    x, y = np.meshgrid(np.arange(5), np.arange(5))
    faces = [[5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5] for j in range(4) for i in range(4)]
    lines = [f"v {i} {j} 0" for i, j in zip(x.ravel(), y.ravel())] + ["g left"]
    for k, face in enumerate(faces):
        lines += (["g right"] if k == 8 else []) + ["f " + " ".join(str(v + 1) for v in face)]
    (tmp_path / "sheet.obj").write_text("\n".join(lines) + "\n")
    mesh = sublimit.read(tmp_path / "sheet.obj")
    assert mesh.face_names == ["left"] * 8 + ["right"] * 8
    surface = sublimit.LimitSurface(mesh, "catmull-clark")
    plain, named = (sublimit.step(surface, tmp_path / f"{name}.step", face_names=names)
                    for name, names in (("plain", None), ("named", mesh.face_names)))
    assert plain.faces == 1 and named.faces == 2 and (named.solids, named.shells) == (0, 1)
    assert all(f"'{name}'" in (tmp_path / "named.step").read_text() for name in ("left", "right"))
    program("step", tmp_path / "sheet.obj", "-s", "catmull-clark", "-o", tmp_path / "program.brep", "--quiet")
    sublimit.step(surface, tmp_path / "ours.brep", face_names=mesh.face_names)
    assert (tmp_path / "ours.brep").read_bytes() == (tmp_path / "program.brep").read_bytes()
    with pytest.raises(sublimit.InvalidParameter, match="names"):
        sublimit.step(surface, tmp_path / "ours.brep", face_names=["left"])


@pytest.mark.usefixtures("opencascade")
def test_patches_as_cad_files(tmp_path: pathlib.Path) -> None:
    net = [[u, v, u * v] for v in range(4) for u in range(4)]
    patches = sublimit.construct({"kind": "bezier_surface", "degree": [3, 3], "points": net}).surfaces()
    written = sublimit.step(patches, tmp_path / "patch.brep", tolerance=1e-6)
    assert (written.faces, written.shells, written.solids) == (1, 1, 0) and written.is_valid


@pytest.mark.parametrize("arguments, error, words", [
    (dict(path="cube.stl"), sublimit.InvalidOption, r"CAD files are \.step, \.stp or \.brep, not '\.stl'"),
    (dict(path=3), TypeError, "str, bytes or os.PathLike"),
    (dict(tolerance=0), sublimit.InvalidParameter, "tolerance is 0; it should be a length"),
    (dict(tolerance=-1), sublimit.InvalidParameter, "tolerance is -1"),
    (dict(tolerance=float("nan")), sublimit.InvalidParameter, "tolerance is nan"),
    (dict(tolerance="a"), ValueError, "could not convert"),
    (dict(surface=None), TypeError, "surface is a NoneType; a sublimit.LimitSurface or sublimit.Patches is right"),
    (dict(unit="foot"), sublimit.InvalidOption, "unit is 'foot'; 'mm', 'm' or 'inch' are right"),
    (dict(path="cube.brep", unit="m"), sublimit.InvalidOption, "only STEP files have a unit of length"),
    (dict(face_names="left"), TypeError, "face_names is one word"),
    (dict(face_names=[1] * 6), TypeError, r"face_names\[0\] is a int")])
def test_refuses_cad_files(arguments: dict[str, Any], error: type[Exception], words: str, cube: sublimit.Mesh,
                           tmp_path: pathlib.Path) -> None:
    """Also where OpenCASCADE is not: it is loaded after these are looked at."""
    given: dict[str, Any] = {"surface": sublimit.LimitSurface(cube, "catmull-clark"), "path": tmp_path / "cube.step", **arguments}
    with pytest.raises(error, match=words):
        sublimit.step(**given)
    assert not list(tmp_path.iterdir())


@pytest.mark.usefixtures("opencascade")
def test_refuses_surfaces_without_polynomials(cube: sublimit.Mesh, icosahedron: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    with pytest.raises(sublimit.UnsupportedTopology, match="butterfly: no piece of this scheme's limits is a polynomial"):
        sublimit.step(sublimit.LimitSurface(icosahedron, "butterfly"), tmp_path / "out.step")
    with pytest.raises(sublimit.InvalidMesh, match="extent|faces"):
        sublimit.step(sublimit.LimitSurface(sublimit.Mesh([], []), "catmull-clark"), tmp_path / "out.step")
    with pytest.raises(sublimit.IoError):
        sublimit.step(sublimit.LimitSurface(cube, "catmull-clark"), tmp_path / "nowhere" / "out.step")
    assert not list(tmp_path.iterdir())


def test_missing_parts_are_named_in_the_programs_words(cube: sublimit.Mesh, tmp_path: pathlib.Path) -> None:
    """The module and the program alone, as they are built where OpenVDB and OpenCASCADE are not."""
    alone = tmp_path / "alone"
    alone.mkdir()
    shutil.copytree(pathlib.Path(sublimit.__file__).parent, alone / "sublimit", ignore=shutil.ignore_patterns("libsublimit_*"))
    shutil.copy(os.environ["SUBLIMIT_PROGRAM"], alone / "program")
    cube.write(alone / "cube.obj")
    (alone / "sphere.json").write_text(json.dumps(SPHERE))
    code = ("import sublimit\n"
            "surface = sublimit.LimitSurface(sublimit.read('cube.obj'), 'catmull-clark')\n"
            "for call in (lambda: sublimit.implicit('sphere.json'), lambda: sublimit.step(surface, 'cube.step')):\n"
            "    try: call()\n"
            "    except sublimit.InvalidOption as error: print(error)\n")
    environment = {**os.environ, "PYTHONPATH": str(alone)}
    done = subprocess.run([sys.executable, "-c", code], cwd=alone, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    said = done.stdout.splitlines()
    assert len(said) == 2 and "libsublimit_openvdb.so" in said[0] and "libsublimit_opencascade.so" in said[1]
    for words, message in zip((["implicit", "sphere.json", "-o", "cage.obj"],
                               ["step", "cube.obj", "-s", "catmull-clark", "-o", "cube.step"]), said):
        told = subprocess.run([alone / "program", *words], cwd=alone, capture_output=True, text=True)
        assert told.returncode == 2 and message in told.stderr
    assert not (alone / "cube.step").exists()
