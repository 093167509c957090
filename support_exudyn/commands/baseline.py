"""`baseline make|check|update DIR [NAME...]`: the results of scenarios, kept, and what has changed since."""

import argparse
import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from support_exudyn.commands.command_line import add_json, answer, folder, refusing, say, shown_progress, warn
from support_exudyn.postprocessing.comparing.baselines import BaselineFolder, CheckedScenario, lines
from user_forces.values.value import InputError

EPILOG = """
make runs the scenarios of DIR that have no baseline yet and writes DIR/baseline/NAME.json: numbers and thinned
curves with their numerical errors. check runs all again and reports what has changed by more than both
errors, what is new, and what is gone. update reports the same, and writes the scenarios that are named. Exit
codes of all three: 0 nothing changed, 1 something did, or a run cannot be finished, 2 an input is wrong.
"""
CHANGED, WRONG = 1, 2  # exit codes
MAKE, CHECK, UPDATE = "make", "check", "update"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What is done, with which folder, and of update which scenarios."""
    add = parser.add_argument
    parser.epilog = EPILOG
    add("action", choices=(MAKE, CHECK, UPDATE), metavar="ACTION", help=f"{MAKE}, {CHECK} or {UPDATE}")
    add("folder", type=folder, metavar="DIR", help="a folder of scenarios, *.toml")
    add("names", nargs="*", default=[], metavar="NAME", help="of update: scenarios that are written")
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Do it; ends with exit code 1 if something has changed, and 2 if an input is wrong."""
    with refusing(WRONG):
        if given.action != UPDATE and given.names:
            raise InputError(f"{given.action} takes DIR alone; allowed: names with {UPDATE}")
        kept = BaselineFolder(given.folder)
        if given.action == MAKE:
            _make(kept, given)
            return
        found: list[CheckedScenario] = []
        with shown_progress(given.action) as progress:
            found += kept.check(list(dict.fromkeys(given.names)) or kept.names, progress)
    if given.json:
        answer({one.name: _object(one) for one in found})
    else:
        _report(found)
    left = [one for one in found if one.state != "same"]
    if given.action == UPDATE:
        left = _update(kept, left, given)
    if left:
        raise SystemExit(CHANGED)


def _make(kept: BaselineFolder, given: argparse.Namespace) -> None:
    """Write what has no baseline yet; each as soon as it is run."""
    missing = [name for name in kept.scenarios if name not in kept.baselines]
    written: dict[str, Any] = {}
    with shown_progress(MAKE) as progress:
        for one in kept.check(missing, progress):
            written[one.name] = None if one.failed else kept.write(one)
            if one.failed:
                warn(f"{one.name}: not made, its run cannot be finished: {one.failed}")
            elif not given.json:
                say(f"{written[one.name]}: {_kept_of(one)}")
    there = [name for name in kept.scenarios if name in kept.baselines]
    if given.json:
        answer({"made": written, "there": there})
    elif there:
        say(f"left as they are: {', '.join(there)}; `check` compares them, `{UPDATE}` changes them")
    if None in written.values():
        raise SystemExit(CHANGED)


def _kept_of(one: CheckedScenario) -> str:
    assert one.now is not None
    words = f"{len(one.now.numbers)} numbers, {len(one.now.curves)} channels"
    if math.isfinite(one.now.horizon):
        words += f"; determined up to {one.now.horizon:.4g} s, nothing is kept beyond"
    return words


def _report(found: Sequence[CheckedScenario]) -> None:
    """The state of each scenario, and what has changed."""
    for one in found:
        if one.state == "changed":
            say(f"{one.name}: {len(one.changes)} changed by more than both errors, new, or gone")
            for line in lines(one.changes):
                say(f"  {line}")
            if words := _versions(one):
                say(f"  made with {words}")
            continue
        states = {
            "failed": f"its run cannot be finished: {one.failed}",
            "new": "new, it has no baseline",
            "gone": "gone, there is a baseline and no such scenario",
        }
        say(f"{one.name}: {states.get(one.state) or f'nothing changed ({_kept_of(one)})'}")
    counts = Counter(one.state for one in found)
    say(", ".join(f"{number} {state}" for state, number in counts.items()))


def _versions(one: CheckedScenario) -> str:
    """With what else the baseline was made, what was and what is; empty if with the same."""
    if one.was is None or one.now is None:
        return ""
    was, now = one.was.provenance, one.now.provenance
    others = [key for key in was if key != "made_at" and was[key] != now.get(key)]
    return ", ".join(f"{key} {was[key][:40]} (now {now.get(key, 'none')[:40]})" for key in others)


def _update(
    kept: BaselineFolder, changed: Sequence[CheckedScenario], given: argparse.Namespace
) -> list[CheckedScenario]:
    """Write the scenarios that are named; returns those that are left. A run that failed is never written."""
    left = [one for one in changed if one.state == "failed" or one.name not in given.names]
    for one in changed:
        if one not in left:
            with refusing(WRONG):
                path = kept.write(one)
            if not given.json:
                say(f"{path}: {'removed' if one.now is None else 'written'}")
    if left:
        warn(f"{len(left)} not written; to write one, name it: {UPDATE} {given.folder} NAME")
    return left


def _object(one: CheckedScenario) -> dict[str, Any]:
    """A scenario for scripts."""
    changed = [change._asdict() for change in one.changes]
    return {"state": one.state, "failed": one.failed or None, "changes": changed}
