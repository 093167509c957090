"""Commands about sweeps: `sweep` runs one, `chart` and `table` show its numbers, and `show` its summary."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from support_exudyn.commands import command_line as cli
from support_exudyn.postprocessing import sweep_runs, sweep_sliders, sweep_summary
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.sweep_runs import SweepRuns
from support_exudyn.sweeps import open_run as compute_run
from support_exudyn.sweeps import read_sweep, read_table
from support_exudyn.sweeps import sweep as run_sweep
from support_exudyn.sweeps.run import known
from support_exudyn.sweeps.table import is_sampled
from user_forces.values.value import InputError

FAILURES = 3  # exit code
MOST = 8  # numbers that are shown unless all or some are asked for
FORMATS = {"md": sweep_runs.as_markdown, "csv": sweep_runs.as_csv, "latex": sweep_runs.as_latex}
Store = Annotated[Path, Parameter(help="Folder of a sweep, or the table.parquet in it.")]
Workers = Annotated[int | None, cli.at_most(1024)]


def sweep(
    file: Path,
    /,
    *,
    out: Path | None = None,
    workers: Workers = None,
    scheduler: str = "",
    retry_failed: bool = False,
    prune: bool = False,
    dry_run: bool = False,
    open_run: str = "",
    json: cli.Json = False,
) -> int:
    """Run what is missing, and print how many runs there are of each kind, and where the table is.

    The store is a folder with table.parquet and table.csv, which have a row for every run.
    The same command resumes an interrupted sweep; after a change of FILE only those runs are made that it
    lacks.

    Args:
        file: What is varied, as TOML.
        out: The store (FILE_sweep next to FILE).
        workers: Runs side by side on this machine (as many as there are cores).
        scheduler: Address of a Dask scheduler, such as tcp://10.0.0.5:8786, whose workers have this program,
            too; needs `pip install 'support-exudyn[cluster]'`.
        retry_failed: Run again what has failed before.
        prune: Remove runs from the store that FILE no longer asks for.
        dry_run: Only print how many runs there are to do.
        open_run: Only compute this run again, by its name in the table, and write STORE/NAME.h5.
    """
    if workers and scheduler:
        raise InputError(f"--workers {workers}: allowed: without --scheduler")
    plan = read_sweep(file)
    store = out or plan.store or Path()
    if open_run:
        cli.say(compute_run(plan, open_run).save(store / f"{open_run}.h5"))
        return 0
    if dry_run:
        outcome = known(plan, store, retry_failed)
    else:
        with cli.shown_progress(file.stem) as progress:
            outcome = run_sweep(
                plan,
                store,
                workers=workers,
                scheduler=scheduler,
                retry_failed=retry_failed,
                prune=prune,
                progress=lambda so_far: progress(so_far.finished / so_far.runs),
            )
    counts = {"done": outcome.done, "failed": outcome.failed, "killed": outcome.killed}
    words = ", ".join(f"{number} {kind}" for kind, number in counts.items() if number) or "none done"
    words += f" ({outcome.found} of them were in the store)" if outcome.found else ""
    words += f", {outcome.pruned} others removed from the store" if outcome.pruned else ""
    for name in outcome.missing:
        cli.warn(f"{name}: no run has this number")
    to_do = outcome.runs - outcome.finished
    left = f", {to_do} to do" if dry_run else ""
    place = [] if dry_run else [outcome.table, f"next: support-exudyn show {outcome.table.parent}"]
    cli.put(json, asdict(outcome) | {"to_do": to_do}, f"{outcome.runs} runs{left}: {words}", *place)
    if dry_run:
        return 0
    if outcome.unmet:
        cli.warn(f"{outcome.unmet} runs are less accurate than asked for; the table's reason names them")
    if outcome.done < outcome.runs:
        cli.warn("some runs have failed; their reasons are in the table")
        return FAILURES
    return 0


def chart(
    store: Store,
    /,
    *names: str,
    by: str | None = None,
    histogram: bool = False,
    tornado: bool = False,
    sliders: bool = False,
    out: Annotated[Path | None, cli.output(*cli.PICTURES, ".html")] = None,
) -> None:
    """Draw, write, and print the names of the files.

    Args:
        names: [X] Y: what was varied, such as pins.rear_base.clearance_mm, and a number of the table, such as
            pin.rear_base.force.mean. A number alone is drawn over what was varied, or as histogram if the runs
            were drawn from distributions; without names the only number that was recorded.
        by: Something else that was varied, a curve for each of its values.
        histogram: Draw how Y is distributed, with percentiles.
        tornado: Draw by how much each varied field moves Y.
        sliders: Write a page with a slider for every input, which shows the numbers of the nearest run; of the
            numbers named, or of all.
        out: Folder of the figure or page (figures in the store), or its file (.png, .pdf, .svg; .html).
    """
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures import sweeps as figures
    from support_exudyn.postprocessing.figures.of_runs import joined, save_figures

    if sliders and (histogram or tornado or by is not None):
        raise InputError("--sliders: allowed: without --by, --histogram, --tornado")
    if histogram + tornado + len(names[:-1]) > 1 and not sliders:
        raise InputError("--histogram, --tornado: allowed: one of them, and a number alone")
    if len(names) > 2 and not sliders:
        raise InputError(f"{' '.join(names)}: allowed: what was varied and a number, or a number alone")
    is_page = out is not None and cli.is_file(out) and out.suffix.lower() == ".html"
    if cli.is_file(out) and is_page != sliders:
        kinds = ".html with --sliders, else " + ", ".join(cli.PICTURES)
        raise InputError(f"--out {out}: allowed: a file that ends in {kinds}; or a folder, without an ending")
    runs, folder = SweepRuns(read_table(store)), store if store.is_dir() else store.parent
    if sliders:
        page = out if out is not None and is_page else (out or folder / "figures") / "sliders.html"
        chosen = _chosen(runs, names) or list(runs.numbers.values())
        cli.say(sweep_sliders.write_sliders(runs, chosen, page, folder.resolve().name))
        return
    if not names and len(runs.numbers) != 1:
        raise InputError(f"Y: which number? allowed: {', '.join(runs.numbers) or 'none was recorded'}")
    *before, y = names or runs.numbers
    with style.look():
        if tornado:
            drawing, name = figures.tornado(runs.table, y), joined(y, "tornado")
        elif histogram or (not before and is_sampled(runs.table)):
            drawing, name = figures.histogram(runs.table, y), joined(y, "histogram")
        elif (x := before[0] if before else runs.usual_input) is None:
            raise InputError(
                f"{y}: over which field? allowed: chart STORE X Y with X one of {', '.join(runs.varied)}; or "
                "--histogram, --tornado"
            )
        else:
            drawing = figures.sweep_chart(runs.table, x, y, by)
            name = joined(y, "over", x, f"by_{by}" if by else "")
        style.named(drawing, folder.resolve().name)
        cli.say(
            "\n".join(map(str, save_figures({name: drawing}, out, folder / "figures", cli.is_file(out))[name]))
        )


def table(
    store: Store,
    /,
    *numbers: str,
    format: Literal["md", "csv", "latex"] = "md",  # noqa: A002, the option's name
    out: Path | None = None,
) -> None:
    """Print the table of the runs, or write it.

    Args:
        numbers: Only these: names or patterns, such as `tip.*.mean` (all).
        format: Markdown (md), CSV with errors, or LaTeX (booktabs).
        out: File for the table (standard output).
    """
    runs = SweepRuns(read_table(store))
    chosen = _chosen(runs, numbers) or list(runs.numbers.values())
    cli.write_or_say(FORMATS[format](runs, chosen), out)


def _chosen(runs: SweepRuns, words: Sequence[str]) -> list[str]:
    """The columns of the numbers that are asked for by names or patterns."""
    return [runs.numbers[name] for name in matching(runs.numbers, words, "number")]


def show_sweep(store: Path, words: Sequence[str], every: bool, json: bool) -> None:
    """Print what varied, how many runs there are, what came out, what it follows, and what to type next."""
    runs = SweepRuns(read_table(store))
    names = runs.numbers
    filled = [column for column in names.values() if runs.number(column).rows.size]
    chosen = _chosen(runs, words) or filled[: len(names) if every or json else MOST]
    if json:
        cli.answer(sweep_summary.data_of(runs, chosen))
        return
    cli.say(f"{sweep_summary.counts(runs)}\n")
    more = len(names) - len(chosen)
    rest = f" ({more} more: --all)" if more > 0 and not words else ""
    for table in sweep_summary.sweep_tables(runs, chosen, rest):
        cli.show_table(*table)
    if chosen:
        folder = store if store.is_dir() else store.parent
        number = next(name for name, column in names.items() if column == chosen[0])
        cli.say(f"next: support-exudyn chart {folder} {number}, or table {folder} --format md")
