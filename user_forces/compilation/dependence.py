"""What a contact's force depends on, seen from its formulas."""

from __future__ import annotations

import re

from user_forces.compilation.flat import ARGUMENTS, lines, needed, text, traceable
from user_forces.contact import JournalContact, SlipHistory
from user_forces.normal.law import Touch


def asks_for_mass(contact: JournalContact) -> bool:
    """Whether the force depends on the mass that moves with the depth, and so on where it was renewed."""
    formulas, (x, y, vx, vy, bore_spin, journal_spin, _, speed, mass, deflection, slip, step) = lines(ARGUMENTS)
    history = SlipHistory(deflection, slip, step)
    touch = Touch(speed, mass)
    found = traceable(contact).force(x, y, vx, vy, bore_spin, journal_spin, touch, history)
    return any(re.search(r"\bmass\b", line) for line in needed(formulas, map(text, found)))
