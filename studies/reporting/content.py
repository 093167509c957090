"""What the report holds: what studies left in their folders, and what is said around it."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from studies.common import paper_machine
from studies.common.words import Chapter, Words, read_stored, text_table, titled
from support_exudyn import CubicStep, HydraulicSupport, reference_support
from support_exudyn.model.linkage import Part, lumped
from support_exudyn.postprocessing.page.live import LiveFigure
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import provenance
from user_forces import STEEL, STEEL_35CRMO, Material
from user_forces.values.value import InputError


class Summary(BaseModel, strict=True):
    """The part of a study's summary.json that the report shows."""

    versions: dict[str, str]
    wall_s: float


@dataclass(frozen=True)
class ReportSection:
    """A chapter, the folder of its files, its live figures, its time [s] and the versions that made it."""

    folder: Path
    chapter: Chapter
    wall_s: float
    versions: dict[str, str]
    live: Mapping[str, LiveFigure]

    @staticmethod
    def load(folder: Path) -> ReportSection:
        """Read the results of a study. Raises InputError with the file and the reason."""
        chapter, summary = Chapter.load(folder), read_stored(Summary, folder / "summary.json")
        live = {}
        for picture in chapter.pictures:
            if not (folder / f"{picture.stem}.png").is_file():
                raise InputError(f"{folder / picture.stem}.png: no such file; the chapter beside it shows it")
            if (data := folder / f"{picture.stem}.live.json").is_file():
                live[picture.stem] = LiveFigure.load(data)
        return ReportSection(folder, chapter, summary.wall_s, summary.versions, live)


def around_chapters(sections: Sequence[ReportSection]) -> dict[str, object]:
    """What is said around these chapters; the paper's machine is left out if none is about it.

    Returns title and question of all, date and time, notes and data on the assumptions, times and versions.
    """
    support = reference_support()
    machines = tuple(dict.fromkeys(one.chapter.machine for one in sections if one.chapter.machine))
    contacts = tuple(dict.fromkeys(one.chapter.contact for one in sections if one.chapter.contact))
    of_paper = any(not one.chapter.machine for one in sections)
    words = Words("reporting", "reporting/words.md.j2").blocks({
        "machines": machines,
        "contacts": contacts,
        "of_paper": of_paper,
        "start_height": millimetres(support.start_hinge_height),
        "total_mass": sum(part.mass for parts in support.parts.values() for part in parts),
        "platform": platform.platform(),
    })  # fmt: skip
    title = next(iter(words))
    data = tables(support) if of_paper else {}
    sheets = {"times": _times(sections), "versions": _versions(sections), **data}
    shown = {name: titled(table, name, words) for name, table in sheets.items()}
    return {
        "title": title,
        "asked": " ".join(words[title]),
        "made_at": provenance()["made_at"].replace("T", " ").removesuffix("+00:00") + " UTC",
        "notes": words["Notes"],
        "data": [shown[name] for name in data],
        "times": shown["times"],
        "versions": shown["versions"],
    }


def _times(sections: Sequence[ReportSection]) -> Sheet:
    rows = [(s.chapter.study, f"{s.wall_s:.1f}") for s in sections]
    total = sum(section.wall_s for section in sections)
    return text_table(("study", "wall time [s]"), (*rows, ("together", f"{total:.1f}")))


def _versions(sections: Sequence[ReportSection]) -> Sheet:
    """Versions recorded by the studies; more than one where the studies were run with different ones."""
    found: dict[str, dict[str, None]] = {}
    for section in sections:
        for name, version in section.versions.items():
            found.setdefault(name, {})[version] = None
    rows = tuple((name, ", ".join(versions)) for name, versions in found.items())
    return text_table(("package", "version"), rows, left=2)


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
    """The reference support's pivots and parts, and the data of contact and drive."""
    return {"pivots": pivots(support), "masses": masses(support), "contact_and_drive": contact_and_drive()}


def pivots(support: HydraulicSupport) -> Sheet:
    """Where the pivots are in the reference posture."""
    rows = tuple(
        (meaning, ASSUMED, *(millimetres(x) for x in getattr(support, name)))
        for name, meaning in PIVOTS.items()
    )
    return text_table(("pivot", "source", "x [mm]", "y [mm]"), rows, left=2)


def masses(support: HydraulicSupport) -> Sheet:
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
    return text_table(header, rows, left=2)


def _part(name: str, part: Part) -> tuple[str, ...]:
    centre = (f"{1e3 * x:.1f}" for x in part.centre)
    return name, ASSUMED, f"{part.mass:g}", *centre, f"{part.inertia:.1f}"


def contact_and_drive() -> Sheet:
    """Materials, bearing, laws and drive."""
    paper = paper_machine
    pin = paper.clearance_joint(CLEARANCE_MM, paper.SLIDING_COEFFICIENT, law=paper.PAPERS_LAW)
    bearing = pin.contact.bearing
    normal: Any = pin.contact.normal
    friction: Any = pin.contact.friction
    drive = CubicStep()
    stiffness = "stiffness K at {:.1f} mm of radial clearance (Eq. 5)"
    printed = [
        *_material(STEEL, "bore"),
        *_material(STEEL_35CRMO, "journal"),
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


def _material(material: Material, part: str) -> list[tuple[str, str, float]]:
    name = f"{material.name} ({part}, Table 1)"
    return [
        (f"elastic modulus, {name}", "GPa", material.elastic_modulus / 1e9),
        (f"Poisson's ratio, {name}", "1", material.poisson_ratio),
        (f"density, {name}; not used", "kg/m³", material.density),
    ]


def millimetres(metres: float) -> str:
    """A length [m] in millimetres, to six digits."""
    return f"{1e3 * metres:.6g}"
