"""A force of a given course: its work, and statics of the support under it."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import (
    AppliedForce,
    Result,
    Scenario,
    reference_support,
    simulate,
)
from support_exudyn.mechanics.kinetics import kinetics_of
from tests.roof_cases import DAMPED, MASS, OVER_THE_COLUMNS, TOP, Ram
from user_forces.values.value import InputError, Vector2

MEGANEWTON = 1e6


def pressing(full_force: Vector2 = (0.0, -MEGANEWTON), **changes: object) -> AppliedForce:
    fields: dict[str, object] = {"body": "canopy", "point": OVER_THE_COLUMNS, "full_force": full_force}
    return AppliedForce(**fields | {"start": 0.02, "end": 0.12} | changes)


def pressed(load: AppliedForce, **changes: object) -> Result:
    fields: dict[str, object] = {"machine": reference_support(), "loads": {"roof": load}, "duration": 0.3}
    return simulate(Scenario(**fields | changes))


def test_a_body_that_it_accelerates_gets_its_work() -> None:
    up = AppliedForce(body="ram", point=TOP, full_force=(0.0, 5e3), start=0.1, end=0.3)
    scene = Scenario(machine=Ram(), loads={"jack": up}, duration=0.5, record_period=1e-3, gravity=(0.0, 0.0))
    result = simulate(scene)
    # m v = F (0.1 + 0.2), the ramp counting half; second order in the step
    speed = 5e3 * 0.3 / MASS
    assert result["ram.velocity_y"][-1] == pytest.approx(speed, rel=1e-5)
    assert result["energy.work"][-1] == pytest.approx(0.5 * MASS * speed**2, rel=1e-5)
    assert result["jack.force_y"][[0, 100, 200, 300, 500]] == pytest.approx(
        [0.0, 0.0, 2.5e3, 5e3, 5e3], abs=1e-6
    )
    assert result.energy_error < 1e-4 * 0.5 * MASS * speed**2


@pytest.mark.parametrize("actuators", [{}, DAMPED], ids=["rigid", "oil"])
@pytest.mark.parametrize("force", [(0.0, -MEGANEWTON), (2e5, -5e5)])
def test_actuators_and_pins_carry_what_statics_say(actuators: dict[str, object], force: Vector2) -> None:
    result = pressed(pressing(force), actuators=actuators, duration=0.6)
    linkage = result.scenario.linkage
    closed = kinetics_of(linkage)
    position = np.concatenate(
        [
            [
                result[f"{name}.{axis}"][-1] - of
                for axis, of in zip(("x", "y", "angle"), (*body.centre, body.angle), strict=True)
            ]
            for name, body in linkage.bodies.items()
        ]
    )
    load = (
        closed.weight(result.scenario.gravity)
        + np.array(force) @ closed.point(position, "canopy", OVER_THE_COLUMNS)[1]
    )
    found = closed.respond(position, load, 0.0)[1]
    # on oil what the lines leave of vibrations after 0.48 s
    for n, name in enumerate(linkage.pins):
        size = float(np.hypot(*found[2 * n : 2 * n + 2]))
        assert result[f"pin.{name}.force"][-1] == pytest.approx(size, rel=1e-6)
    for name, pull in zip(linkage.actuators, found[closed.driven()], strict=True):
        assert result[f"{name}.force"][-1] == pytest.approx(-pull, rel=1e-6)
    # 1 MN over some tenths of a millimetre of oil
    assert result.energy_error < 1e-4 * max(1.0, result["energy.work"].max())


def test_times_in_disorder_are_refused() -> None:
    with pytest.raises(InputError, match=r"end = 0\.1 s: allowed: > start = 0\.2 s, or both 0"):
        pressing(start=0.2, end=0.1)
