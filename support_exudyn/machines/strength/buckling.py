"""Buckling of a cylinder of several stages between two pins.

Euler, for a column whose bending stiffness EI changes from stage to stage: w'' + P/(E I) w = 0 with w = 0 at
both ends. In a stage w = a sin(k s + phase), k = sqrt(P/(E I)); where the next begins, w and w' go on. The
least load is that at which the phase reaches pi at the far end. It lies between the loads of uniform columns of
the weakest and the stiffest stage, and the phase grows with P, so that it is the only one in that range.

Johnson, for columns that yield before: P = P_y (1 - P_y/(4 P_E)) where P_E > P_y/2, with P_y = yield stress
times the least area of steel.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from support_exudyn.machines.strength.strength_data import CylinderStage, CylinderStrength
from user_forces.roots import bracketed_root
from user_forces.values.value import InputError

Segment = tuple[float, float]  # length [m] and bending stiffness [N m^2]
CLOSE = 1e-12  # of the load


def euler_load(segments: Sequence[Segment]) -> float:
    """The least load [N] at which a pinned column of these segments buckles."""
    length = math.fsum(part for part, _ in segments)
    ends = [(math.pi / length) ** 2 * stiffness for _, stiffness in segments]
    low, high = min(ends), max(ends)
    if high - low <= CLOSE * high:
        return low
    return bracketed_root(lambda load: _phase(segments, load) - math.pi, low, high, xtol=CLOSE * low)


def _phase(segments: Sequence[Segment], load: float) -> float:
    """Phase of the deflection at the far end [rad], 0 at the near one."""
    phase, before = 0.0, 1.0
    for length, stiffness in segments:
        k = math.sqrt(load / stiffness)
        # the deflection and its slope go on; the phase stays within its quarter turn
        changed = math.atan2(k * math.sin(phase), before * math.cos(phase))
        phase += math.remainder(changed - phase, 2.0 * math.pi) + k * length
        before = k
    return phase


def johnson_load(euler: float, squash: float) -> float:
    """Load [N] at which a column fails: Johnson's parabola for a stocky one, Euler's load for a slender one.

    Arguments:
        euler: P_E [N].
        squash: P_y, at which its weakest section yields [N].
    """
    return euler if euler <= 0.5 * squash else squash * (1.0 - squash / (4.0 * euler))


def seen_stages(cylinder: CylinderStrength, length: float) -> list[tuple[float, CylinderStage]]:
    """Lengths [m] of the stages that are seen when a cylinder is so long [m], with the stages, foot first.

    The first stage is seen whole. The thicker moves out first, as its larger area does at a lower pressure.
    Where two overlap, the outer one alone counts.

    Raises InputError if all stages together are not so long, or the first is longer.
    """
    first, *others = cylinder.stages
    left = length - first.length
    if left <= 0.0:
        raise InputError(
            f"stages[0].length = {first.length:.6g} m: the cylinder is {length:.6g} m long there; allowed: less"
        )
    found = [(first.length, first)]
    for stage in others:
        seen = min(stage.length, left)
        if seen > 0.0:
            found.append((seen, stage))
        left -= seen
    if left > CLOSE * length:
        raise InputError(
            f"stages: together {length - left:.6g} m long, and the cylinder has to be {length:.6g} m; allowed: "
            "stages that reach so far"
        )
    return found


def buckling_loads(cylinder: CylinderStrength, length: float) -> tuple[float, float | None]:
    """Loads [N] of one cylinder that is so long [m]: Euler's, and Johnson's where the yield stress is known.

    Raises InputError as `seen_stages` does.
    """
    seen = seen_stages(cylinder, length)
    euler = euler_load([(part, cylinder.elastic_modulus * stage.second_moment) for part, stage in seen])
    if cylinder.yield_stress is None:
        return euler, None
    squash = cylinder.yield_stress * min(stage.area for _, stage in seen)
    return euler, johnson_load(euler, squash)
