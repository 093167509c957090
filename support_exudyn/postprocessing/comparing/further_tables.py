"""Tables of a comparison beside that of the channels: statistics after the parting, impacts, bands."""

from __future__ import annotations

import math

from support_exudyn.postprocessing.comparing.files_compared import ComparedPair
from support_exudyn.postprocessing.comparing.statistics import Interval, StatisticDifference
from support_exudyn.postprocessing.comparing.told import DIGITS, NONE, Row, share
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable, said

STATISTICS = (
    "channel",
    "statistic",
    "unit",
    ">reference",
    ">other",
    ">difference",
    ">from",
    ">to",
    "difference is",
)
IMPACTS = (
    "contact", ">matched before parting", ">times apart, most", ">speeds apart, most", ">matched after",
    ">only in reference", ">only in other",
)  # fmt: skip
BANDS = ("channel", "unit", ">from [Hz]", ">to [Hz]", ">reference, RMS", ">other, RMS", ">difference")
MEAN, PER_SECOND = "mean", "impacts_per_second"


def statistics_rows(pair: ComparedPair) -> list[Row]:
    """A row for each statistic after the parting, with the confidence interval of the difference."""
    return [
        _statistic(name, one.unit, found)
        for name, one in pair.channels.items()
        for found in one.statistics.values()
    ]


def brief_statistics_rows(pair: ComparedPair) -> list[Row]:
    """Rows of the means alone, and of the statistics that are not equal."""
    return [
        _statistic(name, one.unit, found)
        for name, one in pair.channels.items()
        for found in one.statistics.values()
        if found.name == MEAN or found.equal is False
    ]


def _statistic(channel: str, unit: str, one: StatisticDifference) -> Row:
    size = max(abs(one.first.value), abs(one.second.value))
    shown = DisplayUnit("1/s", 1.0) if one.name == PER_SECOND else readable(unit, size)
    numbers = (_plain(item.value, shown.scale) for item in (one.first, one.second, one.difference))
    ends = (NONE, NONE) if one.not_told else _ends(one.difference, shown.scale)
    told = {True: "0 or not to be told from it", False: "not 0", None: one.not_told or "not known"}[one.equal]
    return channel, one.name.replace("_", " "), shown.name, *numbers, *ends, told


def _ends(one: Interval, scale: float) -> tuple[str, str]:
    return f"{scale * one.low:.3g}", f"{scale * one.high:.3g}"


def _plain(value: float, scale: float) -> str:
    return NONE if math.isnan(value) else f"{scale * value:.{DIGITS - 1}g}"


def impacts_rows(pair: ComparedPair) -> list[Row]:
    """A row for each contact that both runs know."""
    end = pair.parting.time
    rows = []
    for contact, found in pair.impacts.items():
        if not (found.pairs or found.only_first or found.only_second):
            continue
        before = [(one, other) for one, other in found.pairs if max(one.time, other.time) < end]
        late = said(max(abs(b.time - a.time) for a, b in before), "s") if before else NONE
        fast = said(max(abs(b.speed - a.speed) for a, b in before), "m/s") if before else NONE
        counts = (len(found.pairs) - len(before), len(found.only_first), len(found.only_second))
        rows.append((contact, str(len(before)), late, fast, *map(str, counts)))
    return rows


def bands_rows(pair: ComparedPair) -> list[Row]:
    """A row for each band of each channel whose spectra are compared."""
    rows: list[Row] = []
    for name, one in pair.channels.items():
        if one.bands is None:
            continue
        first, second = one.bands
        shown = readable(one.unit, float(max(first.rms.max(), second.rms.max())))
        for n, (mine, its) in enumerate(zip(first.rms, second.rms, strict=True)):
            ends = f"{first.edges[n]:.4g}", f"{first.edges[n + 1]:.4g}"
            change = share(its / mine - 1.0) if mine > 0.0 else NONE
            rows.append((name, shown.name, *ends, _plain(mine, shown.scale), _plain(its, shown.scale), change))
    return rows
