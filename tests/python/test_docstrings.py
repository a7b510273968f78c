# SPDX-License-Identifier: Apache-2.0
"""What docstrings say happens, and everything public has one."""
from __future__ import annotations

import doctest
import inspect
import pathlib
import re
from collections.abc import Callable

import pytest
from conftest import shared_mesh

import sublimit

README = pathlib.Path(sublimit.__file__).resolve().parent.parent / "README.md"  # of the sources, which the links lead to
PUBLIC = [name for name in sublimit.__all__ if not name.startswith("__")]


@pytest.mark.parametrize("name", ["sublimit", *PUBLIC])
def test_examples(name: str) -> None:
    thing = sublimit if name == "sublimit" else getattr(sublimit, name)
    if name == "sublimit":
        examples = doctest.DocTestParser().get_doctest(sublimit.__doc__ or "", {}, name, None, 0)
        tests = [examples]
    else:
        tests = doctest.DocTestFinder().find(thing, name, module=False)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    said: list[str] = []
    for test in tests:
        runner.run(test, out=said.append, clear_globs=False)
    assert not runner.summarize(verbose=False).failed, "".join(said)


@pytest.mark.parametrize("name", PUBLIC)
def test_everything_public_is_described(name: str) -> None:
    thing = getattr(sublimit, name)
    assert inspect.getdoc(thing), name
    if inspect.isclass(thing):
        assert thing.__module__ == "sublimit"
        for member, value in vars(thing).items():
            if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                assert inspect.getdoc(value), f"{name}.{member}"


def test_the_readme_names_what_there_is() -> None:
    names = set(re.findall(r"`(?:sublimit\.)?([a-z_]+)\(", README.read_text()))
    assert names and all(hasattr(sublimit, name) for name in names - {"write"}), names


@pytest.mark.parametrize("cage", ["tagged", "large and far away", "catmark_car"])
def test_the_example_of_the_readme_runs(cage: str, tagged: sublimit.Mesh, tmp_path: pathlib.Path,
                                        monkeypatch: pytest.MonkeyPatch) -> None:
    (example,) = re.findall(r"```python\n(.*?)```", README.read_text(), flags=re.S)
    mesh = tagged
    if cage == "large and far away":
        mesh = sublimit.Mesh(1000 * tagged.points + [3e4, -7e3, 1e5], tagged.faces, creases=tagged.creases)
    if cage == "catmark_car":
        mesh = sublimit.read(shared_mesh(cage))
    mesh.write(tmp_path / "cage.obj")
    monkeypatch.chdir(tmp_path)
    exec(compile(example, "README.md", "exec"), {})


def test_the_version_is_the_programs(program: Callable[..., str]) -> None:
    assert sublimit.version() == sublimit.__version__ == program("--version").split()[1]


def test_lists_its_names() -> None:
    assert set(PUBLIC) <= set(dir(sublimit))
    with pytest.raises(AttributeError, match="no attribute 'refne'"):
        sublimit.refne
