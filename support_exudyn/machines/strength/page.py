"""The page of what a support must stand: one page of text, in mm, kN, MPa and degrees."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence

from support_exudyn.machines.check.report import aligned
from support_exudyn.machines.strength.assessment import FACTORS, FRICTION
from support_exudyn.machines.strength.results import PinLoad, StandReport, SupportForce
from support_exudyn.machines.strength.roof_forces import RoofForce

Row = tuple[str, ...]
WIDTH = 100  # letters of a line
WEAK = 0.8  # of the rated force: what is less is said in words, assumed
ROWS = 5  # postures that are told
OVER = 1.2  # EN 1804-1, 4.3.1: times the rated force, at most
FINE_KN = 1e4  # [N]: smaller forces are told with decimals
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
    rows: list[Row] = [
        ("", "number", "bore mm", "set MPa", "yield MPa", "set kN", "yield kN", "x 1.2 kN", "pull kN")
    ]
    for name, one in report.cylinders.items():
        setting = one.setting_pressure
        rows.append(
            (
                name,
                str(one.count),
                f"{1e3 * one.bore:.0f}",
                "-" if setting is None else f"{1e-6 * setting:.1f}",
                f"{1e-6 * one.yield_pressure:.1f}",
                "-" if setting is None else _kn(setting * one.area),
                _kn(one.push),
                _kn(FACTORS[1] * one.push),
                _kn(one.pull),
            )
        )
    yield from aligned(rows)


def _support(report: StandReport) -> Iterator[str]:
    rams = len(report.legs) < len(report.cylinders)
    free = ", rams at rest" if rams else ""
    yield f"2 support force, legs alike at setting or yield{free} [plain: virtual work, less weight]"
    last = ("ram pulls kN", "ram pushes kN") if rams else ()
    rubs = tuple(f"mu {mu:+g} kN" for mu in report.forces[0].rubbed)
    rows: list[Row] = [("roof mm", "set kN", "yield kN", "place mm", "place %", *rubs, *last)]
    for one in _some(report.forces):
        ends = (_force(one.pull), _force(one.push)) if rams else ()
        rows.append(
            (
                _mm(one.contact.height),
                _force(one.setting),
                _force(one.yielding),
                *_place(one, one.yielding),
                *(_force(roof) for roof in one.rubbed.values()),
                *ends,
            )
        )
    yield from aligned(rows)
    yield "  place: of the resultant at yield, from the rear end of the canopy; mu: the roof rubs, + forward"
    rated = report.rated
    found = [
        roof.force
        for one in report.forces
        for roof in (one.yielding, one.pull, one.push, *one.rubbed.values())
        if roof
    ]
    if not found:
        yield "  no roof force balances all legs together"
        return
    most = max(found)
    assumed = " (assumed)" if report.rated_is_assumed else ""
    yield (
        f"  rule EN 1804-1, 4.3.1 (as the roof converges, at most {OVER:g} of the rated force): "
        f"{most / rated:.3f} of {_kn(rated)} kN{assumed}: {_met(most <= OVER * rated)} on "
        "a slow roof; what valves add at its speed only a run tells"
    )
    if most < WEAK * rated:
        yield f"  the support reaches only {most / rated:.2f} of its rated force, and no rule asks for more"


def _over(report: StandReport) -> Iterator[str]:
    yield "3 resistance over the canopy, kN: the largest force that opens no valve and lifts no leg [plain]"
    shares = (0.0, 0.25, 0.5, 0.75, 1.0)
    rows: list[Row] = [("roof mm", *("rear end", "1/4", "middle", "3/4", "front end", "largest", "at mm"))]
    for one in _some(report.forces, 3):
        places = [one.over[round(share * (len(one.over) - 1))] for share in shares]
        most = one.largest
        told = (_kn(most.force), _mm(most.x - one.contact.rear))
        rows.append((_mm(one.contact.height), *(_kn(one.force) for one in places), *told))
    yield from aligned(rows)


def _pins(report: StandReport) -> Iterator[str]:
    yield "4 pins at yield and 1.2 x yield, largest over the height, kN [rule EN 1804-1, 4.3.2: no part fails]"
    rows: list[Row] = [
        ("", "alike", "x 1.2", "any", "x 1.2", "rubs", "x 1.2", "bearing", "shear", "bending", "rubs")
    ]
    for name, one in report.pins.items():
        rows.append((name, *_loads(one), *_safeties(one)))
    yield from aligned(rows)
    yield "  alike: legs alike, smooth roof; any: any force of it the cylinders hold; rubs: so, rough roof"
    yield "  then safeties against yield of pin and eyes at 1.2 x any, and the least of them at 1.2 x rubs"
    yield from _yields(report)
    judged = {name: one.stresses for name, one in report.pins.items() if one.stresses is not None}
    for word, place in (("roof without friction", 0), (f"friction {FRICTION:g}", 1)):
        fails = [
            f"{name} ({told[place].least[0]})" for name, told in judged.items() if told[place].least[1] < 1.0
        ]
        if judged:
            said = f"NOT met by {', '.join(fails)}" if fails else "met"
            yield (
                f"  4.3.2, {word}: {said}, judged by {len(judged)} of {len(report.pins)} pins and their eyes, "
                "elastic stresses"
            )
    if report.unknown_pins:
        yield f"  not told for want of bore or length: {', '.join(report.unknown_pins)}"


def _yields(report: StandReport) -> Iterator[str]:
    """The yield stresses on which the safeties rest."""
    alike: dict[tuple[float, float], list[str]] = {}
    for name, one in report.pins.items():
        if one.yields is not None:
            alike.setdefault(one.yields, []).append(name)
    for (pin, eyes), names in alike.items():
        of = "" if len(alike) == 1 else f" of {', '.join(names)}"
        yield f"  yield stress{of}: pin {1e-6 * pin:.0f} MPa, eyes {1e-6 * eyes:.0f} MPa"


def _buckled(report: StandReport) -> Iterator[str]:
    yield "5 buckling of one cylinder at its longest, ends pinned [plain: Euler of its stages; Johnson]"
    if report.buckling:
        rows: list[Row] = [("", "length mm", "yield kN", "Euler kN", "Johnson kN", "safety", "at 1.2 x yield")]
        for name, one in report.buckling.items():
            rows.append(
                (
                    name,
                    _mm(one.length),
                    _kn(one.force),
                    _kn(one.euler),
                    "-" if one.johnson is None else _kn(one.johnson),
                    f"{one.least / one.force:.2f}",
                    f"{one.least / (FACTORS[1] * one.force):.2f}",
                )
            )
        yield from aligned(rows)
    for name, one in report.buckling.items():
        safety = one.least / one.force
        if safety < FACTORS[1]:
            at = "its yield force" if safety < 1.0 else f"{FACTORS[1]:g} x its yield force"
            least = safety if safety < 1.0 else safety / FACTORS[1]
            yield f"  {name} buckles below {at}: safety {least:.2f}, below 1"
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
    chosen = dict.fromkeys(round(n * last / (count - 1)) for n in range(count))
    return [forces[n] for n in chosen]


def _place(one: SupportForce, roof: RoofForce | None) -> tuple[str, str]:
    if roof is None:
        return "-", "-"
    along = roof.x - one.contact.rear
    share = along / (one.contact.front - one.contact.rear)
    return _mm(along), f"{round(100.0 * share, 1) + 0.0:.1f}"


def _loads(one: PinLoad) -> Iterator[str]:
    for loads in (one.nominal, one.worst, one.rubbed):
        for force in loads.values():
            yield _kn(force)


def _safeties(one: PinLoad) -> tuple[str, ...]:
    if one.stresses is None:
        return ("-",) * 4
    smooth, rubs = one.stresses
    return *(f"{safety:.2f}" for safety in smooth.safeties.values()), f"{rubs.least[1]:.2f}"


def _met(holds: bool) -> str:
    return "met" if holds else "NOT met"


def _force(roof: RoofForce | None) -> str:
    return "-" if roof is None else _kn(roof.force)


def _kn(force: float) -> str:
    if not math.isfinite(force):
        return "-"
    return f"{1e-3 * force:.0f}" if abs(force) >= FINE_KN or force == 0.0 else f"{1e-3 * force:.2f}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.0f}" if abs(length) >= 0.1 else f"{round(1e3 * length, 1) + 0.0:.1f}"


def _folded(text: str, indent: str) -> list[str]:
    first = text[: len(text) - len(text.lstrip())]
    return textwrap.wrap(
        text.lstrip(), WIDTH, initial_indent=first, subsequent_indent=indent or "  ", break_on_hyphens=False
    )
