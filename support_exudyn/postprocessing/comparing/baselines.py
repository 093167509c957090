"""Baselines: kept numbers and curves of runs, compared with their errors as tolerance; a folder of them.

The file is JSON with a line for each number and curve, so that its versions can be compared. A number
is a text of its value, its error and its unit; a curve is a text of its values.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.files.scenarios.scenario_file import OTHER_FILES, ScenarioFile, read_scenario_file
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import contents, missing_file, whole_file, writing_alone
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn, compared
from support_exudyn.postprocessing.comparing.compared_file import recorded_columns
from support_exudyn.postprocessing.comparing.mapping import BOTH_ERRORS
from support_exudyn.scene.contract import Progress, SimulationError
from support_exudyn.simulation.estimate import Estimate, horizon
from support_exudyn.simulation.provenance import provenance
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import own_sources, program
from user_forces.values.value import InputError, cleaned, short

FOLDER, ENDING = "baseline", ".json"  # of baselines next to scenarios and tests
RECORDS = 100  # of every curve that are kept
FORMAT = "support_exudyn baseline 2"
MOST = 100_000_000  # bytes
DIGITS, OF_ERRORS = 13, 3  # of values and errors that are written; errors count rounding from 1e-10 on
DAMAGES = (LookupError, AttributeError, TypeError, ValueError, RecursionError, OverflowError)


@dataclass(frozen=True)
class KeptRun:
    """What is kept of a run, so that a change can be recognised later.

    numbers: by name. provenance: versions, platform, time, digests of sources. scenario: of the run, as plain
    data; empty where it is not compared. curves: thinned, by channel, in SI. horizon: up to when curves are
    determined [s], see `determined_until`.
    """

    numbers: Mapping[str, Estimate]
    provenance: Mapping[str, str]
    scenario: Mapping[str, Any] = field(default_factory=dict)
    curves: Mapping[str, ComparedColumn] = field(default_factory=dict)
    horizon: float = math.inf


def kept_run(item: Result | Mapping[str, Estimate]) -> KeptRun:
    """What is kept of a run, or of numbers of one's own by their names.

    Beyond the horizon impacts depend on the steps, and so does any number of the whole run: of a run with a
    horizon no numbers are kept.

    Raises InputError if a result has nothing to estimate errors by.
    """
    made = {**provenance(), "sources": program()["sources"]}
    if not isinstance(item, Result):
        return KeptRun(numbers=dict(item), provenance=made)
    if item.coarser is None:
        raise InputError(
            "the run has no numerical errors, so that no change can be recognised; allowed: a run with an "
            "accuracy, or made with errors=True"
        )
    end = determined_until(item)
    rows = np.unique(np.linspace(0, item.time.size - 1, RECORDS).round().astype(np.intp))
    names = [name for name, channel in item.channels.items() if name != "time" and channel.is_determined]
    own = {f"module {name}": digest for name, digest in own_sources(item.scenario.plain).items()}
    return KeptRun(
        numbers=item.numbers() if math.isinf(end) else {},
        provenance={**item.provenance, "sources": made["sources"], **own},
        curves={
            name: ComparedColumn(column.unit, *(each[rows] for each in column[1:]))
            for name, column in recorded_columns(item, names).items()
        },
        horizon=end,
    )


def determined_until(result: Result) -> float:
    """Until when a run is determined [s]: the earlier horizon of it and of the next coarser run."""
    runs = [run for run in (result, result.coarser) if run is not None and run.coarser is not None]
    return min(map(horizon, runs), default=math.inf)


# --- what has changed ---


class RunChange(NamedTuple):
    """A difference between a run and its baseline.

    kind: "changed", "new", or "gone". what: "number", "channel", "key" of the scenario. name: of it. values:
    what it was and is, in words. ratio: the difference over both errors; infinite if nothing measures it.
    """

    kind: str
    what: str
    name: str
    values: str = ""
    ratio: float = math.inf

    def __str__(self) -> str:
        """The change in a sentence."""
        return f"{self.kind} {self.what} {self.name}{': ' * bool(self.values)}{self.values}"


def changes(old: KeptRun, new: KeptRun) -> list[RunChange]:
    """All that has changed by more than the errors of both runs, is new, or gone, the worst first.

    Keys of the scenario stand first, for they explain the rest. What is not determined is not compared: numbers
    of which an error is not known or that one of the runs has no more because of its horizon, and curves beyond
    the horizon of either run.
    """
    end = min(old.horizon, new.horizon)
    columns = [dict(run.curves) for run in (old, new)]
    if math.isinf(old.horizon) == math.isinf(new.horizon):
        for own, run in zip(columns, (old, new), strict=True):
            own |= {name: ComparedColumn.of_number(each, each.unit) for name, each in run.numbers.items()}
    was, now = columns
    found = []
    for name in dict.fromkeys([*was, *now]):
        what = "channel" if (was | now)[name].time.size else "number"
        if name not in was or name not in now:
            found.append(RunChange("gone" if name in was else "new", what, name))
        elif was[name].unit != now[name].unit:
            values = f"in {was[name].unit} -> in {now[name].unit}"
            found.append(RunChange("changed", what, name, values))
        elif not (was[name].time.size and was[name].time[0] > end):
            channel = compared(name, was[name], now[name], BOTH_ERRORS, until=end)
            if channel.gaps or channel.verdict == "differs":
                ratio = math.inf if channel.gaps else channel.over_errors
                reason = channel.faults[0].removeprefix(f"{name}: ")
                found.append(RunChange("changed", what, name, reason, ratio))
    found.sort(key=lambda change: (-change.ratio, change.name))
    return [*_changed_keys(dict(_leaves(old.scenario)), dict(_leaves(new.scenario))), *found]


def _changed_keys(was: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[RunChange]:
    for name in sorted({*was, *now}):
        if name in was and name in now and was[name] == now[name]:
            continue
        kind = "gone" if name not in now else "new" if name not in was else "changed"
        yield RunChange(
            kind, "key", name, " -> ".join(short(side[name]) for side in (was, now) if name in side)
        )


def _leaves(data: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """The items of nested data by their places in it, such as pins.B.friction or gravity[1]."""
    if isinstance(data, Mapping) and data:
        for key, item in data.items():
            yield from _leaves(item, f"{place}.{key}" if place else str(key))
    elif isinstance(data, (list, tuple)) and data:
        for n, item in enumerate(data):
            yield from _leaves(item, f"{place}[{n}]")
    else:
        yield place, data


def lines(changes: Sequence[RunChange], most: int) -> list[str]:
    """The first changes as sentences, and how many more there are."""
    more = [f"and {len(changes) - most} more"] if len(changes) > most else []
    return [*map(str, changes[:most]), *more]


# --- the file ---


def write_baseline(kept: KeptRun, path: Path) -> None:
    """Write a baseline whole or not at all. Raises OSError that names the file if it cannot be written."""
    data = {
        "format": FORMAT,
        "provenance": dict(kept.provenance),
        "horizon_s": kept.horizon if math.isfinite(kept.horizon) else None,
        "numbers": {
            name: f"{float(number.value)!r} {_text([number.error], OF_ERRORS)} {number.unit}"
            for name, number in kept.numbers.items()
        },
        "time_s": _text(next((curve.time for curve in kept.curves.values()), []), DIGITS),
        "curves": {
            name: {
                "unit": curve.unit,
                "values": _text(curve.values, DIGITS),
                "errors": _text(curve.errors, OF_ERRORS),
            }
            for name, curve in kept.curves.items()
        },
        "scenario": kept.scenario,
    }
    text = json.dumps(data, indent=1, allow_nan=False)
    with whole_file(path) as temporary:
        temporary.write_text(f"{text}\n", encoding="utf-8", newline="\n")


def _text(values: Iterable[float], digits: int) -> str:
    """Numbers in a text; those that are not known, or without end, as nan."""
    return " ".join(f"{value:.{digits}g}" if math.isfinite(value) else "nan" for value in values)


def _numbers(text: str, unknown: float = math.nan) -> Series:
    """The numbers of a text; unknown: what stands for nan, infinite of errors."""
    numbers = np.array(text.split(), dtype=np.float64)
    return np.where(np.isnan(numbers), unknown, numbers)


def read_baseline(path: Path) -> KeptRun:
    """Read what `write_baseline` wrote.

    Raises InputError if the file is no baseline or damaged; OSError if it cannot be read.
    """
    if not path.exists():
        raise missing_file(path, "the file of a baseline")
    try:
        data = json.loads(contents(path, MOST))
        if data["format"] != FORMAT:
            raise ValueError(f"it does not begin with {FORMAT!r}")
        time = _numbers(data["time_s"])
        curves = {
            name: ComparedColumn(
                each["unit"], time, _numbers(each["values"]), _numbers(each["errors"], math.inf)
            )
            for name, each in data["curves"].items()
        }
        if any(not time.size == each.values.size == each.errors.size for each in curves.values()):
            raise ValueError("a curve has more or fewer values than there are times")
        numbers = {}
        for name, text in data["numbers"].items():
            value, error, unit = text.split(" ", 2)
            numbers[name] = Estimate(float(value), float(_numbers(error, math.inf)[0]), unit)
        end = math.inf if data["horizon_s"] is None else data["horizon_s"]
        return KeptRun(numbers, data["provenance"], data["scenario"], curves, end)
    except DAMAGES as error:
        why = cleaned(" ".join(str(error).split()))[:200]
        raise InputError(
            f"{path}: is no baseline, or damaged ({why}); allowed: a file that `baseline make` wrote; take it "
            "from version control, or remove it and make it again"
        ) from None


# --- the scenarios of a folder ---


class CheckedScenario(NamedTuple):
    """A scenario against its baseline.

    name: of the scenario's file. was: its baseline; None: it has none. now: the results of its run; None: there
    is no such scenario, or its run cannot be finished. changes: between both. failed: why it was not finished.
    """

    name: str
    was: KeptRun | None
    now: KeptRun | None = None
    changes: Sequence[RunChange] = ()
    failed: str = ""

    @property
    def state(self) -> str:
        """What became of it, in a word: same, changed, new, gone, or failed."""
        if self.failed:
            return "failed"
        if self.was is None or self.now is None:
            return "new" if self.was is None else "gone"
        return "changed" if self.changes else "same"


class BaselineFolder:
    """A folder of scenarios, `*.toml`, whose baselines are in the folder `baseline` in it, `NAME.json`.

    Files of machines, sweeps, instruments and comparisons, which may lie there as well, are not run.

    Raises InputError if it is no folder, if there is no scenario and no baseline in it, or if a scenario cannot
    be read: all of them are read before any runs.
    """

    def __init__(self, path: Path) -> None:
        if not path.is_dir():
            raise InputError(f"{path}: is no folder; allowed: one with scenarios, *.toml")
        self.path = path
        self.scenarios: dict[str, ScenarioFile] = {}
        for file in sorted(path.glob("*.toml")):
            table = load_toml(file)
            if "machine" in table or table.keys().isdisjoint(OTHER_FILES):  # what is unknown is refused
                self.scenarios[file.stem] = read_scenario_file(file)
        files = sorted((path / FOLDER).glob(f"*{ENDING}"))
        self.baselines = {file.stem: file for file in files if file.is_file()}
        self.names = sorted({*self.scenarios, *self.baselines})  # of scenarios, and of baselines without one
        if not self.names:
            raise InputError(f"{path}: has no scenario; allowed: a folder with scenarios, *.toml")

    def check(self, names: Sequence[str], progress: Progress) -> Iterator[CheckedScenario]:
        """Run scenarios of these names, each after the other, and compare each with its baseline.

        All baselines are read before the first run. Raises InputError if a baseline cannot be, or if a name is
        of no scenario and no baseline.
        """
        for name in names:
            if name not in self.names:
                raise InputError(f"{name}: no such scenario in {self.path}; allowed: {', '.join(self.names)}")
        kept = {name: read_baseline(self.baselines[name]) for name in names if name in self.baselines}

        def share_done(n: int, share: float) -> None:
            progress((n + share) / len(names))

        for n, name in enumerate(names):
            was = kept.get(name)
            if name not in self.scenarios:
                yield CheckedScenario(name, was)
                continue
            file = self.scenarios[name]
            errors = file.errors or file.scenario.accuracy is None
            try:
                run = simulate(file.scenario, errors=errors, progress=partial(share_done, n))
            except SimulationError as error:
                yield CheckedScenario(name, was, failed=" ".join(str(error).split()))
                continue
            now = replace(kept_run(run), scenario=file.scenario.plain)
            yield CheckedScenario(name, was, now, changes(was, now) if was is not None else ())

    def write(self, checked: CheckedScenario) -> Path:
        """Write the results of a scenario; of a scenario that is gone remove them.

        Raises OSError if the file cannot be written, or if another process writes to the folder.
        """
        folder = self.path / FOLDER
        path = folder / f"{checked.name}{ENDING}"
        folder.mkdir(exist_ok=True)
        with writing_alone(folder):
            if checked.now is None:
                path.unlink(missing_ok=True)
            else:
                write_baseline(checked.now, path)
        return path
