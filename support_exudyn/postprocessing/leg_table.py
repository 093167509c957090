"""What hydraulic legs with elements have done in a run, as rows of a table."""

from __future__ import annotations

from collections.abc import Sequence

from support_exudyn.mechanics.trajectory import OilEvent
from support_exudyn.postprocessing.figures.units import said
from support_exudyn.simulation.result import Result

LEGS = ("leg", "what", ">times", ">first", ">last")
FILLED = "filled"  # what ends where a cavity begins, see `OilEvent`

Row = tuple[str, ...]


def leg_rows(result: Result, after: float = 0.0, until: float = float("inf")) -> list[Row]:
    """What happened in every leg between two times [s]: leg, what, how often, when first and last.

    Rows tell when something began; of cavities, when they did.
    """
    rows: list[Row] = []
    for name, events in result.oil_events.items():
        inside = [event for event in events if after <= event.time <= until]
        kinds = dict.fromkeys(event.what for event in inside)
        found = [(_named(what), _begins(inside, what)) for what in kinds]
        found = [(what, times) for what, times in found if times]
        if not found:
            rows.append((name, "nothing opened, boiled or met a stop", "", "", ""))
        for what, times in found:
            rows.append((name, what, str(len(times)), said(times[0], "s", 6), said(times[-1], "s", 6)))
    return rows


def _named(what: str) -> str:
    """What began: of a chamber that is no longer filled, a cavity."""
    return f"cavity in the {what.removesuffix(FILLED).strip()}" if what.endswith(FILLED) else what


def _begins(events: Sequence[OilEvent], what: str) -> list[float]:
    """The times [s] at which it began."""
    return [event.time for event in events if event.what == what and event.begins != what.endswith(FILLED)]
