"""The reduced formulation: what it refuses, how it fails, and its parts."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from typing import Any

import numba
import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    IdealPin,
    Scenario,
    SimulationError,
    Steady,
    UniformSpeed,
    ravn_slider_crank,
)
from support_exudyn.reduced import layout, simulate_reduced, warm_up
from support_exudyn.reduced.contact import contact_force
from support_exudyn.reduced.coverage import PIN
from support_exudyn.reduced.dynamics import arms, kinetic_energy
from support_exudyn.reduced.parameters import parameters, record_times, segments
from support_exudyn.reduced.posture import Posture, Rates, driven, posture, rates
from tests.unit.cases import contact, support
from user_forces import (
    Ambrosio,
    CarvalhoMartins,
    DepthSpeed,
    Exact,
    Flores,
    Hertz,
    InputError,
    JournalBearing,
    JournalContact,
    KelvinVoigt,
    LankaraniNikravesh,
    LuGre,
    NormalLaw,
    Touch,
    TouchSpeed,
    value,
)

FORCE = "pin.rear_base.force"


def scene(pin: ClearancePin | None = None, **changes: Any) -> Scenario:
    fields = {"machine": support(), "duration": 0.05, "pins": {PIN: pin or ClearancePin(contact=contact())}}
    return Scenario(**fields | changes)


def hertz(stiffness: float) -> ClearancePin:
    bearing = JournalBearing(bore_radius=0.0655, clearance=0.0015)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=Hertz(stiffness=stiffness)))


# --- what is covered ---


@value
class Softened(LankaraniNikravesh):
    """A law whose force is no longer that of its family."""

    def elastic_force(self, depth: float) -> float:
        return 0.5 * super().elastic_force(depth)


REFUSED = {
    "machine": (lambda: scene(machine=ravn_slider_crank(), pins={}), "RavnSliderCrank|SliderCrank"),
    "drive": (lambda: scene(drive=Steady(rate=0.01)), "drive = Steady"),
    "start": (lambda: scene(start="settled"), "start = 'settled'"),
    "other pin": (lambda: scene(pins={"front_base": hertz(1e10)}), "pins.front_base = ClearancePin"),
    "law": (
        lambda: scene(pin_with(KelvinVoigt(stiffness=1e8, damping=1e3))),
        r"pins.rear_base.contact.normal = KelvinVoigt",
    ),
    "changed law": (
        lambda: scene(pin_with(Softened(stiffness=1e10, restitution=0.5))),
        r"contact.normal = Softened",
    ),
    "friction": (
        lambda: scene(
            ClearancePin(contact=replace(contact(), friction=LuGre(**lugre()))),
        ),
        r"contact.friction = LuGre",
    ),
}


def pin_with(law: NormalLaw) -> ClearancePin:
    return ClearancePin(contact=replace(contact(), normal=law))


def lugre() -> dict[str, float]:
    """Fields of LuGre that have no default."""
    return {"sliding_coefficient": 0.25, "static_coefficient": 0.31}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_covered_is_refused(case: str) -> None:
    make, what = REFUSED[case]
    with pytest.raises(InputError, match=what) as caught:
        simulate_reduced(make())
    assert "allowed:" in str(caught.value)
    assert "support_exudyn.simulate, covers it" in str(caught.value)


@pytest.mark.parametrize("tolerance", [0.0, -1e-7, 0.1, float("nan")])
def test_a_tolerance_that_makes_no_sense_is_refused(tolerance: float) -> None:
    with pytest.raises(InputError, match="tolerance = "):
        simulate_reduced(scene(), tolerance)


def test_a_pin_may_be_said_to_be_ideal() -> None:
    said = simulate_reduced(scene(pins={PIN: IdealPin()}))
    unsaid = simulate_reduced(scene(pins={}))
    np.testing.assert_array_equal(said[FORCE], unsaid[FORCE])
    assert said.onsets == {}
    assert said.largest_force == {}


def test_an_unknown_channel_is_named() -> None:
    with pytest.raises(KeyError, match="no such channel"):
        simulate_reduced(scene(pins={}))["pin.front_base.force"]


# --- failures ---


def test_a_support_that_falls_through_its_pin_stops_at_a_dead_centre() -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_reduced(scene(hertz(1e3), duration=5.0))
    failure = caught.value.failure
    assert "dead centre" in failure.reason
    assert 0.5 < failure.time < 2.0  # a fall of metres
    assert failure.state["canopy.turn"] > 0.5


def test_a_run_with_too_many_steps_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("support_exudyn.reduced.simulate.MOST_STEPS", 10)
    with pytest.raises(SimulationError, match="more than 10 steps") as caught:
        simulate_reduced(scene())
    assert 0.0 < caught.value.failure.time < 0.05


def test_a_run_with_too_many_touches_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("support_exudyn.reduced.simulate.MOST_TOUCHES", 1)
    with pytest.raises(SimulationError, match="more than 1 touches"):
        simulate_reduced(scene(hertz(1e10), duration=0.3))


# --- parts ---


@numba.njit(error_model="numpy")
def _contact(p: Any, memory: Any, at: Posture, rate: Rates, spin: float, out: Any) -> None:
    contact_force(p, memory, at, rate, spin, out)


LAWS: list[NormalLaw] = [
    kind(stiffness=10**rng, exponent=n, restitution=e, damping_speed=speed)
    for kind in (LankaraniNikravesh, Exact, Flores, CarvalhoMartins)
    for rng, n, e, speed in (
        (10.4, 1.5, 0.9, TouchSpeed(floor=1e-3)),
        (8.5, 1.0, 0.3, DepthSpeed()),
        (12.0, 2.2, 0.6, DepthSpeed()),
    )
]
LAWS.append(Hertz(stiffness=1e10))


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{type(law).__name__}-{law.exponent}")
def test_the_force_is_that_of_the_law(law: NormalLaw, bore: str) -> None:
    bearing = JournalBearing(bore_radius=0.0655, clearance=0.0015)
    friction = Ambrosio(sliding_coefficient=0.25)
    laws = JournalContact(bearing=bearing, normal=law, friction=friction)
    scenario = scene(ClearancePin(contact=laws, bore=bore))
    p = parameters(scenario, support(), support().start(), scenario.clearance_pins[PIN])
    rng = np.random.default_rng(1)
    out = np.zeros(layout.CONTACT)
    sign = 1.0 if bore == "first" else -1.0
    for _ in range(20):
        angle, depth = rng.uniform(0, 7), 10 ** rng.uniform(-7, -3.5)
        x, y = (bearing.clearance + depth) * np.cos(angle), (bearing.clearance + depth) * np.sin(angle)
        vx, vy = rng.normal(size=2) * 10 ** rng.uniform(-4, -1)
        spin, speed = rng.normal() * 0.1, 10 ** rng.uniform(-4, 0)
        at = Posture(*np.zeros(len(Posture._fields)))._replace(
            cos_link=1.0, offset_x=sign * x, offset_y=sign * y
        )
        rate = Rates(*np.zeros(len(Rates._fields)))._replace(end_x=sign * vx, end_y=sign * vy)
        memory = np.array([1.0, speed, 1 / 700.0, 0.0, 1 / 700.0])  # 700 kg in every direction
        _contact(p, memory, at, rate, spin, out)
        spins = (0.0, spin) if bore == "first" else (spin, 0.0)
        expected = laws.force(x, y, vx, vy, *spins, Touch(speed, 700.0))
        got = out[[layout.DEPTH, layout.RATE, layout.SLIP, layout.NORMAL, layout.FRICTION]]
        # the same formula in another order; the depth is a difference of numbers 1e-3, right to 1e-12 at least
        np.testing.assert_allclose(got, expected[:5], rtol=1e-8, atol=1e-12)
        on_link = sign * np.array([expected.force_x, expected.force_y])
        np.testing.assert_allclose(out[[layout.FORCE_X, layout.FORCE_Y]], on_link, rtol=1e-8, atol=1e-9)
        arm = expected.journal_arm if bore == "first" else -(expected.journal_arm + np.hypot(x, y))
        assert out[layout.MOMENT] == pytest.approx(arm * expected.friction_force, rel=1e-8, abs=1e-9)


@numba.njit(error_model="numpy")
def _driven(segment: Any, t: float) -> tuple[float, float, float]:
    got = driven(segment, t)
    return got.extension, got.speed, got.acceleration


@pytest.mark.parametrize(
    "drive",
    [
        Held(),
        CubicStep(stroke=-0.3, start=0.0, end=1.5),
        CubicStep(stroke=0.3, start=0.5, end=3.0),
        UniformSpeed(stroke=0.3, start=0.5, end=1.0),
        UniformSpeed(stroke=0.3, start=3.0, end=4.0),
    ],
    ids=str,
)
def test_segments_are_the_drive(drive: Drive) -> None:
    rows = segments(drive, 2.0)
    assert rows[0, layout.BEGIN] == 0.0
    assert rows[-1, layout.END] == 2.0
    np.testing.assert_array_equal(rows[1:, layout.BEGIN], rows[:-1, layout.END])
    for row in rows:
        assert row[layout.JUMP] == drive.speed_jump(row[layout.BEGIN])
        for t in np.linspace(row[layout.BEGIN], row[layout.END], 7)[1:]:  # a break belongs to what is before
            extension, speed, acceleration = _driven(row, t)
            # rounding; the speed's central difference over 2e-6 s is right to 1e-9
            assert extension == pytest.approx(drive.extension(t), abs=1e-15)
            assert speed == pytest.approx(drive.speed(t), abs=1e-14)
            if t < row[layout.END]:
                slope = (drive.speed(t + 1e-6) - drive.speed(t - 1e-6)) / 2e-6
                assert acceleration == pytest.approx(slope, abs=1e-8)


def test_records_are_multiples_of_the_period_and_the_end() -> None:
    np.testing.assert_array_equal(record_times(1.0, 0.25), [0.0, 0.25, 0.5, 0.75, 1.0])
    np.testing.assert_allclose(record_times(1.0, 0.3), [0.0, 0.3, 0.6, 0.9, 1.0], rtol=1e-15)
    assert record_times(0.3, 0.1)[-1] == 0.3
    assert record_times(5.0, 1e-3).size == 5001


@numba.njit(error_model="numpy")
def _energy(p: Any, canopy: float, link: float, canopy_rate: float, link_rate: float) -> float:
    """Kinetic energy and that of weight, columns held at their start length."""
    at = posture(p, canopy, link, 0.0)
    arm = arms(p, at)
    x = p[layout.CANOPY_MASS] * (at.hinge_x + arm.canopy_x) + p[layout.SHIELD_MASS] * (
        at.hinge_x + arm.shield_x
    )
    y = p[layout.CANOPY_MASS] * (at.hinge_y + arm.canopy_y) + p[layout.SHIELD_MASS] * (
        at.hinge_y + arm.shield_y
    )
    x += p[layout.FRONT_LINK_MASS] * arm.front_x
    y += p[layout.FRONT_LINK_MASS] * arm.front_y
    x += p[layout.REAR_LINK_MASS] * (at.hinge_x + at.cx + arm.rear_x)
    y += p[layout.REAR_LINK_MASS] * (at.hinge_y + at.cy + arm.rear_y)
    kinetic = kinetic_energy(p, at, rates(p, at, canopy_rate, link_rate, 0.0, 0.0), canopy_rate, link_rate)
    return kinetic - p[layout.GRAVITY_X] * x - p[layout.GRAVITY_Y] * y


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("law", [Hertz(stiffness=2.7e10), Exact(stiffness=2.7e10, restitution=0.6)], ids=str)
def test_energy_adds_up(law: Hertz | Exact, bore: str) -> None:
    scenario = scene(
        ClearancePin(contact=replace(contact(), normal=law), bore=bore), duration=0.3, gravity=(2.0, -9.0)
    )
    result = simulate_reduced(scenario, 1e-10)
    machine, start = support(), support().start()
    p = parameters(scenario, machine, start, scenario.clearance_pins[PIN])
    turn = result["rear_link.angle"] - result["rear_link.angle"][0] + start.rear_link
    states = (
        result["canopy.angle"],
        turn,
        result["canopy.angular_velocity"],
        result["rear_link.angular_velocity"],
    )
    mechanical = np.array([_energy(p, *state) for state in np.transpose(states)])
    stored = np.array([law.elastic_energy(d) if d > 0.0 else 0.0 for d in result["pin.rear_base.depth"]])
    lost = result["energy.damping_loss"] + result["energy.friction_loss"]
    balance = mechanical + stored + lost
    # measured 3e-7 at this tolerance, in proportion to it; friction's kinks leave the most
    assert lost[-1] > 1.0
    assert np.abs(balance - balance[0]).max() < 1e-6 * lost[-1]


# --- the same numbers everywhere ---


def _bytes() -> bytes:
    result = simulate_reduced(scene(duration=0.2))
    return b"".join(channel.tobytes() for channel in result.channels.values())


def test_runs_are_the_same_bit_for_bit_also_in_another_process() -> None:
    warm_up()
    here = _bytes()
    assert _bytes() == here
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(_bytes).result() == here


def test_records_do_not_change_the_run() -> None:
    coarse = simulate_reduced(scene(duration=0.2, record_period=0.1))
    fine = simulate_reduced(scene(duration=0.2, record_period=1e-4))
    assert coarse.onsets == fine.onsets
    assert coarse[FORCE][-1] == fine[FORCE][-1]
