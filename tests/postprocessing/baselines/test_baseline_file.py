"""The file of a baseline: what is read is what was written, and a damaged file is refused in a sentence."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from support_exudyn import InputError
from support_exudyn.postprocessing.comparing.baselines import (
    KeptRun,
    changes,
    read_baseline,
    write_baseline,
)
from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn
from support_exudyn.simulation.estimate import Estimate

TIMES, ERRORS = np.array([0.0, 0.1, 0.2]), np.array([1e-9, 1e-9, math.inf])
WHOLE = KeptRun(
    numbers={"pin.B.force.mean": Estimate(1.0 / 3.0, 1e-9, "N"), "unknown": Estimate(math.nan, math.inf, "m")},
    provenance={"python": "3.11"},
    scenario={"gravity": [0.0, -9.81], "pins": {"B": {"of": "Clearance"}}},
    curves={"tip.x": ComparedColumn("m", TIMES, np.array([1.0, math.nan, 2.0]), ERRORS)},
    horizon=0.15,
)
UNCHECKED = [HealthCheck.function_scoped_fixture]


def test_what_is_read_is_what_was_written(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "one.json"
    write_baseline(WHOLE, path)
    found = read_baseline(path)
    assert changes(WHOLE, found) == changes(found, WHOLE) == []
    for name in ("horizon", "scenario", "provenance"):
        assert getattr(found, name) == getattr(WHOLE, name)
    first = path.read_bytes()
    write_baseline(found, path)
    assert path.read_bytes() == first
    assert json.loads(first)["horizon_s"] == 0.15


@given(value=st.floats(width=64), error=st.floats(0.0, 1e300) | st.just(math.inf), name=st.text(max_size=8))
@settings(suppress_health_check=UNCHECKED)
def test_any_number_is_kept(value: float, error: float, name: str, tmp_path: Path) -> None:
    write_baseline(KeptRun({name: Estimate(value, error, name)}, {}), tmp_path / "one.json")
    kept = read_baseline(tmp_path / "one.json").numbers[name]
    assert kept.value == value or (math.isnan(kept.value) and not math.isfinite(value))
    assert kept.error == pytest.approx(error, rel=0.01)


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: whole[:-100],
        lambda whole: whole.replace(b"0.3333333333333333 ", b"a third "),
        lambda whole: whole.replace(b'"unit": "m"', b'"unity": "m"'),
        lambda whole: whole.replace(b"baseline 2", b"baseline 1"),
        lambda whole: whole.replace(b'"values": "', b'"values": "1 '),
        lambda _: b"[]",
        lambda _: b"\0",
    ],
)
def test_a_damaged_file_is_refused_in_a_sentence(damage: Callable[[bytes], bytes], tmp_path: Path) -> None:
    path = tmp_path / "one.json"
    write_baseline(WHOLE, path)
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(InputError) as error:
        read_baseline(path)
    assert str(error.value).startswith(f"{path}: is no baseline, or damaged (")
    assert "\n" not in str(error.value)
