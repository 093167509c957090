"""Whether a run comes to a change point or dead centre, in which rigid bodies do not determine its forces.

There one condition more than elsewhere follows from the others: of the singular values of all conditions the
least, s, vanishes. The forces in the joints grow beyond any limit, F = c/s, unless c = 0 belongs to the load,
as where a symmetric linkage swings through. Errors of a run grow as 1/s^2 there and may hide that.
"""

import math

import numpy as np

from support_exudyn.machines.check.freedoms import in_line
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.closing import Conditions, repeated_count
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scenario.scenario import Scenario

SINGULAR = 1e-5  # of the largest singular value: below, a condition says nothing
NEAR = 0.2  # of the largest singular value of a dip that is looked into
DIP = 1.2  # times what is left at the record nearest to the point is left at one beside
UNBOUNDED = 0.25  # share of a force that grows as one over what is left of a condition: it has no limit
SPIKE = 10.0  # times the forces a little beside: what records next to the point show is none
LEAP = 0.01  # share of the largest force by which none leaps from record to record
BEYOND = 1e6  # times the median: forces beside a point that is passed freely, which are of rounding
CLOSE = 1e-3  # of the largest singular value: where a run ends so near to a point it is the reason
STRIDE = 16  # records between those whose values are computed in any case
SAMPLES = 2000  # records at least that are looked at, of many
FOUND = 1e-9  # of the time between two records
ADVICE = (
    "Rigid bodies do not determine the forces there: give one joint a clearance or a bushing, or let the drive "
    "stop before."
)


def values_of(conditions: Conditions, position: Series) -> Series:
    """Singular values of the conditions at positions (n, 3 bodies), as shares of the largest, (n, k)."""
    return _values(_rows(conditions, position))


def _rows(conditions: Conditions, position: Series) -> Series:
    motion = BodyMotion(conditions.linkage, position, position)
    return np.asarray(conditions.counts[:, None] * conditions.kinetics.arrays.matrix(motion) / conditions.arms)


def _values(rows: Series) -> Series:
    values: Series = np.asarray(np.linalg.svd(rows, compute_uv=False))
    return values / np.maximum(values[:, :1], math.ulp(0.0))


def _where_it_dips(conditions: Conditions, position: Series, last: int) -> Series:
    """What is left of a condition at positions (n, 3 bodies), (n,); nan where it certainly has no dip.

    A singular value changes by no more than the norm of the difference of two matrices (Weyl). Between two
    of some positions with little difference no neighbours can differ as much as a dip does.
    """
    rows = _rows(conditions, position)
    count = len(rows)
    some = np.unique(np.append(np.arange(0, count, STRIDE), count - 1))
    values = np.linalg.svd(rows[some], compute_uv=False)
    moved = np.linalg.norm(np.diff(rows, axis=0), axis=(1, 2))
    length = np.concatenate([[0.0], np.cumsum(moved)])
    way = np.diff(length[some])
    lowest, highest = values[:-1, last] - way, values[:-1, 0] + way
    steepest = np.maximum.reduceat(moved, some[:-1])
    # of a share s_k / s_1 of two neighbours: (1 + step / s_k) / (1 - step / s_1), with room to spare
    shaky = ~((lowest > 0.0) & (steepest * (1.0 / lowest + 1.0 / (highest - 2.0 * way)) < 0.5 * (DIP - 1.0)))
    shaky |= highest <= 2.0 * way
    shaky[[0, -1]] = True
    shaky |= np.append(shaky[1:], False) | np.append(False, shaky[:-1])
    wanted = np.append(np.repeat(shaky, np.diff(some)), True)
    left = np.full(count, np.nan)
    left[wanted] = _values(rows[wanted])[:, last]
    return left


def words(conditions: Conditions, position: Matrix) -> str:
    """That a posture is a change point, with what lies in line and where the driven parts stand."""
    moved = position * conditions.arms
    rows = conditions.rows(moved)
    why = in_line(conditions, moved, rows) if len(rows) >= rows.shape[1] else ""
    linkage, kinetics = conditions.linkage, conditions.kinetics
    stands = []
    for name, crank in linkage.cranks.items():
        angle = linkage.bodies[crank.body].angle + float(kinetics.motion(position).turn(crank.body)[0])
        stands.append(f"{name} at {round(math.degrees(angle), 3) % 360.0:g} degrees")
    return "the linkage is at a change point or dead centre" + "".join(
        f" ({said})" for said in (", ".join(stands), why) if said
    )


