"""`python -m studies`: the studies of the paper on Exudyn; other studies by name; and the report on them."""

import os
import sys
import time
import traceback
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from studies.adams import run as adams
from studies.benchmarking import trade
from studies.catalogue import DEFAULT, STUDIES
from studies.common.options import KEPT, Options
from studies.common.study import Study, output_folder, say_short, work_in_folder
from studies.common.subject import chosen_subject
from studies.common.witness import compiling
from studies.report import rebuild
from studies.reporting.arranged import PAGE
from support_exudyn.commands.command_line import (
    Imports,
    answered,
    at_most,
    carry_out,
    import_modules,
    new_app,
    say,
    warn,
)
from support_exudyn.simulation.at_start import EXIT_CODE
from support_exudyn.sweeps.workers import Workers, worker_pool
from user_forces.values.value import InputError, short

BENCHMARK, ADAMS = "benchmark", "adams"  # the commands that stand beside the studies
app = new_app("python -m studies", "Run studies and write the report on them.", version_flags=())
app.command(trade.benchmark, name=BENCHMARK)
app.command(adams.adams, name=ADAMS)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies`. Returns the exit code."""
    return carry_out(app, argv)


@app.default
def run_studies(
    *names: str,
    all: bool = False,  # noqa: A002, the option's name
    list: bool = False,  # noqa: A002, the option's name
    out: Path = Path("results"),
    workers: Annotated[int, at_most(1024)] = os.cpu_count() or 1,
    machines: Annotated[int | None, at_most(100_000)] = None,
    runs: Annotated[int | None, at_most(1_000_000)] = None,
    machine: Path | None = None,
    pin: str | None = None,
    imports: Imports = (),
) -> int:
    """Run studies and write the report after each.

    Args:
        names: Studies to run (the paper's answer).
        all: Run all studies.
        list: Print all studies, their questions and times.
        out: Folder for output (results).
        workers: Processes (all cores).
        machines: Machines that claims draws (80; with --all more).
        runs: Scenes that extremes draws; blow: its small form.
        machine: Your machine or scenario in place of the paper's: a TOML file, or a shipped machine's name.
        pin: The pin of your machine that gets clearance (rear_base).

    Returns the exit code: 0, or 1 if any study failed or the report could not be written.
    """
    if list:
        _list()
        return 0
    chosen = _chosen(names, all, machine is not None)
    import_modules(imports)
    options = Options(out, workers, out / KEPT, machines, runs, chosen_subject(machine, pin), thorough=all)
    with output_folder(out), worker_pool(workers) as pool:
        return _run(chosen, options, pool)


def _list() -> None:
    """Every study with its question; those of the paper's answer first."""

    def line(name: str, seconds: float, question: str, *about: str) -> None:
        notes = ", ".join(filter(None, about))
        say(f"{name:20} {_seconds(seconds):>8}  {question}" + (f" ({notes})" if notes else ""))

    for name, study in STUDIES.items():
        paper = "the paper's answer" if name in DEFAULT else ""
        line(name, study.seconds, study.question(), paper, "takes --machine" if study.own_machine else "")
    alone = "alone, not in the report"
    question = (trade.benchmark.__doc__ or "").partition("?")[0]
    line(BENCHMARK, trade.BENCHMARK_SECONDS, f"{question}?", alone)
    line(ADAMS, 0.0, "How is the paper's model written for ADAMS?", alone)


def _chosen(names: Sequence[str], every: bool, has_machine: bool) -> list[str]:
    unknown = [name for name in names if name not in STUDIES]
    if unknown:
        raise InputError(f"{short(unknown[0])}: no such study; allowed: {', '.join(STUDIES)}")
    if names and every:
        raise InputError("--all: allowed: without names of studies")
    if every:
        return list(STUDIES)
    if has_machine and not names:
        papers = [name for name in DEFAULT if not STUDIES[name].own_machine]
        warn(f"left out, for they are about the paper's machine alone: {', '.join(papers)}")
        return [name for name in DEFAULT if STUDIES[name].own_machine]
    return list(names or DEFAULT)


def _run(names: Sequence[str], options: Options, pool: Workers) -> int:
    """Run studies one after the other, and write the report after each, whether others have failed or not.

    The witness of the paper's studies is compiled in the meantime.
    """
    began = time.perf_counter()
    failed: list[str] = []
    written = False
    with compiling() if set(names) & set(DEFAULT) else nullcontext():
        for n, name in enumerate(names):
            spent = _seconds(time.perf_counter() - began)
            left = _seconds(sum(STUDIES[one].seconds for one in names[n:]))
            warn(f"study {n + 1} of {len(names)}: {name}; {spent} so far, about {left} to go")
            chosen = replace(options, out=options.out / name, workers=pool)
            if _code_of(STUDIES[name], chosen):
                failed.append(name)
            elif answered(lambda: rebuild(options.out)):
                failed.append(f"report after {name}")
            else:
                written = True
    if failed:
        others = "; the report has all the others" if written else ""
        warn(f"error: failed: {', '.join(failed)}{others}")
    page = f"; the report: {options.out / PAGE}" if written else ""
    say(f"\n{_seconds(time.perf_counter() - began)} in all{page}")
    return 1 if failed else 0


def _code_of(study: type[Study], options: Options) -> int:
    """Run a study and print its answer. Returns the exit code; an interruption ends all studies."""
    try:
        code = work_in_folder(lambda out: say_short(study(options).write(), out), options.out)
    except Exception:  # a bug in one study; the others are still worth having
        traceback.print_exc()
        return 1
    if code == EXIT_CODE:
        sys.exit(code)  # an exception, so that no process works on
    return code


def _seconds(duration: float) -> str:
    """A duration in seconds or minutes."""
    return f"{duration:.0f} s" if duration < 100.0 else f"{duration / 60.0:.0f} min"


if __name__ == "__main__":
    sys.exit(main())
