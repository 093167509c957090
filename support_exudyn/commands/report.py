"""`report RUN [RUN...]`: a page on runs, for a browser."""

import argparse
from pathlib import Path

from support_exudyn.commands.command_line import add_json, add_out, answer, folder, say
from support_exudyn.commands.runs import named_runs
from support_exudyn.files.whole_file import whole_file
from support_exudyn.simulation.result import Result

HELP = "a page on runs: what was run, the machine, numbers with errors, live figures, a picture"
FILE = "report.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The runs' files, what is drawn, and where to."""
    parser.add_argument(
        "runs", nargs="+", type=folder, metavar="RUN", help="files of runs, as Result.save writes them"
    )
    parser.add_argument(
        "--channels",
        nargs="+",
        default=(),
        metavar="CHANNEL",
        help="over time: names, or patterns as 'pin.*.force' (clearance pins, their bodies, traced points)",
    )
    add_out(parser, f"folder for {FILE}, or a file .html (RUN_{FILE} beside the first run)")
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Write the page, and print its name."""
    results = {name: Result.load(path) for name, path in named_runs(given.runs).items()}
    from support_exudyn.postprocessing.run_report import run_report

    page = run_report(results, given.channels)
    first: Path = given.runs[0]
    out = given.out or first.with_name(f"{first.stem}_{FILE}")
    path = out if out.suffix == ".html" else out / FILE
    with whole_file(path) as temporary:
        temporary.write_text(page, encoding="utf-8")
    if given.json:
        answer({"report": path})
    else:
        say(str(path))
