"""Whether pins shake, told of scenarios: in a mirror, turned, in other units, with loads, of any machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from studies.common.paper_machine import clearance_rise
from support_exudyn import (
    AppliedForce,
    AppliedTorque,
    ClearancePin,
    Scenario,
    SpringDamper,
    Steady,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.mechanics.pin_stability import painleve_friction
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.scenario.pin_stability import PinOutlook, pin_outlooks
from tests.metamorphic.moving import MIRROR, Move, moved, turn
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Ambrosio,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    external_contact_stiffness,
)

BEARING = JournalBearing(bore_radius=0.0655, clearance=1.5e-3)
TIMES = (3.5, 4.0, 4.5)  # of the rise [s]


def contact(mu: float = 0.25, factor: float = 1.0) -> JournalContact:
    stiffness = factor * external_contact_stiffness(BEARING, STEEL, STEEL_35CRMO)
    normal = LankaraniNikravesh(stiffness=stiffness, restitution=0.9)
    return JournalContact(bearing=BEARING, normal=normal, friction=Ambrosio(sliding_coefficient=mu))


def rise(pin: str = "rear_base", mu: float = 0.25) -> Scenario:
    return replace(clearance_rise(1.5, mu, 1e-3), pins={pin: ClearancePin(contact=contact(mu))})


def roots(outlooks: Sequence[PinOutlook]) -> dict[str, list[np.ndarray]]:
    return {one.pin: [np.sort_complex(pin.roots) for pin in one.found if pin] for one in outlooks}


def check_alike(one: Sequence[PinOutlook], other: Sequence[PinOutlook], factor: float = 1.0) -> None:
    known, found = roots(one), roots(other)
    assert known.keys() == found.keys()
    for name in known:
        for a, b in zip(known[name], found[name], strict=True):
            assert factor * b == pytest.approx(a, rel=1e-5, abs=1e-6 * np.abs(a).max())


@pytest.mark.parametrize("move", [MIRROR, turn(137.0), Move(shift=(3.0, -2.0))])
def test_a_machine_that_is_elsewhere_shakes_alike(move: Move) -> None:
    scene = rise()
    check_alike(pin_outlooks(scene, TIMES), pin_outlooks(moved(scene, move), TIMES))


def test_front_pins_are_stable_and_rear_pins_shake() -> None:
    """So an independent linearisation found it, too; with a Painleve threshold of .23 and 63 Hz."""
    found = {one.pin: one for one in pin_outlooks(rise(), [4.0])}
    stable = {name: one.stable for name, one in found.items()}
    assert stable == {
        "rear_base": False, "rear_shield": False,
        "front_base": True, "front_shield": True, "shield_canopy": True,
    }  # fmt: skip
    rear = found["rear_base"].found[0]
    assert rear is not None
    assert rear.frequency == pytest.approx(63.0, rel=0.05)
    assert painleve_friction(found["rear_base"].journals[0], contact()) == pytest.approx(0.202, abs=2e-3)
    assert [one.assumed for one in found.values()] == [False, True, True, True, True]


@pytest.mark.parametrize(
    ("pin", "formulation"),
    [("rear_base", "compiled"), ("rear_shield", "exudyn"), ("shield_canopy", "exudyn")],
)
def test_the_equilibrium_is_where_a_run_stays(pin: str, formulation: str) -> None:
    """A journal that starts there goes on with the load's direction, which turns slowly."""

    def scene(eccentricity: tuple[float, float] = (0.0, 0.0)) -> Scenario:
        return Scenario(
            machine=reference_support(),
            drive=Steady(rate=0.4),
            duration=2e-3,
            step=1e-4,
            record_period=1e-4,
            formulation=formulation,
            pins={pin: ClearancePin(contact=contact(0.1), eccentricity=eccentricity)},
        )

    found = next(one for one in pin_outlooks(scene(), [0.0]) if one.pin == pin).found[0]
    assert found is not None
    x, y = found.place.tolist()
    run = simulate(scene((x, y)))
    assert np.ptp(run[f"pin.{pin}.depth"]) < 2e-3 * found.depth
    assert run[f"pin.{pin}.normal_force"][0] == pytest.approx(found.normal_force, rel=1e-6)
    assert run[f"pin.{pin}.slip"][0] == pytest.approx(found.slip, rel=1e-3)
    away = np.hypot(run[f"pin.{pin}.eccentricity_x"] - x, run[f"pin.{pin}.eccentricity_y"] - y)
    assert away.max() < 1e-3 * found.depth


