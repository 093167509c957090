"""Where within a step a contact begins or ends, by depth and rate at ends of its parts.

Over a part the depth is the cubic that fits both; where that leaves in doubt whether something happens, the
step is too long, and is made again shorter.
"""

from support_exudyn.scene.compilation import compiled
from user_forces.contact_events import DepthPath

# CUT: the law begins or ceases to ask for tension
NOTHING, IMPACT, SEPARATION, CUT, TOO_LONG = range(5)
SAMPLES = 8  # of a cubic, when a change of sign is looked for
PARTS = 4  # of a step in free flight
PARTS_CLOSED = 1  # of a step in contact
SHORT = 1e-9  # [s]: in so short a step what cannot be told apart is taken as it ends
CUT_MET = 1e-9  # PUSH, of the order of 1, at which a cut of tension is met; the force has only a kink there
NEAR_CUT = 0.5  # PUSH below which a step is looked at for two cuts,
CUT_SAMPLES = 4  # in so many parts
AT_ZERO = 1e-13  # depth [m] that is an impact or separation just made; those are met to a tenth of it
TOGETHER = 10.0 * AT_ZERO  # depth [m] within which contacts meet or part at the same instant
Found = tuple[int, float, float]  # what, and fractions of the step between which it happens


# the one cubic of all formulations, compiled
depth_of, rate_of = compiled(DepthPath.depth), compiled(DepthPath.rate)
may_turn, doubt_of = compiled(DepthPath.may_turn), compiled(DepthPath.doubt)


@compiled
def turning_point(path: DepthPath) -> float:
    """Fraction at which the cubic's rate passes zero, its signs at both ends being different.

    By bisection, which never gives the start itself: a step that ends there would have no length.
    """
    low, high = 0.0, 1.0
    for _ in range(30):
        x = 0.5 * (low + high)
        if (rate_of(path, x) > 0.0) == (path.rate0 > 0.0):
            low = x
        else:
            high = x
    return 0.5 * (low + high)


@compiled
def separation(path: DepthPath) -> Found:
    """The first way out of a contact that is open at the end of a part."""
    inside = 0.0 if path.depth0 > AT_ZERO or path.rate0 < 0.0 else -1.0
    for n in range(1, SAMPLES + 1):
        x = n / SAMPLES
        if depth_of(path, x) > 0.0:
            inside = x
        elif inside >= 0.0:
            return SEPARATION, inside, x
    return (SEPARATION, 1.0, 1.0) if path.step <= SHORT else (TOO_LONG, 0.0, 0.0)


@compiled
def in_contact(d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """What happens in a part that begins in contact.

    Arguments:
        d0, r0, d1, r1: depth [m] and rate [m/s] at both ends.
        h: length of the part [s].
    """
    path = DepthPath(d0, r0, d1, r1, h)
    turns = r0 < 0.0 <= r1
    if h > SHORT and not turns and not r0 > 0.0 > r1:
        lowest = min(d0, d1) - h * max(abs(r0), abs(r1))
        if lowest <= 0.0 < d1 and may_turn(path):
            return TOO_LONG, 0.0, 0.0
    if d1 <= 0.0:
        return separation(path)
    if turns:
        x = turning_point(path)
        lowest = depth_of(path, x)
        if h > SHORT and abs(lowest) < doubt_of(path):
            return TOO_LONG, 0.0, 0.0
        if lowest <= 0.0:
            return SEPARATION, 0.0, x
    return NOTHING, 1.0, 1.0


@compiled
def rise(d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """The first impact of a journal that is free at the start of a part of a step; fractions of that part."""
    path, top = DepthPath(d0, r0, d1, r1, h), 1.0
    if d1 <= 0.0:
        if not r0 > 0.0 > r1:
            unseen = h > SHORT and max(d0, d1) + h * max(abs(r0), abs(r1)) > 0.0 and not r0 < 0.0 < r1
            unclear = unseen and may_turn(path)
            return (TOO_LONG, 0.0, 0.0) if unclear else (NOTHING, 1.0, 1.0)
        top = turning_point(path)
        highest = depth_of(path, top)
        if h > SHORT and abs(highest) < doubt_of(path):
            return TOO_LONG, 0.0, 0.0
        if highest <= 0.0:
            return NOTHING, 1.0, 1.0
    low = 0.0
    apart = d0 < -AT_ZERO or r0 > 0.0  # else the surfaces have just separated and must be seen apart first
    for n in range(1, SAMPLES + 1):
        x = top * n / SAMPLES
        if depth_of(path, x) > 0.0:
            return (IMPACT, low, x) if apart or h <= SHORT else (TOO_LONG, 0.0, 0.0)
        low, apart = x, True
    return IMPACT, low, top
