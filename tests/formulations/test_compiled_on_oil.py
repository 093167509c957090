"""A support on columns of oil in the compiled formulation: against the engine, and its own refinement."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Literal

import numpy as np
import pytest

from studies.contact_laws.catalogue import friction_laws, normal_laws
from support_exudyn import (
    Body,
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    Linkage,
    Machine,
    OilColumn,
    Reciprocating,
    Result,
    Scenario,
    SimulationError,
    SolverSettings,
    Steady,
    UniformSpeed,
    bore_area,
    simulate,
)
from support_exudyn.model.linkage import GROUND, pinned
from tests.cases.run_cases import FORCE, PIN, paper_contact, support
from user_forces import (
    BrownMcPhee,
    Flores,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    value,
)

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}
STIFF = dict.fromkeys(BOTH, replace(OIL, bulk_modulus=1.5e10))  # 3e9 N/m


def on_oil(tolerance: float = 1e-8, friction: float = 0.25, **changes: object) -> Scenario:
    """The support on oil with a clearance of 1.5 mm."""
    fields: dict[str, object] = {
        "pins": {PIN: ClearancePin(contact=paper_contact(1.5, friction))},
        "actuators": BOTH,
        "formulation": "compiled",
        "solver": SolverSettings(tolerance=tolerance),
    }
    return support(**fields | changes)


# --- against the Exudyn formulation ---

DRIVES = {"mode 2": CubicStep(start=0.05, end=0.25, stroke=0.02), "mode 1": UniformSpeed(start=0.05, end=2.05)}


@cache
def both(drive: str, actuators: str) -> tuple[Result, Result]:
    """The same scene in the compiled and in the Exudyn formulation."""
    columns, step = {"oil": (BOTH, 1e-4), "stiff": (STIFF, 2.5e-5)}[actuators]
    scene = on_oil(drive=DRIVES[drive], actuators=columns, duration=0.15, step=step)
    return simulate(scene), simulate(replace(scene, formulation="exudyn"))


CASES = [
    pytest.param(("mode 2", "oil"), marks=pytest.mark.slow),
    pytest.param(("mode 2", "stiff"), marks=pytest.mark.slow),
    ("mode 1", "oil"),
]


@pytest.mark.parametrize("case", CASES)
def test_the_first_impacts_are_those_of_the_redundant_formulation(case: tuple[str, str]) -> None:
    ours, theirs = both(*case)
    assert len(ours.onsets[PIN]) >= 3
    for one, other in zip(ours.onsets[PIN][:3], theirs.onsets[PIN][:3], strict=True):
        # an implicit step of 0.1 ms carries the oil's vibration of 50 Hz to 3e-4 between impacts
        assert one.time == pytest.approx(other.time, abs=5e-6)
        assert one.speed == pytest.approx(other.speed, rel=1e-3)
    assert ours.largest_force[PIN] == pytest.approx(theirs.largest_force[PIN], rel=1e-4)


@pytest.mark.parametrize("case", CASES)
def test_all_channels_are_those_of_the_redundant_formulation(case: tuple[str, str]) -> None:
    ours, theirs = both(*case)
    assert {n: (c.unit, c.meaning) for n, c in ours.channels.items()} == {
        n: (c.unit, c.meaning) for n, c in theirs.channels.items()
    }
    for name in ours.channels:
        if name == "energy.balance":
            continue
        # what the implicit steps have of error; accelerations and forces of ideal pins have more of it just
        # after an impact, so that one record or two are off by some tens of per cent
        spread = np.quantile(np.abs(ours[name] - theirs[name]), 0.97)
        assert spread <= 5e-3 * max(np.abs(theirs[name]).max(), 1e-30), name


def test_the_redundant_formulation_tends_to_the_compiled_one() -> None:
    ours = simulate(on_oil(1e-11, drive=Held(), duration=0.06))
    settings = SolverSettings(impact_steps=256)
    base = on_oil(drive=Held(), duration=0.06, formulation="exudyn", step=1e-4, solver=settings)

    def off(scene: Scenario) -> float:
        return float(np.sqrt(np.mean((ours[FORCE] - simulate(scene)[FORCE]) ** 2)))

    coarse, fine = off(base), off(base.refined(2))
    # 1.6 of 413 000 N, and with second order
    assert fine < 1e-5 * ours[FORCE].max()
    assert 3.0 < coarse / fine < 5.0


# --- its own accuracy ---

FRICTIONS = (pytest.param(0.0, marks=pytest.mark.slow), 0.25)


@cache
def rise(tolerance: float, friction: float) -> Result:
    """A short rise that begins in the middle of the impacts."""
    return simulate(
        on_oil(tolerance, friction, drive=CubicStep(start=0.03, end=0.4, stroke=0.05), duration=0.2)
    )


def test_the_mass_that_moves_is_that_of_the_bores_axes_where_both_bodies_turn() -> None:
    # along the normal the journal has next to no way: the mass that moves is tens of tons, and 18 times that
    # of other directions per radian. The engine's connector has axes in the middle between both bodies
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.0655, clearance=0.243e-3),
        normal=Flores(restitution=0.426, stiffness=2.2e10, exponent=1.5),
        friction=BrownMcPhee(static_coefficient=0.178, sliding_coefficient=0.137, transition_speed=0.01),
    )
    oil = OilColumn(bore_area=0.12847, oil_length=0.698, bulk_modulus=9.81e8)
    scene = support(
        pins={"front_shield": ClearancePin(contact=contact, bore="second", eccentricity=(3.1e-5, -4.65e-5))},
        actuators=dict.fromkeys(BOTH, oil),
        drive=Reciprocating(stroke=3.013e-3, period=0.1462),
        duration=0.0245,
        formulation="compiled",
        solver=SolverSettings(tolerance=1e-8),
    )
    right = simulate(scene).largest_force["front_shield"]
    engine = replace(scene, formulation="exudyn", step=1e-4, solver=SolverSettings(impact_steps=400))
    # in the axes in the middle: 1.7e-4 off, at any step
    assert simulate(engine).largest_force["front_shield"] == pytest.approx(right, rel=5e-6)


@pytest.mark.parametrize("friction", FRICTIONS)
def test_errors_fall_with_the_tolerance(friction: float) -> None:
    exact = rise(1e-11, friction)

    def off(tolerance: float) -> float:
        difference = rise(tolerance, friction)["rear_link.angle"] - exact["rear_link.angle"]
        return float(np.abs(difference).max())

    # impacts amplify errors a hundredfold and more, but in proportion; a kink of friction that is met elsewhere
    # in a step makes up to a factor of ten
    assert off(1e-9) < 0.05 * off(1e-6)
    assert off(1e-6) < 1e-5


@pytest.mark.parametrize("friction", FRICTIONS)
def test_the_first_touches_are_right_at_a_loose_tolerance(friction: float) -> None:
    # of what its errors are see `simulate_as_fine`; measured 1.1e-6 s at 1e-5
    for one, other in zip(
        rise(1e-6, friction).onsets[PIN][:2], rise(1e-11, friction).onsets[PIN][:2], strict=True
    ):
        assert one.speed == pytest.approx(other.speed, rel=1e-3)
        assert one.time == pytest.approx(other.time, abs=1e-6)


@pytest.mark.parametrize("friction", FRICTIONS)
def test_energy_adds_up(friction: float) -> None:
    for tolerance, allowed in ((1e-6, 1e-4), (1e-8, 1e-5), (1e-11, 1e-8)):
        result = rise(tolerance, friction)
        # the share of the dissipated energy falls with the tolerance; it amounts to some tens of joule
        assert result.dissipated > 10.0
        assert result.energy_error < allowed * result.dissipated


def test_largest_forces_lie_between_the_records() -> None:
    ours, finer = rise(1e-7, 0.25), rise(1e-11, 0.25)
    assert ours.largest_force[PIN] > ours[FORCE].max()
    # the parabola through three of some fifty points of an impact
    assert ours.largest_force[PIN] == pytest.approx(finer.largest_force[PIN], rel=1e-5)


def test_a_sudden_start_needs_no_impulse() -> None:
    result = simulate(on_oil(drive=UniformSpeed(start=0.05, end=2.05), duration=0.06, record_period=1e-5))
    assert result.impulses == ()
    jump = int(np.searchsorted(result.time, 0.05 + 1e-9))
    # nothing jumps: beside what it vibrated with before, oil is compressed by what has been let in since
    before, after = np.diff(result["rear_column.force"])[jump - 2 : jump]
    assert after - before == pytest.approx(OIL.stiffness(0.0) * 0.25 * 1e-5, rel=0.02)  # bodies give way


def test_records_do_not_change_the_run() -> None:
    often, seldom = (simulate(on_oil(1e-6, drive=Held(), duration=0.05, record_period=p)) for p in (1e-4, 7e-3))
    assert often.counts.steps == seldom.counts.steps
    assert often.onsets == seldom.onsets
    assert seldom.time.tolist() == pytest.approx([7e-3 * n for n in range(8)] + [0.05])
    # the same motion within the steps; joints of a record are closed by the factors of what was looked at last
    np.testing.assert_allclose(often["tip.y"][::70], seldom["tip.y"][:-1], rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("name", ["exact", "kelvin_voigt", "anagnostopoulos", "johnson"])
@pytest.mark.parametrize("restitution", [0.3, pytest.param(0.9, marks=pytest.mark.slow)])
def test_laws_of_every_kind(name: str, restitution: float) -> None:
    # one with hysteresis, a dashpot, one that asks for tension, cylinders
    pin = ClearancePin(contact=replace(paper_contact(1.5, 0.0), normal=normal_laws(1.5, restitution)[name]))
    coarse, fine = (simulate(on_oil(t, drive=Held(), duration=0.06, pins={PIN: pin})) for t in (1e-7, 1e-10))
    assert len(coarse.onsets[PIN]) == len(fine.onsets[PIN]) >= 1
    for one, other in zip(coarse.onsets[PIN], fine.onsets[PIN], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-3, abs=1e-5)
    assert fine.energy_error < 1e-6 * fine.dissipated


@pytest.mark.parametrize("name", ["stribeck", "threlfall"])
def test_friction_laws(name: str) -> None:
    pin = ClearancePin(contact=replace(paper_contact(1.5, 0.0), friction=friction_laws(0.25)[name]))
    result = simulate(on_oil(1e-7, drive=Held(), duration=0.04, pins={PIN: pin}))
    assert result["energy.friction_loss"][-1] > 0.1
    # of only 1.3 J after two impacts
    assert result.energy_error < 1e-4 * result.dissipated


# --- starts ---


def test_a_settled_machine_stays_at_rest() -> None:
    scene = on_oil(start="settled", drive=Held(), duration=0.1)
    result = simulate(scene)
    # steps grow to the limit of stability, where errors of the tolerance come and go
    np.testing.assert_allclose(result[FORCE], result[FORCE][0], rtol=1e-6)
    theirs = simulate(replace(scene, formulation="exudyn", duration=0.01))
    assert result[FORCE][0] == pytest.approx(theirs[FORCE][0], rel=1e-8)
    assert result["tip.x"][0] == pytest.approx(theirs["tip.x"][0], abs=1e-9)
    assert result["front_column.force"][0] == pytest.approx(theirs["front_column.force"][0], rel=1e-7)


def test_a_drive_that_moves_from_the_start_on_finds_the_machine_moving() -> None:
    scene = on_oil(drive=Steady(rate=0.05), duration=0.01)
    ours, theirs = simulate(scene), simulate(replace(scene, formulation="exudyn", step=1e-4))
    for name in ("rear_link.angular_velocity", "canopy.velocity_y"):
        assert ours[name][0] == pytest.approx(theirs[name][0], rel=1e-9)
    # free flight, second order in a step of 0.1 ms
    np.testing.assert_allclose(ours["tip.y"], theirs["tip.y"], atol=1e-8)


# --- other linkages ---


@value
class Bars(Machine):
    """Bars of 1 m that hang side by side from the ground, neighbours joined at their lower ends.

    Arguments:
        number: of bars.
        spin: of each at the start [rad/s].
    """

    number: int
    spin: float = 0.0

    def linkage(self) -> Linkage:
        bars = {
            f"bar{n}": Body(
                mass=10.0 + n,
                inertia=1.0,
                centre=(0.1 * n, -0.5),
                velocity=(0.5 * self.spin, 0.0),
                spin=self.spin,
            )
            for n in range(self.number)
        }
        pins = {f"top{n}": pinned(GROUND, f"bar{n}", (0.1 * n, 0.0)) for n in range(self.number)}
        pins |= {f"low{n}": pinned(f"bar{n}", f"bar{n + 1}", (0.1 * n, -1.0)) for n in range(self.number - 1)}
        return Linkage(bodies=bars, pins=pins)


def test_a_pendulum_without_any_loose_pin_swings_as_it_should() -> None:
    result = simulate(
        Scenario(machine=Bars(number=1, spin=3.0), duration=1.0, formulation="compiled", record_period=0.01)
    )
    about_pivot = 1.0 + 10.0 * 0.25
    turn, spin = result["bar0.angle"], result["bar0.angular_velocity"]
    energy = 0.5 * about_pivot * spin**2 + 10.0 * 9.81 * 0.5 * (1.0 - np.cos(turn))
    # tolerance 1e-7 of a speed of 0.1 m/s a step, some hundred steps
    np.testing.assert_allclose(energy, 0.5 * about_pivot * 9.0, rtol=1e-5)
    # along the bar: weight and what keeps it on its circle; across: what turns it
    along = 10.0 * (9.81 * np.cos(turn) + 0.5 * spin**2)
    across = 10.0 * 9.81 * np.sin(turn) * (1.0 - 10.0 * 0.25 / about_pivot)
    np.testing.assert_allclose(result["pin.top0.force"], np.hypot(along, across), rtol=1e-9)


def test_loose_pins_between_moving_bodies_of_several_branches() -> None:
    contact = replace(
        paper_contact(1.0, 0.2),
        normal=LankaraniNikravesh(stiffness=1e9, restitution=0.7),
    )
    pins = {"low0": ClearancePin(contact=contact), "low1": ClearancePin(contact=contact, bore="second")}
    scene = Scenario(
        machine=Bars(number=3, spin=0.5),
        pins=pins,
        duration=0.15,
        formulation="compiled",
        step=5e-5,
        solver=SolverSettings(tolerance=1e-9),
    )
    ours, theirs = simulate(scene), simulate(replace(scene, formulation="exudyn"))
    for name in pins:
        assert len(ours.onsets[name]) >= 2
        for one, other in zip(ours.onsets[name][:3], theirs.onsets[name][:3], strict=True):
            # errors of the implicit steps in two pins that strike each other
            assert one.time == pytest.approx(other.time, abs=1e-5)
            assert one.speed == pytest.approx(other.speed, rel=2e-3)
    np.testing.assert_allclose(ours["bar1.angle"], theirs["bar1.angle"], atol=1e-6)
    assert ours.energy_error < 1e-7 * ours.dissipated


def test_a_drive_that_is_no_cubic_is_followed_too() -> None:
    drive = Swaying(stroke=0.01, rate=40.0)
    ours, cut = (simulate(on_oil(t, drive=drive, duration=0.02)) for t in (1e-8, 1e-10))
    assert ours["front_column.force"][-1] == pytest.approx(cut["front_column.force"][-1], rel=1e-6)
    assert ours.energy_error < 1e-6 * abs(ours["energy.work"]).max()
    theirs = simulate(on_oil(drive=drive, duration=0.02, formulation="exudyn", step=5e-6))
    # second order of an implicit step of 5 us
    assert ours["front_column.force"][-1] == pytest.approx(theirs["front_column.force"][-1], rel=1e-5)


@value
class Swaying(Drive):
    """A drive in and out: stroke (1 - cos(rate t)) / 2."""

    stroke: float
    rate: float

    def extension(self, t: float) -> float:
        return 0.5 * self.stroke * (1.0 - math.cos(self.rate * t))

    def speed(self, t: float) -> float:
        return 0.5 * self.stroke * self.rate * math.sin(self.rate * t)

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, self.stroke


# --- what is refused ---


@value
class Torn(Bars):
    """A bar whose velocity does not fit its pin."""

    def linkage(self) -> Linkage:
        good = super().linkage()
        return replace(good, bodies={"bar0": replace(good.bodies["bar0"], velocity=(1.0, 0.0))})


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
def test_velocities_that_tear_a_pin_are_refused(formulation: Literal["exudyn", "compiled"]) -> None:
    with pytest.raises(SimulationError, match="energy does not add up: it is open by 1"):
        simulate(Scenario(machine=Torn(number=1), duration=0.1, formulation=formulation))
