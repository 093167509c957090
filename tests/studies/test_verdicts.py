"""From judgements to verdicts: shares, their uncertainty, and when a condition is named."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.claims.claim_list import Claim, Varied
from studies.claims.evidence import Evidence, Measured, Verdict
from studies.claims.plausible import Choice, samples
from studies.claims.plausible_runs import OIL
from studies.claims.verdicts import ENOUGH, TELLING, Ruling, known_to, rule

Sample = Mapping[str, Choice]
MACHINES = samples(256, 7)
SHOWN = {True: Measured(1.0), False: Measured(-1.0), None: Measured(1.0, 2.0)}
CLAIM = Claim("section 0", "It is above zero.", "m > 0", lambda e: e["run", "m"].above(0.0), lambda e: "ours")


def evidence(verdict: Verdict) -> Evidence:
    """Of a machine that judges CLAIM so."""
    return Evidence({"run": {"m": SHOWN[verdict]}})


def ruling(verdicts: Sequence[Verdict], reference: Verdict = True, claim: Claim = CLAIM) -> Ruling:
    """Of the first machines, judging so."""
    machines = [(machine, evidence(v)) for machine, v in zip(MACHINES, verdicts, strict=False)]
    return rule(claim, evidence(reference), machines)


def judged_by(rule_: Callable[[Sample], Verdict], number: int = 256) -> Ruling:
    machines = MACHINES if number == len(MACHINES) else samples(number, 7)
    return rule(CLAIM, evidence(True), [(machine, evidence(rule_(machine))) for machine in machines])


def friction(machine: Sample) -> float:
    return float(machine["sliding_coefficient"])


# --- shares ---


@given(holds=st.integers(0, 30), fails=st.integers(0, 30), left=st.integers(0, 60))
def test_open_judgements_are_told_but_not_counted(holds: int, fails: int, left: int) -> None:
    found = ruling([True] * holds + [False] * fails + [None] * left)
    assert (found.holds, found.fails, found.open) == (holds, fails, left)
    if holds + fails:
        assert found.share == holds / (holds + fails)
    else:
        assert found.share is None
        assert found.interval is None


@given(holds=st.integers(0, 200), fails=st.integers(0, 200))
def test_the_interval_is_wilsons(holds: int, fails: int) -> None:
    found = Ruling(CLAIM, True, holds, fails, 3, "", "")
    n = holds + fails
    if not n:
        assert found.interval is None
        return
    z, p = 1.959963984540054, holds / n  # z: 97.5 % of a normal distribution lie below
    centre = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    # rounding alone
    assert found.interval == pytest.approx((centre - half, centre + half), abs=1e-12)


def test_a_share_of_one_half_is_known_to_so_many_points() -> None:
    assert known_to(128) == pytest.approx(0.0854, abs=1e-4)  # Wilson: 1.96 / 2 / sqrt(128 + 1.96^2)
    assert known_to(80) == pytest.approx(0.107, abs=1e-3)


# --- verdicts by share; below ENOUGH machines no condition is looked for ---


@pytest.mark.parametrize(
    ("holds", "fails", "verdict"),
    [
        (80, 0, "holds"),
        (72, 0, "cannot be judged (72 machines: holds for 94.9 to 100 %)"),  # Wilson: 1 / (1 + 1.96^2 / 72)
        (1, 0, "cannot be judged (1 machine: holds for 21 to 100 %)"),
        (16, 4, "holds only for 80 % of the machines"),
        (1, 3, "cannot be judged (4 machines: holds for 4.6 to 70 %)"),
        (8, 12, "holds only for 40 % of the machines"),
        (0, 80, "not supported"),
        (0, 8, "cannot be judged (8 machines: holds for 0 to 32 %)"),
    ],
)
def test_the_share_decides(holds: int, fails: int, verdict: str) -> None:
    assert ruling([True] * holds + [False] * fails).verdict == verdict
    # what is open changes nothing, nor does the reference support
    assert ruling([None] * 20 + [True] * holds + [False] * fails, reference=None).verdict == verdict


@pytest.mark.parametrize("kind", list(SHOWN))
def test_without_machines_the_reference_support_decides(kind: Verdict) -> None:
    said = {True: "holds", False: "not supported", None: "cannot be judged: within the numerical error"}
    for found in (ruling([], kind), ruling([None, None], kind)):
        assert found.verdict == said[kind]
        assert found.reference is kind
        assert found.share is None


def test_a_claim_on_the_reference_support_alone_asks_no_machine() -> None:
    alone = Claim(CLAIM.where, CLAIM.text, CLAIM.reading, CLAIM.judge, CLAIM.tell, alone="reference alone")
    found = ruling([False] * 100, claim=alone)
    assert (found.holds, found.fails, found.open) == (0, 0, 0)
    assert found.verdict == "holds"
    assert found.ours == "ours"


def test_a_claim_without_a_judge_cannot_be_judged() -> None:
    found = ruling([True] * 100, claim=Claim("section 0", "It is good.", "cannot be judged: no measure"))
    assert found.verdict == "cannot be judged"
    assert found.reference is None
    assert found.share is None
    assert found.ours == ""


# --- conditions ---


def test_a_condition_that_is_nearly_always_right_is_the_verdict() -> None:
    found = judged_by(lambda m: friction(m) > 0.2)
    assert re.fullmatch(r"holds only for mu_d above 0\.(2|20\d|19\d) \(right for 100 %\)", found.verdict)


def test_a_condition_that_is_often_right_is_the_most_telling() -> None:
    coin = random.Random(3)
    found = judged_by(lambda m: (friction(m) > 0.2) != (coin.random() < 0.22))
    # 22 % judge otherwise: the bound is right for 78 %, between 50 + 5 % and TELLING; sampling leaves 5 %
    assert found.verdict.startswith(
        f"holds only for {100 * (found.share or 0.0):.0f} % of the machines; most t"
    )
    assert "most telling: mu_d above 0." in found.verdict
    right = float(found.verdict.partition("right for ")[2].split()[0]) / 100
    assert right == pytest.approx(0.78, abs=0.05)
    assert right < TELLING


def test_what_is_open_does_not_enter_a_condition() -> None:
    found = judged_by(lambda m: None if m["bore"] == "base" else friction(m) > 0.2)
    assert found.open == 128  # half of a Latin hypercube
    assert found.verdict.startswith("holds only for mu_d above 0.")


def test_few_machines_name_no_condition() -> None:
    few = judged_by(lambda m: friction(m) > 0.2, ENOUGH - 1)
    assert "mu_d" not in few.verdict
    assert few.verdict.endswith("% of the machines")
    assert "mu_d above" in judged_by(lambda m: friction(m) > 0.2, ENOUGH).verdict


def test_few_decided_machines_name_no_condition_either() -> None:
    for_few = judged_by(lambda m: friction(m) > 0.2 if m["law"] in ("exact", "flores") else None)
    assert 0 < for_few.holds + for_few.fails < ENOUGH
    assert for_few.verdict.endswith("% of the machines")


@pytest.mark.parametrize("share", [0.5, 0.7, 0.8, 0.9])
@pytest.mark.parametrize("number", [ENOUGH, pytest.param(128, marks=pytest.mark.slow), 256])
def test_judgements_by_chance_have_no_condition(number: int, share: float) -> None:
    # thousands of bounds are tried, and the best of them foretells some of what is mere chance; of five
    # drawings one at most may be taken in
    coin = random.Random(f"{number} {share}")
    verdicts = [judged_by(lambda _: coin.random() < share, number).verdict for _ in range(5)]
    assert sum("right for" in verdict for verdict in verdicts) <= 1


def test_the_error_is_the_largest_of_the_numbers_told() -> None:
    evidence = Evidence(
        {"ideal": {"a": Measured(100.0, 1.0), "b": Measured(1.0, 0.02), "c": Measured(1.0, 0.5)}}
    )
    claim = replace(
        CLAIM, judge=lambda e: True, tell=lambda e: f"{e['ideal', 'a'].value} {e['ideal', 'b'].value}"
    )
    # c is not told
    assert rule(claim, evidence, []).error == pytest.approx(0.02)
    closed = replace(claim, tell=lambda e: "exact")
    assert rule(closed, evidence, []).error is None


# --- on oil ---

ON_OIL = replace(CLAIM, on_oil=True)


def on_oil(rule_: Callable[[Sample], Verdict]) -> list[tuple[Sample, Evidence]]:
    """27 machines of which one in three was run on oil."""
    found: list[tuple[Sample, Evidence]] = []
    for n, machine in enumerate(MACHINES[:81]):
        known = dict(evidence(rule_(machine)).measures)
        found.append((machine, Evidence(known if n % 3 else known | {OIL: {}})))
    return found


def test_a_claim_on_oil_asks_those_that_were_run_on_oil_and_says_what_the_contact_does() -> None:
    found = rule(ON_OIL, evidence(False), on_oil(lambda m: m["contact"] != "paper"))
    assert found.holds + found.fails == 27
    assert found.verdict.startswith(f"holds only for {100 * (found.share or 0.0):.0f} % of the machines: ")
    assert "the contact paper 0 %, the contact internal 100 %, the contact cylinders 100 %" in found.verdict
    assert rule(ON_OIL, evidence(True), on_oil(lambda m: True)).kind == "cannot be judged"  # 27 are few


# --- thresholds ---


def by_threshold(values: Sequence[float]) -> Ruling:
    """Of a claim that m is above a threshold, of machines with these values."""
    judge = Varied(lambda bound: lambda e: e["run", "m"].above(bound), 5.0, (2.0, 5.0, 10.0))
    known = [Evidence({"run": {"m": Measured(value)}}) for value in values]
    return rule(replace(CLAIM, judge=judge), known[0], list(zip(MACHINES, known, strict=False)))


def test_a_verdict_that_hangs_on_its_threshold_says_so() -> None:
    found = by_threshold([7.0] * 80)
    assert [one.kind for one in found.thresholds] == ["holds", "holds", "not supported"]
    assert [one.share for one in found.thresholds] == [1.0, 1.0, 0.0]
    assert found.verdict == "holds; hangs on the threshold"


def test_a_verdict_that_does_not_hang_on_it_says_nothing() -> None:
    found = by_threshold([20.0] * 80)
    assert not found.hangs
    assert found.verdict == "holds"


def test_too_few_machines_are_no_reason_to_hang() -> None:
    found = by_threshold([7.0] * 8)
    assert {one.kind for one in found.thresholds} == {"cannot be judged"}
    assert not found.hangs
