"""Means, deviations and extremes are over time from every step, whatever is recorded; times of the largest."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from support_exudyn import (
    ClearancePin,
    Crank,
    Held,
    PlanarLinkage,
    Result,
    Scenario,
    Steady,
    TracePoint,
    simulate,
)
from support_exudyn.files.hdf5 import BLOCK, with_checksum
from support_exudyn.files.series.own_runs import OLDER
from support_exudyn.formulations.statistics.collected import StepStatistics
from support_exudyn.formulations.statistics.magnitudes import divided
from support_exudyn.formulations.statistics.steps import NODES
from support_exudyn.mechanics.time_statistics import TimeStatistics, statistics_of_records
from tests import synthetic
from tests.cases.run_cases import FORCE, SLIDER_PIN, loose_slider_crank, support
from tests.compiled_runs import simulate_compiled, simulate_on_exudyn
from tests.linkage_cases import CrankRocker
from tests.linkages import apex, four_bar, towards


def test_numbers_of_a_rattling_linkage_do_not_depend_on_its_records() -> None:
    pin = ClearancePin.simple(clearance=2e-4, bore_radius=0.012, stiffness=1e9, restitution=0.8, friction=0.1)
    rattles = Scenario(
        machine=CrankRocker(driven=True),
        pins={"B": pin},
        drive=Steady(rate=30.0),
        duration=0.4,
        accuracy="standard",
    )
    fine, *others = (simulate(replace(rattles, record_period=one)) for one in (2e-5, 1e-3, None))
    known = fine.numbers()
    for other in others:
        for name, number in other.numbers().items():
            assert abs(number.value - known[name].value) <= number.error + known[name].error, name
    # by the fine records themselves, of which an impact has some
    force, time = fine["pin.B.force"], fine.time
    mean = np.trapezoid(force, time) / 0.4
    spread = math.sqrt(np.trapezoid((force - mean) ** 2, time) / 0.4)
    assert known["pin.B.force.std"].value == pytest.approx(spread, rel=3e-4)
    highest = fine["pin.O.force"].max()
    assert highest <= known["pin.O.force.largest"].value <= 1.01 * highest
    assert known["pin.B.force.largest"].value == pytest.approx(known["pin.B.largest_force"].value, rel=1e-4)


@pytest.mark.parametrize("formulation", ["compiled", "exudyn"])
def test_the_mean_of_a_coupler_point_is_that_of_its_curve(formulation: str) -> None:
    rate, duration, links = -25.0 * math.pi / 30.0, 2.0, (0.04, 0.11, 0.09)

    def middle(t: float) -> tuple[float, float]:
        crank = towards(60.0 + math.degrees(rate * t), links[0])
        end = apex(crank, (0.12, 0.0), *links[1:])
        assert end is not None
        return 0.5 * (crank[0] + end[0]), 0.5 * (crank[1] + end[1])

    linkage = four_bar(*links, 0.12)
    coupler = TracePoint(body="coupler", point=linkage.bodies["coupler"].centre)
    drawing = replace(linkage, points={"middle": coupler}, cranks={"crank": Crank(body="crank")})
    run = Scenario(
        machine=PlanarLinkage(drawing=drawing),
        drive=Steady(rate=rate),
        duration=duration,
        step=2e-3,
        formulation=formulation,  # type: ignore[arg-type]
        record_period=0.1,
    )
    numbers = simulate(run, errors=True).numbers(until=1.7)
    for axis in range(2):
        mean = quad(lambda t, axis=axis: middle(t)[axis], 0.0, 1.7, epsabs=1e-14, limit=200)[0] / 1.7
        found = numbers[f"middle.{'xy'[axis]}.mean"]
        assert abs(found.value - mean) <= found.error < 1e-5


# --- from steps to intervals, and from these to a window ---


def course(t: np.ndarray) -> np.ndarray:
    """Smooth but for a jump at 1.3 s."""
    return np.asarray(3.0 + np.sin(3.0 * t) + 0.3 * np.cos(11.0 * t) + 2.0 * (t > 1.3))


def collected(intervals: int) -> TimeStatistics:
    """Of that over 2 s, in chunks of steps of any length, one of which ends at the jump."""
    ends = np.sort(np.append(np.random.default_rng(3).uniform(0.0, 2.0, 3000), [0.0, 1.3, 2.0]))
    length = np.diff(ends)
    time = ends[:-1, None] + length[:, None] * NODES
    within = ends[:-1, None] + length[:, None] * np.clip(NODES, 1e-9, 1.0 - 1e-9)
    found = StepStatistics(np.linspace(0.0, 2.0, intervals + 1))
    for rows in np.array_split(np.arange(len(time)), 4):
        found.add(time[rows], {"one": course(within[rows]).ravel(), "other": -course(within[rows]).ravel()})
    return found.finished()


@pytest.mark.parametrize("intervals", [5, 40, 1000])
@pytest.mark.parametrize(("after", "until"), [(0.0, 2.0), (0.4, 1.6), (0.437, 1.51), (1.3, 1.71)])
def test_intervals_combine_to_any_window(intervals: int, after: float, until: float) -> None:
    window = collected(intervals).window("one", after, until)
    time = np.linspace(after, until, 400_001)
    values = course(time + 1e-12)
    mean = np.trapezoid(values, time) / (until - after)
    std = math.sqrt(np.trapezoid((values - mean) ** 2, time) / (until - after))
    assert abs(window.mean - mean) <= window.mean_doubt + 3e-5
    assert abs(window.std - std) <= window.std_doubt + 3e-5
    assert abs(window.greatest[0] - values.max()) <= window.greatest_doubt + 3e-5
    assert abs(window.least[0] - values.min()) <= window.least_doubt + 3e-5
    if intervals == 1000:
        assert window.mean_doubt + window.std_doubt < 5e-3
        assert window.greatest[1] == pytest.approx(time[values.argmax()], abs=1e-3)


# --- records ---


def test_a_file_of_the_version_before_gives_the_numbers_of_its_records(tmp_path: Path) -> None:
    run = simulate(support(drive=Held(), duration=0.1, formulation="compiled", record_period=0.01))
    path = replace(run, statistics=None).save(tmp_path / "run.h5")
    path.write_bytes(with_checksum(path.read_bytes()[BLOCK:], OLDER))
    loaded = Result.load(path)
    assert loaded.statistics is None
    records = statistics_of_records(run.time, {FORCE: run[FORCE]}).window(FORCE, 0.0, 0.1)
    assert loaded.window(FORCE).mean == records.mean
    assert records.mean == pytest.approx(np.trapezoid(run[FORCE], run.time) / 0.1, rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "period"),
    [
        ({}, 2e-3),  # a rise of 2 s, ideal pins; the finest of a run of 5 s is 1 ms
        ({"duration": 40.0}, 1e-2),
        ({"drive": Held(), "duration": 0.3}, 5e-4),  # steps of the Exudyn formulation are not cut
        ({"drive": Held(), "duration": 0.3, "formulation": "compiled"}, 2e-4),
        ({"record_period": 0.07}, 0.07),
    ],
)
def test_records_follow_the_machine_unless_their_period_is_given(
    changes: dict[str, Any], period: float
) -> None:
    scenario = support(**{"record_period": None} | changes)
    assert scenario.recorded_every == period
    assert scenario.refined().recorded_every == period


@pytest.mark.parametrize("tip", [0.0, 1e-3, 0.1])
def test_the_mean_of_a_magnitude_is_right_where_its_vector_passes_zero_within_a_step(tip: float) -> None:
    time = np.arange(3.0)[:, None] + NODES
    for zero in np.linspace(1.01, 1.99, 23):
        vector = np.stack([time.ravel() - zero, np.full(time.size, tip)], axis=1)
        values = {"size": np.hypot(*vector.T), "cubic": time.ravel() ** 3}
        found = StepStatistics(np.array([0.0, 1.3, 3.0]))
        found.add(*divided(time, values, {"size": vector}))
        whole = found.finished()
        expected = quad(lambda t, zero=zero: math.hypot(t - zero, tip), 0.0, 3.0, points=[zero])[0] / 3.0
        # without pieces 9e-3 off
        assert whole.window("size", 0.0, 3.0).mean == pytest.approx(expected, rel=2e-5)
        assert whole.window("size", 0.0, 3.0).least[0] == pytest.approx(tip, abs=1e-3)
        assert whole.window("cubic", 0.0, 3.0).mean == pytest.approx(27.0 / 4.0, rel=1e-13)


# --- times of largest forces ---


TIME = np.linspace(0.0, 1.0, 101)
PERIOD = 0.01


def bumps(second: float) -> np.ndarray:
    """A force with a top of 2 at 0.2 s and one of another height at 0.7 s."""
    tops = 2.0 * np.exp(-(((TIME - 0.2) / 0.05) ** 2)), second * np.exp(-(((TIME - 0.7) / 0.05) ** 2))
    return np.asarray(-tops[0] + tops[1])


def three(*forces: np.ndarray) -> Result:
    """Runs with these forces of a pin, the last the finest."""
    scenario = replace(support(drive=Held(), duration=1.0), record_period=PERIOD)
    found: Result | None = None
    for force in forces:
        found = replace(synthetic.result(scenario, TIME, {FORCE: (force, "N")}), coarser=found)
    assert found is not None
    return found


def test_the_time_of_the_largest_is_that_of_its_record() -> None:
    when = three(*(bumps(second) for second in (1.0, 1.01, 1.011))).numbers()[f"{FORCE}.largest_time"]
    assert when.unit == "s"
    assert when.value == pytest.approx(0.2)  # where the force pulls with 2 N
    assert PERIOD <= when.error < 2.0 * PERIOD


def test_where_another_time_could_be_meant_the_error_reaches_there() -> None:
    # the runs differ by 0.01 N, and the tops by half of that
    when = three(*(bumps(second) for second in (1.985, 1.985, 1.995))).numbers()[f"{FORCE}.largest_time"]
    assert when.value == pytest.approx(0.2)
    assert when.error >= 0.5


DURATION = 0.004


@pytest.mark.parametrize("run", [simulate_compiled, simulate_on_exudyn])
def test_the_largest_force_at_any_step_is_there_at_its_time_and_not_before(
    run: Callable[..., Result], tmp_path: Path
) -> None:
    scenario = replace(loose_slider_crank(DURATION), record_period=2e-5)
    found = run(scenario)
    largest, when = found.largest_force[SLIDER_PIN], found.largest_force_time[SLIDER_PIN]
    contacts = [(one.time, one.separation_time) for one in found.onsets[SLIDER_PIN]]
    contact = next(n for n, (onset, separation) in enumerate(contacts) if onset < when <= separation)
    records = 2e-5 * np.floor(np.array(contacts[contact]) / 2e-5 + [0, 1])
    before, after = (run(replace(scenario, duration=float(end))) for end in records)
    assert before.largest_force[SLIDER_PIN] < largest
    assert after.largest_force[SLIDER_PIN] == pytest.approx(largest, rel=1e-3)
    assert after.largest_force_time[SLIDER_PIN] == pytest.approx(when, abs=2e-6)
    again = Result.load(found.save(tmp_path / "run.h5"))
    assert again.largest_force_time == found.largest_force_time
