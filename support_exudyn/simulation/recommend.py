"""Which elements of the model a question needs: the cheapest scene whose answers are those of the fullest.

    from dataclasses import replace
    from support_exudyn import recommend

    advice = recommend("mean force")
    scenario = replace(scenario, **advice.fields)  # or advice.apply(scenario)

The rule: of all scenes that the study `scene_detail` has tried, the cheapest whose answers differ from those of
the fullest scene (in the plane; for unequal columns: in space) by no more than the question allows, the
numerical errors of both added to the difference. Among scenes that cost the same within a tenth, the one with
the fewest elements. It is applied to the table that the study has written, so that the advice is as good as
that table: one machine, one stroke.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.evidence.table import EvidenceTable, Tried, committed
from user_forces.values.value import InputError, short


@dataclass(frozen=True)
class Answer:
    """A number that answers a question.

    number: its name in the table. allowed: how far it may be from that of the fullest scene, in its unit, or
    as a share of that if relative.
    """

    number: str
    allowed: float
    relative: bool = True


@dataclass(frozen=True)
class Question:
    """What is asked: by which numbers, in which family of scenes."""

    family: str
    answers: tuple[Answer, ...]
    said: str  # what is allowed, in words


ALIKE = 1.1  # times that differ by less are the same: they scatter so much
STROKE, UNEQUAL = "stroke", "unequal columns"
QUESTIONS: dict[str, Question] = {
    "posture": Question(
        STROKE,
        (Answer("mean_tip_x", 5e-4, relative=False), Answer("mean_tip_y", 5e-4, relative=False)),
        "the canopy's tip is, in the mean of the stroke, within 0.5 mm forward and up",
    ),
    "mean force": Question(
        STROKE, (Answer("mean_pin_force", 0.01),), "the mean force in the rear pin is within 1 %"
    ),
    "peak force": Question(
        STROKE,
        (Answer("largest_pin_force", 0.1), Answer("largest_pin_force_in_stroke", 0.1)),
        "the largest force in the rear pin, of the stroke and of the whole run, is within 10 %",
    ),
    "vibration": Question(
        STROKE,
        (Answer("std_pin_force", 0.1), Answer("std_angular_acceleration", 0.1)),
        "the spreads of the rear pin's force and of the rear link's angular acceleration are within 10 %",
    ),
    "unequal columns": Question(
        UNEQUAL,
        (
            Answer("largest_roll", 0.05),
            Answer("largest_yaw", 0.05),
            Answer("largest_front_column_force", 0.05),
            Answer("largest_moment", 0.05),
        ),
        "roll and yaw of the canopy, the larger front column force and the moment on the rear pin are within 5 "
        "%",
    ),
}


@dataclass(frozen=True)
class Comparison:
    """A number of a scene beside that of the fullest.

    allowed: by how much they may differ, in the number's unit.
    """

    number: str
    here: Estimate
    fullest: Estimate
    allowed: float

    @property
    def difference(self) -> float:
        """How far apart they are, >= 0."""
        return abs(self.here.value - self.fullest.value)

    @property
    def error(self) -> float:
        """Both numerical errors together."""
        return self.here.error + self.fullest.error

    @property
    def passes(self) -> bool:
        """Whether the scene surely answers as the fullest does."""
        return self.difference + self.error <= self.allowed


@dataclass(frozen=True)
class Recommendation:
    """A scene to use for a question.

    fields: of a scenario, for `dataclasses.replace`. scene: its name in the study. reason: in words.
    evidence: its answers beside those of the fullest. seconds, fullest_seconds: what both cost.
    """

    question: str
    scene: str
    fields: Mapping[str, Any]
    reason: str
    evidence: tuple[Comparison, ...]
    seconds: float
    fullest_seconds: float

    def apply(self, scenario: Scenario) -> Scenario:
        """A scenario with these elements. Raises InputError if its machine does not have them."""
        return replace(scenario, **self.fields)


def recommend(question: str, table: EvidenceTable | None = None) -> Recommendation:
    """The cheapest scene that answers a question, by the rule at the top of this file.

    Arguments:
        question: "posture", "mean force", "peak force", "vibration" or "unequal columns".
        table: of scenes that have been tried; None: that of the program, of the reference support.

    Raises InputError if the question is none of these.
    """
    if not isinstance(question, str) or question not in QUESTIONS:
        raise InputError(f"question = {short(question)}: allowed: {', '.join(map(repr, QUESTIONS))}")
    asked = QUESTIONS[question]
    tried = committed() if table is None else table
    scenes, fullest = tried.family(asked.family), tried.fullest_of(asked.family)
    good = [scene for scene in scenes if answers_alike(asked, scene, fullest)]
    enough = ALIKE * min(scene.seconds for scene in good)
    best = min((scene for scene in good if scene.seconds <= enough), key=lambda s: (s.elements, s.seconds))
    compared = comparisons(asked, best, fullest)
    return Recommendation(
        question=question,
        scene=best.name,
        fields=best.fields,
        reason=_reason(asked, best, fullest, f"{len(good)} of {len(scenes)}"),
        evidence=compared,
        seconds=best.seconds,
        fullest_seconds=fullest.seconds,
    )


def comparisons(asked: Question, scene: Tried, fullest: Tried) -> tuple[Comparison, ...]:
    """The answers of a scene beside those of the fullest. Raises InputError if it lacks one."""
    found = []
    for answer in asked.answers:
        for one in (scene, fullest):
            if answer.number not in one.numbers:
                raise InputError(
                    f"scene {one.name!r}: has no {answer.number}; it has {', '.join(one.numbers) or 'nothing'}"
                )
        here, there = scene.numbers[answer.number], fullest.numbers[answer.number]
        allowed = answer.allowed * abs(there.value) if answer.relative else answer.allowed
        found.append(Comparison(answer.number, here, there, allowed))
    return tuple(found)


def answers_alike(asked: Question, scene: Tried, fullest: Tried) -> bool:
    """Whether a scene answers a question as the fullest does, which itself always does.

    A scene without a number that the fullest has cannot: rigid bodies do not determine it there.
    """
    if scene != fullest and any(answer.number not in scene.numbers for answer in asked.answers):
        return False
    return scene == fullest or all(compared.passes for compared in comparisons(asked, scene, fullest))


def _reason(asked: Question, best: Tried, fullest: Tried, count: str) -> str:
    return (
        f"Of {count} scenes in which {asked.said}, the one with the fewest elements among the cheapest: "
        f"{best.seconds:.2g} s, against {fullest.seconds:.2g} s of the fullest."
    )
