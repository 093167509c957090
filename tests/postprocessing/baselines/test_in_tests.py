"""Baselines of tests: nothing is written but what is named, and failures say what has changed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import InputError
from support_exudyn.postprocessing.comparing.in_tests import SessionBaselines
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from support_exudyn.simulation.estimate import Estimate
from tests.postprocessing.baselines.scenes import rocker

FORCE = Estimate(100.0, 0.1, "N")
LARGER = Estimate(100.3, 0.1, "N")


def compared(item: object, folder: Path, *updated: str, name: str = "test_it.test_force") -> tuple[str, bool]:
    """In a session of its own."""
    return SessionBaselines(updated).compare(item, folder / "test_it.py", name)  # type: ignore[arg-type]


def test_only_what_is_named_is_written(tmp_path: Path) -> None:
    path = tmp_path / "baseline" / "test_it.test_force.json"
    assert compared(FORCE, tmp_path)[1] is False
    assert compared(FORCE, tmp_path, "another.*")[1] is False
    assert not path.exists()
    assert compared(FORCE, tmp_path, "test_it.*")[1] is True
    first = path.read_bytes()
    assert compared(FORCE, tmp_path) == ("", False)
    assert compared(Estimate(100.15, 0.1, "N"), tmp_path, "*") == ("", False)  # within both errors
    assert path.read_bytes() == first
    said, written = compared(LARGER, tmp_path)
    assert (path.read_bytes(), written) == (first, False)
    assert "100.3 N, where the reference is 100, differs by" in said
    assert compared(LARGER, tmp_path, "test_it.test_force")[1]
    assert compared(LARGER, tmp_path) == ("", False)


def test_a_name_is_used_once_and_only_numbers_with_errors_are_kept(tmp_path: Path) -> None:
    session = SessionBaselines(["*"])
    session.compare({"a": FORCE, "b": LARGER}, tmp_path / "test_it.py", "one[x/y]")
    assert (tmp_path / "baseline" / "one_x_y.json").exists()
    with pytest.raises(InputError, match="is compared already; allowed: a name of its own"):
        session.compare(FORCE, tmp_path / "test_it.py", "one[x/y]")
    for item in (1.0, {"a": 1.0}, None, "text"):
        with pytest.raises(InputError, match="cannot be a baseline; allowed:"):
            compared(item, tmp_path, name="other")


def test_a_run_without_errors_is_no_baseline(simulate_cached: SimulateCached, tmp_path: Path) -> None:
    plain = simulate_cached(replace(rocker(0.002), accuracy=None))
    with pytest.raises(InputError, match=r"has no numerical errors, .*; allowed: a run with an accuracy"):
        compared(plain, tmp_path)
    with pytest.raises(InputError, match=r"3: cannot be run; allowed: a Scenario"):
        simulate_cached(3)  # type: ignore[arg-type]
