"""The study of the slider-crank, on a part of a revolution."""

from __future__ import annotations

from dataclasses import replace

import pytest

from studies.common.options import Options
from studies.common.runs import file_name
from studies.common.words import Chapter
from studies.slider_crank import run as study
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from tests import figure_checks
from tests.at_once import at_once
from tests.studies.forms import Numbers, numbers_of


@pytest.fixture(scope="module")
def numbers(tmp_path_factory: pytest.TempPathFactory) -> Numbers:
    out = tmp_path_factory.mktemp("results")
    with pytest.MonkeyPatch.context() as patch:
        whole = study.scenarios()
        part = {name: replace(case, duration=case.duration / 9.0) for name, case in whole.items()}  # 1.33 ms
        patch.setattr(study, "scenarios", lambda: part)
        study.SliderCrankStudy(Options(out, at_once())).write()
    with style.look():
        runs = {case: Result.load(out / "runs" / f"{file_name(case)}.h5") for case in part}
        figure_checks.check(study.figure(runs))
    chapter = Chapter.load(out)
    assert chapter.answer.startswith("Yes: the first 5 impacts of the frictionless machine are within ")
    assert [row[0] for row in chapter.sheets[0].rows] == ["1", "2", "3", "4", "5"]
    assert [picture.stem for picture in chapter.pictures] == ["slider_crank"]
    return numbers_of(out)


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
