"""Channels of a run as tables of pandas and xarray, which need not be installed."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from support_exudyn.simulation.recorded_run import RecordedRun
from user_forces.values.value import InputError

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def to_pandas(run: RecordedRun) -> pd.DataFrame:
    """See `Result.to_pandas`."""
    pandas = library("pandas", "to_pandas")
    columns = {name: channel.values for name, channel in run.channels.items() if name != "time"}
    frame = pandas.DataFrame(columns, index=pandas.Index(run.time, name="time"))
    frame.attrs = {
        "units": {name: channel.unit for name, channel in run.channels.items()},
        "meanings": {name: channel.meaning for name, channel in run.channels.items()},
    }
    return frame


def to_xarray(run: RecordedRun) -> xr.Dataset:
    """See `Result.to_xarray`."""
    xarray = library("xarray", "to_xarray")
    series = {
        name: ("time", channel.values, {"units": channel.unit, "long_name": channel.meaning})
        for name, channel in run.channels.items()
    }
    time = series.pop("time")
    about = {"machine": type(run.scenario.machine).__name__, "formulation": run.scenario.formulation}
    return xarray.Dataset(series, {"time": time}, {**about, **run.provenance})


def library(name: str, what: str) -> Any:
    """A library that need not be installed; what: asks for it. Raises InputError if it is not there."""
    try:
        return import_module(name)
    except ModuleNotFoundError:
        raise InputError(
            f"{what}: needs {name}, which is not installed; allowed: after "
            "python -m pip install 'support-exudyn[data]'"
        ) from None
