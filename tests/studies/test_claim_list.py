"""The list of claims: complete, with reasons, and no judge that always says the same."""

from __future__ import annotations

import re

import pytest

from studies.claims.claim_list import CLAIMS, Claim
from studies.claims.evidence import Evidence, Measured, NotedEvidence
from studies.claims.plausible import REFERENCE
from studies.claims.plausible_runs import CLEARANCES, evidence, measures
from studies.common import paper_machine, rise
from tests.cases.evidence_cases import blurred, right, wrong

ON_MACHINES = [claim for claim in CLAIMS if claim.judge is not None and not claim.closed_form]


def numbered(claims: list[Claim]) -> list[object]:
    """With the number of each claim in the table as its name."""
    return [pytest.param(claim, id=f"no. {CLAIMS.index(claim) + 1}") for claim in claims]


@pytest.fixture(scope="module")
def reference() -> Evidence:
    """What is really measured."""
    return evidence(measures(REFERENCE))


@pytest.mark.parametrize("claim", numbered(ON_MACHINES))
def test_no_judge_is_stuck(claim: Claim) -> None:
    assert claim.judge is not None
    assert claim.judge(right()) is True
    assert claim.judge(wrong()) is False


@pytest.mark.parametrize("claim", numbered(ON_MACHINES))
@pytest.mark.parametrize("known", [right(), wrong()], ids=["right", "wrong"])
def test_every_judge_leaves_open_what_the_numerical_error_leaves_open(claim: Claim, known: Evidence) -> None:
    assert claim.judge is not None
    assert claim.judge(blurred(known)) is None


@pytest.mark.slow  # all cases of a machine
@pytest.mark.parametrize("claim", numbered(ON_MACHINES))
def test_every_judge_finds_what_it_asks_for_in_real_measures(claim: Claim, reference: Evidence) -> None:
    assert claim.judge is not None
    noted = NotedEvidence(reference.measures)
    assert claim.judge(noted) in (True, False, None)
    assert re.search(r"\d", noted.describe(CLEARANCES))
    assert "nan" not in noted.describe(CLEARANCES)


def test_closed_forms_are_judged_to_all_digits_printed(monkeypatch: pytest.MonkeyPatch) -> None:
    closed = [claim.judge for claim in CLAIMS if claim.closed_form]
    assert len(closed) == 2
    nothing, ours = Evidence({}), paper_machine.stiffness
    assert all(judge(nothing) is True for judge in closed if judge)
    monkeypatch.setattr(paper_machine, "stiffness", lambda size: ours(size) + 0.001 * 1e3**1.5)
    assert all(judge(nothing) is False for judge in closed if judge)  # the last digit printed


# --- single readings ---


def judged(start: str, known: Evidence) -> bool | None:
    (claim,) = (claim for claim in CLAIMS if claim.text.startswith(start))
    assert claim.judge is not None
    return claim.judge(known)


def with_row(name: str, *values: float, error: float = 0.0) -> Evidence:
    """Evidence in which the paper is right but for a measure of the four clearances."""
    known = right().measures
    cases = ("0.5 mm", "1.0 mm", "1.5 mm", "2.0 mm")
    rows = {
        case: dict(known[case]) | {name: Measured(value, error)}
        for case, value in zip(cases, values, strict=True)
    }
    return Evidence(dict(known) | rows)


@pytest.mark.parametrize(
    ("spread", "verdict"),
    [
        ((6114.9, 5938.1, 6013.1, 6188.9), True),  # the paper's
        ((4.0, 5.0, 3.0, 6.0), True),  # its minimum may be at 1.5 mm
        ((1.0, 2.0, 3.0, 4.0), False),
        ((4.0, 3.0, 2.0, 1.0), False),
        ((2.0, 3.0, 3.0, 1.0), False),
    ],
)
def test_falling_first_and_then_growing_is_a_minimum_inside(
    spread: tuple[float, float, float, float], verdict: bool
) -> None:
    assert (
        judged("The standard deviation of the pin force first falls", with_row("std_force", *spread)) is verdict
    )


EVERY_PART = {  # claims that are true only if several things are
    "Clearance changes the overall movement": ("likeness_speed", "likeness_tip"),
    "The clearance's size has little effect on the angular velocity": tuple(f"speed_{s}" for s in rise.STAGES),
    "Early and late in the rise the angular velocities": ("speed_early", "speed_late"),
    "Early and late, the larger the clearance": ("rms_speed_early", "rms_speed_late"),
    "The larger the clearance, the more the rear link's": ("rms_speed", "rms_acceleration"),
    "The clearance's size has relatively little influence": ("mean_force", "std_force"),
    "Both columns tilt to the rear": ("front_angle", "rear_angle"),
    "The larger the clearance, the smaller these angles": ("front_angle", "rear_angle"),
    "The gentle drive reduces the fluctuation of the rear link's": (
        "rms_from_start_speed",
        "rms_from_start_acceleration",
    ),
}


def spoilt(*names: str) -> Evidence:
    """Evidence in which the paper is right but for these measures."""
    bad = wrong().measures
    return Evidence(
        {
            case: {name: bad[case][name] if name in names else m for name, m in row.items()}
            for case, row in right().measures.items()
        }
    )


@pytest.mark.parametrize(
    ("start", "part"), [(start, part) for start in EVERY_PART for part in EVERY_PART[start]]
)
def test_each_part_of_a_claim_counts(start: str, part: str) -> None:
    assert judged(start, spoilt()) is True
    assert judged(start, spoilt(part)) is False
