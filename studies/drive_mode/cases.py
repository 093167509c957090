"""Runs of the drive modes, and what is measured of them: both modes, both pins, all kinds of actuators.

What assumptions on oil and contact do to the peak of the sudden inlet is a band beside the numerical error: the
start of mode 1 on columns of oil, as assumed and with the stiffest and the softest oil, by each contact of the
pin. The machine starts at rest, its journal on the bore: after a fall into the bore the phase of its last
bounces would decide about a tenth of the peak. It ends when the first swings are over.
"""

import itertools
import math
from dataclasses import replace
from functools import cached_property, partial
from typing import Literal

import numpy as np

from studies.common import paper_machine, rise
from studies.common.numbers import Measured, Measures
from studies.common.paper_machine import CLEARANCE_MM, CONTACT_TITLES, CYLINDERS, PAPER
from studies.common.rise import DEGREES, Crest
from studies.common.study import Study
from support_exudyn import CubicStep, Line, Result, Scenario, UniformSpeed
from support_exudyn.mechanics.channels import ALL_CHANNELS
from support_exudyn.model.drives.coupled_drive import CoupledDrive
from support_exudyn.model.drives.drive import Stroke
from support_exudyn.simulation.impulses import impulses_of
from user_forces.values.value import InputError

MODES: dict[str, type[Stroke]] = {"mode 1": UniformSpeed, "mode 2": CubicStep}
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")  # of the paper's machine
COLUMNS = ("rigid", "oil", "cylinder")
AFTER = 0.05  # of the motion's time that is looked at after it: a sudden stop is part of it
END = 5.4  # on cylinders, so that what rings after the valve has closed is seen [s]
PERIOD = 1e-3  # between records: oil swings at 40 Hz, and records twice as far apart miss 2 % of a peak [s]

START, STOP = "largest_pin_force_in_motion", "largest_pin_force_after_stop"  # from the stop to the run's end
EXTREMES: tuple[Literal["largest", "max", "min"], ...] = ("largest", "max", "min")
USUAL, SOFTEST, STIFFEST = "oil as assumed", "softest oil", "stiffest oil"
OIL = {  # bulk modulus [Pa], four published shields give 1.96 GPa; and hoses of a pair of columns
    USUAL: (paper_machine.BULK_MODULUS, paper_machine.HOSES),
    SOFTEST: (1.5e9, Line(volume=20e-3, nominal_flow=200e-3 / 60.0, nominal_drop=2e6)),
    STIFFEST: (2.2e9, Line(volume=5e-3, nominal_flow=200e-3 / 60.0, nominal_drop=5e5)),
}
INLET, SWINGS = 0.05, 0.4  # when mode 1 starts in these runs, and how long they last after it [s]
PEAK = "peak_at_start"
START_PINS = {PINS[0]: PINS[0]} | {one: f"{PINS[1]}, {CONTACT_TITLES[one]}" for one in (PAPER, CYLINDERS)}


def start_name(pin: str, oil: str) -> str:
    """The name of a start of mode 1."""
    return f"start of mode 1, {pin}, {oil}"


def case_name(mode: str, pin: str, columns: str) -> str:
    """Name of a case."""
    return f"{mode}, {pin}, {columns} columns"


