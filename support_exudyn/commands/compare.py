"""`compare`: by how much files differ, and whether that is allowed; `baseline`: what has changed since."""

import math
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from support_exudyn.commands import command_line as cli
from support_exudyn.commands.runs import files_and_channels
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from support_exudyn.postprocessing.comparing.baselines import CheckedScenario

DIFFERENT, REFUSED = 1, 2  # exit codes
SHOWN = 12  # changes of a scenario that are printed


def compare(
    reference: str,
    /,
    *others: str,
    map: Path | None = None,  # noqa: A002, the option's name
    shift: bool = False,
    tolerance: str | None = None,
    csv: Annotated[Path | None, cli.output(".csv", folder=False)] = None,
    junit: Path | None = None,
    figure: Annotated[Path | None, cli.output(*cli.PICTURES, folder=False)] = None,
    page: Annotated[Path | None, cli.output(".html", folder=False)] = None,
    after: cli.After = -math.inf,
    until: cli.Until = math.inf,
    rate: cli.Rate | None = None,
    json: cli.Json = False,
) -> int:
    """Print by how much files differ from the first, and the verdict, which the exit code gives.

    Any file that can be read will do: runs, CSV and text tables, results of ADAMS, Exudyn's sensor and solution
    files, MATLAB, Parquet. Columns are channels by their names, or by --map.

    Args:
        reference: File that the others are compared with.
        others: Files, then channels: names or patterns, such as `tip.*` (forces and traced points of runs, and
            all that other files have in common).
        map: compare.toml: which column is which channel, tolerances.
        shift: Determine by how much each file lags behind the reference, and take it off.
        tolerance: What is allowed: shares of the reference's range or amounts, `pin.*.force=2%,tip.*=0.1mm`.
        csv: The table as CSV, in SI: a row for each measure of each channel.
        junit: JUnit XML for test servers: a test case for each channel.
        figure: Figure, .png, .pdf or .svg: curves, differences, what is allowed.
        page: Page for a browser with all of it.
        rate: Rows per second [Hz] of files without times.
    """

    def work() -> int:
        from support_exudyn.postprocessing.comparing import compare_page, tables
        from support_exudyn.postprocessing.comparing.files_compared import compare_files

        files, channels = files_and_channels([reference, *others])
        for file in files:
            if file.suffix.lower() == ".toml":
                raise InputError(f"{file}: is no file that is compared; allowed: --map {file}")
        if len(files) == 1:
            rest = f"; {channels[0]} is no file that is there, so it is taken for a channel" if channels else ""
            raise InputError(
                f"{files[0]}: is the only file{rest}; allowed: two files or more, the first is the reference"
            )
        with cli.shown_progress("reading") as progress:
            compared = compare_files(
                *files, channels=channels, mapping=map, tolerance=tolerance or (), after=after, until=until,
                find_shift=shift, rate=rate, progress=progress,
            )  # fmt: skip
        writers = {
            csv: tables.write_csv,
            junit: tables.write_junit,
            figure: compare_page.write_figure,
            page: compare_page.write_page,
        }
        written = [path for path in writers if path is not None]
        for path in written:
            writers[path](compared, path)
        if json:
            cli.answer(tables.as_data(compared) | {"written": written})
            return DIFFERENT if compared.failed else 0
        for pair in compared.pairs:
            sheet = tables.table(pair)
            header = [head if n < sheet.left else f">{head}" for n, head in enumerate(sheet.header)]
            cli.show_table(sheet.title, header, sheet.rows)
            for line in (*tables.notes(pair), *pair.faults):
                cli.say(line)
        cli.say("\n".join([tables.conclusion(compared), *(str(path) for path in written)]))
        return DIFFERENT if compared.failed else 0

    return cli.answered(work, REFUSED)


