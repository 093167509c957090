"""What a support must stand: support force, legs, pins, buckling, tipping."""

from typing import TYPE_CHECKING

from user_forces.values.places import offered

if TYPE_CHECKING:
    from support_exudyn.machines.strength.assessment import StandReport, stand

__all__ = ["StandReport", "stand"]

__getattr__, __dir__ = offered(__name__, {".assessment": ("StandReport", "stand")})
