from __future__ import annotations

import dataclasses
import math
import re

import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    IdealPin,
    Linkage,
    Machine,
    OilColumn,
    OwnBody,
    PinPlace,
    Scenario,
    SolverSettings,
    Steady,
    UniformSpeed,
    cylinders_and_rods,
    reference_support,
)
from support_exudyn.model.linkage import Body
from tests.cases.machine_cases import contact, support
from user_forces import InputError, value

SUPPORT = support()


def scenario(**changes: object) -> Scenario:
    fields: dict[str, object] = {"machine": SUPPORT, "duration": 5.0}
    return Scenario(**fields | changes)


# --- bad input is refused when it is made ---


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"drive": CubicStep(stroke=5.0)}, r"cannot follow beyond 3\.\d+ s \(front_column extended by 1\.1"),
        ({"drive": UniformSpeed(stroke=-2.0)}, r"cannot follow beyond .*extended by -1\.38"),
        ({"drive": Steady(rate=0.1), "duration": 50.0}, r"cannot follow beyond 11\.13 s"),
        ({"step": 0.0}, r"Scenario\.step = 0\.0: .*allowed: > 0 and <= 0\.1"),
        ({"speed": 3}, r"Scenario\.speed = 3: unknown field; allowed: machine, pins, guides"),
        ({"pins": {"rear": IdealPin()}}, r"pins\.rear: unknown pin 'rear'; did you mean 'rear_base'"),
        ({"pins": {"rear_base": contact()}}, r"Scenario\.pins\.rear_base = JournalContact\(.*Pin"),
        ({"record_period": 6.0}, r"record_period = 6\.0 s: allowed: at most the duration, 5\.0 s"),
        ({"duration": 0.0}, r"Scenario\.duration = 0\.0: .*allowed: > 0"),
        ({"machine": "support"}, r"Scenario\.machine = 'support': .*Machine"),
        ({"start": "resting"}, r"Scenario\.start = 'resting': .*'concentric' or 'settled'"),
        (
            {"drive": Steady(rate=0.02), "start": "settled"},
            "start = 'settled': is at rest, but the drive moves",
        ),
        ({"drives": {"rear_column": Steady(rate=0.01)}, "start": "settled"}, r"start = 'settled'.*0\.01 per s"),
        ({"gravity": (0.0, math.nan)}, r"Scenario\.gravity\.1 = nan: "),
        (
            {"drives": {"jack": Held()}},
            r"drives\.jack: unknown driven part 'jack'",
        ),
        ({"drives": {"rear_column": CubicStep(stroke=5.0)}}, r"rear_column cannot follow beyond 3\.4"),
        ({"parts": {"side_shield": OwnBody()}}, r"parts\.side_shield: unknown part on a jack 'side_shield'"),
        ({"parts": {"tail_beam": OwnBody()}}, r"parts\.tail_beam: the machine lacks tail_hinge"),
    ],
)
def test_scenarios_that_cannot_be_are_refused(changes: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        scenario(**changes)


# --- accuracy ---


@pytest.mark.parametrize(
    "wrong", ["fast", "1e-3", 0.11, 0.0, 9e-9, -1e-3, math.nan, math.inf, True, [1e-3]], ids=repr
)
def test_an_accuracy_that_is_none_is_refused_with_what_is_allowed(wrong: object) -> None:
    words = re.escape(f"Scenario.accuracy = {wrong!r}: ")
    allowed = r"allowed: 'draft', 'standard', 'reference', None, or a relative error from 1e-08 to 0\.1$"
    with pytest.raises(InputError, match=f"^{words}.*{allowed}"):
        scenario(accuracy=wrong)


@pytest.mark.parametrize(("accuracy", "goal"), [(None, None), ("draft", 1e-2), ("reference", 1e-5), (0.1, 0.1)])
def test_an_accuracy_is_a_word_or_a_number(accuracy: str | float | None, goal: float | None) -> None:
    assert scenario(accuracy=accuracy).goal == goal


@pytest.mark.parametrize("formulation", ["auto", "exudyn", "compiled"])
def test_a_refined_run_has_half_the_step_or_a_smaller_tolerance_or_accuracy(formulation: str) -> None:
    # errors are of second order in the steps; where an accuracy is asked for, settings are chosen anew and stay
    coarse = scenario(accuracy="draft", formulation=formulation, solver=SolverSettings(impact_steps=9000))
    assert coarse.refined() == dataclasses.replace(coarse, accuracy=2.5e-3)
    assert dataclasses.replace(coarse, accuracy=2e-8).refined().accuracy == 1e-8
    solver = SolverSettings(impact_steps=100, tolerance=8e-7)
    finer = scenario(step=1e-3, formulation=formulation, solver=solver).refined()
    if formulation == "compiled":
        assert (finer.step, finer.solver.tolerance) == (1e-3, pytest.approx(1e-7, rel=1e-12))
        finest = dataclasses.replace(finer, solver=SolverSettings(tolerance=2e-13)).refined()
        assert finest.solver.tolerance == 1e-13
        assert finest.refined() == finest
    else:
        assert (finer.step, finer.solver.impact_steps) == (5e-4, 200)
        # steps end at records, so one of 5 ms is one of 1 ms here
        assert scenario(step=5e-3, record_period=1e-3, formulation=formulation).refined().step == 5e-4


def test_an_ideal_pin_must_be_closed_at_the_start() -> None:
    one = Body(mass=1.0, inertia=1.0, centre=(0.0, 0.0))
    apart = PinPlace(first="ground", second="one", first_point=(0.0, 0.0), second_point=(0.001, 0.0))

    @value
    class Open(Machine):
        def linkage(self) -> Linkage:
            return Linkage(bodies={"one": one}, pins={"pin": apart})

    with pytest.raises(InputError, match=r"pins\.pin: .* 0\.001 m apart .* allowed for an ideal pin: 0"):
        Scenario(machine=Open(), duration=1.0)
    Scenario(machine=Open(), duration=1.0, pins={"pin": ClearancePin(contact=contact())})


# --- drives of single parts ---


def test_oil_is_checked_against_the_drive_of_its_own_actuator() -> None:
    oil = OilColumn(bore_area=0.1, oil_length=0.1, bulk_modulus=1e9)
    lowers = {"rear_column": CubicStep(stroke=-0.2)}
    assert scenario(actuators={"front_column": oil}, drives=lowers).drives == lowers
    with pytest.raises(InputError, match=r"actuators\.rear_column\.oil_length = 0\.1 m"):
        scenario(actuators={"rear_column": oil}, drives=lowers)


# --- levels of detail ---

HEAVY = cylinders_and_rods()


def test_actuators_of_two_bodies_bring_bodies_pins_and_a_guide() -> None:
    plain, detailed = scenario().linkage, scenario(actuators={"front_column": HEAVY["front_column"]}).linkage
    assert set(detailed.bodies) - set(plain.bodies) == {"front_column_cylinder", "front_column_rod"}
    assert set(detailed.pins) - set(plain.pins) == {"front_column_foot", "front_column_head"}
    assert set(detailed.slides) == {"front_column_guide"}
    actuator = detailed.actuators["front_column"]
    assert (actuator.foot, actuator.head) == ("front_column_cylinder", "front_column_rod")
    assert actuator.start_length == plain.actuators["front_column"].start_length
    assert detailed.actuators["rear_column"] == plain.actuators["rear_column"]


def test_a_jack_on_oil_is_held() -> None:
    one = Scenario(
        machine=reference_support(),
        actuators=HEAVY,
        parts={"tail_beam": OwnBody(jack=OilColumn(bore_area=0.01, oil_length=0.3, bulk_modulus=1e9))},
        drives={"rear_column": CubicStep(stroke=0.2)},
        duration=5.0,
    )
    assert sorted(one.legs) == ["tail_jack"]
    assert one.drive_of("tail_jack") == Held()


@pytest.mark.parametrize("name", ["jack", "tail_jack"])
def test_only_driven_actuators_are_actuators_of_the_scenario(name: str) -> None:
    said = rf"actuators\.{name}: unknown actuator '{name}'; .*front_column, rear_column"
    for actuator in (OilColumn(bore_area=0.1, oil_length=0.1, bulk_modulus=1e9), HEAVY["front_column"]):
        with pytest.raises(InputError, match=said):
            Scenario(
                machine=reference_support(),
                actuators={name: actuator},
                parts={"tail_beam": OwnBody()},
                duration=1.0,
            )
