"""The connectors of the engine that a pin uses: which one, what they conserve, and that all act alike."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any, Literal

import numpy as np
import pytest

from support_exudyn import ClearancePin, Held, Result, Scenario, SolverSettings, simulate
from support_exudyn.formulations.redundant.clearance.clearance_pin import ClearanceJoint
from support_exudyn.formulations.redundant.clearance.connector_force import Attachment, attachment
from support_exudyn.formulations.redundant.scene.scene_builder import build
from tests.cases.run_cases import PIN, Pair, loose_support, paper_contact
from tests.formulations.test_momentum import ONE, TWO, momenta
from user_forces import (
    Ambrosio,
    FrictionLaw,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
)

Backend = Literal["python", "symbolic"]
BEARING = JournalBearing(bore_radius=0.02, clearance=0.001)
NEARLY = Ambrosio(sliding_coefficient=1e-12)  # no friction, but the connector of one


def contact(friction: FrictionLaw = Frictionless()) -> JournalContact:  # noqa: B008
    normal = LankaraniNikravesh(stiffness=1e9, restitution=0.9)
    return JournalContact(bearing=BEARING, normal=normal, friction=friction)


@cache
def fly(law: JournalContact, bore: Literal["first", "second"], backend: Backend) -> Result:
    """Two free bodies that turn against each other, joined by the pin alone."""
    scenario = Scenario(
        machine=Pair(one=ONE, two=TWO, one_point=(0.2, 0.25), two_point=(0.2, 0.25)),
        pins={"pin": ClearancePin(contact=law, bore=bore)},
        duration=0.03,
        step=1e-4,
        gravity=(0.0, 0.0),
        solver=SolverSettings(backend=backend, newton_tolerance=1e-10),
    )
    return simulate(scenario)


@pytest.mark.parametrize(
    ("friction", "ends", "expected"),
    [
        (Frictionless(), (True, False), Attachment.LINE),
        (Frictionless(), (False, False), Attachment.LINE),
        (NEARLY, (True, False), Attachment.JOURNAL),
        (NEARLY, (False, True), Attachment.BORE),
        (NEARLY, (False, False), Attachment.MIDDLE),
    ],
)
def test_the_least_connector_that_does_is_taken(
    friction: FrictionLaw, ends: tuple[bool, bool], expected: Attachment
) -> None:
    assert attachment(contact(friction), *ends) is expected


EVERY_WAY = pytest.mark.parametrize(("bore", "backend"), [("first", "python"), ("second", "symbolic")])


@EVERY_WAY
def test_momentum_is_kept_without_friction(bore: Literal["first", "second"], backend: Backend) -> None:
    result = fly(contact(), bore, backend)
    assert len(result.onsets["pin"]) >= 3  # else the test says nothing
    assert result["one.angular_velocity"].std() > 0.1
    linear, angular = momenta(result, ONE, TWO)
    # rounding of some thousand steps
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-12)
    # asked for; what is left is the integrator's, and falls with the square of its steps
    np.testing.assert_allclose(angular, angular[0], rtol=1e-6)


@EVERY_WAY
def test_two_free_bodies_move_alike_on_every_connector(
    bore: Literal["first", "second"], backend: Backend
) -> None:
    lean, full = (fly(contact(friction), bore, backend) for friction in (Frictionless(), NEARLY))
    one, two = lean.onsets["pin"], full.onsets["pin"]
    assert len(one) == len(two) >= 3
    # a coefficient of friction of 1e-12
    assert [impact.time for impact in one] == pytest.approx([impact.time for impact in two], rel=1e-8)
    assert [impact.speed for impact in one] == pytest.approx([impact.speed for impact in two], rel=1e-6)
    for name in ("one.x", "two.angle", "one.angular_velocity"):
        np.testing.assert_allclose(lean[name], full[name], rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize("bore", ["first", "second"])
def test_the_support_moves_alike_on_every_connector(bore: Literal["first", "second"]) -> None:
    def impacts(law: JournalContact, backend: Backend) -> list[tuple[float, float]]:
        pins = {PIN: ClearancePin(contact=law, bore=bore)}
        solver = SolverSettings(backend=backend, impact_steps=64)
        result = simulate(replace(loose_support(duration=0.08, solver=solver), pins=pins))
        return [tuple(impact) for impact in result.onsets[PIN]]

    lean = paper_contact(1.5, 0.0)
    nearly = replace(lean, friction=NEARLY)
    expected = impacts(lean, "python")
    assert len(expected) == 3
    for law, backend in ((lean, "symbolic"), (nearly, "python"), (nearly, "symbolic")):
        # Newton's tolerance of 1e-8, magnified tenfold by each impact
        np.testing.assert_allclose(impacts(law, backend), expected, rtol=1e-5)


def test_memory_is_that_of_the_last_step_that_stands() -> None:
    # a step that is tried and given up must leave nothing behind
    scene = build(loose_support())
    pin = scene.clearance_joints[PIN]
    kept = pin.kept
    pin.begin_try(1e-3)
    scene.mbs.systemData.SetODE2Coordinates(0.0 * scene.mbs.systemData.GetODE2Coordinates())
    pin.engine_force.function(None, 0.0, 0, 1e-4, 0.5, 0.0, 0.0, 0.0)  # 0.1 mm deep at 0.5 m/s
    assert pin.after_newton(1e-3) is not None
    assert pin.wants_cut
    assert pin.kept == kept
    pin.begin_try(5e-4)
    assert pin.memory == kept
    assert not pin.wants_cut
    assert pin.landing < 1e-3


@pytest.mark.parametrize(
    "choice",
    [{}, {"newton": "full"}, {"constraint_index": 2, "integrator": "trapezoidal"}, {"newton_tolerance": 1e-4}],
    ids=str,
)
@pytest.mark.parametrize("friction", [0.0, 0.25])
def test_force_was_last_evaluated_at_the_end_of_the_step(
    friction: float, choice: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    # the Python backend takes the motion at the end of a step from there
    after_newton = ClearanceJoint.after_newton
    wrong: list[float] = []

    def checked(self: ClearanceJoint, t: float) -> float | None:
        (bx, by, *_), (x, y, vx, vy, *_) = self.frames.moving.now()  # the bore stands
        x, y = x - bx, y - by
        eccentricity = math.hypot(x, y)
        found = self.frames.relative(self.engine_force)
        wrong.append(abs(math.hypot(found.x, found.y) - eccentricity))
        wrong.append(abs((found.x * found.vx + found.y * found.vy) - (x * vx + y * vy)) / eccentricity)
        return after_newton(self, t)

    monkeypatch.setattr(ClearanceJoint, "after_newton", checked)
    solver = SolverSettings(backend="python", impact_steps=64, **choice)
    simulate(loose_support(1.5, friction, drive=Held(), duration=0.05, solver=solver))
    assert len(wrong) > 300
    # rounding of positions and speeds of some metres
    assert max(wrong) < 1e-13
