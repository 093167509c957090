"""How much of the linkage's horizontal stiffness does slack in its pins take?

The reference support and a ZF18000 on trapped oil under three roof loads, pushed slowly to the front and to
the rear, with ideal pins and with 0.25 to 2 mm of clearance in all of them: slack of the canopy, stiffness
within it and beyond it, and what links and legs carry.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.numbers import Found, Number, by_case, cell
from studies.common.options import Options
from studies.common.panels import finish
from studies.common.runs import run_cases
from studies.common.study import Study, StudyOutcome
from studies.common.words import text_table
from studies.slack_stiffness import loops as plan
from studies.slack_stiffness.loops import (
    CLEARANCES_MM,
    FRICTION,
    MACHINES,
    ROOF_SHARES,
    Loop,
    PushedSupport,
    cases,
    kinematic_slack,
    numbers,
    participation,
    pin_shares,
)
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet

ROOF_MOVES_MM = (5.0, 10.0, 20.0, 40.0)  # by how much a roof moves the canopy, either way
Shares = Mapping[tuple[str, float], Mapping[str, float]]  # of the push, by machine and roof load


def key_table(found: Found, shares: Shares) -> Sheet:
    """Slack and stiffness of every support under the middle roof load."""
    rows = []
    for machine in MACHINES:
        for size in CLEARANCES_MM[1:]:
            case = PushedSupport(machine, size, MIDDLE, FRICTION)
            slack, beyond, whole, within = (
                found[name, case.name] for name in ("slack", "beyond", "whole", "within")
            )
            predicted = 1e3 * kinematic_slack(case, shares[machine, MIDDLE])
            rows.append((
                machine, f"{size:g}", cell(slack), f"{predicted:.2f}", cell(within), cell(beyond), cell(whole),
            ))  # fmt: skip
    header = (
        "support", "clearance [mm]", "slack [mm]", "by virtual work [mm]", "within [kN/mm]", "beyond [kN/mm]",
        "turn to turn [kN/mm]",
    )  # fmt: skip
    return text_table(header, rows, left=1)


def participation_table(found: Found) -> Sheet:
    """What is left of the linkage's stiffness, by clearance and by how far the roof moves."""
    rows = []
    for size in CLEARANCES_MM[1:]:
        slack = found["slack", PushedSupport(MACHINES[0], size, MIDDLE, FRICTION).name]
        left = [100.0 * participation(slack.value, one) for one in ROOF_MOVES_MM]
        rows.append((f"{size:g}", cell(slack), *(f"{one:.0f} %" for one in left)))
    header = ("clearance [mm]", "slack [mm]", *(f"roof moves ± {one:g} mm" for one in ROOF_MOVES_MM))
    return text_table(header, rows)


def pin_table(shares: Shares) -> Sheet:
    """Force of each pin over the push, with ideal pins."""
    rows = [
        (machine, *(f"{one:.3f}" for one in shares[machine, MIDDLE].values()), f"{factor(shares, machine):.2f}")
        for machine in MACHINES
    ]
    pins = (name.replace("_", " ") for name in shares[MACHINES[0], MIDDLE])
    return text_table(("support", *pins, "slack over clearance"), rows)


def factor(shares: Shares, machine: str) -> float:
    """Slack over the radial clearance, by virtual work."""
    return 2.0 * sum(shares[machine, MIDDLE].values())


# --- figures ---

Ran = Mapping[str, tuple[PushedSupport, Result]]
DRAWN_MM = (0.0, 0.5, 1.0, 2.0)  # clearances whose loops are drawn
MIDDLE = ROOF_SHARES[1]


def loop_figure(ran: Ran) -> Figure:
    """Push over displacement of the canopy, a panel for each machine, under the middle roof load."""
    drawing = Figure(figsize=style.size(170, 85))
    panels = list(drawing.subplots(1, 2))
    for axes, machine in zip(panels, MACHINES, strict=True):
        for (colour, dashes), size in zip(reversed(style.CURVES[:4]), DRAWN_MM, strict=True):
            case, run = ran[PushedSupport(machine, size, MIDDLE, FRICTION).name]
            loop = Loop(case, run)
            label = f"{size:g} mm" if size else "ideal pins"
            axes.plot(1e3 * loop.shift, 1e-3 * loop.force, color=colour, ls=dashes, label=label)
        axes.set(xlabel="displacement of the canopy [mm]", ylabel="horizontal force [kN]", title=machine)
    return finish(drawing, panels, 4)


