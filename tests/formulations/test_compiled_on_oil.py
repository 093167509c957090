"""A support on columns of oil in the compiled formulation: against the engine, and its own refinement."""

from __future__ import annotations

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
    Held,
    Linkage,
    Machine,
    OilColumn,
    Reciprocating,
    Result,
    Scenario,
    SimulationError,
    SolverSettings,
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
NORMAL = ("exact", "kelvin_voigt", "anagnostopoulos", "johnson")


def on_oil(tolerance: float = 1e-8, friction: float = 0.25, **changes: object) -> Scenario:
    """The support on oil with a clearance of 1.5 mm."""
    fields: dict[str, object] = {
        "pins": {PIN: ClearancePin(contact=paper_contact(1.5, friction))},
        "actuators": BOTH,
        "formulation": "compiled",
        "solver": SolverSettings(tolerance=tolerance),
    }
    return support(**fields | changes)


# --- against the formulation on Exudyn ---


def test_the_formulation_on_exudyn_tends_to_the_compiled_one() -> None:
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


@cache
def rise(tolerance: float) -> Result:
    """A short rise that begins in the middle of the impacts."""
    return simulate(on_oil(tolerance, drive=CubicStep(start=0.03, end=0.4, stroke=0.05), duration=0.2))


def test_errors_fall_with_the_tolerance() -> None:
    exact = rise(1e-11)

    def off(tolerance: float) -> float:
        difference = rise(tolerance)["rear_link.angle"] - exact["rear_link.angle"]
        return float(np.abs(difference).max())

    # impacts amplify errors a hundredfold and more, but in proportion; a kink of friction that is met elsewhere
    # in a step makes up to a factor of ten
    assert off(1e-9) < 0.05 * off(1e-6)
    assert off(1e-6) < 1e-5
    # of what its errors are see `simulate_as_fine`; measured 1.1e-6 s at 1e-5
    for one, other in zip(rise(1e-6).onsets[PIN][:2], exact.onsets[PIN][:2], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-3)
        assert one.time == pytest.approx(other.time, abs=1e-6)


def test_energy_adds_up() -> None:
    for tolerance, allowed in ((1e-6, 1e-4), (1e-8, 1e-5), (1e-11, 1e-8)):
        result = rise(tolerance)
        # the share of the dissipated energy falls with the tolerance; it amounts to some tens of joule
        assert result.dissipated > 10.0
        assert result.energy_error < allowed * result.dissipated


# of laws with hysteresis, a dashpot, one that asks for tension, cylinders, and of friction
LAWS = {
    **{f"normal {name}": {"normal": normal_laws(1.5, 0.3)[name]} for name in NORMAL},
    **{f"friction {name}": {"friction": friction_laws(0.25)[name]} for name in ("stribeck", "threlfall")},
}


@pytest.mark.parametrize("name", LAWS)
def test_laws_of_every_kind(name: str) -> None:
    pin = ClearancePin(contact=replace(paper_contact(1.5, 0.0), **LAWS[name]))
    coarse, fine = (simulate(on_oil(t, drive=Held(), duration=0.06, pins={PIN: pin})) for t in (1e-7, 1e-10))
    assert len(coarse.onsets[PIN]) == len(fine.onsets[PIN]) >= 1
    for one, other in zip(coarse.onsets[PIN], fine.onsets[PIN], strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-3, abs=1e-5)
    assert fine.energy_error < 1e-6 * fine.dissipated
    assert (fine["energy.friction_loss"][-1] > 0.1) == name.startswith("friction")


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
