"""Runs of the drive modes: both modes, both pins, all kinds of columns; and the recipe that has no limit."""

from __future__ import annotations

from dataclasses import replace

from studies import drive_mode_cylinders as cylinders
from studies import paper_machine
from support_exudyn import CubicStep, Drive, Scenario, UniformSpeed
from user_forces import value

STUDY = "drive_mode"
CLEARANCE_MM = 1.5
MODES: dict[str, Drive] = {"mode 1": UniformSpeed(), "mode 2": CubicStep()}
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")
COLUMNS = ("rigid", "oil", "cylinder")
FRICTION = paper_machine.SLIDING_COEFFICIENT
DURATION = 5.1  # the sudden stop at 5 s is part of it [s]
NAIVE = "mode 1, stock recipe"  # velocities not made consistent


@value
class UnannouncedSpeed(UniformSpeed):
    """Mode 1 as a stock model has it: the speed jumps and the solver is not told."""

    def speed_jump(self, t: float) -> float:
        """None that anybody knows of."""
        del t
        return 0.0


def case_name(mode: str, pin: str, columns: str) -> str:
    """Name of a case."""
    return f"{mode}, {pin}, {columns} columns"


def scenarios(quick: bool) -> dict[str, Scenario]:
    """Both modes, both pins, all kinds of columns."""
    step, steps = (2e-3, 16) if quick else (1e-3, 64)
    bases = {
        PINS[0]: paper_machine.ideal_rise(step),
        PINS[1]: paper_machine.loose_rise(CLEARANCE_MM, FRICTION, step, steps, symbolic=True),
    }

    def run(mode: str, pin: str, columns: str) -> Scenario:
        base = replace(bases[pin], duration=DURATION, record_period=step, drive=MODES[mode])
        if columns == "cylinder":
            return cylinders.scenario(base, mode)
        return replace(base, columns=paper_machine.oil_columns() if columns == "oil" else {})

    return {
        case_name(mode, pin, columns): run(mode, pin, columns)
        for columns in reversed(COLUMNS)  # the longest first
        for pin in reversed(PINS)
        for mode in MODES
    }


def naive_scenarios() -> dict[str, Scenario]:
    """Mode 1 without consistent velocities, recorded step by step, at three steps, each half the one before."""
    drive = UnannouncedSpeed(start=0.05, end=2.05)
    base = replace(paper_machine.ideal_rise(1e-3), drive=drive, duration=0.06)
    base = replace(base, solver=replace(base.solver, audit=False))  # that energy does not add up is the point
    # after a break of the drive the solver takes a 32nd of its step
    return {
        f"{NAIVE}, step {1e3 * step:g} ms": replace(base, step=32 * step, record_period=step)
        for step in (1e-3, 5e-4, 2.5e-4)
    }
