"""`python -m studies`: all studies, each into a folder of its own, and the report on them."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies.catalogue import STUDIES
from studies.common.study import Options, add_options, output_folder, run_main
from studies.report import rebuild
from support_exudyn.commands.command_line import Parser, answered
from support_exudyn.sweeps.workers import worker_pool


def main(argv: Sequence[str] | None = None) -> int:
    """Run every study and write the report; the exit code is the first that is not zero."""
    parser = Parser(prog="python -m studies", description="Run all studies and write the report.")
    add_options(parser, Path("results"))
    given = parser.parse_args(argv)
    codes: list[int] = []

    def work() -> None:
        with output_folder(given.out):
            codes.append(_studies(given))
            if not codes[0]:
                codes[0] = rebuild(given.out, list(STUDIES), given.quick)

    return answered(work) or codes[0]


def _studies(given: argparse.Namespace) -> int:
    """Run them one after the other; the first exit code that is not zero."""
    try:
        with worker_pool(given.workers) as pool:
            for name, study in STUDIES.items():
                print(f"study {name}", file=sys.stderr)
                code = run_main(study, Options(given.out / name, given.quick, pool, given.machines))
                if code:
                    sys.exit(code)  # an exception, so that no process works on
    except SystemExit as stop:
        return int(str(stop.code))
    return 0


if __name__ == "__main__":
    sys.exit(main())