def baseline(
    action: Literal["make", "check", "update"], folder: Path, /, *names: str, json: cli.Json = False
) -> int:
    """Make, check or update the baselines of scenarios.

    make runs the scenarios of FOLDER that have no baseline yet and writes FOLDER/baseline/NAME.json: numbers
    and thinned curves with their numerical errors. check runs all again and reports what has changed by more
    than both errors, what is new, and what is gone. update reports the same, and writes the scenarios that are
    named. Exit codes: 0 nothing changed, 1 something did, or a run cannot be finished, 2 an input is wrong.

    Args:
        action: make, check or update.
        folder: Of scenarios, `*.toml`.
        names: Of update: scenarios that are written.
    """

    def work() -> int:
        from support_exudyn.postprocessing.comparing.baselines import BaselineFolder

        if action != "update" and names:
            raise InputError(f"{action} takes FOLDER alone; allowed: names with update")
        kept = BaselineFolder(folder)
        there = [name for name in kept.scenarios if name in kept.baselines]
        missing = [name for name in kept.scenarios if name not in kept.baselines]
        chosen = missing if action == "make" else list(dict.fromkeys(names)) or kept.names
        checked: list[CheckedScenario] = []
        written: dict[str, Path] = {}
        with cli.shown_progress(action) as progress:
            for each in kept.check(chosen, progress):
                checked.append(each)
                if each.state not in ("same", "failed") and (action == "make" or each.name in names):
                    written[each.name] = kept.write(each)
        left = [each for each in checked if each.state != "same" and each.name not in written]
        if json and action == "make":
            cli.answer({"made": {each.name: written.get(each.name) for each in checked}, "there": there})
        elif json:
            cli.answer({
                each.name: {
                    "state": each.state,
                    "failed": each.failed or None,
                    "changes": [change._asdict() for change in each.changes],
                }
                for each in checked
            })  # fmt: skip
        else:
            for each in checked:
                if action != "make":
                    cli.say("\n  ".join(_report(each)))
                if each.name in written:
                    cli.say(f"{written[each.name]}: {_counts(each)}")
            if action != "make":
                counts = Counter(each.state for each in checked)
                cli.say(", ".join(f"{number} {state}" for state, number in counts.items()))
            elif there:
                cli.say(f"left as they are: {', '.join(there)}; `check` compares them, `update` changes them")
        if left and action == "make":
            cli.warn("\n".join(f"{each.name}: not made, {_state(each)}" for each in left))
        if left and action == "update":
            cli.warn(f"{len(left)} not written; to write one, name it: update {folder} NAME")
        return DIFFERENT if left else 0

    return cli.answered(work, REFUSED)


def _counts(checked: "CheckedScenario") -> str:
    """How much is kept of a run, and up to when; nothing of a scenario that is gone."""
    if checked.now is None:
        return "removed"
    words = f"{len(checked.now.numbers)} numbers, {len(checked.now.curves)} channels"
    if math.isfinite(checked.now.horizon):
        words += f"; determined up to {checked.now.horizon:.4g} s, nothing is kept beyond"
    return words


def _state(checked: "CheckedScenario") -> str:
    """The state of a scenario in words."""
    states = {
        "changed": f"{len(checked.changes)} changed by more than both errors, new, or gone",
        "failed": f"its run cannot be finished: {checked.failed}",
        "new": "new, it has no baseline",
        "gone": "gone, there is a baseline and no such scenario",
    }
    return states.get(checked.state) or f"nothing changed ({_counts(checked)})"


def _report(checked: "CheckedScenario") -> list[str]:
    """Lines on the state of a scenario, what has changed, and with what else its baseline was made."""
    from support_exudyn.postprocessing.comparing.baselines import lines

    report = [f"{checked.name}: {_state(checked)}", *lines(checked.changes, SHOWN)]
    if checked.changes and checked.was is not None and checked.now is not None:
        was, now = checked.was.provenance, checked.now.provenance
        others = [key for key in was if key != "made_at" and was[key] != now.get(key)]
        words = ", ".join(f"{key} {was[key][:40]} (now {now.get(key, 'none')[:40]})" for key in others)
        report += [f"made with {words}"] if words else []
    return report
