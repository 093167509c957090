"""A load and a pin that gives way, each one class of this file: both solvers, equilibrium, channels, pages."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from support_exudyn import (
    CompliantPin,
    Load,
    LoadChannel,
    PinPlace,
    Result,
    Scenario,
    SolverSettings,
    TorsionSpring,
    simulate,
    value,
)
from support_exudyn.model.loads.load import ActingLoad
from tests.formulations.test_bushing_pin import MASS as BLOCK_MASS
from tests.formulations.test_bushing_pin import Block
from tests.roof_cases import MASS, TOP, Ram
from user_forces.kernel import kernel
from user_forces.values.value import Vector2

K, LIMIT, DAMPING, G = 2e5, 0.02, 300.0, 9.81


@kernel
def stiffening(way: float, rate: float, stiffness: float, limit: float, damping: float) -> tuple[float, ...]:
    """Force, energy and loss of a spring that grows stiffer, and of a damper."""
    square = way * way
    force = -stiffness * (1.0 + square / limit**2) * way - damping * rate
    return force, 0.5 * stiffness * square * (1.0 + 0.5 * square / limit**2), damping * rate * rate


@value
class OwnBuffer(Load):
    """A stiffening spring and a damper under a point.

    Arguments:
        stiffness: at the start [N/m]. limit: way at which it is doubled [m]. damping: [N s/m].
    """

    stiffness: float = K
    limit: float = LIMIT
    damping: float = DAMPING

    @staticmethod
    @kernel
    def action(
        t: float, x: float, y: float, vx: float, vy: float, z: float, vz: float, *spring: float
    ) -> tuple[float, ...]:
        force, stored, loss = stiffening(y, vy, spring[0], spring[1], spring[2])
        return 0.0, force, 0.0, stored, 0.0, loss, force, -y

    @property
    def spring(self) -> tuple[float, ...]:
        return self.stiffness, self.limit, self.damping

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        return {"force": LoadChannel("N", "of the buffer, up"), "pressed": LoadChannel("m", "how far it gives")}

    @property
    def steepness(self) -> tuple[float, ...]:
        return 0.0, self.stiffness, 0.0


@value
class _Rubber(OwnBuffer):
    """The same up and down, and a straight spring forward, between the points of two bodies."""

    other: str
    other_point: Vector2

    def against(self, name: str) -> str:
        return self.other

    @property
    def origin(self) -> Vector2:
        return self.other_point

    @staticmethod
    @kernel
    def action(
        t: float, x: float, y: float, vx: float, vy: float, z: float, vz: float, *spring: float
    ) -> tuple[float, ...]:
        force, stored, loss = stiffening(y, vy, spring[0], spring[1], spring[2])
        return -K * x, force, 0.0, stored + 0.5 * K * x * x, 0.0, loss, math.hypot(K * x, force), -y


@value
class OwnRubberPin(CompliantPin):
    """A bushing of rubber.

    Arguments:
        stiffness: at the start [N/m].
    """

    stiffness: float = K

    def loads(self, place: PinPlace) -> Mapping[str, ActingLoad]:
        point, origin = place.second_point, place.first_point
        rubber = _Rubber(
            body=place.second, point=point, other=place.first, other_point=origin, stiffness=self.stiffness
        )
        return {"force": rubber}


SCENES = {
    "load": Scenario(machine=Ram(), loads={"own": OwnBuffer(body="ram", point=TOP)}, duration=0.2, step=1e-4),
    "pin": Scenario(
        machine=Block(),
        pins={"mount": OwnRubberPin()},
        duration=0.2,
        step=1e-4,
        loads={"upright": TorsionSpring(body="block", stiffness=300.0)},
    ),
}
MASSES, STEMS = {"load": MASS, "pin": BLOCK_MASS}, {"load": "own", "pin": "pin.mount"}
each = pytest.mark.parametrize("kind", SCENES)
both = pytest.mark.parametrize("formulation", ["exudyn", "compiled"])


def run(kind: str, formulation: str, **changes: object) -> Result:
    solver = SolverSettings(tolerance=1e-9, newton_tolerance=1e-11)
    return simulate(
        replace(SCENES[kind], formulation=formulation, record_period=1e-3, solver=solver, **changes)
    )


@each
@both
def test_it_settles_where_its_force_is_the_weight(kind: str, formulation: str) -> None:
    result, weight = run(kind, formulation, start="settled", duration=0.01), MASSES[kind] * G
    down = brentq(lambda way: stiffening(-way, 0.0, K, LIMIT, 0.0)[0] - weight, 0.0, weight / K)
    assert result[f"{STEMS[kind]}.pressed"] == pytest.approx(down, rel=1e-8)
    assert result[f"{STEMS[kind]}.force"] == pytest.approx(weight, rel=1e-6)


@each
@both
def test_it_swings_as_by_scipy_and_its_energies_add_up(kind: str, formulation: str) -> None:
    result, mass = run(kind, formulation), MASSES[kind]

    def rates(t: float, state: np.ndarray) -> list[float]:
        return [state[1], stiffening(state[0], state[1], K, LIMIT, DAMPING)[0] / mass - G]

    found = solve_ivp(rates, (0.0, 0.2), [0.0, 0.0], "DOP853", rtol=1e-11, atol=1e-13)
    pressed = result[f"{STEMS[kind]}.pressed"]
    # second order in the step of the engine
    share = 3e-4 if formulation == "exudyn" else 1e-6
    assert pressed[-1] == pytest.approx(-found.y[0, -1], abs=share * np.abs(pressed).max())
    turned = np.ptp(result["energy.potential"])
    assert result.energy_error < 1e-3 * turned
    assert result["energy.damping_loss"][-1] > 1e-3 * turned
