"""The study of the slider-crank, on a part of a revolution."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from studies.common.options import Options
from studies.common.words import Chapter
from studies.slider_crank import run as study
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from tests import figure_checks
from tests.at_once import at_once
from tests.studies.forms import Numbers


@pytest.fixture(scope="module")
def numbers(tmp_path_factory: pytest.TempPathFactory) -> Numbers:
    out = tmp_path_factory.mktemp("results")
    with pytest.MonkeyPatch.context() as patch:
        whole = study.scenarios()
        part = {name: replace(case, duration=case.duration / 9.0) for name, case in whole.items()}  # 1.33 ms
        patch.setattr(study, "scenarios", lambda: part)
        study.SliderCrank(Options(out, at_once())).write()
    assert (out / "slider_crank.png").read_bytes().startswith(b"\x89PNG")
    assert "onset 5 speed" in Path(out / "numbers.csv").read_text(encoding="utf-8")
    with style.look():
        cases = (study.IDEAL, study.SMOOTH, study.DRY)
        files = {case: f"{case.replace(' ', '_').replace('.', 'p')}.h5" for case in cases}
        figure_checks.check(
            study.figure({case: Result.load(out / "runs" / file) for case, file in files.items()})
        )
    chapter = Chapter.load(out)
    assert chapter.findings[0].startswith("Without friction the first 5 impacts are within ")
    assert chapter.answer.startswith("Yes: the first 5 impacts of the frictionless machine are within ")
    assert len(chapter.numbers) == 3
    key = chapter.sheets[0]
    assert (key.name, [row[0] for row in key.rows]) == ("table_agreement", ["1", "2", "3", "4", "5"])
    assert [picture.stem for picture in chapter.pictures] == ["slider_crank"]
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert summary["study"] == "slider_crank"
    return {(n["name"], n["case"]): n for n in summary["numbers"]}


def test_onsets_agree_with_the_independent_solution(numbers: Numbers) -> None:
    for n, (time, speed) in enumerate(study.REFERENCE):
        found = numbers[f"onset_{n + 1}_time", study.SMOOTH], numbers[f"onset_{n + 1}_speed", study.SMOOTH]
        assert [number["paper"] for number in found] == [time, speed]
        # asked for
        assert found[0]["value"] == pytest.approx(time, rel=1e-5)
        assert found[1]["value"] == pytest.approx(speed, rel=1e-3)
        # the error reported covers the one there is, or that is below the reference's print
        for number, printed in zip(found, (5e-4, 5e-7), strict=True):
            assert abs(number["value"] - number["paper"]) < 2.0 * number["numerical_error"] + printed


def test_friction_changes_later_touches_only(numbers: Numbers) -> None:
    first = [numbers["onset_1_speed", case]["value"] for case in (study.SMOOTH, study.DRY)]
    second = [numbers["onset_2_speed", case]["value"] for case in (study.SMOOTH, study.DRY)]
    assert first[0] == pytest.approx(first[1], rel=1e-9)  # in flight there is no friction
    assert abs(second[0] - second[1]) > 0.1
