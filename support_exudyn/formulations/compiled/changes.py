"""What impacts, separations and contacts that are pressed on again change in what contacts remember."""

import math

from support_exudyn.formulations.compilation import compiled, once
from support_exudyn.formulations.compiled.arrays import IMPACTS, Matrix, SceneArrays, Scratch, Vector
from support_exudyn.formulations.compiled.depth import IMPACT, RETURN, SEPARATION, TOGETHER
from support_exudyn.formulations.compiled.masses import renew_mass


@once
def separate(scene: SceneArrays, n: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> None:
    """The surfaces of a contact part at t [s]."""
    contact = scene.contacts[n]
    contact.closed = contact.impact_velocity = 0.0
    for i in range(int(report[IMPACTS]) - 1, -1, -1):
        if onsets[i, 0] == n:
            onsets[i, 3], onsets[i, 4] = t, max(0.0, -contact.rate)
            break
    if contact.state >= 0:
        y[contact.state] = 0.0


@compiled
def strike(scene: SceneArrays, n: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> bool:
    """The surfaces of a contact meet at t [s]; whether there is room to note it."""
    i = int(report[IMPACTS])
    if i >= onsets.shape[0]:
        return False
    contact = scene.contacts[n]
    contact.closed, contact.impact_velocity = 1.0, max(0.0, contact.rate)
    onsets[i, 0], onsets[i, 1], onsets[i, 2] = n, t, contact.impact_velocity
    onsets[i, 3], onsets[i, 4] = math.inf, 0.0
    report[IMPACTS] += 1
    if contact.state >= 0:
        y[contact.state] = 0.0
    return True


@once
def happen(scene: SceneArrays, n: int, what: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> bool:
    """Change what contacts remember as an event of one at t [s] does; whether there is room for it.

    Others that meet at the same instant, as both corners of a face do, impact with it.
    """
    contact = scene.contacts[n]
    if what == SEPARATION:
        separate(scene, n, t, y, onsets, report)
    elif what == RETURN and contact.forgets != 0:
        contact.impact_velocity = 0.0
    elif what == IMPACT:
        if not strike(scene, n, t, y, onsets, report):
            return False
        for m in range(scene.contacts.size):
            other = scene.contacts[m]
            together = other.closed == 0.0 and abs(other.depth) <= TOGETHER and other.rate > 0.0
            if together and not strike(scene, m, t, y, onsets, report):
                return False
    return True


@once
def renew_masses(
    scene: SceneArrays, room: Scratch, n: int, what: int, t: float, y: Vector, onsets: Matrix, report: Vector
) -> None:
    """Renew the mass that the law of a contact is told, and of others that have impacted with it."""
    if what == RETURN:
        if scene.contacts[n].renews != 0:
            renew_mass(scene, room, n, y)
        return
    for i in range(int(report[IMPACTS]) - 1, -1, -1):
        if onsets[i, 1] != t:
            break
        m = int(onsets[i, 0])
        if scene.contacts[m].renews != 0:
            renew_mass(scene, room, m, y)
