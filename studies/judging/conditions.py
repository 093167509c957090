"""Which data of a machine decide a judgement: the bound, or the two together, that foretells most of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from studies.judging.plausible import FACTORS, Factor, Sample

CUTS = 24  # bounds tried on a range
OTHER_THAN = "machines other than those with "
PAIR_GAIN = 0.03  # by how much two bounds together must beat the best one alone

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Condition:
    """When a claim holds, in words, and the share of machines for which that is right."""

    text: str
    right: float


def best_condition(decided: Sequence[tuple[Sample, bool]]) -> Condition | None:
    """The condition that foretells most judgements; None if there is only one kind of them.

    Tried are bounds on every factor, alone and in pairs, and that the claim holds where they are met, or except
    where they are met.
    """
    holds = np.array([verdict for _, verdict in decided])
    if holds.all() or not holds.any():
        return None
    texts, met = _bounds([sample for sample, _ in decided])
    single = max(_best(texts, met, holds, ""), _best(texts, met, ~holds, OTHER_THAN), key=_right)
    double = max(_best_pair(texts, met, holds, ""), _best_pair(texts, met, ~holds, OTHER_THAN), key=_right)
    return double if double.right >= single.right + PAIR_GAIN else single


def _right(condition: Condition) -> float:
    return condition.right


def _best(texts: Sequence[str], met: Mask, goal: Mask, prefix: str) -> Condition:
    right = (met == goal).mean(axis=1)
    best = int(np.argmax(right))
    return Condition(prefix + texts[best], float(right[best]))


def _best_pair(texts: Sequence[str], met: Mask, goal: Mask, prefix: str) -> Condition:
    """The same for two bounds that are both met."""
    count = len(goal)
    ones = met.astype(float)
    both = ones @ ones.T
    hits = (ones * goal) @ ones.T
    right = (hits + (count - both - (goal.sum() - hits))) / count
    one, other = divmod(int(np.argmax(right)), len(texts))
    return Condition(f"{prefix}{texts[one]} and {texts[other]}", float(right[one, other]))


def _bounds(samples: Sequence[Sample]) -> tuple[list[str], Mask]:
    """All bounds in words, and which machines meet them, shape (bounds, machines)."""
    texts: list[str] = []
    met: list[Mask] = []
    for factor in FACTORS:
        for text, mask in _bounds_on(factor, samples):
            texts.append(text)
            met.append(mask)
    return texts, np.array(met)


def _bounds_on(factor: Factor, samples: Sequence[Sample]) -> list[tuple[str, Mask]]:
    if factor.choices:
        chosen = np.array([str(sample[factor.name]) for sample in samples])
        return [(factor.chosen(choice), chosen == choice) for choice in factor.choices]
    numbers = np.array([float(sample[factor.name]) for sample in samples])
    found = []
    for cut in np.unique(np.quantile(numbers, np.arange(1, CUTS) / CUTS)):
        found.append((factor.bound("below", cut), numbers < cut))
        found.append((factor.bound("above", cut), numbers >= cut))
    return found
