"""`baseline make|check|update DIR [NAME...]`: what scenarios came out at, kept, and what has changed since."""

import argparse
import math
import sys
from collections import Counter
from collections.abc import Sequence
from typing import Any

from support_exudyn.commands.command_line import add_json, answer, folder, refusing, say, shown_progress, warn
from support_exudyn.commands.tables import printed, show_table
from support_exudyn.postprocessing.comparing.baselines import BaselineFolder, Looked
from support_exudyn.postprocessing.comparing.changes import HEADER, rows
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

EPILOG = """
make runs the scenarios of DIR that have no baseline yet and writes DIR/baseline/NAME.json: numbers, impacts and
thinned curves with their numerical errors. check runs all again and tells what has changed by more than both
errors, what is new, and what is gone. update shows the same, and writes those that are named; without a name it
asks for each. Exit codes of all three: 0 nothing changed, 1 something did, or a run cannot be finished, 2 an
input is wrong.
"""
CHANGED, WRONG = 1, 2  # exit codes
MAKE, CHECK, UPDATE = "make", "check", "update"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What is done, with which folder, and of update which scenarios."""
    add = parser.add_argument
    parser.epilog = EPILOG
    add("action", choices=(MAKE, CHECK, UPDATE), metavar="ACTION", help=f"{MAKE}, {CHECK} or {UPDATE}")
    add("folder", type=folder, metavar="DIR", help="a folder of scenarios, *.toml")
    add(
        "names",
        nargs="*",
        default=[],
        metavar="NAME",
        help="of update: scenarios that are written, no question asked",
    )
    add("--reason", default="", metavar="TEXT", help="of update: why, kept in the files that are written")
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Do it; ends with exit code 1 if something has changed, and 2 if an input is wrong."""
    with refusing(WRONG):
        if given.action != UPDATE and (given.names or given.reason):
            raise InputError(f"{given.action} takes DIR alone; allowed: names and a reason with {UPDATE}")
        kept = BaselineFolder(given.folder)
        kept.check_names(given.names)
        if given.action == MAKE:
            _make(kept, given)
            return
        names = list(dict.fromkeys(given.names)) or kept.names
        found: list[Looked] = []
        with shown_progress(given.action) as progress:
            found += kept.looked_at(names, progress)
    if given.json:
        answer({one.name: _object(one) for one in found})
    else:
        _tell(found)
    if given.action == CHECK:
        if any(one.state != "same" for one in found):
            raise SystemExit(CHANGED)
        return
    _update(kept, found, given)


def _make(kept: BaselineFolder, given: argparse.Namespace) -> None:
    """Write what has no baseline yet; each as soon as it is run."""
    missing = [name for name in kept.scenarios if name not in kept.baselines]
    failed = 0
    written: dict[str, Any] = {}
    with shown_progress(MAKE) as progress:
        for one in kept.looked_at(missing, progress):
            failed += bool(one.failed)
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
    if failed:
        raise SystemExit(CHANGED)


def _kept_of(one: Looked) -> str:
    assert one.now is not None
    impacts = sum(map(len, one.now.impacts.values()))
    said = f"{len(one.now.numbers)} numbers, {len(one.now.curves)} channels, {impacts} impacts"
    if math.isfinite(one.now.horizon):
        said += f"; determined up to {one.now.horizon:.4g} s, nothing is kept beyond"
    return said


def _tell(found: Sequence[Looked]) -> None:
    """What has become of each scenario, and a table of what has changed."""
    for one in found:
        if one.state == "same":
            say(f"{one.name}: nothing changed ({_kept_of(one)})")
        elif one.state == "failed":
            say(f"{one.name}: its run cannot be finished: {one.failed}")
        elif one.state == "new":
            say(f"{one.name}: new, it has no baseline")
        elif one.state == "gone":
            say(f"{one.name}: gone, there is a baseline and no such scenario")
        else:
            _show_changes(one)
            if said := _versions(one):
                say(f"made with {said}\n")
    counts = Counter(one.state for one in found)
    say(", ".join(f"{number} {state}" for state, number in counts.items()))


def _show_changes(one: Looked) -> None:
    title = f"{one.name}: {len(one.changes)} changed by more than both errors, new, or gone"
    printed(lambda console: show_table(console, title, HEADER, rows(one.changes)))


def _versions(one: Looked) -> str:
    """With what else the baseline was made, what was and what is; empty if with the same."""
    if one.was is None or one.now is None:
        return ""
    was, now = one.was.provenance, one.now.provenance
    others = [key for key in was if key != "made_at" and was[key] != now.get(key)]
    return ", ".join(f"{key} {was[key][:40]} (now {now.get(key, 'none')[:40]})" for key in others)


def _update(kept: BaselineFolder, found: Sequence[Looked], given: argparse.Namespace) -> None:
    """Write what is named or confirmed; a run that failed is never written."""
    left = 0
    for one in found:
        if one.state == "same":
            continue
        if one.state == "failed" or not (one.name in given.names or _is_confirmed(one, given)):
            left += 1
            continue
        with refusing(WRONG):
            path = kept.write(one, given.reason)
        if not given.json:
            say(f"{path}: {'removed' if one.now is None else 'written'}")
    if left:
        warn(f"{left} not written; to write one, name it: {UPDATE} {given.folder} NAME")
        raise SystemExit(CHANGED)


def _is_confirmed(one: Looked, given: argparse.Namespace) -> bool:
    """Whether the user says so; nobody is asked where nobody can answer."""
    if given.json or given.names or not (sys.stdin and sys.stdin.isatty()):
        return False
    try:
        return input(f"{one.name}: {one.state}; write it? [y/N] ").strip().lower() in ("y", "yes")
    except EOFError:
        return False


def _object(one: Looked) -> dict[str, Any]:
    """A scenario for scripts."""

    def number(item: Estimate | None) -> dict[str, Any] | None:
        return None if item is None else item._asdict()

    changed = [
        change._asdict() | {"was": number(change.was), "now": number(change.now)} for change in one.changes
    ]
    return {"state": one.state, "failed": one.failed or None, "changes": changed}
