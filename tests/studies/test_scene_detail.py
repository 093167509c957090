"""What each element of the model changes and costs."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from studies.common.words import Chapter
from studies.scene_detail import run as study
from studies.scene_detail.figures import BELOW
from studies.scene_detail.measures import Change, change
from studies.scene_detail.scenes import (
    EQUAL,
    PLAINEST,
    UNEQUAL_FULLEST,
    UNEQUAL_IDEAL,
    UNEQUAL_WITH_CLEARANCE,
    DetailScene,
    scenes,
)
from support_exudyn import Estimate, recommend
from support_exudyn.simulation.evidence.table import EvidenceTable, committed, fields_of
from support_exudyn.simulation.recommend import QUESTIONS, comparisons
from tests.studies.forms import ONLY_WHOLE, Numbers, numbers_of, results


@pytest.fixture(scope="module", params=ONLY_WHOLE)
def out(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return results("scene_detail", request.param, tmp_path_factory)


@pytest.fixture(scope="module")
def numbers(out: Path) -> Numbers:
    return numbers_of(out)


def test_every_number_is_finite_and_has_an_error(numbers: Numbers) -> None:
    for number in numbers.values():
        assert math.isfinite(number["value"])
        assert number["numerical_error"] >= 0.0
    counted = {name for (name, _), number in numbers.items() if number["unit"] == "1"}
    exact = {name for (name, _), number in numbers.items() if number["numerical_error"] == 0.0}
    # of a scene from itself there is no distance
    assert exact - counted <= {"tip_distance_from_fullest"}


def test_every_element_is_added_and_taken() -> None:
    chosen = scenes()
    names = {group: [s.name for s in chosen.values() if s.group == group] for group in study.ORDER}
    words = {"friction", "clearance", "mass of columns", "oil in columns", "tail beam", "start"}
    for group in ("added", "taken"):
        for word in words:
            assert any(word in name for name in names[group]), (group, word)
    assert any("space" in name for name in names["added"])
    assert len({json.dumps(s.scenario.to_data()) for s in chosen.values()}) == len(chosen)  # no two alike


def test_added_and_taken_scenes_differ_by_one_element() -> None:
    chosen = scenes()

    def differing(scene: DetailScene) -> list[str]:
        mine, its = (fields_of(one.scenario) for one in (scene, chosen[scene.reference]))
        return [name for name in mine if mine[name] != its[name]]

    for scene in chosen.values():
        if scene.group in ("added", "taken", "space") and scene.reference:
            assert len(differing(scene)) == 1, scene.name


def test_what_changes_nothing_is_said_to_be_below_the_error(numbers: Numbers, out: Path) -> None:
    # a rigid jack holds the tail beam as the shield beam does; space is symmetric
    for name in (f"{PLAINEST} + tail beam, rigid jack", f"{PLAINEST} + space"):
        for what in ("mean_pin_force", "mean_tip_x"):
            a, b = numbers[what, name], numbers[what, PLAINEST]
            assert abs(a["value"] - b["value"]) <= a["numerical_error"] + b["numerical_error"]
    chapter = Chapter.load(out)
    (added,) = (sheet for sheet in chapter.sheets if sheet.title.startswith("What each element changes"))
    (row,) = (row for row in added.rows if row[0] == "+ tail beam, rigid jack")
    assert all(cell.startswith(BELOW) for cell in row[2:-1])


def test_changes_and_errors_add_up() -> None:
    found = change(Estimate(110.0, 2.0, "N"), Estimate(100.0, 3.0, "N"))
    assert found == Change(10.0, 5.0)
    assert not found.below_error
    assert found.scaled(1e3) == Change(1e4, 5e3)
    assert change(Estimate(104.0, 2.0, "N"), Estimate(100.0, 3.0, "N")).below_error
    assert Change(-5.0, 5.0).below_error
    assert Change(0.0, 0.0).below_error


def test_the_table_agrees_with_the_advice(out: Path) -> None:
    found = EvidenceTable.load(out / study.TABLE)
    assert {scene.name for scene in found.scenes} == {scene.name for scene in committed().scenes}
    for question in QUESTIONS:
        advice = recommend(question, found)
        fullest = found.fullest_of(QUESTIONS[question].family)
        assert advice.scene == fullest.name or all(item.passes for item in advice.evidence)
        assert advice.seconds <= 1.1 * advice.fullest_seconds
    # its stroke ends while the pins still bounce and its steps are coarse: of forces and vibration what is
    # advised is not surely worse there
    for question in ("peak force", "vibration"):
        asked, advised = QUESTIONS[question], recommend(question).scene
        scene = next(scene for scene in found.scenes if scene.name == advised)
        for item in comparisons(asked, scene, found.fullest_of(asked.family)):
            assert item.difference - item.error <= item.allowed, item


def test_columns_driven_apart_turn_the_canopy_by_the_clearance_only(numbers: Numbers) -> None:
    for what in ("largest_roll", "largest_yaw"):
        with_clearance, ideal, equal = (numbers[what, name] for name in (UNEQUAL_FULLEST, UNEQUAL_IDEAL, EQUAL))
        assert with_clearance["value"] > 1e3 * (ideal["value"] + equal["value"])
        rough = numbers[what, UNEQUAL_WITH_CLEARANCE]["value"]
        assert with_clearance["value"] == pytest.approx(rough, rel=0.05)  # with friction or without
    # how ideal pins share the moment rigid bodies do not determine
    assert ("largest_moment", UNEQUAL_FULLEST) in numbers
    assert ("largest_moment", UNEQUAL_IDEAL) not in numbers


def test_the_committed_table_is_of_these_scenes() -> None:
    known = {scene.name: scene for scene in committed().scenes}
    chosen = scenes()
    assert list(known) == list(chosen)
    for name, scene in chosen.items():
        assert dict(known[name].fields) == fields_of(scene.scenario)
        assert known[name].family == scene.family
    assert dict(committed().said) == study.families(chosen)
