"""Data that several unit tests share."""

from __future__ import annotations

from support_exudyn import HydraulicSupport, Part
from user_forces import Ambrosio, JournalBearing, JournalContact, LankaraniNikravesh

Point = tuple[float, float]

# Pivots of the reference support [mm], x forward, y up, reference posture
PIVOTS_MM = {
    "rear_base": (0, 300),  # B
    "front_base": (595, 619),  # A
    "rear_shield": (-574, 1162),  # C
    "front_shield": (-337, 1438),  # D
    "hinge": (419, 2267),  # I
    "front_foot": (1670, 202),  # F
    "front_head": (1883, 2260),  # E
    "rear_foot": (922, 174),  # H
    "rear_head": (899, 2252),  # G
    "tip": (419 + 2800, 2267 + 150),
}
PIVOTS = {name: (x / 1e3, y / 1e3) for name, (x, y) in PIVOTS_MM.items()}


def uniform_bar(mass: float, a: Point, b: Point) -> Part:
    square = (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2
    return Part(mass=mass, centre=((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), inertia=mass * square / 12)


def beside(name: str, dx_mm: float, dy_mm: float) -> Point:
    x, y = PIVOTS_MM[name]
    return (x + dx_mm) / 1e3, (y + dy_mm) / 1e3


PARTS = {
    "rear_link": (uniform_bar(500.0, PIVOTS["rear_base"], PIVOTS["rear_shield"]),),
    "front_link": (uniform_bar(400.0, PIVOTS["front_base"], PIVOTS["front_shield"]),),
    "shield": (
        uniform_bar(1500.0, PIVOTS["rear_shield"], PIVOTS["hinge"]),
        Part(mass=1080.0, centre=beside("rear_shield", -487, -383), inertia=1080.0 * 1.05**2 / 12),
    ),
    "canopy": (
        Part(mass=3000.0, centre=beside("hinge", 950, 50), inertia=3000.0 * 3.3**2 / 12),
        Part(mass=200.0, centre=PIVOTS["rear_head"]),
        Part(mass=200.0, centre=PIVOTS["front_head"]),
    ),
}


def support(**changes: object) -> HydraulicSupport:
    """The reference support, changed as asked."""
    fields: dict[str, object] = {**PIVOTS, "parts": PARTS, "start_hinge_height": 1.8}
    return HydraulicSupport(**fields | changes)


def contact(sliding_coefficient: float = 0.25, restitution: float = 0.9) -> JournalContact:
    """A pin of the support's size, with textbook damping."""
    return JournalContact(
        bearing=JournalBearing(bore_radius=0.0655, clearance=0.0015),
        normal=LankaraniNikravesh(stiffness=2.7e10, restitution=restitution, rest_velocity=1e-3),
        friction=Ambrosio(sliding_coefficient=sliding_coefficient),
    )
