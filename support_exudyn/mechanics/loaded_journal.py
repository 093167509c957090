"""What the journal of a pin feels at instants of a motion, were it free in its bore and all else held."""

from collections.abc import Sequence

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.constraints import constraints_of
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.mechanics.pin_stability import LoadedJournal
from support_exudyn.mechanics.reactions import equations
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import Linkage


def loaded_journals(
    linkage: Linkage,
    name: str,
    journal_is_second: bool,
    position: Series,
    velocity: Series,
    driven: Series,
    forces: Series,
) -> list[LoadedJournal]:
    """A pin's journal at all instants of a motion.

    Arguments:
        linkage: whose pins are closed, but this one perhaps, and whose actuators follow their drives.
        name: of the pin. journal_is_second: whether its second body carries the journal.
        position, velocity: of all bodies, (n, 3 bodies).
        driven: second derivatives of what drives move, (n, actuators and cranks) [m/s^2], [rad/s^2].
        forces: on all coordinates (n, 3 bodies) [N], [N m].
    """
    pins = tuple(linkage.pins)
    motion = BodyMotion(linkage, position, velocity)
    multipliers = equations(motion, constraints_of(linkage), driven).solve(forces)[1]
    first = 2 * pins.index(name)
    sign = 1.0 if journal_is_second else -1.0
    loads = -sign * multipliers[:, first : first + 2]
    opened = kinetics_of(linkage, [other for other in pins if other != name])
    return [
        _journal(opened, name, sign, at, speeds, load)
        for at, speeds, load in zip(position, velocity, loads, strict=True)
    ]


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
