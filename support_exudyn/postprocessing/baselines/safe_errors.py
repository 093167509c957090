"""Errors of curves that are to hold for all of their records together, and on other processors."""

from collections.abc import Iterable

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.with_errors import curve_errors
from support_exudyn.simulation.result import Result

# Share of the largest value of a unit, of the whole run, that an error is at least: what is nothing in truth,
# as the force of a pin that carries nothing or what is missing of an energy, is left by rounding of others.
ROUNDING = 1e-12


def safe_errors(result: Result, names: Iterable[str]) -> dict[str, Series]:
    """Errors of channels at every record, (n,), in their units, by name; NaN if the run has none.

    Those of `curve_errors`, at least the largest before: of thousands of records none is to be told by chance,
    and in chaos what is behind an impact is not more certain than that is. Rounding is added.
    """
    largest: dict[str, float] = {}
    for one in result.channels.values():
        size = float(np.abs(one.values[np.isfinite(one.values)]).max(initial=0.0))
        largest[one.unit] = max(largest.get(one.unit, 0.0), size)
    return {
        name: np.maximum.accumulate(errors) + ROUNDING * largest[result.unit(name)]
        for name, errors in curve_errors(result, names).items()
    }
