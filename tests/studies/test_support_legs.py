"""Legs of two supports: what their numbers rest on, and the examples that repeat them."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import pytest

from studies.common.support_legs import PAIRS, legs_data, support_legs
from support_exudyn import bore_area, simulate
from support_exudyn.files import load_toml, read_scenario_file, scenario_file_of
from support_exudyn.sweeps.file import read_sweep

SWEEP = Path(__file__).parents[2] / "studies" / "examples" / "uncertain_legs.toml"
EXAMPLES = resources.files("support_exudyn.files.examples")
MACHINES = {"reference": "ZF7200/20/32", "zf18000": "ZF18000/23/42D"}


@pytest.mark.parametrize("machine", MACHINES)
def test_legs_carry_the_printed_forces_of_their_support(machine: str) -> None:
    (printed,) = [one for one in legs_data().file.published if one.model == MACHINES[machine]]
    leg = legs_data().of(machine).cylinder
    assert leg.yield_valve is not None
    assert leg.setting_pressure is not None
    assert leg.bore_area == pytest.approx(bore_area(printed.bore, 2), rel=1e-6)
    assert leg.bore_area * leg.setting_pressure * len(PAIRS) == pytest.approx(printed.setting, rel=1e-3)
    assert leg.yield_valve.opening_pressure == pytest.approx(printed.yield_pressure, rel=1e-3)


@pytest.mark.parametrize("machine", MACHINES)
def test_every_number_has_a_source_and_lies_in_its_range(machine: str) -> None:
    about = legs_data().about(machine)
    assert len(about) > 20
    sources = set(legs_data().file.sources.values())
    for key, one in about.items():
        assert one.source in sources, key
        assert one.low is None or one.low <= one.value, key
        assert one.high is None or one.value <= one.high, key


def test_a_support_under_a_converging_roof_yields_at_its_pressure() -> None:
    with resources.as_file(EXAMPLES / "converging_roof.toml") as path:
        scenario = read_scenario_file(path).scenario
    assert scenario.actuators == support_legs("reference")
    run = simulate(scenario)
    (printed,) = [one for one in legs_data().file.published if one.model == MACHINES["reference"]]
    for name in PAIRS:
        pressure, flow = run[f"{name}.pressure"], run[f"{name}.yield_flow"]
        assert flow.max() > 0.0
        assert pressure[flow > 0.0].min() > 0.999 * printed.yield_pressure
        assert pressure[-1] == pytest.approx(printed.yield_pressure, rel=2e-3)
    roof = run["front_roof.force"] + run["rear_roof.force"]
    assert 1.0 < roof.max() / printed.rated < 1.2  # EN 1804-1, 4.3.1


def test_the_sweep_over_legs_draws_from_their_ranges() -> None:
    table = load_toml(SWEEP)
    assert table["vary"]["actuators.*"] == "stated range"
    about = legs_data().about("reference")
    scenario = scenario_file_of(table["scenario"], str(SWEEP), SWEEP.parent)
    for key, one in scenario.sourced.items():
        known = about["cylinder." + key.split(".", 2)[2]]
        assert (one.value, one.low, one.high) == (known.value, known.low, known.high), key
    explicit = {key: one for key, one in table["vary"].items() if one != "stated range"}
    for key, one in explicit.items():
        known = about["cylinder." + key.split(".", 2)[2]]
        assert (one["from"], one["to"]) == (known.low, known.high), key
    plan = read_sweep(SWEEP)
    assert set(plan.names) == scenario.sourced.keys() | explicit.keys()
    assert len(plan.points) == 24
    assert all(plan.scenario(point).actuators for point in plan.points)  # none is refused
