"""Whether the forces of a loose pin can be what its laws say that they are, see `user_forces.lawful`."""

from __future__ import annotations

from support_exudyn.formulations.redundant.clearance.clearance_pin import LoosePin
from user_forces.lawful import PROBED, look

SHALLOW = 1e-9  # depth [m] at which a law is probed that has only just been touched


def look_at(pin: LoosePin, elastic: float, name: str) -> None:
    """Raise LawError if the force at the end of the last step, elastic to this part [N], cannot be one."""
    depth, rate, slip, normal, friction, *_ = pin.force
    look(pin.contact, depth, rate, slip, normal, friction, elastic, name)


def probe(pin: LoosePin, name: str) -> None:
    """Raise LawError if a law is no number where the last step began, or a little deeper and faster."""
    memory, contact = pin.memory, pin.contact
    for more in PROBED:
        depth, slip = more * max(memory.depth, SHALLOW), more * memory.slip
        if depth > contact.normal.largest_depth:  # of which the law has its own words
            return
        normal = contact.normal(depth, memory.rate, pin.touch)
        friction = contact.friction(slip, max(0.0, normal), memory.deflection)
        look(contact, depth, memory.rate, slip, normal, friction, pin=name)
