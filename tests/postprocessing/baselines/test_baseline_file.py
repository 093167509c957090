"""The file of a baseline: what is read is what was written, and a damaged one is told in a sentence."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from support_exudyn import InputError
from support_exudyn.postprocessing.baselines.baseline_file import read_baseline, write_baseline
from support_exudyn.postprocessing.baselines.changes import changes
from support_exudyn.postprocessing.baselines.kept_impacts import KeptImpact
from support_exudyn.postprocessing.baselines.kept_run import KeptCurve, KeptRun
from support_exudyn.simulation.estimate import Estimate

IMPACT = KeptImpact(Estimate(0.1, 1e-6, "s"), Estimate(0.5, 1e-5, "m/s"))
WHOLE = KeptRun(
    numbers={"pin.B.force.mean": Estimate(1.0 / 3.0, 1e-9, "N"), "unknown": Estimate(math.nan, math.inf, "m")},
    provenance={"python": "3.11"},
    scenario={"gravity": [0.0, -9.81], "pins": {"B": {"of": "Clearance"}}},
    time=np.array([0.0, 0.1, 0.2]),
    curves={"tip.x": KeptCurve("m", np.array([1.0, math.nan, 2.0]), np.array([1e-9, 1e-9, math.inf]))},
    impacts={"B": (IMPACT, IMPACT), "C": ()},
    horizon=0.15,
    history=({"date": "2026", "changes": "first"},),
)


def read_or_refused(path: Path) -> KeptRun | str:
    """What is read, or why it is not."""
    try:
        return read_baseline(path)
    except InputError as error:
        return str(error)


def test_what_is_read_is_what_was_written(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "one.json"
    write_baseline(WHOLE, path)
    found = read_baseline(path)
    assert changes(WHOLE, found) == changes(found, WHOLE) == []
    assert (found.impacts, found.history, found.horizon) == (WHOLE.impacts, WHOLE.history, WHOLE.horizon)
    assert (found.scenario, found.provenance) == (WHOLE.scenario, WHOLE.provenance)
    assert found.numbers["pin.B.force.mean"] == WHOLE.numbers["pin.B.force.mean"]
    first = path.read_bytes()
    write_baseline(found, path)
    assert path.read_bytes() == first
    assert json.loads(first)["horizon_s"] == 0.15


values = st.floats(allow_nan=True, allow_infinity=False, width=64)


@given(value=values, error=st.floats(0.0, 1e300) | st.just(math.inf), name=st.text(max_size=8))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_number_is_kept(value: float, error: float, name: str, tmp_path: Path) -> None:
    one = KeptRun(numbers={name: Estimate(value, error, name)}, provenance={})
    write_baseline(one, tmp_path / "one.json")
    kept = read_baseline(tmp_path / "one.json").numbers[name]
    assert kept.value == value or (math.isnan(kept.value) and math.isnan(value))
    assert kept.error == pytest.approx(error, rel=0.01)


@given(data=st.data())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_damaged_one_is_told_in_a_sentence(data: st.DataObject, tmp_path: Path) -> None:
    path = tmp_path / "one.json"
    write_baseline(WHOLE, path)
    whole = path.read_bytes()
    place = data.draw(st.integers(0, len(whole) - 1))
    kind = data.draw(st.sampled_from(["cut", "bit", "insert"]))
    damaged = {
        "cut": whole[:place],
        "bit": whole[:place] + bytes([whole[place] ^ (1 << data.draw(st.integers(0, 7)))]) + whole[place + 1 :],
        "insert": whole[:place] + data.draw(st.binary(min_size=1, max_size=3)) + whole[place:],
    }[kind]
    path.write_bytes(damaged)
    found = read_or_refused(path)
    if isinstance(found, KeptRun):  # white space alone
        assert changes(found, WHOLE) == []
    else:
        assert found.startswith(f"{path}: is no baseline, damaged, or changed by hand (")
        assert "\n" not in found


@pytest.mark.parametrize(
    "text",
    ["", "[]", "null", "{}", '{"format": 1}', "[" * 100_000, '{"format": "support_exudyn baseline 1"}', "\0"],
)
def test_what_is_no_baseline_is_told(text: str, tmp_path: Path) -> None:
    path = tmp_path / "one.json"
    path.write_text(text, "utf-8")
    with pytest.raises(InputError, match="is no baseline, damaged"):
        read_baseline(path)


@pytest.mark.parametrize("key", ["numbers", "curves", "impacts", "time_s", "horizon_s", "history", "scenario"])
@pytest.mark.parametrize("item", [None, 1, "text", [1], {"a": [1]}, [["a"]], True])
def test_with_the_right_digest_the_contents_are_looked_at_too(key: str, item: object, tmp_path: Path) -> None:
    from support_exudyn.postprocessing.baselines.baseline_file import FORMAT, _digest

    path = tmp_path / "one.json"
    write_baseline(WHOLE, path)
    data = json.loads(path.read_text("utf-8")) | {key: item}
    body = {name: one for name, one in data.items() if name not in ("format", "digest")}
    path.write_text(json.dumps({"format": FORMAT, "digest": _digest(body), **body}), "utf-8")
    found = read_or_refused(path)
    assert isinstance(found, KeptRun) or "is no baseline, damaged" in found
