"""Studies as tests run them: as users do, and in a rough form that costs a seventh of it.

The rough form does all that the whole one does, but runs each case once where that has it at half and at a
quarter of its steps, too: the three are then the same run. Findings are there; of the errors one sees only that
there are some. Tests of a study of the paper are made on the rough form by default, on both with the marker
`slow`; those of drive_mode, which_pin, contact_laws and scene_detail on the whole form only, with the marker.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock

from studies.catalogue import STUDIES
from studies.common import runs
from studies.common.options import Options
from studies.common.subject import Subject
from studies.scene_detail import scenes
from support_exudyn import CubicStep, Result, Scenario
from support_exudyn.postprocessing.figures import style
from tests.at_once import at_once

Numbers = dict[tuple[str, str], dict[str, Any]]  # of summary.json, by name and case
ROUGH, WHOLE = "rough", "whole"
FORMS = [ROUGH, pytest.param(WHOLE, marks=pytest.mark.slow)]
ONLY_WHOLE = FORMS[1:]
ROUGH_ACCURACY = "standard"  # of runs to an accuracy
COARSER = {"drive_mode": 4.0, "contact_laws": 2.0}  # times as long rough steps and records
SHORT = {  # strokes of scene_detail, in which pins still bounce
    "IN_STEP": CubicStep(stroke=0.0003, start=0.01, end=0.058), "DURATION": 0.06, "STEP": 2e-3,
    "BESIDE": CubicStep(stroke=0.0028, start=0.01, end=0.16), "STEP_BESIDE": 1e-2,
}  # fmt: skip

_run_cases = runs.run_cases


def _once(cases: Mapping[str, Scenario], chosen: Options, coarser: float) -> dict[str, Result]:
    first = {name.partition(", steps / ")[0]: case for name, case in cases.items()}  # the coarsest come last
    for name, case in first.items():
        if case.accuracy is not None:
            first[name] = replace(case, accuracy=ROUGH_ACCURACY)
        elif coarser != 1.0 and case.duration > 0.1:  # no single impact
            first[name] = replace(case, step=coarser * case.step, record_period=coarser * case.record_period)
    found = _run_cases(first, chosen)
    return {name: found[name.partition(", steps / ")[0]] for name in cases}


def written(
    study: str,
    form: str,
    folder: Path,
    machines: int | None = None,
    subject: Subject | None = None,
    kept: Path | None = None,
) -> Path:
    """The folder into which a study has written its results, in one of the forms."""
    with pytest.MonkeyPatch.context() as patch:
        for name, value in SHORT.items():
            patch.setattr(scenes, name, value)
        if form == ROUGH:
            patch.setattr(runs, "run_cases", partial(_once, coarser=COARSER.get(study, 1.0)))
            patch.setitem(style.STYLE, "savefig.dpi", 60)
        chosen = Options(folder, at_once(), kept, machines=machines)
        STUDIES[study](replace(chosen, subject=subject) if subject else chosen).write()
    return folder


def results(study: str, form: str, folders: pytest.TempPathFactory) -> Path:
    """The folder of a study of the paper in a form, written once in a session by whichever worker comes first.

    Studies share the runs that they have in common, as those of one command do.
    """
    root = folders.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        root = root.parent  # of all workers
    out = root / "studies" / f"{study}-{form}"
    out.mkdir(parents=True, exist_ok=True)
    with FileLock(out.with_suffix(".lock")):
        if not (out / "summary.json").exists():
            written(study, form, out, kept=out.with_name("kept"))
    return out


def numbers_of(out: Path) -> Numbers:
    """All numbers that a study has written."""
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    return {(number["name"], number["case"]): number for number in summary["numbers"]}
