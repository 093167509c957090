"""A study that takes minutes, to be interrupted: the script of test_hostile_studies.py."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from studies.common.numbers import Number, write_summary
from studies.common.options import Options, add_options, read_options
from studies.common.runs import run_cases
from studies.common.study import work_in_folder
from support_exudyn import Held
from support_exudyn.commands.command_line import Parser
from tests.cases.run_cases import loose_support

LONG = 1000.0  # [s] that the machine is simulated for


def study(chosen: Options) -> None:
    """Write what is finished, then run two scenarios side by side."""
    write_summary(chosen.out, "hostile", [Number("finished", "before", 1.0, "1", 0.0)], 0.0)
    scenario = loose_support(drive=Held(), duration=LONG)
    run_cases({"one": scenario, "other": replace(scenario, gravity=(0.0, -9.0))}, chosen)


if __name__ == "__main__":
    parser = Parser(description="A long study.")
    add_options(parser, Path("results"))
    chosen = replace(read_options(parser.parse_args()), kept=None)
    sys.exit(work_in_folder(lambda out: study(chosen), chosen.out))
