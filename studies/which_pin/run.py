"""Which pin's clearance matters?

1.5 mm in each of the five pins of the reference support alone, in pairs, and in all together: what it does to
the tip's position, to the forces and to the shaking in the rise.
"""

from studies.common.numbers import by_case
from studies.common.options import Options
from studies.common.runs import run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.which_pin import cases, tables
from studies.which_pin.cases import PinPlan
from studies.which_pin.figures import figures
from studies.which_pin.measures import measure
from studies.which_pin.posture import loads
from support_exudyn.machines.four_bar_shield import PINS


def work(chosen: Options) -> StudyOutcome:
    """The motion with clearance pins; of the paper's support also the closed form of where it stands."""
    plan = PinPlan(chosen.subject)
    results = run_with_errors(plan.scenarios, chosen)
    under_loads = loads(plan.pin(0.0, plan.clearance_mm)) if plan.subject.is_paper else {}
    numbers = measure(plan, results)
    found = by_case(numbers)
    rankings = {
        f"table_{title.split()[-1]}_{_mu(friction)}": (title, friction)
        for title in tables.rankings(plan)
        for friction in plan.frictions
    }
    forces = {f"table_all_forces_{_mu(friction)}": friction for friction in plan.frictions}
    conditions = tables.condition_table(plan, found)
    closed_form = {
        "table_closed_form": tables.posture_table(found),
        "table_loads": tables.load_table(under_loads),
    }
    sheets = {
        "which_pin": tables.key_table(plan, found),
        "table_together": tables.together_table(plan, found),
        **(closed_form if plan.subject.is_paper else {}),
        "table_conditions": conditions,
        **{name: tables.ranking_table(plan, found, *what) for name, what in rankings.items()},
        **{name: tables.force_table(plan, found, friction) for name, friction in forces.items()},
    }
    means = {name: {pin: under.mean(pin) for pin in PINS} for name, under in under_loads.items()}
    words = {
        "cases": cases,
        "plan": plan,
        "window": f"{plan.watched.window:g} s",
        "tables": tables,
        "found": found,
        "orders": {name: tables.in_order(shifts) for name, shifts in means.items()},
        "shifts": {name: sum(shifts.values()) for name, shifts in means.items()},
        "rms_orders": [row for row in conditions.rows if row[0].startswith("rms")],
        "rankings": rankings,
        "forces": forces,
    }
    return StudyOutcome(numbers, words, figures(plan, found, under_loads), sheets, results)


def _mu(friction: float) -> str:
    return f"mu{friction:g}".replace(".", "p")


study = Study("which_pin", __doc__, work, seconds=70.0, own_machine=True)
main = study.main
