"""A ram on a hydraulic cylinder, and the support on four."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from support_exudyn import (
    Body,
    Held,
    HydraulicCylinder,
    Inlet,
    LinearActuator,
    Linkage,
    Machine,
    Result,
    Scenario,
    Slide,
    simulate,
)
from support_exudyn.model.linkage import GROUND
from tests.cases.run_cases import loose_support, support
from user_forces import value

MASS, GRAVITY = 16000.0, 9.81
CYLINDER = HydraulicCylinder(
    bore_area=0.098,
    rod_side_area=0.03,
    oil_length=0.5,
    rod_side_length=1.0,
    bulk_modulus=1.5e9,
    system_pressure=31.5e6,
    tank_pressure=0.5e6,
    nominal_flow=6e-3,
    hose_volume=5e-3,
    rod_side_hose_volume=3e-3,
)


@value
class Ram(Machine):
    """A ram of 16 t on one upright cylinder."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={"ram": Body(mass=MASS, inertia=1.0, centre=(0.0, 1.6))},
            actuators={
                "jack": LinearActuator(foot=GROUND, head="ram", foot_point=(0.0, 0.0), head_point=(0.0, 1.6))
            },
            slides={"guide": Slide(body="ram", point=(0.0, 1.6), direction=0.5 * math.pi)},
        )


def lift(cylinder: HydraulicCylinder, duration: float, step: float = 5e-4, record: float = 1e-3) -> Result:
    return simulate(
        Scenario(
            machine=Ram(),
            actuators={"jack": cylinder},
            drive=Held(),
            duration=duration,
            step=step,
            record_period=record,
        )
    )


def opened(inlet: Inlet, **changes: Any) -> HydraulicCylinder:
    return replace(CYLINDER, inlet=inlet, **changes)


def on_cylinders(with_clearance: bool, inlet: Inlet | None = None, **changes: Any) -> Scenario:
    cylinder = CYLINDER if inlet is None else opened(inlet)
    actuators = dict.fromkeys(("front_column", "rear_column"), cylinder)
    return (loose_support if with_clearance else support)(actuators=actuators, drive=Held(), **changes)
