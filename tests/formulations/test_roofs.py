"""Roofs by a reaction curve: closed forms, an independent integrator, both formulations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support_exudyn import (
    GroundReaction,
    Scenario,
    SolverSettings,
    SpringDamper,
    reference_support,
    simulate,
)
from support_exudyn.model.loads.load import ActingLoad
from tests.roof_cases import DAMPED, MASS, OVER_THE_COLUMNS, TOP, Ram

EXACT = SolverSettings(tolerance=1e-9)


def over_the_canopy(load: ActingLoad | dict[str, ActingLoad], **changes: object) -> Scenario:
    fields: dict[str, object] = {
        "machine": reference_support(), "loads": load if isinstance(load, dict) else {"roof": load},
        "duration": 0.15, "actuators": DAMPED, "start": "settled",
        "step": 2.5e-4, "record_period": 1e-3,
    }  # fmt: skip
    return Scenario(**fields | changes)


@pytest.mark.parametrize("load", ["linear", "smooth"])
def test_kinks_of_the_force_cost_no_accuracy(load: str) -> None:
    # by where the point is, so that nothing tells when: two tolerances of the method with error control
    roof = reaction(body="canopy", between=load)
    scene = over_the_canopy(roof, formulation="compiled")
    rough, fine = (
        simulate(replace(scene, solver=SolverSettings(tolerance=t)))["front_column.force"] for t in (1e-6, 1e-9)
    )
    np.testing.assert_allclose(rough / fine.max(), fine / fine.max(), atol=1e-5)


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
