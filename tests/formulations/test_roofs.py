"""Roofs over a stretch and by a reaction curve: closed forms, an independent integrator, both formulations."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support_exudyn import (
    BeddedRoof,
    Body,
    CubicStep,
    GroundReaction,
    Linkage,
    Machine,
    Scenario,
    SolverSettings,
    SpringDamper,
    simulate,
)
from support_exudyn.model.linkage import pinned
from tests.roof_cases import MASS, OVER_THE_COLUMNS, TOP, Ram
from user_forces import value

EXACT = SolverSettings(tolerance=1e-9)


@value
class Plate(Machine):
    """A plate of 4 m and 1 t on a pivot in its middle, and nothing else."""

    spin: float = 0.0

    def linkage(self) -> Linkage:
        plate = Body(mass=1000.0, inertia=1500.0, centre=(0.0, 1.0), spin=self.spin)
        return Linkage(bodies={"plate": plate}, pins={"pivot": pinned("ground", "plate", (0.0, 1.0))})


def over_the_plate(**changes: object) -> BeddedRoof:
    fields: dict[str, object] = {
        "body": "plate", "points": ((-2.0, 1.0), (2.0, 1.0)), "bedding": 1e6, "gaps": (0.01, 0.002),
        "descent": CubicStep(stroke=0.012, start=0.0, end=0.2), "damping": 0.3,
    }  # fmt: skip
    return BeddedRoof(**fields | changes)


@cache
def tilted(damping: float) -> np.ndarray:
    """Angle and spin of the plate after 0.6 s, with the integral over 4000 points (the rule of midpoints)."""
    roof = over_the_plate(damping=damping)
    s = (np.arange(4000) + 0.5) / 4000
    x = -2.0 + 4.0 * s
    gaps = 0.01 + s * (0.002 - 0.01)

    def rates(t: float, state: np.ndarray) -> list[float]:
        angle, spin = state
        depth = roof.descent.extension(t) + x * math.sin(angle) - gaps
        rate = roof.descent.speed(t) + x * math.cos(angle) * spin
        spread = 1e6 * np.maximum(0.0, depth) * np.maximum(0.0, 1.0 + damping * rate)
        return [spin, -float((spread * x).mean()) * 4.0 * math.cos(angle) / 1500.0]

    found = solve_ivp(rates, (0.0, 0.6), [0.0, 0.0], "DOP853", rtol=1e-10, atol=1e-12, max_step=1e-3)
    return found.y[:, -1]


@pytest.mark.parametrize(("formulation", "share"), [("exudyn", 2e-4), ("compiled", 1e-6)])
@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_a_bedding_is_the_integral_over_its_stretch(formulation: str, share: float, damping: float) -> None:
    scene = Scenario(
        machine=Plate(), loads={"roof": over_the_plate(damping=damping)}, duration=0.6, step=1e-4,
        formulation=formulation, solver=EXACT,
    )  # fmt: skip
    result = simulate(scene)
    found = np.array([result["plate.angle"][-1], result["plate.angular_velocity"][-1]])
    size = [np.abs(result[f"plate.{what}"]).max() for what in ("angle", "angular_velocity")]
    # the reference's own points are good to 1e-7
    np.testing.assert_allclose(found / size, tilted(damping) / size, atol=share)
    turned = np.abs(result["energy.work"]).max()
    assert result.energy_error < 1e-4 * turned
    if damping > 0.0:
        assert result["energy.damping_loss"][-1] > 1e-3 * turned


# --- a reaction curve ---


def reaction(**changes: object) -> GroundReaction:
    fields: dict[str, object] = {
        "body": "ram", "point": TOP, "convergences": (0.0, 0.002, 0.005, 0.02),
        "forces": (4e5, 2.5e5, 1e5, 6e4), "between": "linear",
    }  # fmt: skip
    if changes.get("body") == "canopy":
        changes["point"] = OVER_THE_COLUMNS
    return GroundReaction(**fields | changes)


@pytest.mark.parametrize("between", ["linear", "smooth"])
# redundant: second order, four times less with half the steps
@pytest.mark.parametrize(("formulation", "share"), [("exudyn", 4e-4), ("compiled", 1e-7)])
def test_a_ram_under_a_reaction_curve_is_as_by_scipy(between: str, formulation: str, share: float) -> None:
    roof = reaction(between=between)
    hold = SpringDamper(body="ram", point=TOP, other_point=(0.0, 0.0), stiffness=3e7, free_length=1.0)
    scene = Scenario(
        machine=Ram(), loads={"roof": roof, "hold": hold}, duration=0.2, step=5e-5,
        formulation=formulation, solver=EXACT,
    )  # fmt: skip
    result = simulate(scene)

    def curve(down: float) -> float:
        if between == "linear":
            return float(np.interp(down, roof.convergences, roof.forces))
        from scipy.interpolate import PchipInterpolator

        first, *inner, last = roof.convergences
        table = PchipInterpolator([first - 1.0, first, *inner, last, last + 1.0], [4e5, *roof.forces, 6e4])
        return float(table(min(max(down, first - 0.5), last + 0.5)))

    def rates(t: float, state: np.ndarray) -> list[float]:
        up, speed = state
        return [speed, (-3e7 * up - curve(-up)) / MASS - 9.81]

    found = solve_ivp(rates, (0.0, 0.2), [0.0, 0.0], "DOP853", rtol=1e-11, atol=1e-13, max_step=2e-4)
    size = np.abs(result["ram.y"] - TOP[1]).max()
    assert size > 0.005  # past two of the curve's points
    assert result["ram.y"][-1] - TOP[1] == pytest.approx(found.y[0, -1], abs=share * size)
    assert result.energy_error < 1e-3 * np.abs(result["energy.work"]).max()
    expected = [curve(one) for one in result["roof.convergence"]]
    np.testing.assert_allclose(result["roof.force"], expected, rtol=1e-9)
