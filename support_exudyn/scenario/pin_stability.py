"""Whether the pins of a scenario would shake under their load, from its postures alone: nothing is run.

Every pin is looked at by itself, as a clearance pin among closed ones: those that have clearance with their own
contact, the others as if they had the play of the first of those. Actuators are as long as they are driven, so
oil counts as rigid.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from support_exudyn.mechanics.acting_loads import add_load, load_series
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.closing import Conditions, moved_on, newton
from support_exudyn.mechanics.constraints import constraints_of
from support_exudyn.mechanics.kinetics import Kinetics, Matrix, kinetics_of, weight_of
from support_exudyn.mechanics.pin_stability import (
    LoadedJournal,
    SlidingPin,
    critical_friction,
    sliding_pin,
    with_friction,
    without_state,
)
from support_exudyn.mechanics.reactions import accelerations, equations
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.drives.drive import Reciprocating
from support_exudyn.model.linkage import Linkage
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact
from user_forces.normal.law import LoadError

SAMPLES = 24  # postures between two breaks of the drives
NOT_TOLD = (
    "nothing is told; allowed: a scenario in the plane with a clearance pin, whose drives move it and leave "
    "nothing free, without hydraulic cylinders"
)


@dataclass(frozen=True)
class PinOutlook:
    """What small motions of a pin's journal would do over a scenario.

    Arguments:
        pin: its name. assumed: whether it has no clearance, and is looked at as if it had.
        contact: laws and play it is looked at with.
        times: (n,) [s]. travels: how far the first driven part has gone by then (n,) [m], [rad]. turns: whether
            that is a crank.
        journals: what it feels then. found: its equilibrium, and how it shakes; None where there is none.
    """

    pin: str
    assumed: bool
    contact: JournalContact
    times: Series
    travels: Series
    turns: bool
    journals: Sequence[LoadedJournal]
    found: Sequence[SlidingPin | None]

    @property
    def worst(self) -> int | None:
        """The place in `times` at which small motions grow fastest, or decay slowest; None: none is told."""
        told = [n for n, pin in enumerate(self.found) if pin is not None]
        return max(told, key=lambda n: self.growth(n)) if told else None

    def growth(self, n: int) -> float:
        """Growth rate at the n-th time [1/s]; not a number where there is no equilibrium."""
        pin = self.found[n]
        return math.nan if pin is None else pin.growth

    @property
    def stable(self) -> bool:
        """Whether nothing shakes at any time, and there is an equilibrium at each."""
        return all(pin is not None and pin.stable for pin in self.found)

    @property
    def critical_friction(self) -> float:
        """The smallest coefficient with which it shakes at the worst time [-]; infinite: none up to 1."""
        worst = self.worst
        return math.inf if worst is None else critical_friction(self.journals[worst], self.contact)

    def over_friction(self, coefficients: Sequence[float]) -> tuple[Series, Series, Series]:
        """Growth rates [1/s], margins to growth [1/s] and normal mobilities [1/kg] for other frictions.

        Each is (coefficients, times); not a number where the journal has no equilibrium.
        """
        found = np.full((3, len(coefficients), len(self.times)), math.nan)
        for row, coefficient in enumerate(coefficients):
            contact = with_friction(self.contact, coefficient)
            for column, journal in enumerate(self.journals):
                pin = _slides(journal, contact)
                if pin is not None:
                    found[:, row, column] = pin.growth, pin.margin, pin.normal_mobility
        return found[0], found[1], found[2]


def pin_outlooks(
    scenario: Scenario, times: Sequence[float] | None = None, pins: Collection[str] | None = None
) -> list[PinOutlook]:
    """What small motions of the journal of every pin would do, in the order of the linkage.

    Arguments:
        scenario: in the plane.
        times: at which it is looked at [s], in order; by default over the time in which its drives move, of
            motions that repeat themselves over the first time round.
        pins: names of those that are asked for; by default all.

    Returns an empty list where no pin has clearance, where nothing moves, where hydraulic cylinders move the
    machine, whose posture is not known beforehand, or where degrees of freedom are left.
    """
    clearances = scenario.clearance_pins
    if not clearances or scenario.dimensions == 3 or scenario.valved:
        return []
    usual = next(iter(clearances.values()))
    way = _Way.of(scenario, _moving_times(scenario) if times is None else times)
    if way is None:
        return []
    outlooks = []
    for name in scenario.unloaded.pins:
        if pins is None or name in pins:
            pin, assumed = clearances.get(name, usual), name not in clearances
            contact = without_state(pin.contact)
            journals, found = way.loaded(name, pin.bore == "first", contact)
            outlooks.append(
                PinOutlook(name, assumed, contact, way.times, way.travels, way.turns, journals, found)
            )
    return outlooks


@dataclass(frozen=True)
class _Way:
    """Postures of a scenario with all pins closed: times (n,), travels of the first driven part (n,), positions
    (n, 3 bodies), second derivatives of drives (n, driven).
    """

    scenario: Scenario
    conditions: Conditions
    times: Series
    travels: Series
    position: Series
    driven: Series

    @classmethod
    def of(cls, scenario: Scenario, times: Sequence[float]) -> "_Way | None":
        """The postures at these times, as far as the linkage closes; None if there are none."""
        conditions = Conditions(scenario.unloaded)
        moved, linkage = conditions.still, conditions.linkage
        if np.linalg.matrix_rank(conditions.kinetics.rows(moved)) < moved.size:
            return None
        positions: list[Matrix] = []
        for time in times:
            moved, share = moved_on(conditions, moved, _travels(scenario, linkage, time))
            if share < 1.0:
                break
            positions.append(moved / conditions.arms)
        if not positions:
            return None
        at = np.array(times[: len(positions)])
        names = (*linkage.actuators, *linkage.cranks)
        driven = [accelerations(scenario.drive_of(name), at, scenario.duration) for name in names]
        lead = scenario.drive_of(scenario.driven[0])
        travels = np.array([lead.extension(t) for t in at.tolist()])
        return cls(scenario, conditions, at, travels, np.array(positions), np.array(driven).T)

    @property
    def turns(self) -> bool:
        """Whether what moves it first is a crank."""
        return self.scenario.driven[0] in self.conditions.linkage.cranks

    def loaded(
        self, name: str, second: bool, contact: JournalContact
    ) -> tuple[list[LoadedJournal], list[SlidingPin | None]]:
        """What the journal of a pin feels, and its equilibria; second: whether its second body carries it.

        The first equilibria follow from the postures with the journal in the middle; with it there the machine
        stands a little otherwise, and with it the load.
        """
        position, sign, conditions = self.position, 1.0 if second else -1.0, self.conditions
        for last in (False, True):
            journals = self._journals(name, second, position)
            found = [_slides(journal, contact) for journal in journals]
            if last:
                break
            laid = []
            for at, time, pin in zip(position, self.times.tolist(), found, strict=True):
                offset = {} if pin is None else {name: tuple((sign * pin.place).tolist())}
                targets = conditions.targets(_travels(self.scenario, conditions.linkage, time), offset)
                moved = newton(conditions, conditions.arms * at, targets, conditions.size)
                laid.append(at if moved is None else moved / conditions.arms)
            position = np.array(laid)
        return journals, found

    def _journals(self, name: str, second: bool, position: Series) -> list[LoadedJournal]:
        """What the journal feels at all positions (n, 3 bodies), were it free in its bore and all else held."""
        scenario, linkage = self.scenario, self.conditions.linkage
        velocity = np.array(
            [self._velocity(at, t) for at, t in zip(position, self.times.tolist(), strict=True)]
        )
        motion = BodyMotion(linkage, position, velocity)
        forces = weight_of(motion, scenario.gravity) + _loaded(scenario, motion, self.times)
        multipliers = equations(motion, constraints_of(linkage), self.driven).solve(forces)[1]
        pins = tuple(linkage.pins)
        first = 2 * pins.index(name)
        sign = 1.0 if second else -1.0
        loads = -sign * multipliers[:, first : first + 2]
        opened = kinetics_of(linkage, [other for other in pins if other != name])
        return [
            _journal(opened, name, sign, at, speeds, load)
            for at, speeds, load in zip(position, velocity, loads, strict=True)
        ]

    def _velocity(self, position: Matrix, time: float) -> Matrix:
        """Of all bodies as they are driven (n,)."""
        closed = self.conditions.kinetics
        rates = closed.rates(lambda name: self.scenario.drive_of(name).speed(time))
        return closed.respond(position, np.zeros_like(position), rates)[0]


def _journal(
    opened: Kinetics, name: str, sign: float, position: Series, velocity: Series, load: Series
) -> LoadedJournal:
    place = opened.linkage.pins[name]
    rate = sign * opened.relative(position, place)[1]
    answer = opened.respond(position, rate.T, 0.0)[0]  # velocities by impulses on the journal
    inverse_mass = rate @ answer
    by_velocity = answer @ np.linalg.pinv(inverse_mass, hermitian=True)
    bodies: Sequence[str] = (place.second, place.first) if sign > 0.0 else (place.first, place.second)
    journal, bore = (opened.turning(position.size, body) for body in bodies)
    return LoadedJournal(
        inverse_mass=0.5 * (inverse_mass + inverse_mass.T),
        load=load,
        journal_turn=journal @ by_velocity,
        bore_turn=bore @ by_velocity,
        journal_spin=float(journal @ velocity),
        bore_spin=float(bore @ velocity),
    )


def _slides(journal: LoadedJournal, contact: JournalContact) -> SlidingPin | None:
    try:
        return sliding_pin(journal, contact)
    except LoadError:
        return None


def _travels(scenario: Scenario, linkage: Linkage, time: float) -> dict[str, float]:
    names = (*linkage.actuators, *linkage.cranks)
    return {name: scenario.drive_of(name).extension(time) for name in names}


def _moving_times(scenario: Scenario) -> list[float]:
    """Times at which something that is driven moves, evenly between breaks [s]."""
    drives = [scenario.drive_of(name) for name in scenario.driven]
    end = scenario.duration
    for name in scenario.driven:
        drive = scenario.drive_of(name)
        if isinstance(drive, Reciprocating):
            end = min(end, drive.period)
        if name in scenario.linkage.cranks and drive.initial_speed != 0.0:
            end = min(end, 2.0 * math.pi / abs(drive.initial_speed))
    breaks = sorted({t for drive in drives for t in drive.breaks if 0.0 < t < end})
    found: list[float] = []
    for first, last in pairwise([0.0, *breaks, end]):
        middles = first + (np.arange(SAMPLES) + 0.5) / SAMPLES * (last - first)
        found += [t for t in middles.tolist() if any(drive.speed(t) != 0.0 for drive in drives)]
    return found


def _loaded(scenario: Scenario, motion: BodyMotion, times: Series) -> Series:
    """Forces of loads between what the machine has and the ground, on all coordinates (n, 3 bodies)."""
    forces = np.zeros_like(motion.position)
    for name, load in scenario.elements.items():
        add_load(forces, motion, name, load, load_series(load, name, motion, times))
    return forces
