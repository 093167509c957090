"""The datum of a machine on which a judgement depends most."""

from collections.abc import Sequence

import numpy as np

from studies.claims.plausible import FACTORS, Factor, Sample

CHANCE = 0.01  # how often chance alone would part machines so by any of the data, if a datum is named


def dependence(decided: Sequence[tuple[Sample, bool]]) -> str:
    """The datum by which machines part most, with the share of each part; empty if by none beyond chance."""
    chance, text = min((_split(factor, decided) for factor in FACTORS), key=lambda part: part[0])
    return text if chance < CHANCE / len(FACTORS) else ""


def _split(factor: Factor, decided: Sequence[tuple[Sample, bool]]) -> tuple[float, str]:
    """How often chance alone would part the machines so by a datum, and the shares of the parts in words.

    By its choices, or by the median; by Pearson's test of independence.
    """
    from scipy.stats import chi2_contingency  # takes a second to import

    values = [sample[factor.name] for sample, _ in decided]
    if factor.choices:
        parts = {factor.chosen(choice): [value == choice for value in values] for choice in factor.choices}
    else:
        middle = float(np.median(np.array(values, dtype=float)))
        below = [float(value) < middle for value in values]
        parts = {factor.bound("below", middle): below, factor.bound("above", middle): [not x for x in below]}
    holds = np.array([verdict for _, verdict in decided])
    counts = np.array([[np.sum(holds[part]), np.sum(~holds[part])] for part in map(np.array, parts.values())])
    if not (counts.any(axis=0).all() and counts.any(axis=1).all()):
        return 1.0, ""
    shares = counts[:, 0] / counts.sum(axis=1)
    text = ", ".join(f"{part} {100.0 * share:.0f} %" for part, share in zip(parts, shares, strict=True))
    return float(chi2_contingency(counts).pvalue), text
