"""A bed of rock over a stretch of a body that spins in space, against many single roofs, and its energy."""

from __future__ import annotations

import numpy as np

from support_exudyn import BeddedRoof, CubicStep, Result, Roof, Scenario, simulate
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage
from tests.cases.spatial_cases import InSpace

COMES_DOWN = CubicStep(stroke=0.05, start=0.0, end=0.1)
ENDS = ((-1.0, 0.1), (1.5, 0.3))
GAPS = (0.002, 0.006)
BEDDING, DAMPING = 2e3, 0.4


def on_a_free_body(loads: dict[str, ActingLoad]) -> Result:
    """A body that spins about all axes, and is pressed beside its centre."""
    body = SpatialBody(
        mass=20.0, inertia=(3.0, 9.0, 8.0, 0.0, 0.0, 0.0), centre=(0.0, 0.0, 0.0), spin=(0.8, 0.5, -0.6)
    )
    scenario = Scenario(
        machine=InSpace(space=SpatialLinkage(bodies={"a": body})),
        dimensions=3,
        loads=loads,
        duration=0.2,
        step=5e-4,
        record_period=1e-2,
        gravity=(0.0, 0.0),
    )
    return simulate(scenario)


def bed(**changes: object) -> BeddedRoof:
    fields: dict[str, object] = {
        "body": "a",
        "points": ENDS,
        "lateral": 0.3,
        "bedding": BEDDING,
        "gaps": GAPS,
        "damping": DAMPING,
        "descent": COMES_DOWN,
    }
    return BeddedRoof(**fields | changes)


def test_many_single_roofs_tend_to_the_bed_with_second_order() -> None:
    whole = on_a_free_body({"roof": bed()})
    length = float(np.hypot(2.5, 0.2))
    channels = ("a.x", "a.y", "a.z", "a.roll", "a.yaw", "a.angle")
    errors = []
    for count in (8, 32):
        loads: dict[str, ActingLoad] = {}
        for n in range(count):
            s = (n + 0.5) / count
            loads[f"roof_{n}"] = Roof(
                body="a",
                point=(-1.0 + 2.5 * s, 0.1 + 0.2 * s),
                lateral=0.3,
                stiffness=BEDDING * length / count,
                gap=GAPS[0] + s * (GAPS[1] - GAPS[0]),
                damping=DAMPING,
                descent=COMES_DOWN,
            )
        run = on_a_free_body(loads)
        errors.append([float(np.abs(run[name] - whole[name]).max()) for name in channels])
    moved = [float(np.ptp(whole[name])) for name in channels]
    assert moved[1] > 1e-2  # it is pressed down, and rolled
    assert np.ptp(whole["roof.pressed"]) > 0.5  # another part of it is pressed all the time
    for coarse, fine, way, name in zip(*errors, moved, channels, strict=True):
        assert fine < 2e-3 * way + 1e-12, name
        assert coarse > 6.0 * fine or fine < 1e-9, name
    assert whole.energy_error < 1e-4 * whole["energy.work"].max()
