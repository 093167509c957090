"""What studies and examples say of their many runs is what these are: of how many, and from where to where."""

from __future__ import annotations

from pathlib import Path

import pytest

from studies.blow import run as blow
from studies.blow.cases import PINS, Blow, cases
from studies.blow.measures import MEASURES, OF_VALVES
from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.support_legs import legs_data
from studies.common.words import Words
from support_exudyn.sweeps import read_sweep
from tests.processes import ROOT


@pytest.fixture
def no_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blows are not computed; their numbers differ by what pins are loose."""
    loose = {pins: 1.0 + len(names) for pins, names in PINS.items()}

    def made_up(ran: dict[str, tuple[Blow, object]]) -> list[Number]:
        return [
            Number(measure, name, loose[one.pins], unit, 0.0)
            for name, (one, _) in ran.items()
            for measure, (unit, _) in MEASURES.items()
            if one.valve or measure not in OF_VALVES
        ]

    monkeypatch.setattr(Blow, "scenario", lambda self: self)
    monkeypatch.setattr(blow, "run_cases", lambda scenarios, chosen: scenarios)
    monkeypatch.setattr(blow, "numbers", made_up)
    monkeypatch.setattr(blow, "tail_pins", lambda ran: [("front_base", 1)])
    for name in ("peak_figure", "course_figure", "clearance_figure"):
        monkeypatch.setattr(blow, name, lambda *given: None)


@pytest.mark.parametrize(("runs", "compared", "whole"), [(1, 10, 30), (None, 100, 300)])
def test_the_answer_of_blows_counts_those_that_it_compares(
    no_runs: None, runs: int | None, compared: int, whole: int
) -> None:
    outcome = blow.work(Options(out=Path(), runs=runs))
    said = Words("blow").blocks(outcome.words)
    (answer,) = said["Answer"]
    assert f"+500 % (+500 to +500 %): median and range of {compared} blows, each beside" in answer
    assert f"crossed fully: {whole} blows" in " ".join(said["Method"])
    blows = cases(small=runs is not None)
    assert (len([one for one in blows if one.pins == "all"]), len(blows)) == (compared, whole)


def test_the_sweep_over_legs_draws_all_of_the_ranges_that_it_names() -> None:
    plan = read_sweep(ROOT / "studies" / "examples" / "uncertain_legs.toml")
    about = legs_data().about("reference")
    leg = "actuators.front_column."
    drawn = {name: [float(point[name]) for point in plan.points] for name in plan.names}
    for key in ("bulk_modulus_MPa", "yield_valve.rated_flow_l_per_min", "seal_friction.coulomb_kN"):
        known, found = about[f"cylinder.{key}"], sorted(drawn[leg + key])
        assert known.low is not None
        assert known.high is not None
        low, high = float(known.low), float(known.high)
        assert low <= found[0] < found[-1] <= high
        if "flow" not in key:  # which is drawn evenly in its logarithm
            part = (high - low) / len(found)
            assert found[0] < low + part
            assert found[-1] > high - part
    for point in plan.points:  # none is refused: no leg slides with more friction than it sticks
        seals = plan.scenario(point).actuators["front_column"].seal_friction  # type: ignore[attr-defined]
        assert seals.static >= seals.coulomb
