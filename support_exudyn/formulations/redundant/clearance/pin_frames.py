"""The axes in which a pin's connector tells its displacement, from step to step, and the motion in them.

Between two moving bodies with friction, see `Attachment.MIDDLE`, they lie in the middle between both marker
frames, which are lined up before a step that turns them apart.
"""

import math
from collections.abc import Callable

from support_exudyn.formulations.redundant.clearance.connector import PinConnector
from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    Relative,
    displacement_scale,
)
from support_exudyn.formulations.redundant.clearance.pin_motion import Motion, Moving
from support_exudyn.formulations.redundant.clearance.steep_friction import EngineForce
from support_exudyn.formulations.redundant.clearance.symbolic_force import SymbolicForce

SPIN_ERROR = 1e-13  # of slip [m/s] by a bore's spin that had to be guessed, above which a step is repeated
SPIN_REPEATS = 4


class PinFrames:
    """The axes of a pin's connector over a run.

    Arguments:
        connector: of the pin.
        moving: how bore and journal move.
        bore_spin: tells the angular velocity of the bore's body now [rad/s].
    """

    def __init__(self, connector: PinConnector, moving: Moving, bore_spin: Callable[[], float]) -> None:
        self.connector, self.moving, self.bore_spin = connector, moving, bore_spin
        self.at = connector.at
        self.follows = connector.at is Attachment.MIDDLE  # whether anything is kept from step to step
        # at the last accepted step
        self._turn, self._turn_rate = 0.0, 0.0  # between the marker frames [rad], [rad/s]
        self._spin, self._spin_rate = 0.0, 0.0  # of the bore [rad/s], [rad/s^2]
        # of the step being tried
        self._step = 0.0  # its length [s]
        self._tried_turn = (0.0, 0.0)
        self._tried_spin = 0.0
        self.guessed_spin = 0.0  # of the bore at its end [rad/s]
        self.guessed_turn = 0.0  # between the marker frames at its end [rad]
        self._spin_repeats = 0
        self.context: tuple[Motion, Motion] | None = None  # motions of bore and journal at its end, if asked

    def start(self, turn: float) -> None:
        """Begin with the turn of the journal against the bore [rad]."""
        self._turn = turn

    def jumped(self) -> None:
        """Velocities have jumped after the last step."""
        self.context = None

    def begin(self, step: float) -> None:
        """Begin to try a step of this length [s]: guess what the connector does not know of its end."""
        self._step = step
        if self.at is not Attachment.MIDDLE:
            return
        self._spin_repeats = 0
        self.guessed_spin = self._spin + self._spin_rate * step
        self.guessed_turn = self._turn + self._turn_rate * step
        if self.connector.line_up(self.guessed_turn):
            self._turn -= self.guessed_turn
            self.guessed_turn = 0.0

    def accept(self) -> None:
        """The step that has been tried stands."""
        if self.at is Attachment.MIDDLE:
            self._turn, self._turn_rate = self._tried_turn
            if self._step > 0.0:
                self._spin_rate = (self._tried_spin - self._spin) / self._step
            self._spin = self._tried_spin

    def spin_was_wrong(self, motion: Relative) -> bool:
        """Whether the engine's expression used a spin of the bore that did not come out; then guess again.

        It is told the bore's own spin before a step, since the connector knows only that of both bodies
        against each other. The slip depends on it by spin times eccentricity.
        """
        if self.at is not Attachment.MIDDLE or self._spin_repeats >= SPIN_REPEATS:
            return False
        if abs(self._tried_spin - self.guessed_spin) * math.hypot(*motion[:2]) < SPIN_ERROR:
            return False
        self._spin_repeats += 1
        self.guessed_spin = self._tried_spin
        return True

    def relative(self, force: EngineForce) -> Relative:
        """The journal in its bore at the end of the step that is being tried."""
        if isinstance(force, SymbolicForce):
            return self._from_coordinates()
        # the residual that satisfied Newton's method was evaluated at this same state
        if self.at is Attachment.LINE:
            depth, rate = force.last
            return Relative(depth + self.connector.clearance, 0.0, rate, 0.0)
        displacement, velocity, *turning = force.last
        x, y, vx, vy = displacement[0], displacement[1], velocity[0], velocity[1]
        if not turning:
            return Relative(x, y, vx, vy)
        (_, _, turn), (_, _, spin) = turning
        if self.at is not Attachment.MIDDLE:
            return Relative(x, y, vx, vy, spin)
        self._tried_turn = turn, spin
        self._tried_spin = self.bore_spin()
        scale = displacement_scale(turn)
        return Relative(scale * x, scale * y, vx, vy, spin, self._tried_spin)

    def _from_coordinates(self) -> Relative:
        self.context = self.moving.now()
        (bx, by, bvx, bvy, bore_angle, bore_spin), journal = self.context
        x, y, vx, vy, journal_angle, spin = journal
        x, y, vx, vy, turning = x - bx, y - by, vx - bvx, vy - bvy, spin - bore_spin
        if self.connector.bore_on_ground:
            return Relative(x, y, vx, vy, turning)
        if self.at is Attachment.LINE:
            return Relative(x, y, vx, vy, turning)
        if self.at is Attachment.MIDDLE:
            turn = math.remainder(journal_angle + self.connector.frame_turn - bore_angle, 2.0 * math.pi)
            self._tried_turn, self._tried_spin = (turn, turning), bore_spin
            bore_angle += 0.5 * turn  # the connector's axes are in the middle between both marker frames
        c, s = math.cos(bore_angle), math.sin(bore_angle)
        return Relative(c * x + s * y, c * y - s * x, c * vx + s * vy, c * vy - s * vx, turning, bore_spin)

    def place(self) -> tuple[float, float]:
        """Where the journal is now in its bore, in the bore's axes [m]."""
        (bx, by, _, _, angle, _), (x, y, *_) = self.context or self.moving.now()
        x, y = x - bx, y - by
        if self.connector.bore_on_ground:
            return x, y
        c, s = math.cos(angle), math.sin(angle)
        return c * x + s * y, c * y - s * x
