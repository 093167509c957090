"""How fast a scene moves, as known before it runs: what steps have to follow, how often a run is recorded."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.acting_loads import largest_forces, strain_rates
from support_exudyn.mechanics.constraints import joints_held
from support_exudyn.mechanics.contact_places import ContactPlace, contact_rate
from support_exudyn.mechanics.kinetics import Kinetics, Matrix, kinetics_of
from support_exudyn.model.drives.drive import Reciprocating, Stroke
from support_exudyn.model.drives.table_drive import TableDrive
from support_exudyn.model.linkage import Linkage
from support_exudyn.scenario.scenario_data import ScenarioData
from user_forces.contact import Contact
from user_forces.friction.law import FrictionLaw
from user_forces.normal.law import LoadError, NormalLaw

SMALLEST_INVERSE_MASS = 1e-15  # [1/kg]
ROUNDING = 1e-9  # share of the weight below which a pin carries nothing: loads are of a linear solve
SLIPS = (0.0, *np.geomspace(1e-9, 1.0, 400).tolist())  # [m/s]
PARTS, ZOOMS, STEEPER = (
    32,
    8,
    1.01,
)  # into which the steepest part of SLIPS is divided, while that shows a steeper
SLOWEST_FALL = 1e-3  # [m/s^2]; a scene in which nothing pulls a journal moves as slowly as one likes

OF_DRIVE = 500.0  # records in a stroke, or in the time of a crank over its speed
OF_CONTACT = 3.0  # in the time of a loaded contact's vibration over its angular frequency: 19 in a period
FEWEST, MOST = 1000.0, 5000.0  # records of a run
PERIODS = (1, 2, 5)  # times powers of ten: periods
SAME = 1e-12  # share of a period


@dataclass(frozen=True)
class Timescales:
    """Shortest times of a scene [s]; infinite where there is no such motion.

    flight: of a journal across its clearance. resting: of the vibration of a loaded contact, of what friction
    holds in it, of a compliant pin, or of what a load presses on, one over its angular frequency. drive: of the
    drive, its stroke, the course of a load, a valve's ramp, or one over a crank's speed, or one over the
    angular frequency of what rises and falls. rubbing: in which friction, where it is steepest, stops what
    slides under the load.
    """

    flight: float
    resting: float
    drive: float
    rubbing: float = math.inf


class LoadedContact(NamedTuple):
    """A contact under a static load in the start posture.

    pin: name of the clearance pin, or of a corner in a guide. contact: its laws. load: what it carries [N].
    along: its direction, any if it is but rounding (2,). inverse_mass: of the journal, ground's axes (2, 2)
    [1/kg]. mass: that moves with it along the load [kg]. lightest: that moves with it in any direction [kg].
    stiffness: of the contact there [N/m]; 0 if it carries nothing or cannot hold it.
    """

    pin: str
    contact: Contact
    load: float
    along: Matrix
    inverse_mass: Matrix
    mass: float
    lightest: float
    stiffness: float

    @property
    def time(self) -> float:
        """One over the angular frequency of its vibration [s]; infinite if there is none."""
        return math.sqrt(self.mass / self.stiffness) if self.stiffness > 0.0 else math.inf


def timescales(scenario: ScenarioData) -> Timescales:
    """The shortest times of a scene.

        flight = sqrt(2 c / a),    resting = sqrt(m / k),  k the contact's stiffness at the static load

    a is gravity's acceleration and that of the fastest body of a machine that runs already; m the mass that
    moves with the journal in the start posture along the load, which is that of the weight on ideal pins, or
    the smallest mass times a if there is no weight. It is the mass with all other clearance pins open; while
    others press it is larger, and the vibration slower.
    """
    linkage = scenario.linkage
    pull = _pull(scenario, kinetics_of(linkage))
    plays = [place.play for place in scenario.contact_places.values()]
    flight = math.sqrt(2.0 * min(plays, default=math.inf) / max(pull, SLOWEST_FALL))
    rests, rubs = [math.inf, *_compliant(scenario)], [math.inf]
    for loaded in loaded_contacts(scenario):
        friction = loaded.contact.friction
        rests += [loaded.time, friction.swing_time(loaded.lightest, loaded.load)]
        steepest = _steepest(friction, loaded.load)
        rubs.append(loaded.lightest / steepest if steepest > 0.0 else math.inf)
    return Timescales(flight, min(rests), _drive_time(scenario, linkage), min(rubs))


def loaded_contacts(scenario: ScenarioData) -> list[LoadedContact]:
    """Every contact under the weight, and under weight and largest loads, see `timescales`."""
    linkage, found = scenario.linkage, []
    closed = kinetics_of(linkage)
    pull = _pull(scenario, closed)
    loads = _static_loads(scenario, closed)
    weight = math.hypot(*scenario.gravity) * sum(body.mass for body in linkage.bodies.values())
    for name, place in scenario.contact_places.items():
        inverse_mass = _inverse_mass(scenario, place)
        lightest = 1.0 / max(float(np.linalg.eigvalsh(inverse_mass).max()), SMALLEST_INVERSE_MASS)
        for reactions in loads:
            static = place.loads(reactions)
            load, mass, along = float(np.linalg.norm(static)), lightest, np.array([1.0, 0.0])
            if load > ROUNDING * weight:
                along = static / load
                mass = 1.0 / max(float(along @ inverse_mass @ along), SMALLEST_INVERSE_MASS)
            else:
                load = mass * pull
            stiffness = _slope(place.contact.normal, load) if load > 0.0 else 0.0
            found.append(
                LoadedContact(name, place.contact, load, along, inverse_mass, mass, lightest, stiffness)
            )
    return found


def _pull(scenario: ScenarioData, closed: Kinetics) -> float:
    """What pulls a journal across its clearance [m/s^2]."""
    return math.hypot(*scenario.gravity) + _running(scenario, closed)


def _steepest(law: FrictionLaw, load: float) -> float:
    """The largest rise of the friction force over the slip [N s/m].

    A ramp narrower than what lies between two of SLIPS is found by dividing what it lies in.
    """
    if law.has_state:
        return 0.0  # a spring, which does not damp
    slips, found = SLIPS, 0.0
    for _ in range(ZOOMS):
        forces = [abs(law(slip, load)) for slip in slips]
        rises = [(b - a) / (v - u) for (u, a), (v, b) in pairwise(zip(slips, forces, strict=True))]
        place = int(np.argmax(rises))
        steeper = rises[place] > STEEPER * found
        found = max(found, rises[place])
        if not steeper:
            break
        slips = tuple(np.linspace(slips[place], slips[place + 1], PARTS + 1).tolist())
    return found


def _slope(law: NormalLaw, load: float) -> float:
    """Stiffness of a contact at rest under a load [N/m]; 0 if the law cannot hold it: the run will tell."""
    try:
        depth = law.resting_depth(load)
        return (law.elastic_force(depth) - law.elastic_force(0.99 * depth)) / (0.01 * depth)
    except LoadError:
        return 0.0


def _static_loads(scenario: ScenarioData, closed: Kinetics) -> list[dict[str, Matrix]]:
    """What every pin and guide carries in the start posture, all ideal, see `ContactPlace.loads`.

    Under the weight, and under weight and largest loads.
    """
    weight = closed.weight(scenario.gravity)
    still, forces = np.zeros(weight.size), [weight]
    if scenario.acting_loads:
        forces.append(weight + largest_forces(closed, scenario.acting_loads, scenario.duration))
    fields = {"pins": "pins", "slides": "guides"}
    held = joints_held(closed.constraints).items()
    joints = {f"{fields[part]}.{name}": rows for (part, name), rows in held if part in fields}
    reactions = [closed.respond(still, force, 0.0)[1] for force in forces]
    return [{name: one[rows] for name, rows in joints.items()} for one in reactions]


def _compliant(scenario: ScenarioData) -> list[float]:
    """One over the angular frequency of what stiff loads and compliant pins hold, in the start posture [s]."""
    linkage = scenario.linkage
    rigid = tuple(actuator for actuator in linkage.actuators if actuator not in scenario.compliant_actuators)
    free = kinetics_of(scenario.guided_linkage, scenario.held_pins, rigid)
    still, found = np.zeros(3 * len(linkage.bodies)), []
    for name, load in scenario.elements.items():
        rate = strain_rates(free, name, load)
        inverse_mass = np.diag(rate @ free.respond(still, rate.T, 0.0)[0])
        # what nothing but rounding lets move does not vibrate
        found += [
            math.sqrt(1.0 / (steep * mobile))
            for steep, mobile in zip(load.steepness, inverse_mass.tolist(), strict=True)
            if steep > 0.0 and mobile > SMALLEST_INVERSE_MASS
        ]
    return found


def _running(scenario: ScenarioData, closed: Kinetics) -> float:
    """Acceleration of the fastest body of a machine whose cranks turn from the start on [m/s^2]."""
    speeds = {name: scenario.drive_of(name).initial_speed for name in closed.linkage.cranks}
    fastest = max(map(abs, speeds.values()), default=0.0)
    if fastest == 0.0:
        return 0.0
    size = 3 * len(closed.linkage.bodies)
    rates = closed.rates(lambda name: scenario.drive_of(name).initial_speed)
    velocity = closed.respond(np.zeros(size), np.zeros(size), rates)[0]
    return fastest * float(np.hypot(velocity[0::3], velocity[1::3]).max())


def _inverse_mass(scenario: ScenarioData, place: ContactPlace) -> Matrix:
    """Inverse effective mass of a journal in the start posture, ground's axes (2, 2) [1/kg]."""
    still = np.zeros(3 * len(scenario.linkage.bodies))
    return scenario.open_kinetics.inverse_mass(still, contact_rate(scenario.open_kinetics.motion(still), place))


