"""From judgements to verdicts: shares, their intervals, undecided machines, thresholds and repetitions."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.claims.claim_list import CLAIMS, Claim, Stiffness, Varied
from studies.claims.evidence import Evidence, Measured, Verdict
from studies.claims.plausible import Choice, samples
from studies.claims.verdicts import KINDS, Count, Ruling, independent, rule
from tests.cases.evidence_cases import right, wrong

Sample = Mapping[str, Choice]
MACHINES = samples(256, 7)
SHOWN = {True: Measured(1.0), False: Measured(-1.0), None: Measured(1.0, 2.0)}
CLAIM = Claim("section 0", "It is above zero.", "m > 0", lambda e: e["run", "m"].above(0.0))


def evidence(verdict: Verdict) -> Evidence:
    """Of a machine that judges CLAIM so."""
    return Evidence({"run": {"m": SHOWN[verdict]}})


def ruling(verdicts: Sequence[Verdict], reference: Verdict = True, claim: Claim = CLAIM) -> Ruling:
    """Of the first machines, judging so."""
    machines = [(machine, evidence(v)) for machine, v in zip(MACHINES, verdicts, strict=False)]
    return rule(claim, evidence(reference), machines)


# --- shares ---


@given(holds=st.integers(0, 200), fails=st.integers(0, 200))
def test_the_interval_is_wilsons(holds: int, fails: int) -> None:
    n = holds + fails
    if not n:
        assert Count().interval == (0.0, 1.0)
        return
    z, p = 1.959963984540054, holds / n  # z: 97.5 % of a normal distribution lie below
    centre = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    # rounding alone
    assert Count(holds, fails).interval == pytest.approx((centre - half, centre + half), abs=1e-12)


@given(holds=st.integers(0, 30), fails=st.integers(0, 30), undecided=st.integers(0, 60))
def test_undecided_machines_are_reported_and_widen_the_interval(holds: int, fails: int, undecided: int) -> None:
    found = ruling([True] * holds + [False] * fails + [None] * undecided).first
    assert found == (holds, fails, undecided)
    assert found.share == (holds / (holds + fails) if holds + fails else None)
    if undecided and found.share is not None:
        assert f"{undecided} undecided" in str(found)
    low, high = found.interval
    for of_them in range(undecided + 1):  # whatever they are, the share lies inside
        all_decided = Count(holds + of_them, fails + undecided - of_them)
        if sum(all_decided):
            assert low - 1e-12 <= all_decided.interval[0]
            assert all_decided.interval[1] <= high + 1e-12


# --- verdicts ---


@pytest.mark.parametrize(
    ("holds", "fails", "undecided", "kind"),
    [
        (80, 0, 0, "holds"),
        (72, 0, 0, "needs more machines"),  # Wilson: 1 / (1 + 1.96^2 / 72) = 0.949
        (395, 5, 0, "holds"),  # one machine that differs is no reason against it
        (79, 1, 0, "needs more machines"),
        (1, 0, 0, "needs more machines"),
        (16, 4, 0, "in part"),
        (1, 3, 0, "needs more machines"),
        (0, 80, 0, "fails"),
        (5, 395, 0, "fails"),
        (0, 8, 0, "needs more machines"),
        (0, 0, 0, "needs more machines"),
        (40, 20, 20, "in part"),  # 50 to 75 % whatever the undecided machines are
        (80, 0, 2, "needs more machines"),
        (100, 0, 100, "not measurable"),  # 50 to 100 %: more machines do not help
        (0, 0, 80, "not measurable"),
    ],
)
def test_the_interval_decides(holds: int, fails: int, undecided: int, kind: str) -> None:
    verdicts: list[Verdict] = [True] * holds + [False] * fails + [None] * undecided
    assert Count(holds, fails, undecided).kind == kind
    assert (
        ruling(verdicts[:256], reference=None).kind
        == Count(*map(verdicts[:256].count, (True, False, None))).kind
    )


def test_a_closed_form_asks_no_machine() -> None:
    found = ruling([False] * 100, claim=replace(CLAIM, judge=Stiffness((1.5,))))
    assert (found.kind, found.first, found.ours) == ("holds", Count(), "857942.947")


@pytest.mark.parametrize(("known", "kind", "number"), [(right(), "holds", 34), (wrong(), "fails", 34)])
def test_statements_that_are_contained_in_others_are_counted_once(
    known: Evidence, kind: str, number: int
) -> None:
    rulings = [rule(claim, known, [(MACHINES[0], known)] * 100) for claim in CLAIMS]
    judged = [ruling for ruling in rulings if ruling.claim.judge is not None and not ruling.claim.closed_form]
    assert {ruling.kind for ruling in judged} == {kind}
    names = {ruling.claim.name for ruling in independent(rulings)}
    assert "angles fall with size" in names
    assert not {"columns tilt", "front nearer to the vertical", "rear away from the vertical"} & names
    assert len(names) == number


@pytest.mark.parametrize(
    ("judged", "text"),
    [
        (
            lambda machine: machine["sliding_coefficient"] > 0.2,
            r"mu_d below 0\.\d+ 0 %, mu_d above 0\.\d+ \d+ %",
        ),
        (
            lambda machine: machine["bore"] == "base",
            "the bore in the base 100 %, the bore in the rear link 0 %",
        ),
        (lambda machine: True, ""),  # all judge alike
    ],
)
def test_the_datum_on_which_a_verdict_depends_is_named(judged: Callable[[Sample], bool], text: str) -> None:
    assert re.fullmatch(text, ruling([judged(machine) for machine in MACHINES]).depends)


# --- thresholds ---


def by_threshold(values: Sequence[float]) -> Ruling:
    """Of a claim that m is above a threshold, of machines with these values."""
    judge = Varied(lambda bound: lambda e: e["run", "m"].above(bound), 5.0, (2.0, 5.0, 10.0))
    known = [Evidence({"run": {"m": Measured(value)}}) for value in values]
    return rule(replace(CLAIM, judge=judge), known[0], list(zip(MACHINES, known, strict=False)))


@pytest.mark.parametrize(
    ("value", "machines", "kinds", "hangs"),
    [
        (7.0, 80, ["holds", "holds", "fails"], True),
        (20.0, 80, ["holds"] * 3, False),
        (7.0, 8, ["needs more machines"] * 3, False),  # few machines are no reason to hang
    ],
)
def test_a_verdict_hangs_on_a_threshold_that_changes_it(
    value: float, machines: int, kinds: list[str], hangs: bool
) -> None:
    found = by_threshold([value] * machines)
    assert [at.counted.kind for at in found.thresholds] == kinds
    assert found.hangs is hangs
    assert set(kinds) <= set(KINDS)
