"""What the report holds: what studies left in their folders, and what is said around it."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from studies.common import paper_machine
from studies.common.words import Chapter, filled, text_table, titled
from support_exudyn import CubicStep, HydraulicSupport, reference_support
from support_exudyn.model.linkage import lumped
from support_exudyn.postprocessing.page.live import LiveFigure
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import provenance
from user_forces import STEEL, STEEL_35CRMO
from user_forces.values.value import InputError


@dataclass(frozen=True)
class ReportSection:
    """A chapter, the folder of its files, and its live figures."""

    folder: Path
    chapter: Chapter
    live: Mapping[str, LiveFigure]

    @staticmethod
    def load(folder: Path) -> ReportSection:
        """Read the results of a study. Raises InputError with the file and the reason."""
        chapter, live = Chapter.load(folder), {}
        for picture in chapter.pictures:
            if not (folder / f"{picture.stem}.png").is_file():
                raise InputError(f"{folder / picture.stem}.png: no such file; the chapter beside it shows it")
            if (data := folder / f"{picture.stem}.live.json").is_file():
                live[picture.stem] = LiveFigure.load(data)
        return ReportSection(folder, chapter, live)


def around_chapters(sections: Sequence[ReportSection]) -> dict[str, object]:
    """Texts around these chapters; the paper's machine is left out if none is about it.

    Returns title and question of all, date and time, notes and data on the assumptions, times and versions.
    """
    support = reference_support()
    chapters = [one.chapter for one in sections]
    of_paper = any(not one.machine for one in chapters)
    words = filled("reporting/words.md.j2", {
        "machines": list(dict.fromkeys(one.machine for one in chapters if one.machine)),
        "contacts": list(dict.fromkeys(one.contact for one in chapters if one.contact)),
        "of_paper": of_paper,
        "start_height": millimetres(support.start_hinge_height),
        "total_mass": sum(part.mass for parts in support.parts.values() for part in parts),
        "platform": platform.platform(),
    })  # fmt: skip
    times = [(one.study, f"{one.wall_s:.1f}") for one in chapters]
    times.append(("together", f"{sum(one.wall_s for one in chapters):.1f}"))
    versions: dict[str, dict[str, None]] = {}  # several where studies were run with different ones
    for one in chapters:
        for name, version in one.versions.items():
            versions.setdefault(name, {})[version] = None
    data = tables(support) if of_paper else {}
    sheets = {
        "times": text_table(("study", "wall time [s]"), times),
        "versions": text_table(
            ("package", "version"), ((name, ", ".join(found)) for name, found in versions.items()), left=2
        ),
        **data,
    }
    shown = {name: titled(table, name, words) for name, table in sheets.items()}
    title = next(iter(words))
    return {
        "title": title,
        "asked": " ".join(words[title]),
        "made_at": provenance()["made_at"].replace("T", " ").removesuffix("+00:00") + " UTC",
        "notes": words["Notes"],
        "data": [shown[name] for name in data],
        "times": shown["times"],
        "versions": shown["versions"],
    }


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


def tables(support: HydraulicSupport) -> dict[str, Sheet]:
    """The reference support's pivots in its reference posture, its parts, and the data of contact and drive."""
    pivots = [
        (meaning, ASSUMED, *(millimetres(x) for x in getattr(support, name)))
        for name, meaning in PIVOTS.items()
    ]
    masses: list[tuple[str, ...]] = []
    for body, parts in support.parts.items():
        name, several = body.replace("_", " "), len(parts) > 1
        named = [(f"{name}, part {n}" if several else name, part) for n, part in enumerate(parts, 1)]
        for label, part in (*named, *([(f"{name}, whole", lumped(parts))] if several else ())):
            x, y = (f"{1e3 * c:.1f}" for c in part.centre)
            masses.append((label, ASSUMED, f"{part.mass:g}", x, y, f"{part.inertia:.1f}"))
    of_masses = ("body", "source", "mass [kg]", "centre x [mm]", "centre y [mm]", "inertia [kg m²]")
    return {
        "pivots": text_table(("pivot", "source", "x [mm]", "y [mm]"), pivots, left=2),
        "masses": text_table(of_masses, masses, left=2),
        "contact_and_drive": contact_and_drive(),
    }


