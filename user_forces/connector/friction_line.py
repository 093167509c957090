"""A straight line in place of a law of friction, for steps in which Newton's method cannot follow the law.

Where friction is steep against the step (its ramp is narrower than what the slip changes by in the step), the
iterates jump from one side of the ramp to the other for ever. With a straight line,

    friction force = normal force (offset + slope slip),

the step can be solved whatever its length. Then it is seen whether the line meets the law at the slip that
came out. If not, the next line is the law's tangent where the slip is expected: the slip hangs nearly linearly
on the friction, by a softness that two solutions tell. So the step ends with the force of the law itself.

The line is laid when Newton's method has failed, and stands until the surfaces part.
"""

import sys
from collections.abc import Callable

from user_forces.contact import Contact, LawCounts, force_kernel_of, law_kernel_of
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.kernel import kernel

TRIES = 30  # lines that may stand for steep friction in a step, one after another
MEETS = 1e-6  # share of the largest friction so far, by which line and law may differ
LITTLE = 1e-3  # friction over normal force that is counted as the largest at least
# the tangent is taken over shorter and shorter parts of the law, until it changes no more
WIDEST, NARROWER, PARTS, SAME = 0.1, 0.1, 12, 1e-3
SLOWEST = 1e-9  # [m/s] that parts are shares of at least
HALVINGS = 200


@kernel
def line_force(slip: float, normal_force: float, offset: float, slope: float) -> float:
    """Friction force [N] on a line: normal force (offset + slope slip)."""
    return normal_force * (offset + slope * slip)


def can_be_line(law: FrictionLaw) -> bool:
    """Whether a line may stand for a law: for none with a state, which is never replaced."""
    return not law.has_state and not isinstance(law, Frictionless)


def with_line(contact: Contact) -> tuple[Callable[..., object], list[float]]:
    """The force kernel of a contact with a line in place of its law, and its constants, the line's last."""
    normal, elastic = contact.normal.force_formula, contact.normal.elastic_formula
    counts = LawCounts(len(normal.parameters), len(elastic.parameters), 2, 0, 0)
    law = law_kernel_of(normal.function, elastic.function, line_force, None, counts)
    known = [*contact.bearing.constants, contact.normal.largest_depth, *normal.parameters, *elastic.parameters]
    return force_kernel_of(contact.bearing.kinematics, law, None, len(known) + 2, 0), [*known, 0.0, 0.0]


class FrictionLine:
    """The line that stands for a law without a state.

    offset, slope: of the ratio of friction to normal force over the slip [-], [s/m].
    """

    def __init__(self, law: FrictionLaw) -> None:
        self._law = law
        self.offset = self.slope = 0.0
        self._tries = 0
        self._solved: tuple[float, float] | None = None  # ratio and slip of the last solution of this step
        self._largest = LITTLE  # ratio so far

    @property
    def exhausted(self) -> bool:
        """Whether so many lines have been tried in the step that a shorter one is to be made."""
        return self._tries >= TRIES

    def begin(self) -> None:
        """Begin a step with the line of the last one."""
        self._tries = 0
        self._solved = None

    def lay(self, slip: float, normal_force: float) -> None:
        """Take the law's tangent at a slip [m/s] under a force [N]."""
        ratio = self._ratio(normal_force)
        self.slope = _slope(ratio, slip)
        self.offset = ratio(slip) - self.slope * slip

    def meets(self, slip: float, normal_force: float, softness: float) -> bool:
        """Whether line and law are the same where a step was solved; if not, there is another line.

        Arguments:
            slip: that came out [m/s]. normal_force: [N].
            softness: by how much the ratio changes the slip, as far as is known before [m/s].
        """
        ratio = self._ratio(normal_force)
        applied, wanted = self.offset + self.slope * slip, ratio(slip)
        self._largest = max(self._largest, abs(wanted))
        if normal_force <= 0.0 or abs(applied - wanted) <= MEETS * self._largest:
            return True
        self._tries += 1
        if self._solved is not None and applied != self._solved[0]:
            measured = (slip - self._solved[1]) / (applied - self._solved[0])
            softness = measured if measured > 0.0 else softness
        self._solved = applied, slip
        free = slip - softness * applied  # without friction
        self.lay(_meeting(ratio, free, softness), normal_force)
        return False

    def rounding(self, normal_force: float, size: float, step: float) -> float:
        """The scatter of friction [N] in a step [s] by rounding of positions of a size [m].

        Newton's method cannot become closer than that.
        """
        return abs(self.slope) * normal_force * size * sys.float_info.epsilon / step

    def _ratio(self, normal_force: float) -> Callable[[float], float]:
        force = max(normal_force, 1.0)
        return lambda slip: float(self._law(slip, force)) / force


def _meeting(ratio: Callable[[float], float], free: float, softness: float) -> float:
    """The slip v = free + softness ratio(v), which lies between 0 and free: friction is against it."""
    low, high = 0.0, free
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        beyond = middle - free - softness * ratio(middle)
        if (beyond > 0.0) == (free > 0.0):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def _slope(ratio: Callable[[float], float], slip: float) -> float:
    """The rise of the ratio at a slip [s/m]."""
    part, before = WIDEST * max(abs(slip), SLOWEST), None
    slope = 0.0
    for _ in range(PARTS):
        slope = (ratio(slip + part) - ratio(slip - part)) / (2.0 * part)
        if before is not None and abs(slope - before) <= SAME * abs(slope):
            break
        before, part = slope, NARROWER * part
    return slope
