"""A mass on a hydraulic cylinder, and the support on four."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from support_exudyn import Held, HydraulicCylinder, Inlet, Result, Scenario, simulate
from tests.cases.run_cases import loose_support, support
from tests.formulations.hydraulics import leg_cases

CYLINDER = replace(leg_cases.CYLINDER, damping=0.0)


def lift(cylinder: HydraulicCylinder, duration: float) -> Result:
    return simulate(replace(leg_cases.scene(cylinder, duration=duration), step=5e-4, record_period=1e-3))


def opened(inlet: Inlet, **changes: Any) -> HydraulicCylinder:
    return replace(CYLINDER, inlet=inlet, **changes)


def on_cylinders(with_clearance: bool, inlet: Inlet | None = None, **changes: Any) -> Scenario:
    cylinder = CYLINDER if inlet is None else opened(inlet)
    actuators = dict.fromkeys(("front_column", "rear_column"), cylinder)
    return (loose_support if with_clearance else support)(actuators=actuators, drive=Held(), **changes)
