"""A study that takes minutes, to be interrupted: the script of test_hostile_studies.py."""

from __future__ import annotations

import sys
from dataclasses import replace

from studies.common.numbers import Number, write_summary
from studies.common.runs import run_cases
from studies.common.study import Options, options, run_main
from support_exudyn import Held
from tests.cases.run_cases import loose_support

LONG = 1000.0  # [s] that the machine is simulated for


def study(chosen: Options) -> None:
    """Write what is finished, then run two scenarios side by side."""
    write_summary(chosen.out, "hostile", [Number("finished", "before", 1.0, "1", 0.0)], 0.0)
    scenario = loose_support(drive=Held(), duration=LONG)
    run_cases({"one": scenario, "other": replace(scenario, gravity=(0.0, -9.0))}, chosen.workers)


if __name__ == "__main__":
    sys.exit(run_main(study, options("hostile", None, "A long study.")))
