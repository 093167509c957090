"""What fits a shape, in words, for messages."""

from __future__ import annotations

from decimal import Decimal

from support_exudyn.files.toml.place import said
from support_exudyn.files.toml.shapes import (
    Choice,
    Either,
    Fixed,
    Group,
    Named,
    Number,
    Several,
    Shape,
    Text,
    Truth,
)
from user_forces.values.units import Unit


def scaled(limit: float, unit: Unit | None, ending: str) -> Decimal:
    """A limit in the unit of a key."""
    exact = Decimal(repr(float(limit))) if unit is None else unit.write(float(limit), ending)
    return exact.to_integral_value() if exact == exact.to_integral_value() and abs(exact) < 10**15 else exact


def allowed(shape: Shape, unit: Unit | None = None, ending: str = "") -> str:
    """What fits a shape, in words; numbers in the unit of a key."""
    match shape:
        case Number():
            bounds = " and ".join(f"{sign} {scaled(limit, unit, ending)}" for sign, limit in shape.bounds)
            kind = "a whole number" if shape.whole else "a number"
            return bounds if bounds and not shape.whole else f"{kind} {bounds}".strip()
        case Text():
            return "a text"
        case Truth():
            return "true, false"
        case Choice():
            return ", ".join(map(said, shape.options))
        case Fixed():
            inside = dict.fromkeys(allowed(one, unit, ending) for one in shape.items)
            return f"a list of {len(shape.items)}, each {' or '.join(inside)}"
        case Several():
            return f"a list, each {allowed(shape.item, unit, ending)}"
        case Named():
            return f"a table of names, each {allowed(shape.item, unit, ending)}"
        case Group():
            kinds = ", ".join(shape.kinds)
            return f"a table of type {kinds}" if shape.kinds else "none"
        case Either():
            return ", or ".join(allowed(one, unit, ending) for one in shape.options)
