"""Colours of what is drawn, RGB from 0 to 1; the same in pictures, viewer and exported files.

Dull, and told apart by lightness as well, so that the bright colours of figures stand out on them: vermilion is
contact, sky blue flight.
"""

from __future__ import annotations

from support_exudyn.postprocessing.look.solid import Role

Colour = tuple[float, float, float]

COLOURS: dict[Role, Colour] = {
    Role.GROUND: (0.55, 0.52, 0.48),
    Role.BASE: (0.40, 0.44, 0.49),
    Role.LINK: (0.29, 0.47, 0.58),
    Role.SHIELD: (0.83, 0.74, 0.50),
    Role.TAIL: (0.68, 0.58, 0.38),
    Role.CANOPY: (0.92, 0.86, 0.66),
    Role.CYLINDER: (0.36, 0.38, 0.41),
    Role.ROD: (0.84, 0.86, 0.88),
    Role.PIN: (0.13, 0.13, 0.14),
    Role.ROCK: (0.48, 0.45, 0.42),
    Role.BODY: (0.45, 0.58, 0.70),
}
EDGE: Colour = (0.16, 0.16, 0.17)