def _drive_time(scenario: ScenarioData, linkage: Linkage) -> float:
    times = [math.inf]
    cranks = bool(linkage.cranks)
    driving = [(drive, cranks) for drive in scenario.drives_in_use]
    driving += [(drive, False) for load in scenario.acting_loads.values() for drive in load.drives]
    times += [load.shortest_time for load in scenario.acting_loads.values()]
    times += [cylinder.inlet.shortest_time for cylinder in scenario.valved.values()]
    for drive, turns in driving:
        speed = abs(drive.initial_speed)
        if isinstance(drive, Stroke):
            times.append(drive.end - drive.start)
        elif isinstance(drive, Reciprocating):
            times.append(1.0 / drive.frequency)
        elif isinstance(drive, TableDrive):
            times.append(drive.times[-1] - drive.times[0])
        elif speed > 0.0 and turns:
            times.append(1.0 / speed)
    return min(times)


# --- period of the records ---


def default_period(scenario: ScenarioData) -> float:
    """Time between records [s] that shows the drive and the contacts of a scenario: 1, 2, 5 times 10^n.

    A 500th of the stroke or of a crank's time over its speed, a third of a contact's time over its vibration's
    angular frequency; at least 1000 records, at most 5000. Not below steps that the scenario gives, which would
    be cut.
    """
    times = timescales(scenario)
    wanted = min(times.drive / OF_DRIVE, times.resting / OF_CONTACT, scenario.duration / FEWEST)
    given = scenario.accuracy is None and not scenario.chooses_steps
    least = max(scenario.duration / MOST, scenario.step if given else 0.0)
    return min(rounded(wanted, least), scenario.duration)


def rounded(wanted: float, least: float) -> float:
    """The largest round period [s] up to the wanted one; the smallest above the least, if that is longer."""
    limit = max(wanted, least)
    power = math.floor(math.log10(limit))
    periods = [float(f"{step}e{n}") for n in (power - 1, power, power + 1) for step in PERIODS]
    allowed = [one for one in periods if least * (1.0 - SAME) <= one <= limit * (1.0 + SAME)]
    return allowed[-1] if allowed else next(one for one in periods if one > limit)
