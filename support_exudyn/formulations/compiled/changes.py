"""What impacts and separations change in what contacts remember."""

import math

from support_exudyn.formulations.compiled.depth import IMPACT, SEPARATION, TOGETHER
from support_exudyn.scene.arrays import IMPACTS, Matrix, SceneArrays, Vector
from support_exudyn.scene.compilation import compiled, once


@compiled
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
    """Change what contacts remember as an event of contact n at t [s] does; whether there is room for it.

    Contacts that meet at the same instant within rounding, as both corners of a face do, impact together; those
    that part at the same instant separate together. Rounding then does not decide which of them comes first.
    """
    if what == SEPARATION:
        separate(scene, n, t, y, onsets, report)
    elif what == IMPACT:
        if not strike(scene, n, t, y, onsets, report):
            return False
    else:
        return True
    for m in range(scene.contacts.size):
        other = scene.contacts[m]
        if m == n or abs(other.depth) > TOGETHER:
            continue
        if what == SEPARATION and other.closed != 0.0 and other.rate < 0.0:
            separate(scene, m, t, y, onsets, report)
        together = what == IMPACT and other.closed == 0.0 and other.rate > 0.0
        if together and not strike(scene, m, t, y, onsets, report):
            return False
    return True
