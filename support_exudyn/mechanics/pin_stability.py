"""Whether a clearance pin that is loaded and slides stays at its place in the bore, or shakes.

The journal's centre has two coordinates, r from the bore's centre. All else is held: other pins are closed, and
actuators and cranks go as they are driven. Near a posture

    r'' = W (Q(r, r') - R),   Q = F + B_j^T M_j - B_b^T M_b

with W the inverse effective mass of the journal, F the contact's force on it, M_j and M_b its moments about the
centres of journal and bore, B_j and B_b what turns r' into the spins of both bodies, and R the Q that an ideal
pin would transmit. The sliding equilibrium is the r with Q(r, 0) = R. Small motions x about it follow

    x'' = W (dQ/dr x + dQ/dr' x')

R and W change so little over a depth that their slopes are left out. A friction force that follows the normal
force makes dQ/dr unsymmetric: two vibrations may couple so that one of them gains energy from the sliding; and
as it follows the normal force's damping too, damping may feed such a vibration instead of ending it. Beyond
Painleve's threshold a normal force pulls the journal further in, as friction drives the machine that way.

Source: Hoffmann, Fischer, Allgaier and Gaul, A minimal model for studying properties of the mode-coupling type
instability in friction induced oscillations, Mech. Res. Commun. 29 (2002) 197-205; Painleve, C. R. Acad. Sci.
Paris 121 (1895) 112-115.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from user_forces.contact import ContactForce, JournalContact
from user_forces.friction.law import TwoCoefficients
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.normal.law import LoadError

Matrix = npt.NDArray[np.float64]
NEAR = 1e-4  # of the depth: distance over which slopes are taken
SLOW = 1e-6  # [m/s] likewise of velocities
CLOSED = 1e-11  # of the load: what may be left of it at an equilibrium
ROUNDINGS = 4.0  # of the place: a shorter step changes nothing
ITERATIONS = 60
NEGLIGIBLE = 1e-4  # growth rate as a share of the angular frequency, up to which nothing is said to grow
OSCILLATES = 1e-9  # imaginary part of a root, as a share of its size, from which on it is a vibration
LARGEST_FRICTION = 1.0
PRECISE = 1e-5  # to which a critical coefficient is found
STILL = np.zeros(2)
SCANNED = 21  # coefficients of friction at which a critical one is looked for


@dataclass(frozen=True)
class LoadedJournal:
    """A journal of one posture, with all that its two coordinates feel. Axes of the ground.

    Arguments:
        inverse_mass: W (2, 2) [1/kg].
        load: R, the force on the journal that an ideal pin would transmit (2,) [N].
        journal_turn, bore_turn: B_j, B_b: spin of either body by the journal's velocity (2,) [1/m].
        journal_spin, bore_spin: of the bodies as they are driven, with the pin closed [rad/s].
    """

    inverse_mass: Matrix
    load: Matrix
    journal_turn: Matrix
    bore_turn: Matrix
    journal_spin: float
    bore_spin: float


@dataclass(frozen=True)
class SlidingPin:
    """The sliding equilibrium of a loaded journal, and what becomes of small motions about it.

    Arguments:
        place: of the journal's centre from the bore's (2,) [m]. depth: there [m]. slip: [m/s].
        normal_force: [N]. friction_along: the friction force on the journal (2,) [N].
        mass: along the normal [kg]. stiffness: -dQ/dr (2, 2) [N/m]. damping: -dQ/dr' (2, 2) [N s/m].
        roots: eigenvalues of x'' = W (dQ/dr x + dQ/dr' x') (4,) [1/s].
        normal_mobility: n W (-Q) per normal force, n the normal [1/kg]; negative beyond Painleve's threshold.
    """

    place: Matrix
    depth: float
    slip: float
    normal_force: float
    friction_along: Matrix
    mass: float
    stiffness: Matrix
    damping: Matrix
    roots: npt.NDArray[np.complex128]
    normal_mobility: float

    @property
    def _root(self) -> complex:
        """The root that grows fastest, or decays slowest: of vibrations, and of real roots those that grow.

        Real roots that decay are a journal that creeps back; they count where nothing vibrates.
        """
        vibrates = np.abs(self.roots.imag) > OSCILLATES * np.abs(self.roots)
        counted = self.roots[vibrates | (self.roots.real > 0.0)]
        return complex(max(counted if counted.size else self.roots, key=lambda root: root.real))

    @property
    def growth(self) -> float:
        """Growth rate of the motion that grows fastest [1/s]; negative: all decay."""
        return self._root.real

    @property
    def frequency(self) -> float:
        """Frequency of that motion [Hz]; 0: it does not vibrate."""
        root = self._root
        return abs(root.imag) / (2.0 * math.pi) if abs(root.imag) > OSCILLATES * abs(root) else 0.0

    @property
    def friction(self) -> float:
        """Friction force over normal force [-]."""
        return float(np.linalg.norm(self.friction_along)) / self.normal_force

    @property
    def margin(self) -> float:
        """By how much the growth rate stays below what counts as growth [1/s]; negative: it shakes."""
        return NEGLIGIBLE * abs(self._root) - self.growth

    @property
    def stable(self) -> bool:
        """Whether small motions decay, or grow by less than a thousandth part in a swing."""
        return self.margin >= 0.0


class NoEquilibriumError(LoadError):
    """A journal has no place in its bore at which it slides under its load."""


def sliding_pin(journal: LoadedJournal, contact: JournalContact, near: Matrix | None = None) -> SlidingPin:
    """The sliding equilibrium of a journal and its roots.

    Arguments:
        journal: of one posture.
        contact: its laws; the contact has no impact velocity, as one that is closed at the start.
        near: a place (2,) [m] from which the equilibrium is looked for; by default under the load.

    Raises NoEquilibriumError if there is none, LoadError if the law cannot hold the load.
    """
    load = float(np.linalg.norm(journal.load))
    if load == 0.0:
        raise NoEquilibriumError("load = 0 N: the journal is not pressed into its bore; allowed: > 0 N")
    if near is None:
        near = -journal.load / load * (contact.bearing.clearance + contact.normal.resting_depth(load))
    place = _equilibrium(journal, contact, near)
    pushes = _Pushes(journal, contact)
    found = pushes.contact_at(place)
    normal = place / np.linalg.norm(place)
    by_place, by_velocity = pushes.slopes(place)
    free = np.zeros((4, 4))
    free[:2, 2:] = np.eye(2)
    free[2:, :2], free[2:, 2:] = journal.inverse_mass @ by_place, journal.inverse_mass @ by_velocity
    return SlidingPin(
        place=place,
        depth=found.depth,
        slip=found.slip,
        normal_force=found.normal_force,
        friction_along=found.friction_force * np.array([-normal[1], normal[0]]),
        mass=1.0 / float(normal @ journal.inverse_mass @ normal),
        stiffness=-by_place,
        damping=-by_velocity,
        roots=np.linalg.eigvals(free).astype(complex),
        normal_mobility=-float(normal @ journal.inverse_mass @ pushes.at(place)) / found.normal_force,
    )


def with_friction(contact: JournalContact, coefficient: float) -> JournalContact:
    """The contact with another sliding coefficient of friction [-], >= 0.

    A larger coefficient at rest keeps its ratio to it. A contact without friction gets Ambrosio's law.
    """
    friction: Any = contact.friction
    if not hasattr(friction, "sliding_coefficient"):
        return replace(contact, friction=Ambrosio(sliding_coefficient=coefficient))
    changed = {"sliding_coefficient": coefficient}
    if isinstance(friction, TwoCoefficients):
        sliding = friction.sliding_coefficient
        changed["static_coefficient"] = coefficient * (
            friction.static_coefficient / sliding if sliding else 1.0
        )
    return replace(contact, friction=replace(friction, **changed))


def without_state(contact: JournalContact) -> JournalContact:
    """The contact with Ambrosio's law in place of a friction law with a state, of the same sliding coefficient.

    That is what such a law tends to while the pin slides.
    """
    if not contact.friction.has_state:
        return contact
    coefficient = float(getattr(contact.friction, "sliding_coefficient", 0.0))
    return with_friction(replace(contact, friction=Frictionless()), coefficient)


def critical_friction(
    journal: LoadedJournal, contact: JournalContact, largest: float = LARGEST_FRICTION
) -> float:
    """The smallest sliding coefficient of friction with which it shakes [-]; infinite: none up to `largest`.

    A journal that has no equilibrium with a coefficient counts as one that shakes, and so does one whose law
    does not hold it there.
    """
    return _crossing(journal, contact, largest, lambda pin: pin.margin)


def painleve_friction(
    journal: LoadedJournal, contact: JournalContact, largest: float = LARGEST_FRICTION
) -> float:
    """The coefficient of friction from which on the normal mobility is negative [-]; infinite: none."""
    return _crossing(journal, contact, largest, lambda pin: pin.normal_mobility)


def _crossing(
    journal: LoadedJournal, contact: JournalContact, largest: float, margin: Callable[[SlidingPin], float]
) -> float:
    """The smallest coefficient at which a margin is not positive; infinite if there is none up to `largest`."""
    place: Matrix | None = None

    def lost(coefficient: float) -> bool:
        nonlocal place
        try:
            pin = sliding_pin(journal, with_friction(contact, coefficient), place)
        except LoadError:
            return True
        place = pin.place
        return margin(pin) <= 0.0

    low = 0.0
    for high in np.linspace(0.0, largest, SCANNED).tolist():
        if not lost(high):
            low = high
            continue
        while high - low > PRECISE:  # by halving: the margin may jump there
            middle = 0.5 * (low + high)
            low, high = (low, middle) if lost(middle) else (middle, high)
        return float(high)
    return math.inf


class _Pushes:
    """The generalised force of a contact on its journal's two coordinates."""

    def __init__(self, journal: LoadedJournal, contact: JournalContact) -> None:
        self.journal, self.contact = journal, contact

    def contact_at(self, place: Matrix, velocity: Matrix = STILL) -> ContactForce:
        """State and force of the contact at a place [m] and a velocity [m/s], (2,) each."""
        journal = self.journal
        bore_spin = journal.bore_spin + float(journal.bore_turn @ velocity)
        journal_spin = journal.journal_spin + float(journal.journal_turn @ velocity)
        (x, y), (vx, vy) = place.tolist(), velocity.tolist()
        return self.contact.force(x, y, vx, vy, bore_spin, journal_spin, 0.0)

    def at(self, place: Matrix, velocity: Matrix = STILL) -> Matrix:
        """Q (2,) [N]."""
        found = self.contact_at(place, velocity)
        bore_moment = found.friction_force * (found.journal_arm + float(np.linalg.norm(place)))
        return (
            np.array([found.force_x, found.force_y])
            + self.journal.journal_turn * found.journal_moment
            - self.journal.bore_turn * bore_moment
        )

    def slopes(self, place: Matrix) -> tuple[Matrix, Matrix]:
        """dQ/dr [N/m] and dQ/dr' [N s/m] at a place, at rest there; (2, 2) each."""
        depth = self.contact.bearing.depth(float(np.linalg.norm(place)))
        by_place = [self.at(place + h) - self.at(place - h) for h in NEAR * depth * np.eye(2)]
        by_velocity = [self.at(place, h) - self.at(place, -h) for h in SLOW * np.eye(2)]
        return np.transpose(by_place) / (2.0 * NEAR * depth), np.transpose(by_velocity) / (2.0 * SLOW)


def _equilibrium(journal: LoadedJournal, contact: JournalContact, near: Matrix) -> Matrix:
    """The place (2,) [m] with Q = R, by Newton's method from one near it; steps stay inside the contact."""
    place, load = near, float(np.linalg.norm(journal.load))
    pushes = _Pushes(journal, contact)
    for _ in range(ITERATIONS):
        depth = contact.bearing.depth(float(np.linalg.norm(place)))
        missing = journal.load - pushes.at(place)
        if np.linalg.norm(missing) <= CLOSED * load:
            return place
        try:
            step = np.linalg.solve(pushes.slopes(place)[0], missing)
        except np.linalg.LinAlgError:
            break
        if np.abs(step).max() <= ROUNDINGS * np.spacing(np.abs(place).max()):
            return place
        normal = place / np.linalg.norm(place)
        inwards = -float(normal @ step)
        place = place + step * min(1.0, 0.5 * depth / inwards if inwards > 0.0 else 1.0)
        if not contact.bearing.depth(float(np.linalg.norm(place))) > 0.0:
            break
    raise NoEquilibriumError(
        f"load = {load:.6g} N: nowhere in its bore the journal stays while it slides; allowed: a load, a "
        "direction of sliding and a friction with which it does"
    )
