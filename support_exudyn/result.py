"""What comes out of a run, and its file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.channels import Channel
from support_exudyn.files import whole_file
from support_exudyn.impulse import Impulse
from support_exudyn.onset import Onset
from support_exudyn.scenario import Scenario
from support_exudyn.solver import Counts
from user_forces.values import InputError, Value

FORMAT = "support_exudyn result 2"


@dataclass(frozen=True)
class Result:
    """A finished run.

    scenario: what was run. channels: quantities over time by name, see `result["tip.x"]`.
    onsets: for each clearance pin the beginnings of contact. largest_force: for each clearance pin the
    largest force [N] at the end of any step, also between records. impulses: where the speed of
    rigid columns or cranks jumped. counts: what the solver did.
    wall_time: [s], of building, settling and integrating. provenance: versions and platform.
    """

    scenario: Scenario
    channels: Mapping[str, Channel]
    onsets: Mapping[str, tuple[Onset, ...]]
    largest_force: Mapping[str, float]
    impulses: tuple[Impulse, ...]
    counts: Counts
    wall_time: float
    provenance: Mapping[str, str]

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a channel, shape (n,), in SI."""
        return self._channel(name).values

    def unit(self, name: str) -> str:
        """Unit of a channel."""
        return self._channel(name).unit

    def _channel(self, name: str) -> Channel:
        if name not in self.channels:
            raise KeyError(f"{name!r}: no such channel; there are {', '.join(self.channels)}")
        return self.channels[name]

    @property
    def time(self) -> np.ndarray:
        """Times of the records [s], shape (n,)."""
        return self["time"]

    @property
    def dissipated(self) -> float:
        """Energy dissipated in contacts and oil over the run [J]."""
        return float(self["energy.damping_loss"][-1] + self["energy.friction_loss"][-1])

    @property
    def energy_error(self) -> float:
        """Largest amount by which the energy balance is not closed at any record [J]."""
        return float(np.abs(self["energy.balance"]).max())

    def save(self, path: str | Path) -> Path:
        """Write everything to one HDF5 file: /channels/NAME with units, and the rest as JSON attributes."""
        with whole_file(path) as temporary, h5py.File(temporary, "w") as file:
            file.attrs["format"] = FORMAT
            file.attrs["scenario"] = json.dumps(self.scenario.to_data())
            file.attrs["impulses"] = json.dumps([asdict(impulse) for impulse in self.impulses])
            file.attrs["counts"] = json.dumps(asdict(self.counts))
            file.attrs["wall_time_s"] = self.wall_time
            file.attrs["provenance"] = json.dumps(dict(self.provenance))
            for name, channel in self.channels.items():
                data = file.create_dataset(f"channels/{name}", data=channel.values)
                data.attrs["unit"] = channel.unit
                data.attrs["meaning"] = channel.meaning
            for name, onsets in self.onsets.items():
                data = file.create_dataset(f"onsets/{name}", data=np.array(onsets).reshape(-1, 2))
                data.attrs["columns"] = "time [s], approach speed [m/s]"
                data.attrs["largest_force_N"] = self.largest_force[name]
        return Path(path)

    @staticmethod
    def load(path: str | Path) -> Result:
        """Read what `save` wrote.

        Raises InputError if the file is not a whole result file; OSError if it cannot be opened at all.
        """
        if not Path(path).exists():
            raise FileNotFoundError(f"{path}: no such file")
        try:
            with h5py.File(path, "r") as file:
                return _read(file)
        except (OSError, KeyError, json.JSONDecodeError) as error:
            raise InputError(f"{path}: not a result file of this program, or damaged ({error})") from None


def _read(file: h5py.File) -> Result:
    if file.attrs.get("format") != FORMAT:
        raise KeyError(f"format is {file.attrs.get('format')!r}, expected {FORMAT!r}")

    def attribute(name: str) -> Any:
        return json.loads(file.attrs[name])

    onsets = file.get("onsets", {})
    return Result(
        scenario=Value.from_data(attribute("scenario")),
        channels={
            name: Channel(data[:], data.attrs["unit"], data.attrs["meaning"])
            for name, data in file["channels"].items()
        },
        onsets={name: tuple(Onset(*row) for row in data[:].tolist()) for name, data in onsets.items()},
        largest_force={name: float(data.attrs["largest_force_N"]) for name, data in onsets.items()},
        impulses=tuple(Impulse(**item) for item in attribute("impulses")),
        counts=Counts(**attribute("counts")),
        wall_time=float(file.attrs["wall_time_s"]),
        provenance=attribute("provenance"),
    )
