"""Runs of the drive modes: both modes, both pins, all kinds of columns; and the recipe that has no limit."""

from dataclasses import replace

from studies.benchmarking.peers.stock import peak_acceleration
from studies.common import paper_machine, rise
from support_exudyn import CubicStep, Drive, Scenario, UniformSpeed

CLEARANCE_MM = 1.5
MODES: dict[str, Drive] = {"mode 1": UniformSpeed(), "mode 2": CubicStep()}
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")
COLUMNS = ("rigid", "oil", "cylinder")
FRICTION = paper_machine.SLIDING_COEFFICIENT
DURATION = 5.1  # the sudden stop at 5 s is part of it [s]
END = 5.4  # on cylinders, so that what rings after the valve has closed is seen [s]
OIL_PERIOD = 1e-3  # oil swings at 40 Hz: records twice as far apart may miss 2 % of a peak [s]
NAIVE = "mode 1, stock recipe"  # velocities not made consistent
NAIVE_STEPS = (1e-3, 5e-4, 2.5e-4)  # [s]


def case_name(mode: str, pin: str, columns: str) -> str:
    """Name of a case."""
    return f"{mode}, {pin}, {columns} columns"


def scenarios(quick: bool) -> dict[str, Scenario]:
    """Both modes, both pins, all kinds of columns."""
    step, steps = (2e-3, 16) if quick else (1e-3, 64)
    bases = {
        PINS[0]: paper_machine.ideal_rise(step),
        PINS[1]: paper_machine.clearance_rise(CLEARANCE_MM, FRICTION, step, steps, symbolic=True),
    }

    def run(mode: str, pin: str, columns: str) -> Scenario:
        base = replace(bases[pin], duration=DURATION, record_period=step, drive=MODES[mode])
        if columns == "cylinder":
            return replace(paper_machine.on_cylinders(base, paper_machine.INLETS[mode]), duration=END)
        if columns == "oil":
            return replace(base, actuators=paper_machine.oil_columns(), record_period=min(step, OIL_PERIOD))
        return replace(base, actuators={})

    return {
        case_name(mode, pin, columns): run(mode, pin, columns)
        for columns in reversed(COLUMNS)  # the longest first
        for pin in reversed(PINS)
        for mode in MODES
    }


def naive_peaks() -> dict[float, float]:
    """Peak angular accelerations of the rear link [deg/s^2] by the steps of a stock recipe [s].

    Mode 1 without consistent velocities: the engine's own acceleration where it integrates over the jump.
    """
    drive = UniformSpeed(start=0.05, end=2.05)
    jump = replace(paper_machine.ideal_rise(1e-3), drive=drive, duration=0.06)
    return {step: rise.DEGREES * peak_acceleration(jump, step, "rear_link") for step in NAIVE_STEPS}
