"""What the study of contact laws runs: free impacts and rises under every law."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

import user_forces as forces
from studies.common import paper_machine
from studies.common.paper_machine import CLEARANCE_MM
from studies.common.subject import Subject, to_accuracy
from studies.contact_laws import catalogue
from studies.contact_laws.catalogue import CYLINDER_LAWS, POWER_LAWS
from support_exudyn import ClearancePin, ImpactStand, Result, Scenario, SolverSettings
from support_exudyn.model.machine import contact_length
from support_exudyn.scenario.timescales import loaded_contacts
from support_exudyn.simulation.automatic_settings import cheapest, settings_for
from user_forces import JournalBearing, JournalContact, NormalLaw
from user_forces.normal.hysteresis import REST_VELOCITY

ASKED = (0.05, *(n / 10 for n in range(1, 10)))  # e = 0.05, 0.1, 0.2 ... 0.9
FEW = (0.1, 0.3, 0.5, 0.7, 0.9)  # for laws whose damping factor is another's
SPEED = 0.2  # of free impacts [m/s]
IMPACT_STEPS = 96  # of the coarsest of three runs of a free impact; fewer tell no error of a jump in force
# of the first of three runs of a rise that the Exudyn formulation alone covers; the step is between impacts
RISE_STEP, RISE_IMPACT_STEPS = 2e-3, 32  # [s]
OWN_GOAL = 1e-2  # by which those of one's own machine are chosen
LOOP_RESTITUTION = 0.5
REST = {f"rest velocity {1e3 * w:g} mm/s": w for w in (1e-3, REST_VELOCITY, 5e-2, 0.1)}  # [m/s]
SOFT = (5e-3, 2e-2, 0.2)  # impacts that tell which restitution a rest velocity leaves [m/s]
KEY = (  # of the key table
    "exact", "lankarani_nikravesh", "anagnostopoulos", "johnson", "hertz", "friction ambrosio",
    "friction lugre",
)  # fmt: skip
PIN = "pin"
BORE_MASS, JOURNAL_MASS = 3.0, 2.0  # [kg]
REDUCED_MASS = BORE_MASS * JOURNAL_MASS / (BORE_MASS + JOURNAL_MASS)  # of free impacts [kg]
STIFFNESS = 1e8  # K of free impacts [N/m^1.5], or [N/m] of linear laws


def impact_laws() -> dict[str, tuple[forces.NormalLaw, float]]:
    """Laws of the free impacts and the restitution that is to come out, by case."""
    cases: dict[str, tuple[forces.NormalLaw, float]] = {}
    for name, law in POWER_LAWS.items():
        for asked in ASKED:
            chosen = law(stiffness=STIFFNESS, restitution=asked)
            cases[f"{name} e={asked:g}"] = (chosen, chosen.delivered_restitution)
    for asked in FEW:
        linear = forces.Anagnostopoulos(stiffness=STIFFNESS, restitution=asked)
        cases[f"anagnostopoulos e={asked:g}"] = (linear, linear.delivered_restitution)
        bearing = paper_machine.bearing(CLEARANCE_MM)
        for name in CYLINDER_LAWS:
            line = catalogue.cylinder_law(name, bearing, asked)
            cases[f"{name} e={asked:g}"] = (line, line.delivered_restitution)
    cases["hertz e=1"] = (forces.Hertz(stiffness=STIFFNESS), 1.0)
    for ratio in (0.05, 0.2, 0.5, 1.0):
        dashpot = forces.KelvinVoigt(
            stiffness=STIFFNESS, damping=float(2.0 * ratio * np.sqrt(STIFFNESS * REDUCED_MASS))
        )
        cases[f"kelvin_voigt zeta={ratio:g}"] = (dashpot, dashpot.delivered_restitution(REDUCED_MASS))
    for depth in (1e-3, 1e-4):
        impact = forces.AdamsImpact(stiffness=STIFFNESS, full_damping=500.0, full_damping_depth=depth)
        cases[f"adams_impact d_max={1e3 * depth:g} mm"] = (
            impact,
            one_dimensional_restitution(impact, REDUCED_MASS, SPEED),
        )
    return cases


def loop_laws() -> dict[str, forces.NormalLaw]:
    """Laws whose loops of force over depth are drawn, by name."""
    laws: dict[str, forces.NormalLaw] = {
        name: law(stiffness=STIFFNESS, restitution=LOOP_RESTITUTION) for name, law in POWER_LAWS.items()
    }
    laws["kelvin_voigt"] = forces.KelvinVoigt(stiffness=STIFFNESS, damping=5e3)
    laws["anagnostopoulos"] = forces.Anagnostopoulos(stiffness=STIFFNESS, restitution=LOOP_RESTITUTION)
    laws["adams_impact"] = forces.AdamsImpact(stiffness=STIFFNESS, full_damping=2e3, full_damping_depth=3e-4)
    bearing = paper_machine.bearing(CLEARANCE_MM)
    laws["johnson"] = catalogue.cylinder_law("johnson", bearing, LOOP_RESTITUTION)
    return laws


@dataclass(frozen=True)
class Joint:
    """The clearance joint of a motion: what all laws that are tried in it have in common.

    subject: the machine and its pin. load: that the pin holds, the mean of its force when it is ideal [N].
    """

    subject: Subject
    load: float

    @cached_property
    def pin(self) -> ClearancePin:
        """The pin of the scenario, or one like the paper's; without friction."""
        return self.subject.clearance_pin(self.subject.clearance_mm, 0.0)

    @property
    def length(self) -> float | None:
        """Length of the pin's contact [m], as its law, its scenario or its machine has it; None: none does."""
        own = getattr(self.pin.contact.normal, "length", self.pin.length)
        return own or contact_length(self.subject.motion.machine, self.subject.pin)

    @property
    def clearance_mm(self) -> float:
        """The radial clearance of the pin [mm]."""
        return round(1e3 * self.pin.contact.bearing.clearance, 9)

    @property
    def restitution(self) -> float:
        """That all laws are asked for: the pin's law's, or the paper machine's."""
        return float(getattr(self.pin.contact.normal, "restitution", paper_machine.RESTITUTION))

    @cached_property
    def laws(self) -> dict[str, tuple[forces.NormalLaw, forces.FrictionLaw]]:
        """Normal and friction law of every case: normal laws without friction, friction on the exact law."""
        bore, none = self.pin.contact.bearing.bore_radius, forces.Frictionless()
        own = self.pin.contact.normal
        if isinstance(own, forces.PowerLaw) and own.exponent == 1.5:
            stiffness = own.stiffness
        else:  # with which they are pressed as deep as the pin's own law by what it holds
            stiffness = self.load / own.resting_depth(self.load) ** 1.5
        normal = catalogue.normal_laws(
            self.clearance_mm,
            self.restitution,
            bore_radius=bore,
            stiffness=stiffness,
            load=self.load,
            length=self.length,
        )
        exact = normal["exact"]
        friction = catalogue.friction_laws(self.subject.friction)
        return {
            **{name: (law, none) for name, law in normal.items()},
            **{f"friction {name}": (exact, law) for name, law in friction.items()},
        }

    @cached_property
    def runs(self) -> dict[str, Scenario]:
        """The motion under every law, by case.

        To the accuracy of studies; at chosen steps where the Exudyn formulation alone covers a law. There an
        accuracy would never be met: such laws stick and slip without end.
        """
        return {name: self._run(normal, friction) for name, (normal, friction) in self.laws.items()}

    @cached_property
    def rubbing(self) -> dict[str, Scenario]:
        """The motion under every law with hysteresis damping and one stiffness, with friction, by law."""
        friction = catalogue.friction_laws(self.subject.friction)["ambrosio"]
        return {name: self._run(self.laws[name][0], friction) for name in POWER_LAWS}

    @cached_property
    def resting(self) -> dict[str, Scenario]:
        """The motion from a settled start, clearance with friction in all pins, by rest velocity."""
        normal: Any = self.laws["lankarani_nikravesh"][0]
        friction = self.laws["friction ambrosio"][1]
        found = {}
        for name, velocity in REST.items():
            case = self._run(replace(normal, rest_velocity=velocity), friction)
            pins = dict.fromkeys(case.linkage.pins, case.pins[self.subject.pin])
            found[name] = replace(case, pins=pins, start="settled", accuracy="standard")
        return found

    def _run(self, normal: forces.NormalLaw, friction: forces.FrictionLaw) -> Scenario:
        motion = self.subject.motion
        pin = replace(self.pin, contact=replace(self.pin.contact, normal=normal, friction=friction))
        case = to_accuracy(replace(motion, pins={**motion.pins, self.subject.pin: pin}))
        if cheapest(case) != "exudyn":
            return case
        if not self.subject.is_paper:
            return settings_for(case, OWN_GOAL)
        # of Newton's iterations a looser tolerance spares one a step; it changes means and spreads by 1e-6
        settings = SolverSettings(impact_steps=RISE_IMPACT_STEPS, newton_tolerance=1e-6)
        return replace(case, accuracy=None, step=RISE_STEP, solver=settings, formulation="exudyn")


