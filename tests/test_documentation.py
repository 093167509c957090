"""The documentation: every public name has an example that runs, and the site is whole."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from support_exudyn import CubicStep, Result, Scenario, reference_support, simulate
from support_exudyn.documentation.reference import examples, key_of, public_names
from support_exudyn.documentation.site import NEEDED, ROOT, rooms
from support_exudyn.files.starters import starter

NAMES = {key_of(name): thing for name, thing in public_names().items()}


@pytest.fixture(scope="module")
def run() -> Result:
    """A run of a moment, with errors."""
    scenario = Scenario(
        machine=reference_support(), drive=CubicStep(stroke=0.001, start=0.0, end=0.02), duration=0.02
    )
    return simulate(scenario, accuracy="draft")


def test_every_public_name_has_an_example() -> None:
    assert examples().keys() == NAMES.keys()


def slow_where_processes_start(name: str) -> Any:
    return pytest.param(
        name, marks=[pytest.mark.slow] if name in ("sweep", "SweepOutcome", "read_table") else []
    )


@pytest.mark.parametrize("name", list(map(slow_where_processes_start, NAMES)))
def test_the_example_of_a_name_runs(
    name: str, run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = examples()[name]
    monkeypatch.chdir(tmp_path)
    there: dict[str, Any] = {"Path": Path, "replace": replace, "starter": starter}
    there[name.rpartition(".")[2]] = NAMES[name]
    exec(compile(text, name, "exec"), {**NAMES, **there, "scenario": run.scenario, "result": run})


def test_rooms_are_all_told() -> None:
    assert len(rooms()) >= 16
    assert [name for name in rooms() if not (ROOT / name).is_file()] == []


@pytest.mark.slow  # the gallery runs all examples
@pytest.mark.skipif(any(find_spec(name) is None for name in NEEDED), reason="the extra [docs] is not installed")
def test_the_site_is_built_without_the_internet(tmp_path: Path) -> None:
    # a proxy that nobody answers at: what is asked of the internet fails
    nowhere = dict.fromkeys(("http_proxy", "https_proxy", "HTTP_PROXY", "HTTPS_PROXY"), "http://127.0.0.1:9")
    done = subprocess.run(
        [sys.executable, "-m", "support_exudyn", "docs", "--out", str(tmp_path / "site")],
        cwd=tmp_path, env={**os.environ, **nowhere}, capture_output=True, text=True, timeout=900, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "ClearancePin" in (tmp_path / "site" / "reference" / "names_model.html").read_text(encoding="utf-8")
    assert (tmp_path / "site" / "reference" / "index.html").is_file()
    assert "IPKernelApp" not in done.stderr
    keys = (tmp_path / "site" / "reference" / "scenario_keys.html").read_text(encoding="utf-8")
    assert "site.css" in keys  # by which keys are not broken mid-word
    assert (tmp_path / "site" / "search" / "search_index.json").is_file()
