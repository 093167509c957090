"""The rule by which scenes are recommended, on made-up tables and on the one that comes with the program."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import Estimate, Recommendation, Scenario, recommend, reference_support
from support_exudyn.evidence.table import Table, Tried, committed, fields_of
from support_exudyn.recommend import QUESTIONS, STROKE, answers_alike
from user_forces import InputError

PLAIN = Scenario(machine=reference_support(), duration=0.1)


def tried(name: str, seconds: float, mean: float, error: float = 0.0) -> Tried:
    numbers = {"mean_pin_force": Estimate(mean, error, "N")}
    return Tried(name, STROKE, fields_of(PLAIN), numbers, seconds, 100)


def table(*scenes: Tried) -> Table:
    return Table(scenes, {STROKE: "fullest"}, {STROKE: "made up"})


FULL = tried("fullest", 10.0, 1000.0)


def test_the_cheapest_within_what_is_allowed_is_taken() -> None:
    # 1 % of 1000 N are allowed
    made = table(FULL, tried("off", 1.0, 1011.0), tried("good", 2.0, 1009.0), tried("better", 3.0, 1001.0))
    advice = recommend("mean force", made)
    assert (advice.scene, advice.seconds, advice.fullest_seconds) == ("good", 2.0, 10.0)
    (found,) = advice.evidence
    assert found.difference == pytest.approx(9.0)
    assert found.allowed == pytest.approx(10.0)
    assert not found.by_error
    assert "2 of 4" not in advice.reason  # good, better and the fullest
    assert "3 of 4" in advice.reason


def test_if_no_other_will_do_it_is_the_fullest() -> None:
    assert recommend("mean force", table(FULL, tried("off", 1.0, 900.0))).scene == "fullest"


def test_what_the_errors_hide_is_let_pass_and_said() -> None:
    unsure = tried("unsure", 1.0, 1020.0, error=15.0)
    assert recommend("mean force", table(FULL, unsure)).scene == "fullest"
    both = table(replace(FULL, numbers={"mean_pin_force": Estimate(1000.0, 6.0, "N")}), unsure)
    advice = recommend("mean force", both)  # 20 N apart, errors of 21 N together
    assert advice.scene == "unsure"
    assert advice.evidence[0].by_error
    assert "mean_pin_force" in advice.reason


def test_other_questions_are_refused() -> None:
    with pytest.raises(InputError, match="question = 'wear': allowed: 'posture', 'mean force', 'peak force'"):
        recommend("wear", table(FULL))


def test_what_a_table_lacks_is_said() -> None:
    with pytest.raises(InputError, match="family = 'unequal columns': allowed: stroke"):
        recommend("unequal columns", table(FULL))
    with pytest.raises(InputError, match="'fullest': has no mean_tip_x"):
        recommend("posture", table(FULL))


def test_a_table_is_read_as_it_was_written(tmp_path: Path) -> None:
    made = table(FULL, tried("good", 2.0, 1009.0, 0.1))
    made.save(tmp_path / "table.json")
    assert Table.load(tmp_path / "table.json") == made
    committed().save(tmp_path / "table.json")
    assert Table.load(tmp_path / "table.json") == committed()


@pytest.mark.parametrize("text", ["", "{}", '{"format": "other"}', "[]"])
def test_what_is_no_table_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "table.json").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"table\.json: not a table"):
        Table.load(tmp_path / "table.json")


@pytest.mark.parametrize("question", QUESTIONS)
def test_the_advice_follows_from_the_table_by_the_rule(question: str) -> None:
    advice, asked, known = recommend(question), QUESTIONS[question], committed()
    fullest = known.fullest_of(asked.family)
    good, cheaper = [], []
    for scene in known.family(asked.family):
        alike = True
        for answer in asked.answers:  # the rule once more, written out
            here, there = scene.numbers[answer.number], fullest.numbers[answer.number]
            share = abs(there.value) if answer.relative else 1.0
            alike &= abs(here.value - there.value) <= max(answer.allowed * share, here.error + there.error)
        assert alike == answers_alike(asked, scene, fullest)
        (good if alike else []).append(scene)
        if scene.seconds < advice.seconds:
            cheaper.append(scene)
    assert advice.scene in {scene.name for scene in good}
    assert not {scene.name for scene in cheaper} & {scene.name for scene in good}
    assert all(item.passes for item in advice.evidence)
    assert advice.question == question


@pytest.mark.parametrize("question", QUESTIONS)
def test_what_is_recommended_can_be_set(question: str) -> None:
    advice: Recommendation = recommend(question)
    scenario = advice.apply(PLAIN)
    assert scenario == replace(PLAIN, **advice.fields)
    assert fields_of(scenario) == dict(advice.fields)
    assert scenario.dimensions == (3 if question == "unequal columns" else 2)