def damping_ratio(case: Scenario, pin: str) -> float:
    """Damping ratio of small vibrations of a pin under the weight, closed at the start: c / (2 sqrt(k m))."""
    resting = next(one for one in loaded_contacts(case) if one.pin == pin)
    law, step = resting.contact.normal, 1e-6  # [m/s]
    depth = law.resting_depth(resting.load)
    damping = (law(depth, step, 0.0) - law(depth, -step, 0.0)) / (2.0 * step)
    return float(damping / (2.0 * np.sqrt(resting.stiffness * resting.mass)))


def soft_restitution(case: Scenario, pin: str, speed: float) -> float:
    """Restitution of a free impact of a speed [m/s] of the mass that moves with a pin."""
    resting = next(one for one in loaded_contacts(case) if one.pin == pin)
    return one_dimensional_restitution(resting.contact.normal, resting.mass, speed)


LONGEST = 10.0  # durations of an undamped impact in which every law here has let go
Series = npt.NDArray[np.float64]


def free_impact(law: NormalLaw, speed: float, impact_steps: int, records: int = 10) -> Scenario:
    """A journal of 2 kg flies at a speed [m/s] against the wall of a free bore of 3 kg; nothing else acts.

    The run begins shortly before the impact and ends before the far wall can be reached.
    """
    stand = ImpactStand(bore_mass=BORE_MASS, journal_mass=JOURNAL_MASS, speed=speed)
    depth = law.turning_depth(0.5 * stand.reduced_mass * speed**2)
    time = LONGEST * 2.94 * depth / speed
    flight = 0.01 * time
    clearance = 10.0 * speed * time
    wide = JournalBearing(bore_radius=10.0 * clearance, clearance=clearance)
    contact = JournalContact(bearing=getattr(law, "bearing", wide), normal=law)  # of cylinders it has its own
    start = contact.bearing.clearance - speed * flight
    return Scenario(
        machine=ImpactStand(bore_mass=BORE_MASS, journal_mass=JOURNAL_MASS, speed=speed, eccentricity=start),
        pins={PIN: ClearancePin(contact=contact)},
        duration=flight + time,
        record_period=(flight + time) / records,
        gravity=(0.0, 0.0),
        solver=SolverSettings(impact_steps=impact_steps),
    )


def delivered_restitution(result: Result) -> float:
    """Speed of separation over initial impact velocity."""
    separation = result["bore.velocity_x"][-1] - result["journal.velocity_x"][-1]
    machine: Any = result.scenario.machine
    return float(separation / machine.speed)


def one_dimensional_restitution(law: NormalLaw, mass: float, speed: float) -> float:
    """Restitution of a free impact by scipy: m depth'' = -F, tension cut, until the depth is zero again."""
    scale = law.turning_depth(0.5 * mass * speed**2)  # so that tolerances mean something
    time = scale / speed

    def motion(_: float, state: Series) -> list[float]:
        depth = state[0] * scale
        force = max(0.0, law(float(depth), float(state[1] * speed), speed)) if depth > 0.0 else 0.0
        return [state[1], -force * time / (mass * speed)]

    def separation(_: float, state: Series) -> float:
        return float(state[0])

    separation.terminal, separation.direction = True, -1.0  # type: ignore[attr-defined]
    found = solve_ivp(
        motion, (0.0, 1e4), [0.0, 1.0], "LSODA", events=separation, rtol=1e-10, atol=1e-12, max_step=0.05
    )
    ends: Any = found.y_events
    return float(-ends[0][0][1])
