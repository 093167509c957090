"""Colours of what is drawn, RGB from 0 to 1; the same in pictures, viewer and exported files."""

from __future__ import annotations

from support_exudyn.drawing.solid import Role

Colour = tuple[float, float, float]

COLOURS: dict[Role, Colour] = {
    Role.GROUND: (0.55, 0.52, 0.48),
    Role.BASE: (0.36, 0.40, 0.45),
    Role.LINK: (0.00, 0.45, 0.70),
    Role.SHIELD: (0.90, 0.62, 0.00),
    Role.TAIL: (0.80, 0.50, 0.10),
    Role.CANOPY: (0.95, 0.75, 0.25),
    Role.CYLINDER: (0.30, 0.34, 0.38),
    Role.ROD: (0.80, 0.82, 0.85),
    Role.PIN: (0.15, 0.15, 0.15),
    Role.BODY: (0.35, 0.55, 0.75),
}
