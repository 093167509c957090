"""The motion of a corner in its slot, in the slot's own axes, as its connector tells it.

They differ from those of the connector between two moving bodies, see `pin_frames`, by half of the small turn
between both marker frames. It is taken out, since a corner may be far along its slot.
"""

import math

from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    Relative,
    displacement_scale,
    in_slot,
)
from support_exudyn.formulations.redundant.clearance.pin_frames import PinFrames
from support_exudyn.formulations.redundant.clearance.pin_motion import Motion
from support_exudyn.formulations.redundant.clearance.steep_friction import EngineForce
from support_exudyn.formulations.redundant.clearance.symbolic_force import SymbolicForce


class SlotFrames(PinFrames):
    """The axes of a corner's connector over a run; what it tells is in those of the slot.

    Its motion has x = 0, for what is along the slot does not count, and as vy the rate of y.
    """

    _along = 0.0  # of the corner from the connector's point of the middle line, at the end of the step [m]

    def relative(self, force: EngineForce) -> Relative:
        """The corner in its slot at the end of the step that is being tried."""
        if isinstance(force, SymbolicForce):
            return self._from_coordinates()
        (x, y, _), (vx, vy, _), (_, _, turn), (_, _, spin) = force.last
        bore_spin = 0.0
        if self.at is Attachment.MIDDLE:
            self._tried_turn = turn, spin
            self._tried_spin = bore_spin = self.bore_spin()
            scale = displacement_scale(turn)
            x, y = scale * x, scale * y
        self._along, motion = in_slot(self.at, Relative(x, y, vx, vy, spin, bore_spin), 0.5 * turn)
        return motion

    def _from_coordinates(self) -> Relative:
        self.context = bore, journal = self.moving.now()
        self._along, motion = between(bore, journal)
        if self.at is Attachment.MIDDLE:
            turn = math.remainder(journal[4] + self.connector.frame_turn - bore[4], 2.0 * math.pi)
            self._tried_turn, self._tried_spin = (turn, motion.turning), bore[5]
        return motion

    def spin_was_wrong(self, motion: Relative) -> bool:
        """Whether the engine's expression used a spin of the slot that did not come out; then guess again."""
        return super().spin_was_wrong(motion._replace(x=self._along))

    def place(self) -> tuple[float, float]:
        """Where the corner is now across its slot, in the slot's axes [m]."""
        return 0.0, between(*(self.context or self.moving.now()))[1].y


def between(bore: Motion, journal: Motion) -> tuple[float, Relative]:
    """How far a corner is along its slot [m], and what counts of its motion, from those against the ground."""
    bx, by, bvx, bvy, angle, bore_spin = bore
    jx, jy, jvx, jvy, _, spin = journal
    c, s = math.cos(angle), math.sin(angle)
    x, y, vx, vy = jx - bx, jy - by, jvx - bvx, jvy - bvy
    x, y, vx, vy = c * x + s * y, c * y - s * x, c * vx + s * vy, c * vy - s * vx
    return x, Relative(0.0, y, vx, vy - bore_spin * x, spin - bore_spin, bore_spin)
