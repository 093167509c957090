"""A loose pin over a run: what it remembers, and its force at every stage."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix
from support_exudyn.formulations.tree.loads import TURN, push
from support_exudyn.mechanics.contact_state import Mobility, Onset, PinMemory
from support_exudyn.mechanics.pressed_pins import normal
from support_exudyn.model.pins import ClearancePin
from user_forces.compilation.flat import asks_for_mass, flat_force
from user_forces.values.value import Vector2


class Place(NamedTuple):
    """Where a journal's centre is against the bore's, and how it moves; SI, ground's axes."""

    x: float
    y: float
    vx: float
    vy: float
    depth: float
    rate: float


class LoosePin:
    """One clearance pin of a tree.

    Arguments:
        pin: bearing, laws, and which body has the bore.
        pair: which pair of points it is, see `loads`.
        links, points, work: arrays of `loads`.
        bore_angle: of the bore's body at the start [rad].
    """

    def __init__(
        self, pin: ClearancePin, pair: int, links: Matrix, points: Matrix, work: Matrix, bore_angle: float
    ) -> None:
        self.contact = pin.contact
        self.clearance = pin.contact.bearing.clearance
        self._law, self._asks_for_mass = flat_force(pin.contact), asks_for_mass(pin.contact)
        self.pair = pair
        self.onsets: list[Onset] = []
        self.calls = self.clamped_steps = 0
        self.clamped = False  # the law asked for tension at the stage evaluated last
        self._arrays = links, points, work
        row = len(links) + 2 * pair
        self._bore, self._journal = work[row, :TURN], work[row + 1, :TURN]  # views: X to SPIN
        bore_link = int(points[2 * pair, 0])
        self._bore_link = None if bore_link < 0 else work[bore_link]
        self._bore_angle = bore_angle
        self._axes = math.cos(bore_angle), math.sin(bore_angle)  # of a bore in the ground
        self.forgets = pin.contact.normal.forgets
        # where a contact is pressed on again something changes
        self.renews = self.forgets or self._asks_for_mass
        self.start = self.end = Place(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # of the step being tried
        self.memory = PinMemory(False, 0.0, 0.0, 0.0)
        self._mobility = self.memory.mobility

    def remember(self, memory: PinMemory) -> None:
        """Go on with another memory."""
        self.memory = memory
        self._mobility = memory.mobility
        self.clamped = False

    def axes(self) -> tuple[float, float]:
        """Cosine and sine of the angle of the bore's body at the stage evaluated last."""
        if self._bore_link is None:
            return self._axes
        angle = self._bore_angle + float(self._bore_link[TURN])
        return math.cos(angle), math.sin(angle)

    def place(self) -> Place:
        """Where the journal is at the stage evaluated last."""
        bx, by, bvx, bvy, _ = self._bore.tolist()
        jx, jy, jvx, jvy, _ = self._journal.tolist()
        x, y, vx, vy = jx - bx, jy - by, jvx - bvx, jvy - bvy
        eccentricity = math.hypot(x, y)
        # from the middle every way leads outwards
        rate = (x * vx + y * vy) / eccentricity if eccentricity > 0.0 else math.hypot(vx, vy)
        return Place(x, y, vx, vy, eccentricity - self.clearance, rate)

    def bore_centre(self) -> Vector2:
        """Where the bore's centre is at the stage evaluated last [m]."""
        x, y, *_ = self._bore.tolist()
        return x, y

    def frame(self) -> Matrix:
        """Axes of the bore in columns, in the ground's (2, 2)."""
        c, s = self.axes()
        return np.array([[c, -s], [s, c]])

    def normal(self) -> Matrix | None:
        """Along which the journal is pressed at the stage evaluated last, (2,); None if it is not."""
        place = self.place()
        return normal(place.x, place.y, self.clearance)

    def mass(self, mobility: Mobility, x: float, y: float) -> float:
        """Mass [kg] that moves with an eccentricity x, y in the ground's axes."""
        c, s = self.axes()
        return mobility.mass(c * x + s * y, c * y - s * x)

    def add_force(self) -> None:
        """Add the force at the stage that was evaluated last, while the surfaces touch."""
        bx, by, bvx, bvy, bore_spin = self._bore.tolist()
        jx, jy, jvx, jvy, journal_spin = self._journal.tolist()
        x, y = jx - bx, jy - by
        eccentricity = math.hypot(x, y)
        if not eccentricity > self.clearance:
            self.clamped = False
            return
        self.calls += 1
        speed = self.memory.approach_speed
        mass = self.mass(self._mobility, x, y) if self._asks_for_mass else 1.0
        moving = x, y, jvx - bvx, jvy - bvy, bore_spin, journal_spin
        force = self._law(*moving, 1.0, speed, mass, 0.0, 0.0, 0.0)
        self.clamped = bool(force.clamped)
        arm = force.journal_arm / eccentricity
        at_x, at_y = jx + arm * x, jy + arm * y
        push(*self._arrays, self.pair, at_x, at_y, force.force_x, force.force_y)
