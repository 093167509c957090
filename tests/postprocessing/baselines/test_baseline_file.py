"""The file of a baseline: what is read is what was written, and a damaged file is refused in a sentence."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

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


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: whole[:-100],
        lambda whole: whole.replace(b"baseline 2", b"baseline 1"),
        lambda whole: whole.replace(b'"values": "', b'"values": "1 '),
        lambda _: b"[]",
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