class ModeCases(Study):
    """The motion of a machine in both modes, with the stroke and the times of its own drive."""

    own_machine = has_witness = True

    @property
    def pins(self) -> tuple[str, str]:
        """What the pin is called, ideal and with clearance."""
        return PINS[0], f"{self.subject.clearance_mm:g} mm"

    @cached_property
    def leading(self) -> tuple[str, ...]:
        """The actuators with a stroke. Raises InputError if there are none, or if one moves in another way."""
        motion = self.subject.motion
        found = tuple(n for n in self.actuators if not isinstance(motion.drive_of(n), CoupledDrive))
        if not found:
            raise InputError("machine: no drive moves a linear actuator of it; drive_mode needs one that does")
        for name in found:
            if not isinstance(motion.drive_of(name), Stroke):
                kind = type(motion.drive_of(name)).__name__
                allowed = "a drive with a stroke: UniformSpeed, CubicStep"
                raise InputError(f"drive of {name} = {kind}: drive_mode allows: {allowed}")
        return found

    @cached_property
    def actuators(self) -> tuple[str, ...]:
        """The actuators that drives move: those with a stroke, and then those that follow one."""
        motion = self.subject.motion
        driven = [name for name in motion.driven if name in motion.unloaded.actuators]
        return tuple(sorted(driven, key=lambda name: isinstance(motion.drive_of(name), CoupledDrive)))

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """How actuators are modelled: on oil if the scenario says so; on cylinders only the paper's."""
        if self.subject.is_paper:
            return COLUMNS
        return (
            COLUMNS[:2] if set(self.actuators) & set(self.subject.motion.compliant_actuators) else COLUMNS[:1]
        )

    def drive(self, mode: str, actuator: str) -> Stroke:
        """The drive of an actuator in a mode."""
        own = self.subject.motion.drive_of(actuator)
        assert isinstance(own, Stroke)
        return MODES[mode](stroke=own.stroke, start=own.start, end=own.end)

    def cases(self) -> dict[str, Scenario]:
        """All rises, and the starts by assumptions."""
        return {**self.rises, **self.starts}

    @cached_property
    def rises(self) -> dict[str, Scenario]:
        """Both modes, both pins, all kinds of actuators; the longest first."""
        every = itertools.product(reversed(self.columns), reversed(self.pins), MODES)
        return {case_name(mode, pin, columns): self._rise(mode, pin, columns) for columns, pin, mode in every}

    def _rise(self, mode: str, pin: str, columns: str) -> Scenario:
        subject, watched, friction = self.subject, self.subject.watched, self.subject.friction
        drives = {name: self.drive(mode, name) for name in self.leading}
        first, *others = drives.values()
        alike = all(one == first for one in others)
        base = subject.ideal(friction)
        if pin != self.pins[0]:
            base = subject.with_clearance(subject.clearance_mm, friction)
        base = replace(
            base,
            duration=round(watched.end + AFTER * (watched.end - watched.start), 9),
            record_period=min(base.recorded_every, PERIOD),
            channels=ALL_CHANNELS,
            drive=first if alike else base.drive,
            drives={} if alike else drives,
        )
        if columns == "cylinder":
            return paper_machine.on_cylinders(replace(base, duration=END), paper_machine.INLETS[mode])
        if columns == "oil":
            return replace(base, actuators=paper_machine.oil_columns()) if subject.is_paper else base
        rigid = {name: one for name, one in base.actuators.items() if name not in self.actuators}
        return replace(base, actuators=rigid)

    @cached_property
    def starts(self) -> dict[str, Scenario]:
        """The starts of mode 1 by pin and oil; of the paper's machine only."""
        found: dict[str, Scenario] = {}
        for pin, oil in itertools.product(START_PINS, OIL) if self.subject.is_paper else ():
            pins = {}
            if pin != PINS[0]:
                law, friction = paper_machine.PAPERS_LAW, self.subject.friction
                loose = paper_machine.clearance_joint(CLEARANCE_MM, friction, contact=pin, law=law)
                pins = {paper_machine.CLEARANCE_PIN: loose}
            base = self.rises[case_name("mode 1", PINS[1 if pins else 0], "oil")]
            assert isinstance(base.drive, UniformSpeed)
            modulus, hoses = OIL[oil]
            found[start_name(pin, oil)] = replace(
                base,
                drive=replace(base.drive, start=INLET, end=INLET + base.drive.end - base.drive.start),
                duration=INLET + SWINGS,
                start="settled",
                actuators={
                    name: replace(column, bulk_modulus=modulus, line=hoses)
                    for name, column in paper_machine.oil_columns().items()
                },
                pins=pins or base.pins,
                channels=(rise.FORCE,),
            )
        return found

    def measures(self, run: Result) -> Measures:
        """Unit and measure of every number of a case that has a limit, by name.

        Where there is an impulse, it stands in place of what squares or extremes make endless.
        """
        if run.scenario.duration == INLET + SWINGS:
            return {PEAK: ("kN", Crest(rise.FORCE, 1e-3, INLET, INLET + SWINGS))}
        watched = self.subject.watched
        force, begin = watched.force, watched.start  # from the very start on, which is where mode 1 strikes
        found: dict[str, tuple[str, Measured]] = {
            "mean_pin_force": ("N", watched.mean_of(force)),
            "std_pin_force": ("N", watched.spread_of(force)),
            "rms_pin_force": ("N", watched.fluctuation_of(force, 1.0, begin)),
            START: ("N", watched.peak(force)),
            STOP: ("N", Crest(force, begin=watched.end, end=math.inf)),
            "largest_angular_acceleration": ("deg/s^2", watched.peak(watched.acceleration, DEGREES)),
            "std_angular_acceleration": ("deg/s^2", watched.spread_of(watched.acceleration, DEGREES)),
            "rms_angular_velocity": ("deg/s", watched.fluctuation_of(watched.speed, DEGREES, begin)),
        }
        endless: dict[str, tuple[str, tuple[str, ...]]] = {
            "pin": (force, (START, STOP, "std_pin_force", "rms_pin_force"))  # a magnitude
        }
        for name in self.actuators:  # largest is of the magnitude; a push is positive, a pull negative
            channel = f"{name}.force"
            peaks = {f"{one}_{name}_force": replace(watched.peak(channel), extreme=one) for one in EXTREMES}
            found |= {peak: ("N", measure) for peak, measure in peaks.items()}
            endless[name] = channel, tuple(peaks)
        for place, end in enumerate(("start", "end")):
            for what, (channel, gone) in endless.items():
                if len(impulses_of(run, channel, 0.0, math.inf)) == 2:
                    found[f"impulse_{what}_{end}"] = ("N s", partial(_impulse, channel, place))
                    found = {name: about for name, about in found.items() if name not in gone}
        if run.impulses:
            del found["largest_angular_acceleration"], found["std_angular_acceleration"]
        return found | (ON_CYLINDERS if run.scenario.valved else {})


