"""`python -m studies`: all studies, each into a folder of its own."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies import clearance_influence, contact_laws, slider_crank
from studies.study import Options, add_options, run_main

STUDIES = {
    clearance_influence.STUDY: clearance_influence.study,
    contact_laws.STUDY: contact_laws.study,
    slider_crank.STUDY: slider_crank.study,
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run every study; the exit code is the first that is not zero."""
    parser = argparse.ArgumentParser(prog="python -m studies", description="Run all studies.")
    add_options(parser, Path("results"))
    given = parser.parse_args(argv)
    for name, study in STUDIES.items():
        print(f"study {name}", file=sys.stderr)
        code = run_main(study, Options(given.out / name, given.quick, given.workers))
        if code:
            return code
    return 0


if __name__ == "__main__":
    sys.exit(main())
