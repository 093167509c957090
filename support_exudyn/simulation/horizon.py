"""Up to when a run with impacts is determined: each impact multiplies the errors of the ones before.

Two runs with different steps agree impact by impact, until what one impact leaves to the next has grown to the
size of the motion itself. What comes later is no result of any run; its means and spreads may be.
"""

import math
from collections.abc import Iterable, Sequence

from support_exudyn.simulation.recorded_run import RecordedRun
from user_forces.contact_state import Onset

APART = (
    0.1  # share of the time since the impact before, or of the initial impact velocity, by which impacts differ
)


def horizon(result: RecordedRun) -> float:
    """The time [s] of the first impact in which a run differs from the next coarser one; infinite: none does.

    Impacts of a contact are matched in their order. They differ if their times do by more than a tenth of the
    time since the one before, or their initial impact velocities by more than a tenth, or if one run lacks it.

    Raises ValueError if there is no coarser run.
    """
    if result.coarser is None:
        raise ValueError("no coarser run to compare with")
    pairs = ((onsets, result.coarser.onsets.get(name, ())) for name, onsets in result.onsets.items())
    return min((_first_difference(one, other) for one, other in pairs), default=math.inf)


def agreed(result: RecordedRun) -> int:
    """How many impacts lie before the horizon."""
    end = horizon(result)
    return sum(onset.time < end for onset in _all(result.onsets.values()))


def _all(onsets: Iterable[Sequence[Onset]]) -> Iterable[Onset]:
    return (onset for of_contact in onsets for onset in of_contact)


def _first_difference(one: Sequence[Onset], other: Sequence[Onset]) -> float:
    before = 0.0
    for mine, theirs in zip(one, other, strict=False):
        late = abs(mine.time - theirs.time) > APART * (mine.time - before)
        fast = abs(mine.speed - theirs.speed) > APART * max(mine.speed, theirs.speed)
        if late or fast:
            return min(mine.time, theirs.time)
        before = mine.time
    rest = (*one[len(other) :], *other[len(one) :])
    return min((onset.time for onset in rest), default=math.inf)
