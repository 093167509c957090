"""Runs of the rise by valves: both modes, a pump of limited flow or one without a limit, both pins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from studies.common import paper_machine
from studies.common.paper_machine import CLEARANCE_MM
from studies.common.subject import paper_subject
from support_exudyn import (
    CheckValve,
    Inlet,
    PumpStation,
    RampedOpening,
    Scenario,
    SolverSettings,
    SuddenOpening,
    YieldValve,
)

START, LONG, SHORT = 3.0, 15.0, 5.0  # the valve opens, and closes on the limited pump and on the other [s]
AFTER = 1.0  # that is looked at after it has closed [s]
PERIOD = 1e-3  # between records [s]
VAPOUR = -99e3  # of water, above the atmosphere's [Pa]
PUMP = PumpStation(flow=450e-3 / 60.0, pressure=paper_machine.SYSTEM_PRESSURE)
CHECK = CheckValve(pilot_ratio=4.0)
YIELD = YieldValve(opening_pressure=40e6, rated_flow=1.0 / 60.0, rated_overpressure=4e6)
MODES: dict[str, type[Inlet]] = {"mode 1": SuddenOpening, "mode 2": RampedOpening}
PUMPS = ("450 l/min", "no limit")
OILS = ("boils", "pulls")
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")
FIRST = SolverSettings(tolerance=1e-5)  # of the first of three runs, each finer than the one before
CHANNELS = ("front_column.*", "rear_column.*", "pin.rear_base.force", "energy.*")


def case_name(mode: str, pump: str, pin: str, oil: str = "boils") -> str:
    """Name of a case."""
    return f"{mode}, {pump}, {pin}" + (", oil pulls" if oil == "pulls" else "")


def end_of(pump: str) -> float:
    """When the valve closes [s]."""
    return LONG if pump == PUMPS[0] else SHORT


def scenarios() -> Mapping[str, Scenario]:
    """All cases, the longest first."""
    return {
        case_name(mode, pump, pin, oil): _run(mode, pump, pin, oil)
        for pump in PUMPS
        for pin in reversed(PINS)
        for oil in OILS
        for mode in MODES
    }


def _run(mode: str, pump: str, pin: str, oil: str) -> Scenario:
    paper = paper_subject()
    ideal = pin == PINS[0]
    base = paper.ideal(paper.friction) if ideal else paper.with_clearance(CLEARANCE_MM, paper.friction)
    end = end_of(pump)
    inlet: Inlet = (
        SuddenOpening(start=START, end=end, extent=paper_machine.SUDDEN_OPENING)
        if mode == "mode 1"
        else RampedOpening(start=START, end=end, ramp=paper_machine.RAMP)
    )
    base = paper_machine.on_cylinders(base, inlet)
    columns = {
        name: replace(
            column,
            check_valve=CHECK,
            yield_valve=YIELD,
            vapour_pressure=VAPOUR if oil == "boils" else None,
        )
        for name, column in paper_machine.hydraulic_cylinders(inlet).items()
    }
    return replace(
        base,
        actuators=columns,
        pump=PUMP if pump == PUMPS[0] else None,
        duration=end + AFTER,
        record_period=PERIOD,
        accuracy=None,
        formulation="compiled",
        solver=FIRST,
        channels=(*CHANNELS, "pump.*") if pump == PUMPS[0] else CHANNELS,
    )
