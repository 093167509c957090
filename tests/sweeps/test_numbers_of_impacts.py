"""Numbers of impacts are noted by their names: of pins, of sides and edges in space, of falling blocks."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path

import pytest

from support_exudyn import Result, simple_scenario, simulate
from support_exudyn.simulation.reported_numbers import measures
from support_exudyn.sweeps import read_sweep, read_table, sweep
from support_exudyn.sweeps.measures import check_numbers
from user_forces.values.value import InputError

BLOCK = {
    "type": "FallingBlock",
    "body": "canopy",
    "point_mm": [3195.9, 1950],
    "mass_kg": 1000,
    "height_mm": 1,
    "stiffness_N_per_m_to_n": 1e9,
    "restitution": 0.3,
}
PIN = {"clearance_mm": 1, "bore_radius_mm": 50}
SWEEP = """
scenario = "a.toml"
[vary]
"loads.rock.restitution" = [0.3, 0.9]
[record]
numbers = ["rock.largest_force", "rock.largest_force_time", "rock.onset_1.time", "rock.onset_1.speed"]
"""
SCENARIO = """
machine = "reference"
duration_s = 0.02
step_s = 1e-4
[loads.rock]
""" + "\n".join(f"{key} = {item!r}" for key, item in BLOCK.items())


@cache
def run(dimensions: int) -> Result:
    pins = {"rear_base": PIN, "front_base": PIN}
    keys = {"dimensions": dimensions, "pins": pins, "loads": {"rock": BLOCK}}
    return simulate(simple_scenario("reference", duration_s=0.02, step_s=1e-4, **keys))


@pytest.mark.parametrize("dimensions", [2, 3])
def test_every_number_that_a_run_tells_may_be_asked_for(dimensions: int) -> None:
    result = run(dimensions)
    names = list(measures(result, 0.0, math.inf))
    told = {name for name in names if name.startswith("rock.") and "onset" not in name}
    assert {"rock.largest_force", "rock.largest_force_time"} <= told
    assert {"rock.onset_1.time", "rock.onset_1.speed"} <= set(names)
    edges = [name for name in names if name.startswith("pin.front_base_left.left.onset_1.")]
    assert bool(edges) is (dimensions == 3)
    check_numbers(result.scenario, names)


@pytest.mark.parametrize(
    ("dimensions", "name"),
    [
        (2, "rok.largest_force"),
        (2, "rock.onset_1.tim"),
        (2, "rock.left.onset_1.time"),
        (2, "pin.rear_base.left.onset_1.time"),
        (2, "pin.rock.largest_force"),
        (2, "pin.front_base_left.largest_force"),
        (3, "pin.front_base_middle.largest_force"),
    ],
)
def test_numbers_that_no_run_tells_are_refused(dimensions: int, name: str) -> None:
    with pytest.raises(InputError, match=r"no such number.*falling block: NAME.largest_force"):
        check_numbers(run(dimensions).scenario, [name])


def test_a_sweep_notes_the_blows_of_a_block_by_name(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(SCENARIO.replace("'", '"'), encoding="utf-8")
    (tmp_path / "sweep.toml").write_text(SWEEP, encoding="utf-8")
    outcome = sweep(read_sweep(tmp_path / "sweep.toml"), workers=1)
    assert (outcome.done, outcome.missing) == (2, ())
    rows = read_table(outcome.table).to_pylist()
    for row in rows:  # a fall of 1 mm onto a support that stands still
        assert row["rock.onset_1.time_s"] == pytest.approx(math.sqrt(2e-3 / 9.81), rel=1e-4)
        assert row["rock.onset_1.speed_m_per_s"] == pytest.approx(math.sqrt(2e-3 * 9.81), rel=1e-3)
        assert row["rock.onset_1.time_s"] < row["rock.largest_force_time_s"] <= 0.02
        assert row["rock.largest_force_N"] > 1e3 * 9.81
