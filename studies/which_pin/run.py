"""Which pin's clearance matters? (The paper sets the question aside and lets one pin rattle.)

1.5 mm in each of the five pins of the reference support alone, in pairs, and in all together: what it does to
the tip's position, to the forces and to the shaking in the rise.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

from studies.common.study import (
    Options,
    options,
    run_main,
    run_with_errors,
    save_figures,
    save_run,
    show_table,
    write_summary,
)
from studies.common.wording import by_case
from studies.which_pin import cases as cases
from studies.which_pin.cases import FRICTIONS, scenarios, slack_pin
from studies.which_pin.figures import figures
from studies.which_pin.measures import measure
from studies.which_pin.posture import load_sheet, loads
from studies.which_pin.tables import (
    RANKED,
    condition_sheet,
    force_sheet,
    in_order,
    posture_sheet,
    ranking_sheet,
    together_sheet,
)
from studies.which_pin.words import chapter
from support_exudyn.postprocessing.figures import style

STUDY = cases.STUDY


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    results = run_with_errors(scenarios(chosen.quick), chosen.workers)
    for name, result in results.items():
        save_run(result, chosen.out, _file_name(name))
    under_loads = loads(slack_pin(0.0))
    numbers = measure(results)
    found = by_case(numbers)
    with style.look():
        drawings = figures(found, under_loads)
    save_figures(chosen, drawings)
    for title in RANKED:
        for friction in FRICTIONS:
            stem = f"table_{title.split()[-1]}_mu{friction:g}".replace(".", "p")
            show_table(chosen.out / f"{stem}.txt", ranking_sheet(found, title, friction))
    for friction in FRICTIONS:
        stem = f"table_all_forces_mu{friction:g}".replace(".", "p")
        show_table(chosen.out / f"{stem}.txt", force_sheet(found, friction), width=170)
    show_table(chosen.out / "table_together.txt", together_sheet(found))
    show_table(chosen.out / "table_closed_form.txt", posture_sheet(found))
    show_table(chosen.out / "table_loads.txt", load_sheet(under_loads, in_order), width=170)
    show_table(chosen.out / "table_conditions.txt", condition_sheet(found), width=170)
    chapter(found, under_loads, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def _file_name(case: str) -> str:
    named = case.replace(" + ", "+").replace(", mu_d = ", "_mu").replace(" ", "_")
    return named.replace(".", "p")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.which_pin`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
