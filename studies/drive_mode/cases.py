"""Runs of the drive modes: both modes, both pins, all kinds of actuators."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from studies.common import paper_machine
from studies.common.paper_machine import CLEARANCE_MM
from studies.common.subject import Subject
from support_exudyn import CubicStep, Scenario, UniformSpeed
from support_exudyn.mechanics.channels import ALL_CHANNELS
from support_exudyn.model.drives.coupled_drive import CoupledDrive
from support_exudyn.model.drives.drive import Stroke
from user_forces.values.value import InputError

MODES: dict[str, type[Stroke]] = {"mode 1": UniformSpeed, "mode 2": CubicStep}
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")  # of the paper's machine
COLUMNS = ("rigid", "oil", "cylinder")
AFTER = 0.05  # of the motion's time that is looked at after it: a sudden stop is part of it
END = 5.4  # on cylinders, so that what rings after the valve has closed is seen [s]
PERIOD = 1e-3  # between records: oil swings at 40 Hz, and records twice as far apart miss 2 % of a peak [s]


def case_name(mode: str, pin: str, columns: str) -> str:
    """Name of a case."""
    return f"{mode}, {pin}, {columns} columns"


@dataclass(frozen=True)
class ModePlan:
    """The cases of a machine: its motion in both modes, with the stroke and the times of its own drive."""

    subject: Subject

    @property
    def pins(self) -> tuple[str, str]:
        """What the pin is called, ideal and with clearance."""
        return PINS[0], f"{self.subject.clearance_mm:g} mm"

    @cached_property
    def actuators(self) -> tuple[str, ...]:
        """The actuators that drives move: those with a stroke, and those that follow one, as a shield's ram.

        Raises InputError if there are none, or if one of them moves in another way.
        """
        return self.leading + tuple(name for name in self._driven if name not in self.leading)

    @property
    def _driven(self) -> tuple[str, ...]:
        motion = self.subject.motion
        return tuple(name for name in motion.driven if name in motion.unloaded.actuators)

    @cached_property
    def leading(self) -> tuple[str, ...]:
        """The actuators with a stroke. Raises InputError as `actuators` does."""
        motion = self.subject.motion
        found = tuple(n for n in self._driven if not isinstance(motion.drive_of(n), CoupledDrive))
        if not found:
            raise InputError("machine: no drive moves a linear actuator of it; drive_mode needs one that does")
        for name in found:
            if not isinstance(motion.drive_of(name), Stroke):
                kind = type(motion.drive_of(name)).__name__
                allowed = "a drive with a stroke: UniformSpeed, CubicStep"
                raise InputError(f"drive of {name} = {kind}: drive_mode allows: {allowed}")
        return found

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

    @cached_property
    def scenarios(self) -> Mapping[str, Scenario]:
        """Both modes, both pins, all kinds of actuators; the longest first."""
        return {
            case_name(mode, pin, columns): self._run(mode, pin, columns)
            for columns in reversed(self.columns)
            for pin in reversed(self.pins)
            for mode in MODES
        }

    def _run(self, mode: str, pin: str, columns: str) -> Scenario:
        subject, watched = self.subject, self.subject.watched
        ideal = pin == self.pins[0]
        friction = subject.friction
        base = subject.ideal(friction) if ideal else subject.with_clearance(subject.clearance_mm, friction)
        duration = round(watched.end + AFTER * (watched.end - watched.start), 9)
        first, *others = drives = [self.drive(mode, name) for name in self.leading]
        period = min(base.recorded_every, PERIOD)
        base = replace(base, duration=duration, record_period=period, channels=ALL_CHANNELS)
        if all(one == first for one in others):
            base = replace(base, drive=first, drives={})
        else:
            base = replace(base, drives=dict(zip(self.leading, drives, strict=True)))
        if columns == "cylinder":
            return paper_machine.on_cylinders(replace(base, duration=END), paper_machine.INLETS[mode])
        if columns == "oil":
            if subject.is_paper:
                base = replace(base, actuators=paper_machine.oil_columns())
            return base
        rigid = {name: one for name, one in base.actuators.items() if name not in self.actuators}
        return replace(base, actuators=rigid)
