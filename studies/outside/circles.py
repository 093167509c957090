"""The path of the canopy's hinge of Velenje's support by circles that meet, from its published lengths."""

import numpy as np

from support_exudyn.mechanics.trajectory import Series

# mm: pivots A and B on the base, and lengths: A E, D E, B D, E C, and the angle of the beam at E
BASE, ABOVE, LEVEL = 674.0, 440.0, 510.0  # a1, and its direction: O - Q over N
FRONT, SHORT, REAR = 1360.0, 382.0, 1310.0  # a2, a3, a4
BEAM, BENT = 1427.70, np.radians(179.34)  # a5, and its angle to E D
HEIGHT = 640.0  # O, of A over the floor


def hinge(front_angle: Series) -> Series:
    """Places of the hinge (2, n) [m], for angles of the front link from A to E (n,) [rad]."""
    first = 1j * HEIGHT
    second = first - BASE * (LEVEL + 1j * ABOVE) / np.hypot(LEVEL, ABOVE)
    e = first + FRONT * np.exp(1j * front_angle)
    way = e - second
    along = (REAR**2 - SHORT**2 + np.abs(way) ** 2) / (2.0 * np.abs(way))
    d = second + way / np.abs(way) * (along + 1j * np.sqrt(REAR**2 - along**2))  # on the left of the way to E
    c = e + BEAM * np.exp(-1j * BENT) * (d - e) / np.abs(d - e)
    return 1e-3 * np.array([c.real, c.imag])
