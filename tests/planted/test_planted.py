"""Faults that are planted in the code, one at a time, in a copy of it: each is caught by its test.

`python -m pytest -m slow tests/planted --hypothesis-profile=long` plants them all; without that profile it is
only looked whether the table still fits the code.
"""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.processes import ROOT

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PACKAGES = ("support_exudyn", "user_forces", "studies", "tests")
PATIENCE = 120.0  # [s] for one test
RUN = ["-m", "pytest", "-n", "0", "-q", "-x", "-p", "no:cacheprovider", "-m", ""]  # slow tests, too
FAILED = 1  # pytest's code for tests that ran and failed; others are of collections, interruptions and options


class Fault(NamedTuple):
    """A text of a file, what it becomes, and the test that is to fail then."""

    area: str
    file: str
    old: str
    new: str
    caught_by: str


FAULTS = [
    Fault(**one) for one in tomllib.loads((Path(__file__).parent / "faults.toml").read_text("utf-8"))["fault"]
]


def test_the_table_fits_the_code() -> None:
    areas = Counter(fault.area for fault in FAULTS)
    assert set(areas) == {
        *("events", "time grid", "result_checks", "inverse_mass", "bushing", "stability", "guides", "springs"),
        *("compiled", "instruments", "adams", "baselines", "strength", "legs", "own models"),
    }
    assert areas.total() >= 30
    assert len({fault[1:4] for fault in FAULTS}) == len(FAULTS)
    for fault in FAULTS:
        text = (ROOT / fault.file).read_text("utf-8")
        assert text.count(fault.old) == 1, fault
        # a fault is one in what the code does, not in how it is written
        assert ast.dump(ast.parse(text)) != ast.dump(ast.parse(text.replace(fault.old, fault.new))), fault
        file, _, test = fault.caught_by.partition("::")
        assert re.search(rf"^def {test.partition('[')[0]}\(", (ROOT / file).read_text("utf-8"), re.M), fault


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The packages, without what was compiled of them."""
    folder = tmp_path_factory.mktemp("planted")
    for package in PACKAGES:
        shutil.copytree(ROOT / package, folder / package, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    return folder


def tried(folder: Path, compiled: Path, *tests: str) -> subprocess.CompletedProcess[str]:
    """The tests of a copy, run. compiled: where it keeps what is compiled of it."""
    # examples are the same every time
    own = {
        "PYTHONPATH": str(folder),
        "PYTHONDONTWRITEBYTECODE": "1",
        "NUMBA_CACHE_DIR": str(compiled),
        "CI": "true",
    }
    return subprocess.run(
        [sys.executable, *RUN, *tests],
        cwd=folder,
        env=dict(os.environ) | own,
        capture_output=True,
        text=True,
        timeout=PATIENCE * len(tests),
        check=False,
    )


@pytest.mark.slow
def test_without_a_fault_all_pass(copy: Path, tmp_path: Path) -> None:
    found = tried(copy, tmp_path, *sorted({fault.caught_by for fault in FAULTS}))
    assert found.returncode == 0, found.stdout[-2000:] + found.stderr[-2000:]


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: f"{fault.area}-{FAULTS.index(fault)}")
def test_a_planted_fault_is_caught(fault: Fault, copy: Path, tmp_path: Path) -> None:
    file = copy / fault.file
    text = file.read_text("utf-8")
    file.write_text(text.replace(fault.old, fault.new), "utf-8")
    try:
        found = tried(copy, tmp_path, fault.caught_by)  # nothing compiled is kept from one fault to the next
    finally:
        file.write_text(text, "utf-8")
    assert found.returncode == FAILED, found.stdout[-2000:] + found.stderr[-2000:]
