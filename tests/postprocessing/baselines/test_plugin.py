"""The pytest plugin, by tests in processes of their own: the example of the page, failures, workers."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.postprocessing.pytest_plugin import OPTION
from tests.pages import ROOT, listings
from tests.processes import environment

PLUGIN = "support_exudyn.postprocessing.pytest_plugin"
PAGE = ROOT / "support_exudyn" / "postprocessing" / "comparing" / "baselines.md"
NAME = "test_rocker.test_nothing_has_changed"


def tried(folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """All tests of a folder, with warnings as errors and unknown marks refused."""
    words = ["-m", "pytest", "-q", "-p", PLUGIN, "-W", "error", "--strict-markers", "--tb=short"]
    own = environment() | {"PYTEST_ADDOPTS": "", "PYTEST_DEBUG_TEMPROOT": str(folder)}
    return subprocess.run(
        [sys.executable, *words, *options], cwd=folder, env=own, capture_output=True, text=True, timeout=300,
        check=False,
    )  # fmt: skip


def test_the_plugin_imports_nothing_of_the_package_before_it_is_used() -> None:
    code = f"import sys, {PLUGIN}; print({{'numpy', 'numba', 'pydantic'}} & {{*sys.modules}})"
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment(), capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "set()"


def test_the_example_of_the_page(tmp_path: Path) -> None:
    (example,) = (one for one in listings(PAGE) if one.kind == "python")
    (tmp_path / "test_rocker.py").write_text(example.text, "utf-8")
    written = tried(tmp_path, OPTION, "test_rocker.*")
    assert written.returncode == 0, written.stdout + written.stderr
    assert "3 passed" in written.stdout
    assert f"{NAME}.json: written" in written.stdout
    assert len(list(tmp_path.glob(".pytest_cache/**/*.h5"))) == 2
    kept = json.loads((tmp_path / "baseline" / f"{NAME}.json").read_text("utf-8"))
    assert kept["numbers"]


@pytest.mark.slow  # a process for each
def test_failures_tell_the_worst_number_and_its_time(tmp_path: Path) -> None:
    (example,) = (one for one in listings(PAGE) if one.kind == "python")
    file = tmp_path / "test_rocker.py"
    file.write_text(example.text, "utf-8")
    first = tried(tmp_path)
    assert "1 failed, 2 passed" in first.stdout
    assert "there is no such baseline" in first.stdout
    assert f"to write it: pytest {OPTION} {NAME}" in first.stdout
    assert tried(tmp_path, OPTION, NAME).returncode == 0
    assert tried(tmp_path).returncode == 0
    file.write_text(example.text.replace('"clearance_mm": 0.5', '"clearance_mm": 0.51'), "utf-8")
    found = tried(tmp_path)
    assert "2 failed, 1 passed" in found.stdout
    assert re.search(r"changed number .*, where the reference is ", found.stdout)
    assert "differs by" in found.stdout
    shared = tried(tmp_path, "-n", "2", OPTION, "test_rocker.*")
    assert f"{NAME}.json: written" in shared.stdout  # workers tell it, too
    assert tried(tmp_path, "-m", "not simulation").returncode == 5  # none is left
    without = tried(tmp_path, "-p", "no:cacheprovider", "-n", "2", "-m", "baseline")
    assert "1 passed" in without.stdout
    stale = tried(tmp_path, OPTION, "no_such")
    assert "nothing was written: no test has a new or changed baseline no_such" in stale.stdout
