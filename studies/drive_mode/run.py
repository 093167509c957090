"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
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
from studies.drive_mode import cases as cases
from studies.drive_mode import cylinders as cylinders
from studies.drive_mode.cases import COLUMNS, naive_peaks, scenarios
from studies.drive_mode.figures import figures
from studies.drive_mode.measures import measure
from studies.drive_mode.tables import convergence_sheet, mode_sheet, saving_sheet
from studies.drive_mode.words import chapter
from support_exudyn.postprocessing.figures import style

STUDY = cases.STUDY


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    results = run_with_errors(scenarios(chosen.quick), chosen.workers)
    for name, result in results.items():
        save_run(result, chosen.out, _file_name(name))
    naive = naive_peaks()
    numbers = measure(results)
    with style.look():
        drawings = figures(results) | cylinders.figures(results)
    save_figures(chosen, drawings)
    for columns in COLUMNS:
        show_table(chosen.out / f"table_{columns}.txt", mode_sheet(numbers, columns))
    show_table(chosen.out / "table_saving.txt", saving_sheet(numbers))
    show_table(chosen.out / "table_valves.txt", cylinders.sheet(numbers))
    show_table(chosen.out / "table_convergence.txt", convergence_sheet(results), width=170)
    chapter(results, naive, numbers, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def _file_name(case: str) -> str:
    return case.replace(",", "").replace(" ", "_").replace(".", "p")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.drive_mode`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
