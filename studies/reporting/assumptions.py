"""All data that the studies put in, each marked as printed in the paper or assumed."""

from typing import Any

from studies.common import paper_machine
from studies.common.words import TextTable
from support_exudyn import CubicStep, HydraulicSupport
from support_exudyn.model.linkage import Part, lumped
from user_forces import STEEL, STEEL_35CRMO, Material

PAPER, ASSUMED = "paper", "assumed"
PIVOTS = {  # with the letters of the sketch in support_exudyn/machines/four_column_support.py
    "rear_base": "B, rear link on base (the clearance pin)",
    "front_base": "A, front link on base",
    "rear_shield": "C, rear link on shield beam",
    "front_shield": "D, front link on shield beam",
    "hinge": "I, shield beam on canopy",
    "front_foot": "F, front column on base",
    "front_head": "E, front column on canopy",
    "rear_foot": "H, rear column on base",
    "rear_head": "G, rear column on canopy",
    "tip": "T, tip of the canopy",
}
CLEARANCE_MM = 1.5  # that of section 3; all else in the contact data does not depend on it


def tables(support: HydraulicSupport) -> dict[str, TextTable]:
    """The reference support's pivots and parts, and the data of contact and drive."""
    return {"pivots": pivots(support), "masses": masses(support), "contact_and_drive": contact_and_drive()}


def pivots(support: HydraulicSupport) -> TextTable:
    """Where the pivots are in the reference posture."""
    rows = tuple(
        (meaning, ASSUMED, *(millimetres(x) for x in getattr(support, name)))
        for name, meaning in PIVOTS.items()
    )
    return TextTable(("pivot", "source", "x [mm]", "y [mm]"), rows, left=2)


def masses(support: HydraulicSupport) -> TextTable:
    """What the bodies are made of, and each body as a whole where it has several parts."""
    rows = []
    for body, parts in support.parts.items():
        name = body.replace("_", " ")
        if len(parts) > 1:
            rows += [_part(f"{name}, part {n}", part) for n, part in enumerate(parts, 1)]
            rows.append(_part(f"{name}, whole", lumped(parts)))
        else:
            rows.append(_part(name, parts[0]))
    header = ("body", "source", "mass [kg]", "centre x [mm]", "centre y [mm]", "inertia [kg m²]")
    return TextTable(header, tuple(rows), left=2)


def _part(name: str, part: Part) -> tuple[str, ...]:
    centre = (f"{1e3 * x:.1f}" for x in part.centre)
    return name, ASSUMED, f"{part.mass:g}", *centre, f"{part.inertia:.1f}"


def contact_and_drive() -> TextTable:
    """Materials, bearing, laws and drive."""
    contact = paper_machine.clearance_joint(
        CLEARANCE_MM, paper_machine.SLIDING_COEFFICIENT, law=paper_machine.PAPERS_LAW
    ).contact
    normal: Any = contact.normal
    friction: Any = contact.friction
    drive = CubicStep()
    rows = (
        *_material(STEEL, "bore"),
        *_material(STEEL_35CRMO, "journal"),
        (
            "bore radius (shaft radius and clearance of Table 2)",
            PAPER,
            "mm",
            millimetres(contact.bearing.bore_radius),
        ),
        *(_stiffness(clearance) for clearance in paper_machine.STIFFNESS),
        ("exponent of the normal force (Eq. 4)", PAPER, "1", f"{normal.exponent:g}"),
        ("restitution", ASSUMED, "1", f"{normal.restitution:g}"),
        ("smallest speed that damps a contact", ASSUMED, "mm/s", millimetres(normal.rest_velocity)),
        ("sliding friction coefficient mu_d (Eq. 7)", ASSUMED, "1", f"{friction.sliding_coefficient:g}"),
        (
            "speed v_s below which there is no friction (Eq. 8)",
            ASSUMED,
            "mm/s",
            millimetres(friction.static_speed),
        ),
        ("speed v_d above which it is full (Eq. 8)", ASSUMED, "mm/s", millimetres(friction.dynamic_speed)),
        ("oil: bore of a column, two to a pair", ASSUMED, "mm", millimetres(paper_machine.OIL_BORE)),
        ("oil: length under the pistons at the start", ASSUMED, "mm", millimetres(paper_machine.OIL_LENGTH)),
        (
            "oil: bulk modulus (1.96 by the published stiffness of four shields)",
            ASSUMED,
            "GPa",
            f"{paper_machine.BULK_MODULUS / 1e9:g}",
        ),
        ("oil: in the hoses of a pair", ASSUMED, "l", f"{1e3 * paper_machine.HOSES.volume:g}"),
        (
            "oil: drop of pressure in them at 200 l/min",
            ASSUMED,
            "MPa",
            f"{paper_machine.HOSES.nominal_drop / 1e6:g}",
        ),
        ("cylinders: rod", ASSUMED, "mm", millimetres(paper_machine.ROD)),
        (
            "cylinders: length around the rods at the start",
            ASSUMED,
            "mm",
            millimetres(paper_machine.ROD_SIDE_LENGTH),
        ),
        ("cylinders: pressure of the pump", ASSUMED, "MPa", f"{paper_machine.SYSTEM_PRESSURE / 1e6:g}"),
        ("cylinders: flow of a pair at 1 MPa", ASSUMED, "l/min", f"{6e4 * paper_machine.NOMINAL_FLOW:g}"),
        ("cylinders: hoses of either side", ASSUMED, "l", millimetres(paper_machine.HOSE_VOLUME)),
        ("cylinders: damping of the seals", ASSUMED, "kN s/m", f"{paper_machine.SEAL_DAMPING / 1e3:g}"),
        ("stroke of the columns", PAPER, "mm", millimetres(drive.stroke)),
        ("stroke begins and ends", PAPER, "s", f"{drive.start:g}, {drive.end:g}"),
        ("start: journal at rest, off the middle of its bore by", ASSUMED, "mm", "0"),
    )
    return TextTable(("quantity", "source", "unit", "value"), rows, left=3)


def _material(material: Material, part: str) -> tuple[tuple[str, ...], ...]:
    name = f"{material.name} ({part}, Table 1)"
    return (
        (f"elastic modulus, {name}", PAPER, "GPa", f"{material.elastic_modulus / 1e9:g}"),
        (f"Poisson's ratio, {name}", PAPER, "1", f"{material.poisson_ratio:g}"),
        (f"density, {name}; not used", PAPER, "kg/m³", f"{material.density:g}"),
    )


def _stiffness(clearance_mm: float) -> tuple[str, ...]:
    value = paper_machine.stiffness(clearance_mm) / 1e3**1.5
    return (
        f"stiffness K at {clearance_mm:.1f} mm of radial clearance (Eq. 5)",
        PAPER,
        "N/mm^1.5",
        f"{value:.3f}",
    )


def millimetres(metres: float) -> str:
    """A length [m] in millimetres, or a volume [m^3] in litres, to six digits."""
    return f"{1e3 * metres:.6g}"
