# SPDX-License-Identifier: Apache-2.0
"""The examples run, and what they assert holds."""
from __future__ import annotations

import pathlib
import subprocess
import sys

import pytest

import sublimit

FOLDER = pathlib.Path(sublimit.__file__).resolve().parent.parent / "examples"
EXAMPLES = sorted(FOLDER.glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=[path.stem for path in EXAMPLES])
def test_runs(example: pathlib.Path, tmp_path: pathlib.Path) -> None:
    done = subprocess.run([sys.executable, str(example)], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout and done.stderr == ""


def test_there_are_some() -> None:
    assert len(EXAMPLES) >= 4
