"""The scenes that others have computed, each as finely as what is asked of it."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from studies.outside.computed_torque import ComputedTorque
from support_exudyn import ClearancePin, CubicStep, Scenario, SolverSettings, Steady, machine
from support_exudyn.files.machines import load_machine
from support_exudyn.model.guides import ClearanceGuide
from user_forces import (
    Ambrosio,
    Exact,
    FrictionLaw,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
)

HERE = Path(__file__).parent
CRANK = 60.0  # of the crank-rocker [rad/s]
TURN = 2.0 * math.pi / CRANK  # [s]
GAP = 0.005  # of the four-bar's pins [m]
STIFF, PLASTIC = 1e9, 0.05  # smooth contact in place of plastic impacts: K [N/m^1.5], restitution
SMOOTH = Frictionless()
KEPT = 1e-9  # rest velocity [m/s]: sources damp a contact by its impact velocity alone


def crank_rocker() -> Scenario:
    """The crank-rocker with ideal pins, driven."""
    return Scenario(
        machine=machine("crank_rocker"), drive=Steady(rate=CRANK), duration=0.08, step=2e-5, record_period=1e-3
    )


def loose_crank_rocker() -> Scenario:
    """The crank-rocker with a clearance of 0.5 mm in the pin of coupler and rocker, one turn."""
    normal = LankaraniNikravesh(stiffness=1e10, restitution=0.9, rest_velocity=KEPT)
    return Scenario(
        machine=machine("crank_rocker"),
        pins={"B": _pin(JournalBearing(bore_radius=0.01, clearance=0.0005), normal, "second")},
        drive=Steady(rate=CRANK),
        duration=TURN,
        step=3e-6,  # by which flights and impacts, of 2560 steps, err alike
        record_period=TURN / 400,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=2560),
    )


def watt_six_bar() -> Scenario:
    """Watt's six-bar with ideal pins, driven."""
    return Scenario(
        machine=machine("watt_six_bar"), drive=Steady(rate=40.0), duration=0.05, step=1e-5, record_period=1e-3
    )


def free_crank_rocker() -> Scenario:
    """The crank-rocker that a spring, a damper and a torque move."""
    found = load_machine(HERE / "free_crank_rocker.toml").machine
    return Scenario(machine=found, duration=2.0, step=2e-5, record_period=0.1)


def three_loose_pins() -> Scenario:
    """The four-bar with three loose pins; smooth contact of low restitution in place of plastic impacts."""
    found = load_machine(HERE / "four_bar.toml").machine
    bearing = JournalBearing(bore_radius=0.06, clearance=GAP)
    normal, friction = Exact(stiffness=STIFF, restitution=PLASTIC), Ambrosio(sliding_coefficient=0.1)
    bores: dict[str, Literal["first", "second"]] = {"A": "second", "B": "second", "C": "first"}
    start = found.linkage().bodies["crank"].angle
    return Scenario(
        machine=found,
        loads={"motor": ComputedTorque(body="crank", start=start)},
        pins={name: _pin(bearing, normal, bore, friction) for name, bore in bores.items()},
        duration=1.0,
        step=2e-4,
        record_period=1e-2,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=32),
    )


def guided(stiffness: float, duration: float, step: float, friction: FrictionLaw = SMOOTH) -> Scenario:
    """The slider-crank with a clearance of 1 mm on either side of its guide, left to itself.

    Arguments:
        stiffness: of the contact at every corner [N/m^1.5]. duration, step: [s]. friction: its law.
    """
    guide = ClearanceGuide(
        gaps=(1e-3, 1e-3),
        block=(0.1, 0.05),
        normal=Exact(stiffness=stiffness, restitution=0.4, rest_velocity=KEPT),
        friction=friction,
    )
    return Scenario(
        machine=machine("slider_crank_guide"),
        guides={"slot": guide},
        duration=duration,
        step=step,
        record_period=1e-3,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=128),
    )


def slider_crank() -> Scenario:
    """The slider-crank with clearance in its guide, without friction."""
    return guided(1e9, 0.05, 5e-6)


def stiffer_slider_crank() -> Scenario:
    """The slider-crank with contact 100 times as stiff."""
    return guided(1e11, 0.02, 5e-6)


def stiffest_slider_crank() -> Scenario:
    """The slider-crank with contact 10 000 times as stiff."""
    return guided(1e13, 0.02, 2.5e-6)


def rough_slider_crank() -> Scenario:
    """The slider-crank with friction of 0.01, as Siconos has run it."""
    return guided(1e9, 0.02, 1e-5, Ambrosio(sliding_coefficient=0.01))


def velenje_shield() -> Scenario:
    """The four-bar of Velenje's support on its leg."""
    rise = CubicStep(stroke=0.6, start=0.0, end=1.0)
    return Scenario(machine=machine("velenje_shield"), drive=rise, duration=1.0, step=1e-3, record_period=1e-2)


def _pin(
    bearing: JournalBearing,
    normal: NormalLaw,
    bore: Literal["first", "second"],
    friction: FrictionLaw = SMOOTH,
) -> ClearancePin:
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=normal, friction=friction), bore=bore)


SCENES: dict[str, Callable[[], Scenario]] = {
    one.__name__: one
    for one in (
        crank_rocker,
        loose_crank_rocker,
        watt_six_bar,
        free_crank_rocker,
        three_loose_pins,
        slider_crank,
        stiffer_slider_crank,
        stiffest_slider_crank,
        rough_slider_crank,
        velenje_shield,
    )
}
