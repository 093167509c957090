"""The page of what a support must stand: one page of text, in mm, kN, MPa and degrees."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence

from support_exudyn.machines.check.report import aligned
from support_exudyn.machines.strength.assessment import FACTORS, FRICTION
from support_exudyn.machines.strength.results import StandReport, SupportForce
from support_exudyn.machines.strength.roof_forces import RoofForce

Row = tuple[str, ...]
WIDTH = 100  # letters of a line
WEAK = 0.8  # of the rated force: what is less is said in words, assumed
ROWS = 5  # postures in a table
OVER = 1.2  # EN 1804-1, 4.3.1: times the rated force, at most
FINE_KN = 1e4  # [N]: smaller forces have decimals
INCLINED = math.radians(15.0)  # of the floor


def page(report: StandReport) -> Iterator[str]:
    """The lines of the page."""
    low, high = report.forces[0].contact, report.forces[-1].contact
    yield from _folded(f"{report.name or 'machine'}: what it must stand", "")
    yield (
        f"roof {_mm(low.height)} to {_mm(high.height)} mm above the origin; canopy {_mm(low.front - low.rear)} "
        "mm long; static, in the plane"
    )
    for section in (_cylinders, _support, _over, _pins, _buckled, _tipped):
        for line in section(report):
            yield from [line] if len(line) <= WIDTH else _folded(line, "    ")
    for word, sentences in (("assumed", report.assumed), ("source", report.sources)):
        for said in sentences:
            yield from _folded(f"{word}: {said}", "  ")


# --- sections ---


def _cylinders(report: StandReport) -> Iterator[str]:
    yield "1 legs and rams [plain: pressure times area]"
    head = ("", "number", "bore mm", "set MPa", "yield MPa", "set kN", "yield kN", "x 1.2 kN", "pull kN")
    rows: list[Row] = []
    for name, one in report.cylinders.items():
        setting = math.nan if one.setting_pressure is None else one.setting_pressure
        pressures = [_number(1e-6 * pressure, ".1f") for pressure in (setting, one.yield_pressure)]
        forces = [_kn(force) for force in (setting * one.area, one.push, FACTORS[1] * one.push, one.pull)]
        rows.append((name, str(one.count), f"{1e3 * one.bore:.0f}", *pressures, *forces))
    yield from aligned([head, *rows])


def _support(report: StandReport) -> Iterator[str]:
    rams = len(report.legs) < len(report.cylinders)
    free = ", rams at rest" if rams else ""
    yield f"2 support force, legs alike at setting or yield{free} [plain: virtual work, less weight]"
    last = ("ram pulls kN", "ram pushes kN") if rams else ()
    rubs = tuple(f"mu {mu:+g} kN" for mu in report.forces[0].rubbed)
    rows: list[Row] = [("roof mm", "set kN", "yield kN", "place mm", "place %", *rubs, *last)]
    for one in _some(report.forces):
        (rear, front, height), roof = one.contact, one.yielding
        along = math.nan if roof is None else roof.x - rear
        place = _mm(along), _number(round(100.0 * (along / (front - rear)), 1) + 0.0, ".1f")
        ends = (_force(one.pull), _force(one.push)) if rams else ()
        rough = map(_force, one.rubbed.values())
        rows.append((_mm(height), _force(one.setting), _force(roof), *place, *rough, *ends))
    yield from aligned(rows)
    yield "  place: of the resultant at yield, from the rear end of the canopy; mu: the roof rubs, + forward"
    found = [
        roof.force
        for one in report.forces
        for roof in (one.yielding, one.pull, one.push, *one.rubbed.values())
        if roof
    ]
    if not found:
        yield "  no roof force balances all legs together"
        return
    share = max(found) / report.rated
    assumed = " (assumed)" if report.rated_is_assumed else ""
    yield (
        f"  rule EN 1804-1, 4.3.1 (as the roof converges, at most {OVER:g} of the rated force): "
        f"{share:.3f} of {_kn(report.rated)} kN{assumed}: {_met(share <= OVER)} on "
        "a slow roof; what valves add at its speed only a run tells"
    )
    if share < WEAK:
        yield f"  the support reaches only {share:.2f} of its rated force, and no rule asks for more"


def _over(report: StandReport) -> Iterator[str]:
    yield "3 resistance over the canopy, kN: the largest force that opens no valve and lifts no leg [plain]"
    shares = (0.0, 0.25, 0.5, 0.75, 1.0)
    rows: list[Row] = [("roof mm", *("rear end", "1/4", "middle", "3/4", "front end", "largest", "at mm"))]
    for one in _some(report.forces, 3):
        places = [one.over[round(share * (len(one.over) - 1))] for share in shares]
        forces = [_force(roof) for roof in (*places, one.largest)]
        rows.append((_mm(one.contact.height), *forces, _mm(one.largest.x - one.contact.rear)))
    yield from aligned(rows)


def _pins(report: StandReport) -> Iterator[str]:
    yield "4 pins at yield and 1.2 x yield, largest over the height, kN [rule EN 1804-1, 4.3.2: no part fails]"
    rows: list[Row] = [
        ("", "alike", "x 1.2", "any", "x 1.2", "rubs", "x 1.2", "bearing", "shear", "bending", "rubs")
    ]
    alike: dict[tuple[float, float], list[str]] = {}  # pins by the yield stresses of their safeties
    judged = {name: one.stresses for name, one in report.pins.items() if one.stresses is not None}
    for name, one in report.pins.items():
        forces = [_kn(force) for loads in (one.nominal, one.worst, one.rubbed) for force in loads.values()]
        safeties = ["-"] * 4
        if name in judged:
            smooth, rough = judged[name]
            safeties = [f"{safety:.2f}" for safety in (*smooth.safeties.values(), rough.least[1])]
        rows.append((name, *forces, *safeties))
        if one.yields is not None:
            alike.setdefault(one.yields, []).append(name)
    yield from aligned(rows)
    yield "  alike: legs alike, smooth roof; any: any force of it the cylinders hold; rubs: so, rough roof"
    yield "  then safeties against yield of pin and eyes at 1.2 x any, and the least of them at 1.2 x rubs"
    for (pin, eyes), names in alike.items():
        of = "" if len(alike) == 1 else f" of {', '.join(names)}"
        yield f"  yield stress{of}: pin {1e-6 * pin:.0f} MPa, eyes {1e-6 * eyes:.0f} MPa"
    for word, place in (("roof without friction", 0), (f"friction {FRICTION:g}", 1)):
        least = {name: told[place].least for name, told in judged.items()}
        fails = [f"{name} ({part})" for name, (part, safety) in least.items() if safety < 1.0]
        if judged:
            said = f"NOT met by {', '.join(fails)}" if fails else "met"
            yield (
                f"  4.3.2, {word}: {said}, judged by {len(judged)} of {len(report.pins)} pins and their eyes, "
                "elastic stresses"
            )
    if report.unknown_pins:
        yield f"  not told for want of bore or length: {', '.join(report.unknown_pins)}"


def _buckled(report: StandReport) -> Iterator[str]:
    yield "5 buckling of one cylinder at its longest, ends pinned [plain: Euler of its stages; Johnson]"
    rows: list[Row] = [("", "length mm", "yield kN", "Euler kN", "Johnson kN", "safety", "at 1.2 x yield")]
    weak = []
    for name, one in report.buckling.items():
        safety = one.least / one.force
        loads = [_kn(load) for load in (one.force, one.euler, math.nan if one.johnson is None else one.johnson)]
        rows.append((name, _mm(one.length), *loads, f"{safety:.2f}", f"{safety / FACTORS[1]:.2f}"))
        factor = 1.0 if safety < 1.0 else FACTORS[1]
        if safety < factor:
            at = "its yield force" if factor == 1.0 else f"{factor:g} x its yield force"
            weak.append(f"  {name} buckles below {at}: safety {safety / factor:.2f}, below 1")
    if report.buckling:
        yield from aligned(rows)
    yield from weak
    for name, why in report.unbuckled.items():
        yield f"  {name}: not told, {why}"


def _tipped(report: StandReport) -> Iterator[str]:
    if report.tipping is None:
        yield "6 standing free: not computed, the file describes no base"
        return
    yield "6 standing free, all postures: inclination of the floor at which it tips [plain: statics]"
    least = {way: min(one.angles[way] for one in report.tipping) for way in report.tipping[0].angles}
    top = max(report.tipping, key=lambda one: one.centre[1])
    told = ", ".join(f"{way} {math.degrees(angle):.1f}" for way, angle in least.items())
    yield (
        f"  {told} degrees; {math.degrees(INCLINED):.0f} all round: {_met(min(least.values()) >= INCLINED)}; "
        f"{1e-3 * top.mass:.1f} t, centre {_mm(top.centre[1])} mm high"
    )


# --- cells ---


def _some(forces: Sequence[SupportForce], count: int = ROWS) -> list[SupportForce]:
    last = len(forces) - 1
    return [forces[n] for n in dict.fromkeys(round(n * last / (count - 1)) for n in range(count))]


def _met(holds: bool) -> str:
    return "met" if holds else "NOT met"


def _number(number: float, digits: str) -> str:
    return f"{number:{digits}}" if math.isfinite(number) else "-"


def _kn(force: float) -> str:
    return _number(1e-3 * force, ".0f" if abs(force) >= FINE_KN or force == 0.0 else ".2f")


def _force(roof: RoofForce | None) -> str:
    return "-" if roof is None else _kn(roof.force)


def _mm(length: float) -> str:
    if abs(length) >= 0.1:
        return f"{1e3 * length:.0f}"
    return _number(round(1e3 * length, 1) + 0.0, ".1f")


def _folded(text: str, indent: str) -> list[str]:
    first = text[: len(text) - len(text.lstrip())]
    return textwrap.wrap(
        text.lstrip(), WIDTH, initial_indent=first, subsequent_indent=indent or "  ", break_on_hyphens=False
    )