def slack_figure(found: Found, factors: Mapping[str, float]) -> Figure:
    """Slack over clearance with what virtual work says (a), and stiffness from turn to turn (b)."""
    drawing = Figure(figsize=style.size(170, 85))
    slack, whole = drawing.subplots(1, 2)
    markers = dict(zip(ROOF_SHARES, ("o", "s", "^"), strict=True))
    for machine, (colour, dashes) in zip(MACHINES, style.CURVES, strict=False):
        ends = (0.0, CLEARANCES_MM[-1])
        slack.plot(ends, [factors[machine] * one for one in ends], color=colour, ls=dashes, lw=0.8)
        for share, marker in markers.items():
            _draw(slack, found, "slack", machine, share, color=colour, marker=marker, ls="none")
            _draw(whole, found, "whole", machine, share, color=colour, marker=marker, ls=dashes)
    slack.set(xlabel="radial clearance of all pins [mm]", ylabel="slack of the canopy [mm]")
    whole.set(
        xlabel="radial clearance of all pins [mm]", ylabel="stiffness from turn to turn [kN/mm]", ylim=(0, None)
    )
    for machine, (colour, dashes) in zip(MACHINES, style.CURVES, strict=False):
        slack.plot([], [], color=colour, ls=dashes, label=machine)
    for share, marker in markers.items():
        slack.plot([], [], marker, color="black", mfc="none", label=f"roof load {100 * share:g} % of rated")
    return finish(drawing, [slack, whole], 3)


def _draw(axes: Axes, found: Found, measure: str, machine: str, share: float, **look: Any) -> None:
    sizes = CLEARANCES_MM[1:]
    values = [found[measure, PushedSupport(machine, size, share, FRICTION).name].value for size in sizes]
    axes.plot(sizes, values, mfc="none", ms=4.5, lw=0.8, **look)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """All loops, their numbers, figures and tables."""
    all_cases = {case.name: case for case in cases()}
    runs = run_cases({name: case.scenario() for name, case in all_cases.items()}, chosen)
    ran = {name: (case, runs[name]) for name, case in all_cases.items()}
    shares = {
        (machine, share): pin_shares(*ran[PushedSupport(machine, 0.0, share, 0.0).name])
        for machine in MACHINES
        for share in ROOF_SHARES
    }
    reported = numbers(ran) + [
        Number("slack_over_clearance", machine, factor(shares, machine), "1", 0.0) for machine in MACHINES
    ]
    found = by_case(reported)
    slow, fast = PushedSupport(*plan.SLOW, quarter=2.0 * plan.QUARTER), PushedSupport(*plan.SLOW)
    loose = [(name, case) for name, (case, _) in ran.items() if case.clearance_mm]
    words = {
        "plan": plan,
        "found": found,
        "of": lambda name, machine, size, share=MIDDLE, mu=FRICTION: found[
            name, PushedSupport(machine, size, share, mu).name
        ],
        "slow": found["slack", slow.name],
        "fast": found["slack", fast.name],
        "factors": {machine: factor(shares, machine) for machine in MACHINES},
        "off": max(
            abs(
                found["slack", name].value
                / (1e3 * kinematic_slack(case, shares[case.machine, case.roof_share]))
                - 1.0
            )
            for name, case in loose
            if case.roof_share >= MIDDLE
        ),
        "left": participation,
        "middle": MIDDLE,
    }
    sheets = {
        "slack": key_table(found, shares),
        "participation": participation_table(found),
        "pins": pin_table(shares),
    }
    drawings = {
        "loops": loop_figure(ran),
        "slack_and_stiffness": slack_figure(found, {one: factor(shares, one) for one in MACHINES}),
    }
    kept: dict[str, Result] = {
        case.name: runs[case.name]
        for case in (PushedSupport(MACHINES[0], size, MIDDLE, FRICTION) for size in (0.0, 1.0))
    }
    return StudyOutcome(reported, words, drawings, sheets, kept)


study = Study("slack_stiffness", __doc__, work, seconds=400.0)
