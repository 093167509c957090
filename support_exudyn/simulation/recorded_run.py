"""What a run records: channels over time, contacts, impulses, counts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from support_exudyn.mechanics.time_statistics import TimeStatistics, TimeWindow, statistics_of_records
from support_exudyn.mechanics.trajectory import Counts, Impulse, OilEvent, Series
from support_exudyn.scenario.recorded_channels import Channel
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.provenance import WARNINGS
from user_forces.contact_state import Onset
from user_forces.values.names import Named, UnknownNameError
from user_forces.values.value import InputError, short

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


@dataclass(frozen=True)
class RecordedRun:
    """What a finished run has recorded, without its errors and its file.

    scenario: what was run. channels: quantities over time by name, see `result["tip.x"]`.
    onsets: for each clearance pin the beginnings of contact. largest_force: for each clearance pin the
    largest force [N] at any time, also inside steps. largest_force_time: when it is [s]; in the
    Exudyn formulation the end of the step that has it.
    impulses: where the speed of
    rigid actuators or cranks jumped. counts: what the solver did.
    oil_events: for each hydraulic leg with elements, when valves opened and closed, cavities grew and were
    filled, and stops were met.
    wall_time: [s], of building, settling and integrating, of all runs that an accuracy took.
    provenance: versions and platform.
    statistics: of all channels, from every step; None: of a file of an earlier version, see `over_time`.
    goal: the accuracy that was asked for, None if none was; `scenario` then has the settings that were chosen.
    coarser: the same run with longer steps, which has one of its own; from their distances errors are
    estimated.
    """

    scenario: Scenario
    channels: Mapping[str, Channel]
    onsets: Mapping[str, tuple[Onset, ...]]
    largest_force: Mapping[str, float]
    impulses: tuple[Impulse, ...]
    counts: Counts
    wall_time: float
    provenance: Mapping[str, str]
    largest_force_time: Mapping[str, float] = field(default_factory=dict)
    oil_events: Mapping[str, tuple[OilEvent, ...]] = field(default_factory=dict)
    statistics: TimeStatistics | None = None
    goal: float | None = None
    coarser: RecordedRun | None = None

    def __post_init__(self) -> None:
        """Let what is asked for by a wrong name be told with those that look like it."""
        kinds = {"channels": "channel", "onsets": "clearance pin", "largest_force": "clearance pin"}
        kinds["largest_force_time"] = "clearance pin"
        kinds["oil_events"] = "hydraulic leg with elements"
        for name, kind in kinds.items():
            object.__setattr__(self, name, Named(getattr(self, name), kind))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on friction that a law cannot hold, see `slow_slip`."""
        return tuple(self.provenance.get(WARNINGS, "").splitlines())

    def __repr__(self) -> str:
        """In a line; all else is asked for by name."""
        what = f"{type(self).__name__} of {type(self.scenario.machine).__name__}, {self.scenario.formulation}"
        said = f"{len(self.channels)} channels, {self.time.size} records from 0 to {self.time[-1]:g} s"
        return f"<{what}: {said}>"

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a channel, shape (n,), in SI."""
        return self._channel(name).values

    def _ipython_key_completions_(self) -> list[str]:
        """Names of the channels, which notebooks complete."""
        return list(self.channels)

    def unit(self, name: str) -> str:
        """Unit of a channel."""
        return self._channel(name).unit

    def _channel(self, name: str) -> Channel:
        if not isinstance(name, str):
            raise UnknownNameError(f"{short(name)}: no such channel; allowed: names, see `channels`")
        if name not in self.channels and name in self.scenario.channel_definitions:
            raise UnknownNameError(
                f"{name!r}: was not recorded, for the scenario asks for channels = {self.scenario.channels}; "
                "allowed: runs of a scenario that asks for it too"
            )
        if name not in self.channels:
            near = get_close_matches(name, self.channels, 3, 0.4) or list(self.channels)[:3]
            raise UnknownNameError(
                f"{short(name)}: no such channel; there are {len(self.channels)}, see `channels`, among them "
                f"{', '.join(near)}"
            )
        return self.channels[name]

    @property
    def time(self) -> np.ndarray:
        """Times of the records [s], shape (n,)."""
        return self["time"]

    @cached_property
    def over_time(self) -> TimeStatistics:
        """Statistics of all channels over time: from every step, or from the records if that is not known."""
        if self.statistics is not None:
            return self.statistics
        return statistics_of_records(self.time, {name: one.values for name, one in self.channels.items()})

    def window(self, name: str, after: float = 0.0, until: float = math.inf) -> TimeWindow:
        """What a channel does between two times [s]: mean, deviation, extremes; in its unit.

        Raises InputError if the run does not last between them, UnknownNameError if it has no such channel.
        """
        values = self._channel(name).values
        self.check_window(after, until)
        known = self.over_time
        if name not in known.channels:  # the time itself
            known = statistics_of_records(self.time, {name: values})
        return known.window(name, after, until)

    def check_window(self, after: float, until: float) -> None:
        """Raise InputError if the run does not last between two times [s]."""
        if not self.over_time.lasts(after, until):
            raise InputError(
                f"after = {after} s, until = {until} s: the run does not last between them; allowed: times "
                f"around at least one from {self.time[0]:g} to {self.time[-1]:g} s"
            )

    @property
    def dissipated(self) -> float:
        """Energy dissipated in contacts and oil over the run [J]."""
        return float(self["energy.damping_loss"][-1] + self["energy.friction_loss"][-1])

    @property
    def energy_error(self) -> float:
        """Largest amount by which the energy balance is not closed at any record [J]."""
        return float(np.abs(self["energy.balance"]).max())

    def recorded(self, name: str, why: str) -> Series:
        """Values of a channel, shape (n,), in SI, which something cannot do without.

        why: what it is needed for, a sentence's end such as "pictures show it".

        Raises InputError if the run has not recorded it.
        """
        if name not in self.channels:
            allowed = "runs of a scenario with channels = ('*',)"
            raise InputError(f"channel {name!r}: was not recorded, and {why}; allowed: {allowed}")
        return self[name]


# --- tables of pandas and xarray ---


def to_pandas(run: RecordedRun) -> pd.DataFrame:
    """See `Result.to_pandas`."""
    import pandas  # it takes a third of a second

    columns = {name: channel.values for name, channel in run.channels.items() if name != "time"}
    frame = pandas.DataFrame(columns, index=pandas.Index(run.time, name="time"))
    frame.attrs = {
        "units": {name: channel.unit for name, channel in run.channels.items()},
        "meanings": {name: channel.meaning for name, channel in run.channels.items()},
    }
    return frame


def to_xarray(run: RecordedRun) -> xr.Dataset:
    """See `Result.to_xarray`."""
    try:
        import xarray
    except ModuleNotFoundError:
        raise InputError(
            "to_xarray: needs xarray, which is not installed; allowed: after "
            "python -m pip install 'support-exudyn[data]'"
        ) from None
    series = {
        name: ("time", channel.values, {"units": channel.unit, "long_name": channel.meaning})
        for name, channel in run.channels.items()
    }
    time = series.pop("time")
    about = {"machine": type(run.scenario.machine).__name__, "formulation": run.scenario.formulation}
    return xarray.Dataset(series, {"time": time}, {**about, **run.provenance})