def contact_and_drive() -> Sheet:
    """Materials, bearing, laws and drive."""
    paper = paper_machine
    pin = paper.clearance_joint(CLEARANCE_MM, paper.SLIDING_COEFFICIENT, law=paper.PAPERS_LAW)
    bearing = pin.contact.bearing
    normal: Any = pin.contact.normal
    friction: Any = pin.contact.friction
    drive = CubicStep()
    stiffness = "stiffness K at {:.1f} mm of radial clearance (Eq. 5)"
    materials = {
        f"{one.name} ({part}, Table 1)": one for one, part in ((STEEL, "bore"), (STEEL_35CRMO, "journal"))
    }
    printed = [
        *(
            row
            for name, one in materials.items()
            for row in (
                (f"elastic modulus, {name}", "GPa", one.elastic_modulus / 1e9),
                (f"Poisson's ratio, {name}", "1", one.poisson_ratio),
                (f"density, {name}; not used", "kg/m³", one.density),
            )
        ),
        ("bore radius (shaft radius and clearance of Table 2)", "mm", 1e3 * bearing.bore_radius),
        *((stiffness.format(one), "N/mm^1.5", paper.stiffness(one) / 1e3**1.5) for one in paper.STIFFNESS),
        ("exponent of the normal force (Eq. 4)", "1", normal.exponent),
        ("stroke of the columns", "mm", 1e3 * drive.stroke),
        ("stroke begins", "s", drive.start),
        ("stroke ends", "s", drive.end),
    ]
    assumed = [
        ("restitution", "1", normal.restitution),
        ("smallest speed that damps a contact", "mm/s", 1e3 * normal.rest_velocity),
        ("sliding friction coefficient mu_d (Eq. 7)", "1", friction.sliding_coefficient),
        ("speed v_s below which there is no friction (Eq. 8)", "mm/s", 1e3 * friction.static_speed),
        ("speed v_d above which it is full (Eq. 8)", "mm/s", 1e3 * friction.dynamic_speed),
        ("oil: bore of a column, two to a pair", "mm", 1e3 * paper.OIL_BORE),
        ("oil: length under the pistons at the start", "mm", 1e3 * paper.OIL_LENGTH),
        ("oil: bulk modulus (1.96 by the stiffness of four shields)", "GPa", 1e-9 * paper.BULK_MODULUS),
        ("oil: in the hoses of a pair", "l", 1e3 * paper.HOSES.volume),
        ("oil: drop of pressure in them at 200 l/min", "MPa", 1e-6 * paper.HOSES.nominal_drop),
        ("cylinders: rod", "mm", 1e3 * paper.ROD),
        ("cylinders: length around the rods at the start", "mm", 1e3 * paper.ROD_SIDE_LENGTH),
        ("cylinders: pressure of the pump", "MPa", 1e-6 * paper.SYSTEM_PRESSURE),
        ("cylinders: flow of a pair at 1 MPa", "l/min", 6e4 * paper.NOMINAL_FLOW),
        ("cylinders: hoses of either side", "l", 1e3 * paper.HOSE_VOLUME),
        ("cylinders: damping of the seals", "kN s/m", 1e-3 * paper.SEAL_DAMPING),
        ("start: journal at rest, off the middle of its bore by", "mm", 0.0),
    ]
    rows = [
        (quantity, source, unit, f"{value:.9g}")
        for source, known in ((PAPER, printed), (ASSUMED, assumed))
        for quantity, unit, value in known
    ]
    return text_table(("quantity", "source", "unit", "value"), rows, left=3)


def millimetres(metres: float) -> str:
    """A length [m] in millimetres, to six digits."""
    return f"{1e3 * metres:.6g}"
