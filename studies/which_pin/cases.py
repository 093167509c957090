"""Which pins are clearance, with how much clearance and friction, in the cases of `which_pin`."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

from studies.common import paper_machine
from studies.common.numbers import Found, Number
from studies.common.rise import Watched
from studies.common.subject import Subject
from support_exudyn import ClearancePin, CubicStep, Scenario, SolverSettings
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.mechanics.channels import ALL_CHANNELS
from support_exudyn.simulation.automatic_settings import cheapest, settings_for
from user_forces import IndentationVelocity
from user_forces.values.value import InputError

CLEARANCE_MM = 1.5
FRICTIONS = (paper_machine.SLIDING_COEFFICIENT, 0.0)
CONDITIONS = ((0.25, 1.5), (0.1, 1.5), (0.25, 0.5), (0.0, 1.5))  # friction and clearance [mm], single pins
ADDS_UP = 2.0  # [%]: shifts whose sum is off by less are said to add up; ten times that for shaking
ALIKE = 0.05  # pins whose effects differ by less of the larger are said to be alike
IDEAL = "ideal"
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


def clearance_pin(
    friction: float, clearance_mm: float = CLEARANCE_MM, bore_radius: float = paper_machine.BORE_RADIUS
) -> ClearancePin:
    """The paper's pin, with a damping that forgets how its contact once began; bore_radius: [m].

    With the textbook's, which remembers it, a pin that was settled gently shakes eight times as much in the
    same rise as one that was dropped: pins could not be compared.
    """
    return paper_machine.clearance_joint(
        clearance_mm, friction, bore_radius, damping_speed=IndentationVelocity()
    )


def case_name(
    pins: Sequence[str], friction: float, clearance_mm: float = CLEARANCE_MM, usual_mm: float = CLEARANCE_MM
) -> str:
    """What a case is called: its clearance pins, their friction, and their clearance if it is another one."""
    named = ALL if len(pins) == len(PINS) else " + ".join(pins)
    other = "" if clearance_mm == usual_mm else f", {clearance_mm:g} mm"
    return f"{named}, mu_d = {friction:g}{other}"


@dataclass(frozen=True)
class PinPlan:
    """The cases of a machine: each of its pins alone, and all together."""

    subject: Subject

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
    def motion(self) -> Scenario:
        """The run with ideal pins, all channels recorded."""
        motion = self.subject.motion
        if self.subject.is_paper:
            drive = CubicStep(start=self.watched.start, end=self.watched.end)
            motion = replace(motion, drive=drive, duration=self.watched.end)
        period = min(motion.recorded_every, STEP)
        return replace(motion, pins={}, channels=ALL_CHANNELS, accuracy=None, record_period=period, step=STEP)

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
    def clearance_mm(self) -> float:
        """The radial clearance of the pins [mm]."""
        given = self.subject.given
        return CLEARANCE_MM if given is None else round(1e3 * given.contact.bearing.clearance, 9)

    @property
    def frictions(self) -> tuple[float, float]:
        """Coefficients in the clearance pins."""
        return self.subject.friction, 0.0

    @property
    def conditions(self) -> tuple[tuple[float, float], ...]:
        """Friction and clearance [mm] of the single pins."""
        own = tuple((friction, self.clearance_mm) for friction in self.frictions)
        return CONDITIONS if self.subject.is_paper else own

    def case_name(self, pins: Sequence[str], friction: float, clearance_mm: float | None = None) -> str:
        """What a case is called, see `case_name`."""
        size = self.clearance_mm if clearance_mm is None else clearance_mm
        named = [self.everything] if len(pins) == len(self.pins) else pins
        return case_name(named, friction, size, self.clearance_mm)

    def alone(
        self, found: Found, name: str, friction: float, clearance_mm: float | None = None
    ) -> dict[str, Number]:
        """A number of each pin alone, by the name of the pin."""
        return {pin: found[name, self.case_name((pin,), friction, clearance_mm)] for pin in self.pins}

    def pin(self, friction: float, clearance_mm: float) -> ClearancePin:
        """The pin that is put into every place: that of the scenario, or one like the paper's."""
        if self.subject.given is None:
            return clearance_pin(friction, clearance_mm, self.subject.bore_radius)
        chosen = self.subject.with_clearance(clearance_mm, friction).pins[self.subject.pin]
        assert isinstance(chosen, ClearancePin)
        return chosen

    @cached_property
    def scenarios(self) -> dict[str, Scenario]:
        """The ideal machine, each pin alone and all together, with friction and without.

        Of the paper's machine also pairs, and single pins with less friction and with less clearance. Machines
        on actuators start settled, as a support stands that waits to be raised.
        """
        period = min(self.motion.recorded_every, STEP)
        if self.watched.window < 2.0 * period:
            times = f"{self.watched.start:g} to {self.watched.end:g} s"
            least = 40.0 * period
            raise InputError(
                f"motion from {times}, a record every {period:g} s: allowed: longer than {least:g} s, to tell "
                "shaking by, or more records"
            )
        ideal = replace(self.motion, formulation="auto", solver=SolverSettings())
        ideal = replace(ideal, formulation=cheapest(ideal))
        motion = replace(self.motion, formulation="redundant")
        start = motion.start if motion.unloaded.cranks else "settled"

        def clearance(pins: Sequence[str], friction: float, clearance_mm: float) -> Scenario:
            loose = dict.fromkeys(pins, self.pin(friction, clearance_mm))
            case = replace(motion, pins=loose, solver=SETTINGS, start=start)
            return case if self.subject.is_paper else settings_for(case, OWN_GOAL)

        size = self.clearance_mm
        cases = {self.case_name(self.pins, mu): clearance(self.pins, mu, size) for mu in self.frictions}
        cases[IDEAL] = ideal
        cases |= {
            self.case_name((pin,), *how): clearance((pin,), *how)
            for how in self.conditions
            for pin in self.pins
        }
        if self.subject.is_paper:
            cases |= {
                self.case_name(pins, 0.0): clearance(pins, 0.0, size) for pins in combinations(self.pins, 2)
            }
        return cases