TIP = rise().linkage.points["tip"].point


@pytest.mark.parametrize(
    "load",
    [
        AppliedForce(body="canopy", point=TIP, full_force=(0.0, -1e5)),
        SpringDamper(body="canopy", point=TIP, other="shield", other_point=(0.0, 1.0), stiffness=1e6),
        AppliedTorque(body="canopy", other="shield", full_torque=1e5),
    ],
    ids=["force", "spring", "torque"],
)
def test_a_load_on_the_canopy_is_carried_by_the_pins(load: ActingLoad) -> None:
    scene = rise()
    free, loaded = (
        pin_outlooks(one, [4.0])[0].journals[0] for one in (scene, replace(scene, loads={"block": load}))
    )
    run = simulate(
        replace(scene, loads={"block": load}, pins={}, step=1e-2, record_period=0.1, formulation="exudyn")
    )
    at = int(np.argmin(np.abs(run.time - 4.0)))
    # of the pin without play; with it the machine stands by 1.5 mm otherwise
    known = np.array([run["pin.rear_base.force_x"][at], run["pin.rear_base.force_y"][at]])
    assert np.linalg.norm(loaded.load - free.load) > 1e3
    assert loaded.load == pytest.approx(known, abs=0.01 * np.linalg.norm(loaded.load - free.load))


def test_a_slider_crank_over_one_turn() -> None:
    bearing = JournalBearing(bore_radius=0.01, clearance=0.5e-3)
    normal = LankaraniNikravesh(stiffness=6e10, restitution=0.9)
    laws = JournalContact(bearing=bearing, normal=normal, friction=Ambrosio(sliding_coefficient=0.03))
    scene = Scenario(
        machine=ravn_slider_crank(),
        drive=Steady(rate=50.0),
        duration=1.0,
        pins={"slider_pin": ClearancePin(contact=laws)},
    )
    found = {one.pin: one for one in pin_outlooks(scene)}
    assert set(found) == set(scene.linkage.pins)
    assert found["slider_pin"].travels.max() < 2.0 * np.pi
    assert found["slider_pin"].travels.max() > 1.9 * np.pi
    ideal = simulate(replace(scene, pins={}, duration=0.15, step=1e-4, record_period=1e-3))
    force = np.array(
        [
            [np.interp(t, ideal.time, ideal[f"pin.slider_pin.force_{axis}"]) for axis in "xy"]
            for t in found["slider_pin"].times
        ]
    )
    loads = np.array([one.load for one in found["slider_pin"].journals])
    assert np.abs(loads - force).max() < 0.02 * np.abs(force).max()


def test_which_body_has_the_bore_is_no_matter_of_the_load() -> None:
    """A journal on the other body is pushed the other way, and lies on the other side of its bore."""
    one = pin_outlooks(rise(), [4.0])[0]
    scene = rise()
    pins = {"rear_base": ClearancePin(contact=contact(), bore="second")}
    other = pin_outlooks(replace(scene, pins=pins), [4.0])[0]
    assert other.journals[0].load == pytest.approx(-one.journals[0].load, rel=1e-2)
    assert other.journals[0].inverse_mass == pytest.approx(one.journals[0].inverse_mass, rel=2e-2)
    assert other.journals[0].bore_spin == pytest.approx(one.journals[0].journal_spin, rel=1e-2)
    assert other.journals[0].journal_spin == 0.0
