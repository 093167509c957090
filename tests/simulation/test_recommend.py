"""The rule by which scenes are recommended, on made-up tables and on the one that comes with the program."""

from __future__ import annotations

from dataclasses import replace

import pytest

from support_exudyn import Estimate, Recommendation, Scenario, recommend, reference_support
from support_exudyn.simulation.evidence.table import EvidenceTable, Tried, committed, fields_of
from support_exudyn.simulation.recommend import QUESTIONS, STROKE, answers_alike

PLAIN = Scenario(machine=reference_support(), duration=0.1)


def tried(name: str, seconds: float, mean: float, error: float = 0.0) -> Tried:
    numbers = {"mean_pin_force": Estimate(mean, error, "N")}
    return Tried(name, STROKE, fields_of(PLAIN), numbers, seconds, 100)


def table(*scenes: Tried) -> EvidenceTable:
    return EvidenceTable(scenes, {STROKE: "fullest"}, {STROKE: "made up"})


FULL = tried("fullest", 10.0, 1000.0)


def test_the_cheapest_within_what_is_allowed_is_taken() -> None:
    # 1 % of 1000 N are allowed
    made = table(FULL, tried("off", 1.0, 1011.0), tried("good", 2.0, 1009.0), tried("better", 3.0, 1001.0))
    advice = recommend("mean force", made)
    assert (advice.scene, advice.seconds, advice.fullest_seconds) == ("good", 2.0, 10.0)
    (found,) = advice.evidence
    assert found.difference == pytest.approx(9.0)
    assert found.allowed == pytest.approx(10.0)
    assert "2 of 4" not in advice.reason  # good, better and the fullest
    assert "3 of 4" in advice.reason


@pytest.mark.parametrize("question", QUESTIONS)
def test_the_advice_follows_from_the_table_by_the_rule(question: str) -> None:
    advice, asked, known = recommend(question), QUESTIONS[question], committed()
    fullest = known.fullest_of(asked.family)
    good = []
    for scene in known.family(asked.family):
        alike = True
        for answer in asked.answers:  # the rule once more, written out
            there = fullest.numbers[answer.number]
            if answer.number not in scene.numbers:  # rigid bodies do not determine it there
                alike = False
                continue
            here = scene.numbers[answer.number]
            share = abs(there.value) if answer.relative else 1.0
            apart = abs(here.value - there.value) + here.error + there.error
            alike &= apart <= answer.allowed * share
        alike |= scene == fullest
        assert alike == answers_alike(asked, scene, fullest)
        if alike:
            good.append(scene)
    cheapest = min(scene.seconds for scene in good)
    near = [scene for scene in good if scene.seconds <= 1.1 * cheapest]
    (advised,) = (scene for scene in near if scene.name == advice.scene)
    assert advised.elements == min(scene.elements for scene in near)
    assert all(item.passes for item in advice.evidence)
    assert advice.question == question


@pytest.mark.parametrize("question", QUESTIONS)
def test_what_is_recommended_can_be_set(question: str) -> None:
    advice: Recommendation = recommend(question)
    scenario = advice.apply(PLAIN)
    assert scenario == replace(PLAIN, **advice.fields)
    assert fields_of(scenario) == dict(advice.fields)
    assert scenario.dimensions == (3 if question == "unequal columns" else 2)
