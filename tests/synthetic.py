"""Results that no solver has made: channels of one's own, of a scene that fits them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from support_exudyn import Channel, Onset, Result, Scenario
from support_exudyn.mechanics.trajectory import Counts
from tests.cases.run_cases import PIN

UNITS = {"depth": "m", "eccentricity_x": "m", "eccentricity_y": "m", "force": "N"}


def result(
    scenario: Scenario,
    time: np.ndarray,
    channels: Mapping[str, tuple[np.ndarray, str]],
    onsets: Mapping[str, Sequence[Onset]] | None = None,
) -> Result:
    """A run with these channels: values and unit, by name."""
    made = {name: Channel(values, unit, f"meaning of {name}") for name, (values, unit) in channels.items()}
    impacts = {pin: tuple(found) for pin, found in (onsets or {}).items()}
    return Result(
        scenario=scenario,
        channels={"time": Channel(time, "s", "time"), **made},
        onsets=impacts,
        largest_force=dict.fromkeys(impacts, 0.0),
        impulses=(),
        counts=Counts(steps=1),
        wall_time=1.0,
        provenance={"python": "3"},
    )


def journal(
    scenario: Scenario,
    time: np.ndarray,
    x: np.ndarray,
    y: np.ndarray,
    onsets: Sequence[Onset] = (),
    pin: str = PIN,
    **others: tuple[np.ndarray, str],
) -> Result:
    """A run of which the journal's centre is known [m]."""
    clearance = scenario.clearance_pins[pin].contact.bearing.clearance
    depth = np.hypot(x, y) - clearance
    found = {"eccentricity_x": x, "eccentricity_y": y, "depth": depth, "force": np.maximum(depth, 0.0) * 1e9}
    channels = {f"pin.{pin}.{name}": (values, UNITS[name]) for name, values in found.items()}
    named = {name.replace("__", "."): one for name, one in others.items()}
    return result(scenario, time, channels | named, {pin: onsets})
