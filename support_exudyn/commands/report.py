"""`report RUN... [CHANNEL...]`: a page on runs, for a browser."""

import argparse

from support_exudyn.commands.command_line import add_json, add_out, answer, say
from support_exudyn.commands.runs import named_runs, runs_and_channels
from support_exudyn.files.whole_file import whole_file
from support_exudyn.simulation.result import Result

FILE = "report.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The runs' files, what is drawn, and where to."""
    parser.add_argument(
        "names",
        nargs="+",
        metavar="RUN|CHANNEL",
        help="files of runs, as Result.save writes them, then channels that are drawn over time: names, or "
        "patterns as 'pin.*.force' (clearance pins, their bodies, traced points)",
    )
    add_out(parser, f"folder for {FILE}, or a file .html (RUN_{FILE} beside the first run)")
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Write the page, and print its name."""
    paths, channels = runs_and_channels(given.names)
    results = {name: Result.load(path) for name, path in named_runs(paths).items()}
    from support_exudyn.postprocessing.run_report import run_report

    page = run_report(results, channels)
    first = paths[0]
    out = given.out or first.with_name(f"{first.stem}_{FILE}")
    path = out if out.suffix == ".html" else out / FILE
    with whole_file(path) as temporary:
        temporary.write_text(page, encoding="utf-8")
    if given.json:
        answer({"report": path})
    else:
        say(str(path))
