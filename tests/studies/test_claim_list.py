"""The list of claims: complete, with reasons, and no judge that always says the same."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from studies.claims import claim_list
from studies.claims.claim_list import CLAIMS, Claim, Varied
from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible import REFERENCE
from studies.claims.plausible_runs import MODE_1, evidence, measures
from studies.common import paper_machine, rise
from tests.cases.evidence_cases import blurred, right, wrong

ON_MACHINES = [claim for claim in CLAIMS if claim.judge is not None and not claim.closed_form]
PLACES = r"(abstract|section [345](\.[123])?|conclusions|conclusion [1234])"


def numbered(claims: list[Claim]) -> list[object]:
    """With the number of each claim in the table as its name."""
    return [pytest.param(claim, id=f"no. {CLAIMS.index(claim) + 1}") for claim in claims]


@pytest.fixture(scope="module")
def reference() -> Evidence:
    """What is really measured."""
    return evidence(measures(REFERENCE))


def test_there_are_more_than_twenty_claims() -> None:
    assert len(CLAIMS) > 20  # so says the requirement
    assert len(ON_MACHINES) > 20
    assert len({claim.text for claim in CLAIMS}) == len(CLAIMS)


def test_every_part_of_the_paper_that_claims_has_its_claims() -> None:
    where = {place for claim in CLAIMS for place in claim.where.split(", ")}
    parts = {"abstract", "section 3", "section 4.1", "section 4.2", "section 4.3", "section 5"}
    assert parts | {f"conclusion {n}" for n in range(1, 5)} <= where


@pytest.mark.parametrize("claim", numbered(list(CLAIMS)))
def test_every_claim_says_where_what_and_how_it_is_read(claim: Claim) -> None:
    assert all(re.fullmatch(PLACES, place) for place in claim.where.split(", "))
    assert claim.text.endswith(".")
    assert claim.reading
    assert claim.reading.startswith("not measurable: ") == (claim.judge is None)
    if claim.judge is None:
        assert len(claim.reading) > len("not measurable: ") + 20  # a reason
        assert not claim.closed_form


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


@pytest.mark.parametrize("claim", numbered(ON_MACHINES))
def test_small_errors_change_no_judgement(claim: Claim) -> None:
    assert claim.judge is not None
    # the closest calls are of speeds and correlations that differ by thousandths: here are millionths
    assert claim.judge(blurred(right(), 1e-6)) is True


@pytest.mark.parametrize("claim", numbered([c for c in CLAIMS if c.judge is not None]))
def test_every_judge_finds_what_it_asks_for_in_real_measures(claim: Claim, reference: Evidence) -> None:
    assert claim.judge is not None
    assert claim.judge(reference) in (True, False, None)
    said = claim.tell(reference)
    assert re.search(r"\d", said)
    assert "nan" not in said


@pytest.mark.parametrize("claim", [claim for claim in CLAIMS if claim.follows_from], ids=lambda c: c.name)
def test_a_contained_statement_fails_only_together_with_the_one_that_contains_it(claim: Claim) -> None:
    (whole,) = (other for other in CLAIMS if other.name == claim.follows_from)
    assert not whole.follows_from
    if claim.closed_form:
        return
    assert claim.judge is not None
    assert whole.judge is not None
    bad = wrong().measures
    for case, row in right().measures.items():  # one measure of one case is wrong
        for name in row:
            changed = {key: dict(values) for key, values in right().measures.items()}
            changed[case][name] = bad[case][name]
            if claim.judge(Evidence(changed)) is False:
                assert whole.judge(Evidence(changed)) is False or "lean" in name


def test_statements_without_a_measure_and_on_oil_are_these() -> None:
    numbered_ = list(enumerate(CLAIMS, 1))
    assert [n for n, claim in numbered_ if claim.judge is None] == [10, 23, 31, 35, 40, 44, 49, 50]
    # what the ideal pin does at the start of mode 1 on rigid columns is an impulse, without a finite force
    assert [n for n, claim in numbered_ if "columns of oil" in claim.reading] == [42, 43]
    assert [n for n, claim in numbered_ if claim.follows_from] == [1, 2, 6, 8, 29, 36, 38, 39]


def test_closed_forms_are_judged_to_all_digits_printed(monkeypatch: pytest.MonkeyPatch) -> None:
    closed = [claim for claim in CLAIMS if claim.closed_form]
    assert len(closed) == 2
    nothing = Evidence({})
    ours = [paper_machine.stiffness(size) / 1e3**1.5 for size in (0.5, 1.0, 1.5, 2.0)]
    for claim in closed:
        assert claim.judge is not None
        assert claim.judge(nothing) is True
        monkeypatch.setattr(claim_list, "_STIFFNESSES", [k + 0.001 for k in ours])  # the last digit printed
        assert claim.judge(nothing) is False
        monkeypatch.setattr(claim_list, "_STIFFNESSES", ours)


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


def test_a_jump_of_fluctuation_between_1_and_1p5_mm_concerns_all_four() -> None:
    start = "The fluctuations of the angular acceleration at 2.0 and 1.5 mm"
    assert judged(start, with_row("rms_acceleration", 10.0, 11.0, 17.0, 18.0)) is True
    assert judged(start, with_row("rms_acceleration", 10.0, 12.0, 17.0, 19.0)) is False
    assert judged(start, with_row("rms_acceleration", 12.0, 10.0, 17.0, 19.0)) is False
    assert judged(start, with_row("rms_acceleration", 10.0, 11.0, 19.0, 16.0)) is False


def test_growth_asks_for_every_step() -> None:
    start = "The mean pin force grows"
    assert judged(start, with_row("mean_force", 1.0, 2.0, 4.0, 3.0)) is False
    assert judged(start, with_row("mean_force", 1.0, 2.0, 3.0, 4.0, error=0.6)) is None


def test_readings_name_the_thresholds_and_times_that_are_used() -> None:
    readings = " ".join(claim.reading for claim in CLAIMS)
    begin, end = rise.STAGES["middle"]
    assert f"{begin:g} to {end:g} s" in readings
    early, late = rise.STAGES["early"], rise.STAGES["late"]
    assert f"from {early[0]} to {early[1]} s and from {late[0]} to {late[1]} s" in readings
    assert f"moving means of {rise.TREND_WINDOW} s" in readings
    assert f"above {100 * claim_list.VISIBLE:g} % of the curve's range" in readings
    assert f"above {100 * claim_list.GREAT:g} % of the range" in readings
    assert f"correlate by more than {claim_list.ALIKE}" in readings
    assert f"differ by less than {100 * claim_list.LITTLE:g} % among" in readings
    assert f"means of the four differ by less than {100 * claim_list.SMALL:g} %" in readings


VARIED = [claim for claim in ON_MACHINES if isinstance(claim.judge, Varied)]


@pytest.mark.parametrize("claim", numbered(VARIED))
def test_a_threshold_is_told_with_one_below_and_one_above(claim: Claim) -> None:
    assert isinstance(claim.judge, Varied)
    low, used, high = claim.judge.shown
    assert used == claim.judge.used
    assert low < used < high
    for known, verdict in ((right(), True), (wrong(), False)):
        assert claim.judge(known) is claim.judge.at(used)(known) is verdict


def test_greatly_is_asked_at_2_5_and_10_per_cent() -> None:
    greatly = [claim for claim in VARIED if "greatly" in claim.text]
    assert [claim.judge.shown for claim in greatly if isinstance(claim.judge, Varied)] == 2 * [
        (0.02, 0.05, 0.1)
    ]
    start = "Clearance makes the pin force fluctuate greatly"
    judge = next(claim.judge for claim in CLAIMS if claim.text.startswith(start))
    assert isinstance(judge, Varied)
    known = with_row("rms_force", 0.0, 0.0, 700.0, 0.0)  # 7 % of the range
    assert [judge.at(share)(known) for share in judge.shown] == [True, True, False]


def test_no_impulse_is_no_impact() -> None:
    known = right().measures
    still = Evidence(dict(known) | {MODE_1: dict(known[MODE_1]) | {"impulse": Measured(0.0)}})
    assert judged("Mode 1 starts the columns with an impact", still) is False


def test_a_claim_is_a_value() -> None:
    assert replace(CLAIMS[0], text="Other.") != CLAIMS[0]
