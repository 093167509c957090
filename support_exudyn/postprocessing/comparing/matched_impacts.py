"""Impacts of one pin in two runs, matched in time: in their order, one to one."""

from collections.abc import Sequence
from typing import NamedTuple

from support_exudyn.mechanics.contact_state import Onset


class MatchedImpacts(NamedTuple):
    """Impacts of one contact in two runs.

    pairs: those that are matched, the first run's and the second run's, in time.
    only_first, only_second: those that have no partner.
    """

    pairs: tuple[tuple[Onset, Onset], ...]
    only_first: tuple[Onset, ...]
    only_second: tuple[Onset, ...]


def match_impacts(first: Sequence[Onset], second: Sequence[Onset]) -> MatchedImpacts:
    """Match impacts in order, one to one, so that the sum of their distances in time is least."""
    raise NotImplementedError