def _impulse(channel: str, place: int, run: Result) -> float:
    return impulses_of(run, channel, 0.0, math.inf)[place]


# --- on hydraulic cylinders ---

LATE = 5.2  # from here on it is taken as settled in the mean [s]
MIDDLE = (3.6, 4.4)  # of the rise, ramps of mode 2 excluded [s]


def extension(result: Result, column: str) -> rise.Series:
    """The extension of a column since the start (n,) [m]."""
    length = result[f"{column}.length"]
    return np.asarray(length - length[0])


def speed(column: str, begin: float, end: float, result: Result) -> float:
    """The mean speed of a column's extension between two times [s], in mm/s."""
    return (extension_at(column, end, result) - extension_at(column, begin, result)) / (end - begin)


def extension_at(column: str, time: float, result: Result) -> float:
    """The extension of a column at a time [s], in mm."""
    return float(1e3 * np.interp(time, result.time, extension(result, column)))


def _of_column(column: str) -> dict[str, tuple[str, Measured]]:
    side, pressure = column.partition("_")[0], f"{column}.pressure"
    whole = partial(Crest, pressure, 1e-6, end=math.inf)

    def late(run: Result, values: rise.Series) -> float:
        inside = run.time >= LATE - 1e-9
        return rise.mean(run.time[inside], values[inside])

    def settled(run: Result) -> float:
        return late(run, 1e3 * extension(run, column))

    return {
        f"speed_in_mid_rise_{side}": ("mm/s", partial(speed, column, *MIDDLE)),
        f"extension_at_5s_{side}": ("mm", partial(extension_at, column, rise.END)),
        f"settled_extension_{side}": ("mm", settled),
        f"overshoot_{side}": ("mm", lambda run: float(1e3 * extension(run, column).max()) - settled(run)),
        f"largest_pressure_{side}": ("MPa", whole(extreme="max")),
        f"least_pressure_{side}": ("MPa", whole(extreme="min")),
        f"pressure_after_{side}": ("MPa", lambda run: late(run, 1e-6 * run[pressure])),
        f"largest_flow_{side}": ("l/min", Crest(f"{column}.flow", 6e4, begin=0.0, end=math.inf)),
    }


ON_CYLINDERS: dict[str, tuple[str, Measured]] = {
    **_of_column("front_column"),
    **_of_column("rear_column"),
    "loss_in_valves": ("kJ", lambda run: float(1e-3 * run["energy.damping_loss"][-1])),
    "work_of_pumps": ("kJ", lambda run: float(1e-3 * run["energy.work"][-1])),
}
