"""A support on columns of oil in the compiled formulation: against the engine, and its own refinement."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Literal

import numpy as np
import pytest

from support_exudyn import (
    Body,
    ClearancePin,
    CubicStep,
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
from tests.cases.run_cases import PIN, paper_contact, support
from user_forces import (
    BrownMcPhee,
    Flores,
    JournalBearing,
    JournalContact,
    value,
)

OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
BOTH = {"front_column": OIL, "rear_column": OIL}


def on_oil(tolerance: float = 1e-8, friction: float = 0.25, **changes: object) -> Scenario:
    """The support on oil with a clearance of 1.5 mm."""
    fields: dict[str, object] = {
        "pins": {PIN: ClearancePin(contact=paper_contact(1.5, friction))},
        "actuators": BOTH,
        "formulation": "compiled",
        "solver": SolverSettings(tolerance=tolerance),
    }
    return support(**fields | changes)


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
