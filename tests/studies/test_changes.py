"""Every verdict before and now: what is told of a change, and why."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from studies.claims.changes import FORMERS, Former, Judgements, change_table, differ, reason
from studies.claims.claim_list import CLAIMS, Claim
from studies.claims.plausible import Sample, samples
from studies.claims.verdicts import Ruling

CLAIM = Claim("section 0", "It is.", "m > 0", lambda e: True)
CLOSED = Claim("section 0", "It is.", "m > 0", lambda e: True, alone="closed form")
MACHINES = samples(80, 7)


def ruling(holds: int, fails: int, claim: Claim = CLAIM, verdict: str = "holds only") -> Ruling:
    return Ruling(claim, True, holds, fails, 0, "", verdict)


def by(rule: Callable[[Sample], bool]) -> list[tuple[Sample, bool]]:
    return [(machine, rule(machine)) for machine in MACHINES]


def told(before: Judgements, rise: Judgements, judged: list[tuple[Sample, bool]]) -> str:
    holds = sum(verdict for _, verdict in judged)
    return reason(Former(1, "holds only", before, rise), ruling(holds, len(judged) - holds), judged)


def test_every_claim_has_its_former_verdict() -> None:
    assert [former.claim for former in FORMERS] == list(range(1, len(CLAIMS) + 1))
    for former, claim in zip(FORMERS, CLAIMS, strict=True):
        assert (former.counts is None) == (claim.judge is None or bool(claim.alone) or claim.on_oil)
        for counts in (former.counts, former.rise):
            assert counts is None or sum(counts) == 128


@pytest.mark.parametrize(("claim", "percent"), [(21, 94), (28, 10), (29, 69), (30, 84)])
def test_the_rise_alone_as_window_makes_claims_more_likely(claim: int, percent: int) -> None:
    former = FORMERS[claim - 1]
    assert former.counts is not None
    assert former.rise is not None
    assert former.rise.share == pytest.approx(percent / 100, abs=0.005)
    assert (former.rise.share or 0.0) > 1.3 * (former.counts.share or 1.0)


def test_what_is_not_asked_of_machines_has_a_reason_too() -> None:
    unasked = Ruling(Claim("section 0", "It is.", "cannot be judged: no measure"), None, 0, 0, 0, "", "")
    assert reason(Former(1, ""), unasked, []) == "none: it has no measure"
    assert reason(Former(1, ""), ruling(0, 0, CLOSED), []) == "none: a closed form"


def test_what_was_asked_of_the_reference_support_alone_says_so() -> None:
    on_oil = Claim("section 0", "It is.", "m > 0", lambda e: True, on_oil=True)
    said = reason(Former(1, "not supported"), replace(ruling(8, 4, on_oil), reference=False), [])
    assert said.startswith("asked of machines now")
    assert said.endswith("on the reference support alone, where it fails")


def test_another_kind_of_verdict_by_fewer_machines_is_chance() -> None:
    former = Former(1, "holds", Judgements(126, 2), Judgements(126, 2))
    said = reason(former, ruling(78, 2, verdict="cannot be judged (80 machines: holds for 91 to 99 %)"), [])
    assert said == "none beyond the chance of other machines"


def test_the_same_share_has_no_reason() -> None:
    same = Judgements(64, 64)
    assert told(same, same, by(lambda machine: machine["bore"] == "base")) == "none"
    few = told(Judgements(60, 68), Judgements(60, 68), by(lambda machine: machine["bore"] == "base"))
    assert few == "none beyond the chance of other machines"


def test_the_window_is_named_where_it_changes_the_share() -> None:
    judged = by(lambda machine: machine["bore"] == "base")
    assert told(Judgements(32, 96), Judgements(64, 64), judged) == "averages over the rise alone make it 50 %"


def test_the_new_datum_that_decides_is_named_with_its_shares() -> None:
    few = Judgements(0, 128)
    said = told(few, few, by(lambda machine: machine["contact"] != "paper"))
    assert said.startswith("the new data make it 6")
    assert "(the contact paper 0 %, the contact internal 100 %, the contact cylinders 100 %)" in said
    said = told(few, few, by(lambda machine: float(machine["stroke_time"]) > 6.0))
    assert "stroke time below 6.32 s " in said
    assert "stroke time above 6.32 s 100 %" in said


def test_an_old_datum_is_not_taken_for_the_reason() -> None:
    few = Judgements(0, 128)
    assert told(few, few, by(lambda machine: machine["bore"] == "base")) == (
        "the new data make it 50 % (none of them alone)"
    )


def test_fishers_test_knows_what_chance_does() -> None:
    assert not differ(Judgements(64, 64), Judgements(44, 36))
    assert differ(Judgements(64, 64), Judgements(70, 10))


def test_a_share_is_told_once() -> None:
    verdicts = ["holds only for 25 % of the machines"] + ["holds"] * (len(CLAIMS) - 1)
    rulings = [ruling(20, 60, claim, verdict) for claim, verdict in zip(CLAIMS, verdicts, strict=True)]
    rows = change_table(rulings, [by(lambda machine: True)] * len(CLAIMS)).rows
    assert rows[0][3] == "holds only for 25 % of the machines"
    assert rows[1][3] == "holds: 25 %"
    assert rows[1][2] == "holds: 100 %"
