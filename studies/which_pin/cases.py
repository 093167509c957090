"""Which pins are clearance, with how much clearance and friction, and what is measured of these cases."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import combinations

import numpy as np

from studies.common.numbers import Measured, Measures, Number
from studies.common.rise import DEGREES, Versus, Watched
from studies.common.study import Study
from studies.common.subject import without_clearance
from studies.which_pin.closed_form import posture_numbers
from support_exudyn import CubicStep, Result, Scenario, SolverSettings
from support_exudyn.mechanics.channels import ALL_CHANNELS
from support_exudyn.simulation.automatic_settings import cheapest, settings_for
from user_forces.values.value import InputError

CONDITIONS = ((0.25, 1.5), (0.1, 1.5), (0.25, 0.5), (0.0, 1.5))  # friction and clearance [mm], single pins
ADDS_UP = 2.0  # [%]: shifts whose sum is off by less are said to add up; ten times that for shaking
ALIKE = 0.05  # pins whose effects differ by less of the larger are said to be alike
SHIFT, FORCES, SHAKING = "mean_tip_shift_forward", "largest_change_of_a_mean_force", "rms_pin_forces"
OVER_IDEAL = "largest_peak_over_ideal"
IDEAL = "ideal"  # without friction
ALL = "all five"  # of the paper's machine
SHAKEN = ("rear_link", "shield", "canopy")  # its bodies whose angular acceleration is looked at
TIP, ROOF = "tip", "canopy"  # point whose shift is looked at, and body whose tilt is
BEGIN = 0.2  # of the paper's rise here [s]: a support that stands settled waits for nothing
# of the first of three runs, each with half the steps of the one before. Steps do not grow and the method damps
# little, else shaking that friction makes dies down: of a pin with 0.5 mm to a fifth. Newton's looser tolerance
# spares an iteration in four and changes shaking by 3e-5
STEP = 1e-3  # [s]
SETTINGS = SolverSettings(impact_steps=16, spectral_radius=0.8, newton_tolerance=1e-6)

OWN_GOAL = 1e-2  # by which the first steps of one's own machine are chosen


class PinCases(Study):
    """The cases of a machine: each of its pins alone, and all together."""

    own_machine = True

    @cached_property
    def pins(self) -> tuple[str, ...]:
        """All pins of the machine."""
        return tuple(self.subject.motion.unloaded.pins)

    @property
    def everything(self) -> str:
        """What all pins together are called."""
        return ALL if self.subject.is_paper else f"all {len(self.pins)}"

    @property
    def watched(self) -> Watched:
        """When the machine moves."""
        watched = self.subject.watched
        end = BEGIN + watched.end - watched.start
        return replace(watched, start=BEGIN, end=end) if self.subject.is_paper else watched

    @cached_property
    def forces(self) -> dict[str, str]:
        """Names of what carries, pins and actuators, by the channel of its force."""
        of_pins = {f"pin.{name}.force": name for name in self.pins}
        return of_pins | {f"{name}.force": name for name in self.subject.motion.unloaded.actuators}

    @cached_property
    def shaken(self) -> tuple[str, ...]:
        """Bodies whose angular acceleration is looked at."""
        return SHAKEN if self.subject.is_paper else tuple(self.subject.motion.unloaded.bodies)

    @property
    def has_tip(self) -> bool:
        """Whether the machine has a canopy with a tip, whose posture is looked at."""
        machine = self.subject.motion.unloaded
        return TIP in machine.points and ROOF in machine.bodies

    @property
    def rankings(self) -> dict[str, str]:
        """The orders of the machine's pins: title and number."""
        every = {"by the tip's position": SHIFT, "by the forces": FORCES, "by the shaking": SHAKING}
        return {title: name for title, name in every.items() if self.has_tip or name != SHIFT}

    @property
    def frictions(self) -> tuple[float, float]:
        """Coefficients in the clearance pins."""
        return self.subject.friction, 0.0

    @property
    def conditions(self) -> tuple[tuple[float, float], ...]:
        """Friction and clearance [mm] of the single pins."""
        if self.subject.is_paper:
            return CONDITIONS
        return tuple((friction, self.subject.clearance_mm) for friction in self.frictions)

    def case_name(self, pins: Sequence[str], friction: float, clearance_mm: float | None = None) -> str:
        """What a case is called: its clearance pins, their friction, and an unusual clearance."""
        named = self.everything if len(pins) == len(self.pins) else " + ".join(pins)
        other = "" if clearance_mm in (None, self.subject.clearance_mm) else f", {clearance_mm:g} mm"
        return f"{named}, mu_d = {friction:g}{other}"

    def alone(self, name: str, friction: float, clearance_mm: float | None = None) -> dict[str, Number]:
        """A number of each pin alone, by the name of the pin."""
        return {pin: self.found[name, self.case_name((pin,), friction, clearance_mm)] for pin in self.pins}

    @cached_property
    def loose(self) -> Mapping[str, tuple[Sequence[str], float, float]]:
        """Pins with clearance, their friction and clearance [mm], by case.

        Each pin alone and all together, with friction and without; of the paper's machine also pairs, and
        single pins with less friction and with less clearance.
        """
        size = self.subject.clearance_mm
        chosen: list[tuple[Sequence[str], float, float]] = [(self.pins, mu, size) for mu in self.frictions]
        chosen += [((pin,), *how) for how in self.conditions for pin in self.pins]
        if self.subject.is_paper:
            chosen += [(pins, 0.0, size) for pins in combinations(self.pins, 2)]
        return {self.case_name(*how): how for how in chosen}

    def ideal_name(self, pins: Sequence[str], friction: float) -> str:
        """What the case is called in which all pins are ideal and these have friction."""
        return f"{IDEAL}, {self.case_name(pins, friction)}" if friction else IDEAL

    def ideal_of(self, case: str) -> str:
        """The case with ideal pins, the same ones with the same friction, that a case is compared with."""
        return self.ideal_name(*self.loose[case][:2]) if case in self.loose else case

    def cases(self) -> dict[str, Scenario]:
        """All cases with clearance, and the ideal pins that they are compared with.

        Machines on actuators start settled, as a support stands that waits to be raised.
        """
        subject, watched = self.subject, self.watched
        motion = subject.motion
        if subject.is_paper:
            drive = CubicStep(start=watched.start, end=watched.end)
            motion = replace(motion, drive=drive, duration=watched.end)
        period = min(motion.recorded_every, STEP)
        if watched.window < 2.0 * period:
            raise InputError(
                f"motion from {watched.start:g} to {watched.end:g} s, a record every {period:g} s: "
                f"allowed: longer than {40.0 * period:g} s, to separate fluctuations from the trend, or more "
                "records"
            )
        motion = replace(motion, pins={}, channels=ALL_CHANNELS, accuracy=None, record_period=period, step=STEP)
        start = motion.start if motion.unloaded.cranks else "settled"
        cases = {}
        for name, (pins, friction, clearance_mm) in self.loose.items():
            pin = subject.clearance_pin(clearance_mm, friction)
            case = replace(
                motion, pins=dict.fromkeys(pins, pin), formulation="exudyn", solver=SETTINGS, start=start
            )
            cases[name] = case if subject.is_paper else settings_for(case, OWN_GOAL)
        for pins, friction, clearance_mm in self.loose.values():
            tight = without_clearance(subject.clearance_pin(clearance_mm, friction))
            case = replace(motion, pins=dict.fromkeys(pins, tight) if friction else {})
            case = replace(case, formulation="auto", solver=SolverSettings())
            cases[self.ideal_name(pins, friction)] = replace(case, formulation=cheapest(case))
        return cases

    def measures(self, run: Result) -> Measures:
        """Unit and measure of every number of a run against the ideal one, by name."""
        del run  # all have the same
        watched, forces = self.watched, self.forces
        peaks = {f"largest_force_{name}": watched.peak(channel) for channel, name in forces.items()}

        def changes(run: Result, ideal: Result) -> dict[str, float]:
            of = watched.mean
            return {name: 100.0 * (of(run, force) / of(ideal, force) - 1.0) for force, name in forces.items()}

        def all_pins(run: Result) -> float:
            each = [watched.rms_fluctuation(run, run[f"pin.{name}.force"]) for name in self.pins]
            return float(np.sqrt(np.mean(np.square(each))))

        def missed(run: Result, ideal: Result) -> float:  # where both forces are taken from records
            return max(
                (peak.missed(run) + peak(run) / peak(ideal) * peak.missed(ideal)) / peak(ideal)
                for peak in peaks.values()
            )

        def lost(run: Result) -> float:
            all_lost = run["energy.damping_loss"] + run["energy.friction_loss"]
            return float(np.diff(all_lost[watched.in_rise(run)][[0, -1]])[0])

        def largest_shift(run: Result, ideal: Result) -> float:
            along, up = (watched.departure(run, ideal, f"{TIP}.{axis}") for axis in "xy")
            return 1e3 * float(np.hypot(along, up).max())

        over_ideal = Versus(lambda run, ideal: max(p(run) / p(ideal) for p in peaks.values()), missed)
        measures: dict[str, tuple[str, Measured]] = {
            FORCES: ("%", Versus(lambda run, ideal: max(map(abs, changes(run, ideal).values())))),
            OVER_IDEAL: ("1", over_ideal),
            SHAKING: ("N", all_pins),
            "energy_lost_in_rise": ("J", lost),
            **{name: ("N", peak) for name, peak in peaks.items()},
        }
        for body in self.shaken:
            fluctuation = watched.fluctuation_of(f"{body}.angular_acceleration", DEGREES)
            measures[f"rms_{body}_angular_acceleration"] = ("deg/s^2", fluctuation)
        for channel, name in forces.items():
            change = Versus(lambda run, ideal, name=name: changes(run, ideal)[name])  # type: ignore[misc]
            measures[f"mean_force_{name}"] = ("N", watched.mean_of(channel))
            measures[f"change_of_mean_force_{name}"] = ("%", change)
            measures[f"rms_force_{name}"] = ("N", watched.fluctuation_of(channel))
        if self.has_tip:
            measures |= {
                SHIFT: ("mm", watched.shift_of(f"{TIP}.x", 1e3)),
                "mean_tip_shift_up": ("mm", watched.shift_of(f"{TIP}.y", 1e3)),
                "largest_tip_shift": ("mm", Versus(largest_shift)),
                "mean_canopy_tilt": ("deg", watched.shift_of(f"{ROOF}.angle", DEGREES)),
                "rms_tip_forward": ("mm", watched.fluctuation_of(f"{TIP}.x", 1e3)),
            }
        return measures

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        """All numbers of the runs, and those of the closed form beside them."""
        numbers = super().measure(runs)
        for case in self.loose if self.subject.is_paper else ():
            numbers += posture_numbers(case, runs[case].scenario)
        return numbers
