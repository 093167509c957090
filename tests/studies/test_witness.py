"""Numbers of the paper's studies on Exudyn, and the witness that has to lie within their errors."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from studies.catalogue import DEFAULT
from studies.common import witness
from studies.common.numbers import Number, measured_all
from studies.common.options import Options
from studies.common.rise import FORCE
from studies.common.subject import paper_subject
from studies.common.witness import is_within, run_and_measure, with_errors
from studies.common.words import Chapter
from support_exudyn import CubicStep, Result, Scenario
from tests.at_once import at_once
from tests.studies.forms import WHOLE, results

SHORT = CubicStep(stroke=0.002, start=0.1, end=0.2)
MEASURES = {
    "mean": ("N", lambda run: run.window(FORCE, 0.0, 0.25).mean),
    "std": ("N", lambda run: run.window(FORCE, 0.0, 0.25).std),
    "largest": ("N", lambda run: run.window(FORCE, 0.0, 0.25).largest[0]),
    "tip": ("m", lambda run: run.window("tip.x", 0.0, 0.25).mean),
}


def measure(results: Mapping[str, Result]) -> list[Number]:
    return measured_all(results, MEASURES)


@pytest.fixture(scope="module")
def judged(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Number]]:
    """The folder and the numbers of a study in small: half a rise of 2 mm, with friction and without."""
    out = tmp_path_factory.mktemp("small")
    subject, chosen = paper_subject(), Options(out, at_once(), out / "kept")
    rises = {
        "ideal": subject.ideal(), "dry": subject.with_clearance(1.5, 0.25),
        "smooth": subject.with_clearance(1.5, 0.0),
    }  # fmt: skip
    cases: dict[str, Scenario] = {
        name: replace(rise, drive=SHORT, duration=0.25) for name, rise in rises.items()
    }
    return out, run_and_measure(cases, measure, chosen)[1]


def test_the_witness_lies_within_the_errors(judged: tuple[Path, list[Number]]) -> None:
    _, numbers = judged
    assert len(numbers) == 3 * len(MEASURES)
    assert [one for one in numbers if not is_within(one)] == []
    for one in numbers:  # without friction the journal still bounces at the end
        assert one.numerical_error < (0.5 if one.case == "smooth" else 0.05) * abs(one.value)


def test_runs_are_those_of_exudyn_and_witnesses_stand_by_themselves(judged: tuple[Path, list[Number]]) -> None:
    out, _ = judged
    found = {
        folder: [Result.load(path).scenario.formulation for path in (out / folder).glob("*.h5")]
        for folder in ("kept", "witness")
    }
    assert found == {"kept": 6 * ["exudyn"], "witness": 6 * ["compiled"]}


def number(value: float, error: float, name: str = "mean_force", witness: float | None = None) -> Number:
    return Number(name, "case", value, "N", error, None, witness)


def test_errors_have_floors() -> None:
    by_chance, closed = number(100.0, 1e-9), number(100.0, 0.0, "closed form")
    plain, large = number(50.0, 0.5, "std_force"), number(200.0, 4.0, "largest_force")
    found = [one.numerical_error for one in with_errors([by_chance, plain, large, closed])]
    middle = witness.ALIKE * witness.SAFETY * 0.5  # of shares of the largest number
    assert found == pytest.approx([middle, witness.SAFETY * 0.5, witness.SAFETY * 4.0, 0.0])
    assert with_errors([by_chance])[0].numerical_error == pytest.approx(100.0 * witness.LEAST)


@pytest.mark.slow
@pytest.mark.parametrize("study", [study for study in DEFAULT if study != "claims"])  # its machines are drawn
def test_a_study_of_the_paper_runs_on_exudyn_and_names_what_the_witness_does_not_confirm(
    study: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    out = results(study, WHOLE, tmp_path_factory)
    runs = [Result.load(path).scenario.formulation for path in out.rglob("*.h5")]
    assert set(runs) == {"exudyn"}
    numbers: list[dict[str, Any]] = json.loads((out / "summary.json").read_text("utf-8"))["numbers"]
    assert all(one["witness"] is not None for one in numbers)
    beyond = [one for one in numbers if abs(one["value"] - one["witness"]) > one["numerical_error"]]
    assert len(beyond) <= 0.01 * len(numbers)
    chapter = Chapter.load(out)
    for one in beyond:
        assert f"{one['name'].replace('_', ' ')} ({one['case']})" in chapter.findings[-1]
    for sheet in chapter.sheets:
        assert "Computed by Exudyn 1." in sheet.caption
