"""How much of the linkage's horizontal stiffness does slack in its pins take?

The reference support and a ZF18000 on trapped oil under three roof loads, pushed slowly to the front and to
the rear, with ideal pins and with 0.25 to 2 mm of clearance in all of them: slack of the canopy, stiffness
within it and beyond it, and what links and legs carry.
"""

from collections.abc import Mapping

from studies.common.numbers import Found, Number, by_case, cell, rounded
from studies.common.options import Options
from studies.common.runs import run_cases
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.slack_stiffness import cases as plan
from studies.slack_stiffness.cases import CLEARANCES_MM, FRICTION, MACHINES, ROOF_SHARES, PushedSupport, cases
from studies.slack_stiffness.figures import MIDDLE, loop_figure, slack_figure
from studies.slack_stiffness.measures import MEASURES, kinematic_slack, numbers, participation, pin_shares
from support_exudyn import Result

ROOF_MOVES_MM = (5.0, 10.0, 20.0, 40.0)  # by how much a roof moves the canopy, either way
Shares = Mapping[tuple[str, float], Mapping[str, float]]  # of the push, by machine and roof load


def key_table(found: Found, shares: Shares) -> TextTable:
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
    return TextTable(header, tuple(rows), left=1)


def participation_table(found: Found) -> TextTable:
    """What is left of the linkage's stiffness, by clearance and by how far the roof moves."""
    rows = []
    for size in CLEARANCES_MM[1:]:
        slack = found["slack", PushedSupport(MACHINES[0], size, MIDDLE, FRICTION).name]
        left = [100.0 * participation(slack.value, one) for one in ROOF_MOVES_MM]
        rows.append((f"{size:g}", cell(slack), *(f"{one:.0f} %" for one in left)))
    header = ("clearance [mm]", "slack [mm]", *(f"roof moves ± {one:g} mm" for one in ROOF_MOVES_MM))
    return TextTable(header, tuple(rows))


def pin_table(shares: Shares) -> TextTable:
    """Force of each pin over the push, with ideal pins."""
    rows = [
        (machine, *(f"{one:.3f}" for one in shares[machine, MIDDLE].values()), f"{factor(shares, machine):.2f}")
        for machine in MACHINES
    ]
    pins = (name.replace("_", " ") for name in shares[MACHINES[0], MIDDLE])
    return TextTable(("support", *pins, "slack over clearance"), tuple(rows))


def whole_table(found: Found) -> TextTable:
    """All measures of all cases."""
    runs = dict.fromkeys(case for _, case in found)
    rows = [(case, *(cell(found.get((name, case))) for name in MEASURES)) for case in runs]
    header = ("case", *(f"{name.replace('_', ' ')} [{unit}]" for name, (unit, _) in MEASURES.items()))
    return TextTable(header, tuple(rows), in_chapter=False, width=200)


def factor(shares: Shares, machine: str) -> float:
    """Slack over the radial clearance, by virtual work."""
    return 2.0 * sum(shares[machine, MIDDLE].values())


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
        "rounded": rounded,
    }
    sheets = {
        "slack": key_table(found, shares),
        "participation": participation_table(found),
        "pins": pin_table(shares),
        "all": whole_table(found),
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
main = study.main
