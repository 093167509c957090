"""Which data of a machine decide a judgement: the bound, or the two together, that foretells most of them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from studies.claims.plausible import FACTORS, Factor, Sample

CUTS = 24  # bounds tried on a range
OTHER_THAN = "machines other than those with "
PAIR_GAIN = 0.03  # by how much two bounds together must beat the best one alone

TELLING = 0.01  # how often chance alone would part the machines so by a datum that is named

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Condition:
    """When a claim holds, in words.

    right: share of the machines for which that is so. unseen: the same for what is found on one half of the
    machines, judged on the other half; by chance alone it is no better than one answer for all.
    """

    text: str
    right: float
    unseen: float


def best_condition(decided: Sequence[tuple[Sample, bool]]) -> Condition | None:
    """The condition that foretells most judgements; None if there is only one kind of them.

    Tried are bounds on every factor, alone and in pairs, and that the claim holds where they are met, or except
    where they are met.
    """
    holds = np.array([verdict for _, verdict in decided])
    if holds.all() or not holds.any():
        return None
    texts, met = _bounds([sample for sample, _ in decided])
    places, other, right = _search(met, holds)
    text = (OTHER_THAN if other else "") + " and ".join(texts[place] for place in places)
    one = np.arange(len(holds)) % 2 == 0
    unseen = [_right_elsewhere(met, holds, half) for half in (one, ~one)]
    return Condition(text, right, float(np.mean(unseen)))


def _right_elsewhere(met: Mask, holds: Mask, half: Mask) -> float:
    """Share of the other half of the machines for which what is found on this half is right."""
    places, other, _ = _search(met[:, half], holds[half])
    foretold = met[list(places)].all(axis=0) != other
    return float((foretold == holds)[~half].mean())


def _search(met: Mask, holds: Mask) -> tuple[tuple[int, ...], bool, float]:
    """Places of the best bound or two, whether they say where it does not hold, and how often that is right."""
    single = max((_best(met, holds != other, other) for other in (False, True)), key=_right)
    double = max(_best_pairs(met, holds), key=_right)
    return double if _right(double) >= _right(single) + PAIR_GAIN else single


def _right(found: tuple[tuple[int, ...], bool, float]) -> float:
    return found[2]


def _best(met: Mask, goal: Mask, other: bool) -> tuple[tuple[int, ...], bool, float]:
    right = (met == goal).mean(axis=1)
    best = int(np.argmax(right))
    return (best,), other, float(right[best])


def _best_pairs(met: Mask, holds: Mask) -> list[tuple[tuple[int, ...], bool, float]]:
    """The two bounds that are best if what meets both holds, and those if all else does."""
    ones = met.astype(np.float32)  # which counts exactly
    # of the machines that meet both, those that hold less those that do not
    excess = np.where(holds, ones, -ones) @ ones.T
    found: list[tuple[tuple[int, ...], bool, float]] = []
    for other, place in ((False, excess.argmax()), (True, excess.argmin())):
        one, two = divmod(int(place), len(met))
        more = -float(excess[one, two]) if other else float(excess[one, two])
        found.append(((one, two), other, (more + np.count_nonzero(holds == other)) / len(holds)))
    return found


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


def dependence(decided: Sequence[tuple[Sample, bool]], factors: Sequence[Factor]) -> str:
    """The datum by which machines part most, with the share of each part; empty if by none beyond chance."""
    chance, text = min((_split(factor, decided) for factor in factors), key=lambda one: one[0])
    return text if chance < TELLING else ""


def shares_by(name: str, decided: Sequence[tuple[Sample, bool]]) -> str:
    """The share for which it holds, by the choices or halves of a datum, whatever chance does to them.

    Empty if all judge alike or a choice has no machine.
    """
    return next(_split(factor, decided)[1] for factor in FACTORS if factor.name == name)


def _split(factor: Factor, decided: Sequence[tuple[Sample, bool]]) -> tuple[float, str]:
    """How often chance alone would part the machines so by a datum, and the shares of the parts in words.

    By its choices, or by the middle of its range; by Pearson's test of independence.
    """
    from scipy.stats import chi2_contingency  # takes a second to import

    texts = [factor.chosen(choice) for choice in factor.choices] or [
        factor.bound(side, float(factor.at(0.5))) for side in ("below", "above")
    ]
    counts = np.zeros((len(texts), 2), dtype=np.int64)
    for sample, holds in decided:
        value = sample[factor.name]
        place = factor.choices.index(value) if isinstance(value, str) else int(value >= float(factor.at(0.5)))
        counts[place, int(not holds)] += 1
    if not (counts.any(axis=0).all() and counts.any(axis=1).all()):
        return 1.0, ""
    shares = counts[:, 0] / counts.sum(axis=1)
    told = ", ".join(f"{text} {100.0 * share:.0f} %" for text, share in zip(texts, shares, strict=True))
    return float(chi2_contingency(counts).pvalue), told
