"""`baseline make|check|update DIR [NAME...]`: the results of scenarios, kept, and what has changed since."""

import math
from collections import Counter
from pathlib import Path
from typing import Any, Literal

from support_exudyn.commands.command_line import Json, answer, answered, say, shown_progress, warn
from support_exudyn.postprocessing.comparing.baselines import BaselineFolder, CheckedScenario, lines
from user_forces.values.value import InputError

CHANGED, WRONG = 1, 2  # exit codes


def baseline(
    action: Literal["make", "check", "update"], folder: Path, /, *names: str, json: Json = False
) -> int:
    """Make, check or update the baselines of scenarios.

    make runs the scenarios of FOLDER that have no baseline yet and writes FOLDER/baseline/NAME.json: numbers
    and thinned curves with their numerical errors. check runs all again and reports what has changed by more
    than both errors, what is new, and what is gone. update reports the same, and writes the scenarios that are
    named. Exit
    codes: 0 nothing changed, 1 something did, or a run cannot be finished, 2 an input is wrong.

    Args:
        action: make, check or update.
        folder: Of scenarios, `*.toml`.
        names: Of update: scenarios that are written.
    """

    def work() -> int:
        if action != "update" and names:
            raise InputError(f"{action} takes FOLDER alone; allowed: names with update")
        kept = BaselineFolder(folder)
        if action == "make":
            return _make(kept, json)
        with shown_progress(action) as progress:
            checked = list(kept.check(list(dict.fromkeys(names)) or kept.names, progress))
        if json:
            answer({one.name: _data(one) for one in checked})
        else:
            _report(checked)
        left = [one for one in checked if one.state != "same"]
        if action == "update":
            left = _update(kept, left, names, json)
            if left:
                warn(f"{len(left)} not written; to write one, name it: update {folder} NAME")
        return CHANGED if left else 0

    return answered(work, WRONG)


def _make(kept: BaselineFolder, json: bool) -> int:
    """Write what has no baseline yet, each as soon as it is run; returns the exit code."""
    missing = [name for name in kept.scenarios if name not in kept.baselines]
    written: dict[str, Any] = {}
    with shown_progress("make") as progress:
        for one in kept.check(missing, progress):
            written[one.name] = None if one.failed else kept.write(one)
            if one.failed:
                warn(f"{one.name}: not made, its run cannot be finished: {one.failed}")
            elif not json:
                say(f"{written[one.name]}: {_counts(one)}")
    there = [name for name in kept.scenarios if name in kept.baselines]
    if json:
        answer({"made": written, "there": there})
    elif there:
        say(f"left as they are: {', '.join(there)}; `check` compares them, `update` changes them")
    return CHANGED if None in written.values() else 0


def _counts(one: CheckedScenario) -> str:
    assert one.now is not None
    words = f"{len(one.now.numbers)} numbers, {len(one.now.curves)} channels"
    if math.isfinite(one.now.horizon):
        words += f"; determined up to {one.now.horizon:.4g} s, nothing is kept beyond"
    return words


def _report(checked: list[CheckedScenario]) -> None:
    """Print the state of each scenario, and what has changed."""
    for one in checked:
        states = {
            "changed": f"{len(one.changes)} changed by more than both errors, new, or gone",
            "failed": f"its run cannot be finished: {one.failed}",
            "new": "new, it has no baseline",
            "gone": "gone, there is a baseline and no such scenario",
        }
        say(f"{one.name}: {states.get(one.state) or f'nothing changed ({_counts(one)})'}")
        if one.state == "changed":
            others = _other_versions(one)
            for line in (*lines(one.changes), *([f"made with {others}"] if others else [])):
                say(f"  {line}")
    counts = Counter(one.state for one in checked)
    say(", ".join(f"{number} {state}" for state, number in counts.items()))


def _other_versions(one: CheckedScenario) -> str:
    """With what else the baseline was made, what was and what is; empty if with the same."""
    if one.was is None or one.now is None:
        return ""
    was, now = one.was.provenance, one.now.provenance
    others = [key for key in was if key != "made_at" and was[key] != now.get(key)]
    return ", ".join(f"{key} {was[key][:40]} (now {now.get(key, 'none')[:40]})" for key in others)


def _update(
    kept: BaselineFolder, changed: list[CheckedScenario], names: tuple[str, ...], json: bool
) -> list[CheckedScenario]:
    """Write the scenarios that are named; returns those that are left. A run that failed is never written."""
    chosen = [one for one in changed if one.state != "failed" and one.name in names]
    for one in chosen:
        path = kept.write(one)
        if not json:
            say(f"{path}: {'removed' if one.now is None else 'written'}")
    return [one for one in changed if one not in chosen]


def _data(one: CheckedScenario) -> dict[str, Any]:
    """A scenario for scripts."""
    changed = [change._asdict() for change in one.changes]
    return {"state": one.state, "failed": one.failed or None, "changes": changed}
