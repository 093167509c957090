"""`baseline make|check|update DIR [NAME...]`: the results of scenarios, kept, and what has changed since."""

import math
from collections import Counter
from collections.abc import Mapping
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
        there = [name for name in kept.scenarios if name in kept.baselines]
        missing = [name for name in kept.scenarios if name not in kept.baselines]
        chosen = missing if action == "make" else list(dict.fromkeys(names)) or kept.names
        checked, written = list[CheckedScenario](), dict[str, Path]()
        with shown_progress(action) as progress:
            for one in kept.check(chosen, progress):
                checked.append(one)
                if one.state not in ("same", "failed") and (action == "make" or one.name in names):
                    written[one.name] = kept.write(one)
        left = [one.name for one in checked if one.state != "same" and one.name not in written]
        if json and action == "make":
            answer({"made": {one.name: written.get(one.name) for one in checked}, "there": there})
        elif json:
            answer({one.name: _data(one) for one in checked})
        elif action == "make":
            for name, path in written.items():
                say(f"{path}: {_counts(next(one for one in checked if one.name == name))}")
            if there:
                say(f"left as they are: {', '.join(there)}; `check` compares them, `update` changes them")
        else:
            _report(checked, written)
        if left and action == "make":
            warn("\n".join(f"{one.name}: not made, {_state(one)}" for one in checked if one.failed))
        if left and action == "update":
            warn(f"{len(left)} not written; to write one, name it: update {folder} NAME")
        return CHANGED if left else 0

    return answered(work, WRONG)


def _counts(one: CheckedScenario) -> str:
    """How much is kept of a run, and up to when."""
    assert one.now is not None
    words = f"{len(one.now.numbers)} numbers, {len(one.now.curves)} channels"
    if math.isfinite(one.now.horizon):
        words += f"; determined up to {one.now.horizon:.4g} s, nothing is kept beyond"
    return words


def _state(one: CheckedScenario) -> str:
    """The state of a scenario in words."""
    states = {
        "changed": f"{len(one.changes)} changed by more than both errors, new, or gone",
        "failed": f"its run cannot be finished: {one.failed}",
        "new": "new, it has no baseline",
        "gone": "gone, there is a baseline and no such scenario",
    }
    return states.get(one.state) or f"nothing changed ({_counts(one)})"


def _report(checked: list[CheckedScenario], written: Mapping[str, Path]) -> None:
    """Print the state of each scenario, what has changed, and what was written."""
    for one in checked:
        say(f"{one.name}: {_state(one)}")
        if one.state == "changed":
            others = _other_versions(one)
            for line in (*lines(one.changes), *([f"made with {others}"] if others else [])):
                say(f"  {line}")
        if one.name in written:
            say(f"{written[one.name]}: {'removed' if one.now is None else 'written'}")
    counts = Counter(one.state for one in checked)
    say(", ".join(f"{number} {state}" for state, number in counts.items()))


def _other_versions(one: CheckedScenario) -> str:
    """With what else the baseline was made, what was and what is; empty if with the same."""
    if one.was is None or one.now is None:
        return ""
    was, now = one.was.provenance, one.now.provenance
    others = [key for key in was if key != "made_at" and was[key] != now.get(key)]
    return ", ".join(f"{key} {was[key][:40]} (now {now.get(key, 'none')[:40]})" for key in others)


def _data(one: CheckedScenario) -> dict[str, Any]:
    """A scenario for scripts."""
    changed = [change._asdict() for change in one.changes]
    return {"state": one.state, "failed": one.failed or None, "changes": changed}
