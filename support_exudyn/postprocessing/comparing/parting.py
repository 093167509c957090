"""When two curves with impacts part: from then on they are compared by their statistics only."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.simulation.result import Result

Values = npt.NDArray[np.float64]


class Parting(NamedTuple):
    """When two curves part.

    time: [s]; infinite: they do not. because: why, a sentence for users; "" if they do not.
    contact: name of the contact whose impact parts them; "" if none does.
    impacts: how many matched impacts lie before.
    growth: by what factor an impact multiplied differences in time before, the median; NaN if not known.
    """

    time: float
    because: str
    contact: str
    impacts: int
    growth: float


def parting_of_runs(first: Result, second: Result) -> Parting:
    """When two own runs part: at the earlier horizon of both, or at the first impact beyond both errors."""
    raise NotImplementedError


def parting_of_impacts(first: Mapping[str, Sequence[Onset]], second: Mapping[str, Sequence[Onset]]) -> Parting:
    """When two runs part of which one has no errors, by the impacts of contacts of the same names."""
    raise NotImplementedError


def impacts_of_force(time: Values, force: Values) -> tuple[Onset, ...]:
    """Impacts that show in a contact force: where it rises from zero, and where it falls back."""
    raise NotImplementedError
