"""The contact's force by the scenario's own law objects, in place of the compiled family."""

from __future__ import annotations

from support_exudyn.formulations.compiled import plain
from support_exudyn.formulations.reduced.contact import moving_mass
from support_exudyn.formulations.reduced.free_motion import PinState
from support_exudyn.formulations.reduced.layout import TOUCH_SPEED, TOUCHING
from user_forces.compilation.dependence import asks_for_mass
from user_forces.compilation.flat import flat_force
from user_forces.contact import JournalContact
from user_forces.lawful import look
from user_forces.normal.law import Touch

_moving_mass = plain(moving_mass)


class LawContact:
    """What `contact.contact_force` is, for any law. calls: how often the law has been asked."""

    def __init__(self, contact: JournalContact) -> None:
        self.contact = contact
        self.calls = 0
        self._force = flat_force(contact)
        self._elastic_force = contact.normal.elastic_force
        self.asks_for_mass = asks_for_mass(contact)

    def __call__(self, p: list[float], memory: list[float], pin: PinState, out: list[float]) -> None:
        """Write state and force of the contact into `out`, see `layout`."""
        x, y, in_contact = pin.x, pin.y, memory[TOUCHING]
        mass = _moving_mass(memory, pin) if in_contact and self.asks_for_mass else 1.0
        depth, rate, slip, normal, friction, fx, fy, arm, clamped, _ = self._force(
            x,
            y,
            pin.vx,
            pin.vy,
            pin.bore_spin,
            pin.journal_spin,
            in_contact,
            memory[TOUCH_SPEED],
            mass,
            0.0,
            0.0,
            0.0,
        )
        elastic = 0.0
        if in_contact and depth > 0.0:
            self.calls += 1
            elastic = self._elastic_force(depth)
            if not ((normal - elastic) * rate >= 0.0 >= friction * slip and elastic >= 0.0):
                look(self.contact, depth, rate, slip, normal, friction, elastic)
        # in the order of `layout`
        out[:] = (
            depth,
            rate,
            slip,
            normal,
            friction,
            (normal - elastic) * rate,
            -1.0 if clamped else 1.0,
            fx,
            fy,
            arm,
            x,
            y,
            0.0,
        )

    def touch(self, memory: list[float], pin: PinState) -> Touch:
        """What the law is told."""
        return Touch(memory[TOUCH_SPEED], _moving_mass(memory, pin))

    def duration(self, memory: list[float], pin: PinState) -> float:
        """Of the impact that begins now [s]."""
        return self.contact.normal.impact_time(self.touch(memory, pin))