def ended_at(scenario: Scenario, position: Matrix) -> str:
    """Words if a run has ended next to a change point or dead centre; else none.

    position: of all bodies where it has ended, in the order of the linkage (3 bodies,).
    """
    if scenario.dimensions == 3 or not np.isfinite(position).all():
        return ""
    conditions = scenario.held
    values = values_of(conditions, position[None])[0]
    last = len(conditions.counts) - repeated_count(conditions)[0] - 1
    return words(conditions, position) if 0 <= last < len(values) and values[last] < CLOSE else ""


def passed(scenario: Scenario, run: Trajectory) -> tuple[float, str] | None:
    """Return when a plane run has passed the first change point in which forces have no limit [s], and words.

    Returns None if the run has passed no such point.
    """
    if not run.motion.position.size or not run.motion.velocity.size:
        return None
    motion, time = run.motion, run.time
    forces = {name: np.hypot(*force.T) for name, force in run.pins.items()}
    forces |= {name: np.abs(slide[:, 0]) for name, slide in run.slides.items()}
    conditions = scenario.held
    last = len(conditions.counts) - repeated_count(conditions)[0] - 1
    if len(time) < 3 or not forces or not 0 <= last < motion.position.shape[1]:
        return None
    driven = last == motion.position.shape[1] - 1
    some = slice(None, None, max(1, len(time) // SAMPLES))
    time, motion = time[some], BodyMotion(motion.linkage, motion.position[some], motion.velocity[some])
    left = _where_it_dips(conditions, motion.position, last)
    joints = np.array([force[some] for force in forces.values()])
    largest = joints.max(axis=0)
    before, here, after = left[:-2], left[1:-1], left[2:]
    dips = (here <= before) & (here < after) & (here < NEAR) & (DIP * here < np.maximum(before, after))
    for n in [0, *(np.flatnonzero(dips) + 1).tolist(), len(left) - 1]:
        # what swings through freely moves on as energy has it, whatever the forces
        wrong = (
            _unbounded(left, largest, n) or _leaps(left, joints, n)
            if driven
            else largest[max(n - 1, 0) : n + 2].max() > BEYOND * np.median(largest)
        )
        if wrong:
            at, position, least = _least(conditions, motion, time, n, last)
            if least < SINGULAR:
                return at, words(conditions, position)
    return None


def _least(
    conditions: Conditions, motion: BodyMotion, time: Series, n: int, last: int
) -> tuple[float, Matrix, float]:
    """Where a condition says least about record n: time [s], position (3 bodies,), and what is left of it."""
    from scipy.interpolate import CubicHermiteSpline  # slow to import
    from scipy.optimize import minimize_scalar

    best = (
        float(time[n]),
        motion.position[n],
        float(values_of(conditions, motion.position[n : n + 1])[0, last]),
    )
    # what a record in the point itself shows may be of rounding
    for low, high in ((n - 1, n), (n, n + 1), (n - 1, n + 1)) if 0 < n < len(time) - 1 else ():
        ends = [low, high]
        way = CubicHermiteSpline(time[ends], motion.position[ends], motion.velocity[ends])
        found = minimize_scalar(
            lambda t, way=way: float(values_of(conditions, way(t)[None])[0, last]),
            bounds=(time[low], time[high]),
            method="bounded",
            options={"xatol": FOUND * (time[high] - time[low])},
        )
        if found.fun < best[2]:
            best = (float(found.x), way(found.x), float(found.fun))
    return best


def _unbounded(left: Series, largest: Series, n: int) -> bool:
    """Whether forces grow as one over what is left of a condition towards record n, or leap next to it."""
    inside = range(len(left))
    around = [largest[m] for m in (n - 3, n - 2, n + 2, n + 3) if m in inside]
    if max(largest[m] for m in (n - 1, n, n + 1) if m in inside) > SPIKE * max(around, default=math.inf):
        return True
    for one, other in ((n - 1, n - 2), (n + 1, n + 2)):
        if one in inside and other in inside and SINGULAR < left[one] < left[other]:
            share = (largest[one] - largest[other]) * left[other] / (left[other] - left[one])  # c over s at one
            if share > UNBOUNDED * largest[one]:
                return True
    return False


def _leaps(left: Series, joints: Series, n: int) -> bool:
    """Whether record n is in the point itself and shows forces (joints, n) that do not fit those beside."""
    end = len(left) - 1
    one, other = (1, 2) if n == 0 else (end - 1, end - 2) if n == end else (n - 1, n + 1)
    expected = (
        2.0 * joints[:, one] - joints[:, other] if n in (0, end) else 0.5 * (joints[:, one] + joints[:, other])
    )
    leap = np.abs(joints[:, n] - expected).max()
    return bool(left[n] < SINGULAR and leap > LEAP * joints[:, [one, n, other]].max())
