"""When a pin must be looked at again: when its surfaces may have met or parted since the last look."""

from __future__ import annotations

import math

from support_exudyn.formulations.redundant.clearance.pin_motion import PinMotion

WAY = 0.25  # of the way to a touch or parting may be gone before the next look
STRONGER = 4.0  # than it was since the last look the acceleration may become before the next
SMALLEST = 1e-300  # [m/s], only so that nothing is divided by zero
WEAKEST = 100.0  # acceleration that is always allowed for [m/s^2]


class Lookout:
    """Looks at a pin, seldom while its surfaces are far from meeting or parting.

    Arguments:
        motion: of its journal in its bore.
        clearance: [m].
    """

    def __init__(self, motion: PinMotion, clearance: float) -> None:
        self._motion = motion
        self._clearance = clearance
        self._last = (0.0, 0.0, 0.0)  # time of the last look [s], velocity then [m/s]
        self.next = 0.0  # time of the next look [s]

    def look(self, now: float, step: float) -> tuple[float, float]:
        """Depth [m] and rate [m/s] at this time [s]; steps are so long [s]."""
        (bx, by, bvx, bvy, _, _), (x, y, vx, vy, _, _) = self._motion.now()
        x, y, vx, vy = x - bx, y - by, vx - bvx, vy - bvy
        eccentricity = math.hypot(x, y)
        depth = eccentricity - self._clearance
        last, last_vx, last_vy = self._last
        since = max(now - last, step)
        rate = (x * vx + y * vy) / (eccentricity or 1.0)
        strong = max(WEAKEST, STRONGER * math.hypot(vx - last_vx, vy - last_vy) / since)
        strong += (vx * vx + vy * vy) / self._clearance  # of the depth: what circles goes outwards
        way, towards = WAY * abs(depth), rate if depth < 0.0 else -rate
        # the time for that way from this speed at that acceleration, at most twice that since the last look
        wait = 2.0 * way / max(SMALLEST, towards + math.sqrt(towards * towards + 2.0 * strong * way))
        self.next = now + min(wait, 2.0 * since)
        self._last = now, vx, vy
        return depth, rate
