"""Claims, their judges and the verdicts: what errors leave open, shares, intervals, thresholds, repetitions."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.claims.claim_list import CLAIMS, Claim, Judge, stiffnesses
from studies.claims.evidence import RELATIONS, Evidence, Measured, Verdict, every
from studies.claims.plausible import Choice, samples
from studies.claims.verdicts import Count, Ruling, independent, rule
from studies.common import paper_machine
from tests.cases.evidence_cases import blurred, right, wrong

Sample = Mapping[str, Choice]
MACHINES = samples(256, 7)
SHOWN = {True: Measured(1.0), False: Measured(-1.0), None: Measured(1.0, 2.0)}
CLAIM = Claim("section 0", "It is above zero.", "m > 0", Judge("above", ("m",), ("run",)))
RANK = {False: 0, None: 1, True: 2}  # by Kleene: and is the least
measured = st.builds(Measured, st.integers(-(10**6), 10**6).map(float), st.integers(0, 10**4).map(float))


def ruling(verdicts: Sequence[Verdict], claim: Claim = CLAIM) -> Ruling:
    """Of the first machines, judging so."""
    machines = [(machine, {"run": {"m": SHOWN[v]}}) for machine, v in zip(MACHINES, verdicts, strict=False)]
    return rule(claim, {"run": {"m": SHOWN[True]}}, machines)


# --- comparisons with errors ---


@given(one=measured, other=measured)
def test_a_comparison_is_decided_if_nothing_possible_contradicts_it(one: Measured, other: Measured) -> None:
    ends = list(itertools.product(*((m.value - m.error, m.value + m.error) for m in (one, other))))
    sure = {all(a > b for a, b in ends): True, all(a < b for a, b in ends): False}
    assert one.above(other) is sure.get(True)


@given(verdicts=st.lists(st.sampled_from((True, None, False)), max_size=5))
def test_every_obeys_kleenes_logic(verdicts: list[Verdict]) -> None:
    assert RANK[every(verdicts)] == min((RANK[v] for v in verdicts), default=2)


M = Measured
ROWS: list[tuple[str, list[Measured], float, Measured | None, Verdict]] = [
    ("rising", [M(1.0), M(2.0), M(3.0)], 0.0, None, True),
    ("rising", [M(1.0), M(3.0), M(2.0)], 0.0, None, False),
    ("rising", [M(1.0), M(2.0, 1.5), M(3.0)], 0.0, None, None),
    ("rising", [M(3.0), M(2.0, 0.5), M(1.0, 10.0)], 0.0, None, False),
    ("falling", [M(3.0), M(2.0), M(1.0)], 0.0, None, True),
    ("within", [M(100.0), M(103.0), M(98.0)], 0.06, None, True),
    ("within", [M(100.0), M(103.0), M(98.0)], 0.04, None, False),
    ("within", [M(100.0, 1.0), M(103.0), M(98.0, 1.0)], 0.05, None, None),
    ("within", [M(-100.0), M(-103.0)], 0.05, None, True),  # a share of the size, not of the sign
    ("within", [M(1.0), M(2.0)], 0.05, M(-10.0), False),
    ("least inside", [M(6114.9), M(5938.1), M(6013.1), M(6188.9)], 0.0, None, True),  # the paper's
    ("least inside", [M(4.0), M(5.0), M(3.0), M(6.0)], 0.0, None, True),  # it may be at 1.5 mm
    ("least inside", [M(1.0), M(2.0), M(3.0), M(4.0)], 0.0, None, False),
    ("least inside", [M(2.0), M(3.0), M(3.0), M(1.0)], 0.0, None, False),
    ("jump", [M(1.0), M(1.1), M(2.0), M(1.6)], 1.5, None, False),
]


@pytest.mark.parametrize(("relation", "row", "at", "of", "verdict"), ROWS)
def test_relations_of_rows(
    relation: str, row: list[Measured], at: float, of: Measured | None, verdict: Verdict
) -> None:
    assert RELATIONS[relation](row, at, of) is verdict


# --- the list ---


@pytest.mark.parametrize("claim", [claim for claim in CLAIMS if claim.judge], ids=lambda claim: claim.name)
def test_no_judge_is_stuck(claim: Claim) -> None:
    judge = claim.judge
    assert judge is not None
    assert judge(right()) is True
    assert judge(wrong()) is False
    assert judge(blurred(right())) is None
    assert judge(blurred(wrong())) is None
    for name in judge.measures:  # each part of a claim counts
        spoilt = {case: row | {name: wrong()[case].get(name, M(0.0))} for case, row in right().items()}
        assert judge(spoilt) is False
    assert re.search(r"\d", judge.describe(right()))


def test_closed_forms_are_judged_to_all_digits_printed(monkeypatch: pytest.MonkeyPatch) -> None:
    closed, ours = [claim for claim in CLAIMS if claim.stiffness_mm], paper_machine.stiffness
    assert [stiffnesses(claim)[0] for claim in closed] == [True, True]
    found = rule(closed[0], {}, [])
    assert (found.kind, found.first, found.ours) == ("holds", Count(), "857942.947")
    monkeypatch.setattr(paper_machine, "stiffness", lambda size: ours(size) + 0.001 * 1e3**1.5)
    assert [stiffnesses(claim)[0] for claim in closed] == [False, False]  # the last digit printed


# --- verdicts ---


@given(holds=st.integers(0, 30), fails=st.integers(0, 30), undecided=st.integers(0, 60))
def test_undecided_machines_are_reported_and_widen_the_interval(holds: int, fails: int, undecided: int) -> None:
    found = ruling([True] * holds + [False] * fails + [None] * undecided).first
    assert found == (holds, fails, undecided)
    if undecided and found.share is not None:
        assert f"{undecided} undecided" in str(found)
    low, high = found.interval
    for of_them in range(undecided + 1):  # whatever they are, the share lies inside
        all_decided = Count(holds + of_them, fails + undecided - of_them)
        assert low - 1e-12 <= all_decided.interval[0]
        assert all_decided.interval[1] <= high + 1e-12
    if n := holds + fails:
        z, p = 1.959963984540054, holds / n  # z: 97.5 % of a normal distribution lie below
        centre = (p + z * z / (2 * n)) / (1 + z * z / n)
        half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
        # rounding alone
        assert Count(holds, fails).interval == pytest.approx((centre - half, centre + half), abs=1e-12)


@pytest.mark.parametrize(
    ("holds", "fails", "undecided", "kind"),
    [
        (80, 0, 0, "holds"),
        (72, 0, 0, "needs more machines"),  # Wilson: 1 / (1 + 1.96^2 / 72) = 0.949
        (395, 5, 0, "holds"),  # one machine that differs is no reason against it
        (79, 1, 0, "needs more machines"),
        (16, 4, 0, "in part"),
        (0, 80, 0, "fails"),
        (0, 0, 0, "needs more machines"),
        (40, 20, 20, "in part"),  # 50 to 75 % whatever the undecided machines are
        (80, 0, 2, "needs more machines"),
        (100, 0, 100, "not measurable"),  # 50 to 100 %: more machines do not help
    ],
)
def test_the_interval_decides(holds: int, fails: int, undecided: int, kind: str) -> None:
    assert Count(holds, fails, undecided).kind == kind


@pytest.mark.parametrize(("known", "kind"), [(right(), "holds"), (wrong(), "fails")])
def test_statements_that_are_contained_in_others_are_counted_once(known: Evidence, kind: str) -> None:
    rulings = [rule(claim, known, [(MACHINES[0], known)] * 100) for claim in CLAIMS]
    assert {ruling.kind for ruling in rulings if ruling.claim.judge} == {kind}
    names = {ruling.claim.name for ruling in independent(rulings)}
    assert "angles fall with size" in names
    assert not {"columns tilt", "front nearer to the vertical", "rear away from the vertical"} & names
    assert len(names) == 34


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
    judge = Judge("above", ("m",), ("run",), 5.0, shown=(2.0, 5.0, 10.0))
    known = {"run": {"m": Measured(value)}}
    found = rule(replace(CLAIM, judge=judge), known, [(machine, known) for machine in MACHINES[:machines]])
    assert [counted.kind for counted in found.thresholds.values()] == kinds
    assert found.hangs is hangs
