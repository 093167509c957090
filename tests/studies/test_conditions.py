"""Conditions under which a claim holds: those that were planted are found again."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Mapping

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from studies.claims.conditions import CUTS, OTHER_THAN, PAIR_GAIN, best_condition, dependence
from studies.claims.plausible import FACTORS, Choice, samples
from tests.often import often

MACHINES = samples(256, 7)
RANGES = [factor for factor in FACTORS if not factor.choices]
START_HEIGHT = [factor.name for factor in RANGES].index("start_height")
# a bound lies on one of the quantiles that are tried, at most half a step from where it was planted; a Latin
# hypercube has as many machines there as the step is wide, up to one at either end
NEAR = 0.5 / CUTS + 2.0 / len(MACHINES)

Rule = Callable[[Mapping[str, Choice]], bool]


def found(rule: Rule) -> tuple[str, float]:
    condition = best_condition([(machine, rule(machine)) for machine in MACHINES])
    assert condition is not None
    return condition.text, condition.right


def number(machine: Mapping[str, Choice], name: str) -> float:
    return float(machine[name])


# every bound as it can be worded: longer choices first, of which others are the beginning
CHOICES = {factor.chosen(choice): (factor.name, choice) for factor in FACTORS for choice in factor.choices}
NAMES = {factor.said: factor.name for factor in RANGES}
BOUND = re.compile(
    "|".join(re.escape(text) for text in sorted(CHOICES, key=len, reverse=True))
    + f"|({'|'.join(map(re.escape, NAMES))}) (above|below) ([-+.e0-9]+)"
)


def met_in_words(text: str, machine: Mapping[str, Choice]) -> bool:
    """Whether a machine meets a condition as it is worded."""
    met = []
    for bound in BOUND.finditer(text):
        said, side, cut = bound.groups()
        if said is None:
            name, choice = CHOICES[bound.group()]
            met.append(machine[name] == choice)
        else:
            met.append((number(machine, NAMES[said]) < float(cut)) == (side == "below"))
    assert met
    return all(met) != text.startswith(OTHER_THAN)


def chosen(name: str, choice: str) -> str:
    """A choice in words."""
    return next(factor.chosen(choice) for factor in FACTORS if factor.name == name)


def test_a_bound_on_friction_is_found() -> None:
    text, right = found(lambda m: number(m, "sliding_coefficient") > 0.2)
    assert re.fullmatch(r"mu_d above (0\.2|0\.20\d|0\.19\d)", text)
    assert right >= 1.0 - NEAR


def test_a_choice_is_found() -> None:
    assert found(lambda m: m["bore"] == "base") == (chosen("bore", "base"), 1.0)


def test_all_but_one_choice_is_found() -> None:
    assert found(lambda m: m["law"] != "exact") == (OTHER_THAN + chosen("law", "exact"), 1.0)


def test_two_together_are_found() -> None:
    text, right = found(lambda m: number(m, "dynamic_speed") < 0.01 and m["bore"] == "base")
    assert re.fullmatch(rf"v_d below 0\.0\d+ m/s and {chosen('bore', 'base')}", text)
    assert right >= 1.0 - NEAR


def test_all_except_two_together_are_found() -> None:
    text, right = found(lambda m: not (number(m, "dynamic_speed") < 0.01 and m["bore"] == "base"))
    assert re.fullmatch(rf"{OTHER_THAN}v_d below 0\.0\d+ m/s and {chosen('bore', 'base')}", text)
    assert right >= 1.0 - NEAR


def test_a_range_in_the_middle_is_found() -> None:
    text, right = found(lambda m: 0.1 < number(m, "sliding_coefficient") < 0.3)
    bounds = {bound.group(2): float(bound.group(3)) for bound in BOUND.finditer(text)}
    assert text.count("mu_d") == len(bounds) == 2
    assert bounds == pytest.approx({"above": 0.1, "below": 0.3}, rel=0.01)
    assert right >= 1.0 - 2.0 * NEAR


def test_the_second_bound_is_named_only_if_it_tells_something() -> None:
    strangers = {id(machine) for machine in MACHINES[:5]}  # less than PAIR_GAIN of them judge otherwise
    assert len(strangers) / len(MACHINES) < PAIR_GAIN
    text, right = found(lambda m: (m["bore"] == "base") != (id(m) in strangers))
    assert text == chosen("bore", "base")
    assert right == 1.0 - len(strangers) / len(MACHINES)


@settings(max_examples=often(25))
@given(place=st.integers(0, len(RANGES) - 1), share=st.floats(0.1, 0.9), above=st.booleans())
def test_any_bound_on_any_range_is_found(place: int, share: float, above: bool) -> None:
    factor = RANGES[place]
    bound = float(factor.at(share))
    text, right = found(lambda m: (number(m, factor.name) > bound) == above)
    assert text.startswith(f"{factor.said} {'above' if above else 'below'} ")
    assert right >= 1.0 - NEAR


@settings(max_examples=often(25))
@given(place=st.integers(0, len(RANGES) - 1), share=st.floats(0.1, 0.9))
@example(place=START_HEIGHT, share=0.75)  # a narrow range about 1
def test_a_bound_is_worded_so_that_it_can_be_applied(place: int, share: float) -> None:
    # what a reader makes of the printed number must be right for as many machines as is said, but for those
    # between the bound and its rounding: less than one step between the bounds that are tried
    factor = RANGES[place]
    bound = float(factor.at(share))
    text, right = found(lambda m: number(m, factor.name) > bound)
    as_read = sum(met_in_words(text, m) == (number(m, factor.name) > bound) for m in MACHINES)
    assert as_read / len(MACHINES) >= right - 1.0 / CUTS
    bounds = [float(bound[3]) for bound in BOUND.finditer(text)]
    assert all(factor.low <= bound <= factor.high for bound in bounds)


@pytest.mark.parametrize("verdict", [True, False])
def test_no_condition_is_looked_for_if_all_judge_alike(verdict: bool) -> None:
    assert best_condition([(machine, verdict) for machine in MACHINES[:8]]) is None


def test_the_share_that_is_right_is_counted_on_the_machines() -> None:
    # odd for no datum: whatever is found, its words are counted again
    judged = [(machine, n % 3 == 0) for n, machine in enumerate(MACHINES)]
    condition = best_condition(judged)
    assert condition is not None
    again = sum(met_in_words(condition.text, m) == verdict for m, verdict in judged) / len(judged)
    # bounds in words are rounded: machines between a bound and its rounding, for either of two bounds
    assert again == pytest.approx(condition.right, abs=2.0 / CUTS)
    assert condition.right > 2 / 3  # better than "never"


# --- the datum by which machines part ---


def test_the_datum_by_which_machines_part_is_named_with_its_shares() -> None:
    few = MACHINES[:27]
    judged = [(machine, machine["contact"] != "paper") for machine in few]
    assert dependence(judged, FACTORS) == (
        "the contact paper 0 %, the contact internal 100 %, the contact cylinders 100 %"
    )
    judged = [(machine, number(machine, "stroke_time") < 6.0) for machine in MACHINES]
    said = dependence(judged, FACTORS)
    assert said.startswith("stroke time below 6.32 s 9")
    assert said.endswith("above 6.32 s 0 %")


def test_machines_that_all_judge_alike_part_by_nothing() -> None:
    assert dependence([(machine, True) for machine in MACHINES], FACTORS) == ""


def test_chance_parts_machines_by_nothing() -> None:
    contact = [factor for factor in FACTORS if factor.name == "contact"]
    named = 0
    for seed in range(40):
        coin = random.Random(seed)
        named += bool(dependence([(machine, coin.random() < 0.6) for machine in MACHINES[:80]], contact))
    assert named <= 2  # by 1 % each
