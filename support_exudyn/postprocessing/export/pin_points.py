"""The pins of a run as points that move, with what happens in them."""

from __future__ import annotations

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.export.mesh_series import Frame, MeshSeries
from support_exudyn.postprocessing.export.names import Named, numbered
from support_exudyn.postprocessing.look.placed_pins import End, PlacedPin, placed_pins
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.simulation.result import Result


class PinPoints:
    """All pins of a run; in space all bearings.

    Raises InputError if the run has not recorded a force, depth or slip.
    """

    def __init__(self, result: Result) -> None:
        self._result = result
        self._pins = placed_pins(result.scenario)
        poses = Poses(result)
        rows = result.time.size
        self._places = _stacked(
            [poses.of(end.body).path(end.point) for end in map(_shown, self._pins)], (rows, 3)
        )
        self._forces = _stacked([self._force(pin) for pin in self._pins], (rows, 3))
        self._depths = _stacked([self._contact(pin, "depth") for pin in self._pins], (rows,))
        self._slips = _stacked([self._contact(pin, "slip") for pin in self._pins], (rows,))

    @property
    def names(self) -> list[Named]:
        """Of the pins."""
        return numbered("pin", (pin.name for pin in self._pins))

    @property
    def series(self) -> MeshSeries | None:
        """The pins over time; None if there are none.

        Data: force_N of the first body on the second and its size force_magnitude_N; depth_m, negative in
        free flight, and slip_m_s, which an ideal pin has not (NaN); pin, see `names`; loose, 1 or 0.
        """
        if not self._pins:
            return None
        numbers = np.arange(len(self._pins), dtype=np.int32)
        return MeshSeries(
            name="pins",
            cell_type="vertex",
            cells=numbers[:, None],
            frame=self.frame,
            point_constants={
                "pin": numbers,
                "loose": np.array([pin.loose is not None for pin in self._pins], dtype=np.int32),
            },
        )

    def frame(self, record: int) -> Frame:
        """The pins at a record."""
        forces = self._forces[:, record]
        return Frame(
            self._places[:, record],
            {
                "force_N": forces,
                "force_magnitude_N": np.linalg.norm(forces, axis=1),
                "depth_m": self._depths[:, record],
                "slip_m_s": self._slips[:, record],
            },
        )

    def _force(self, pin: PlacedPin) -> Series:
        axes = "xyz" if self._result.scenario.dimensions == 3 else "xy"
        force = np.zeros((self._result.time.size, 3))
        for k, axis in enumerate(axes):
            force[:, k] = self._channel(f"pin.{pin.name}.force_{axis}")
        return force

    def _contact(self, pin: PlacedPin, what: str) -> Series:
        if pin.loose is None:
            return np.full(self._result.time.size, np.nan)
        return self._channel(f"pin.{pin.name}.{what}")

    def _channel(self, name: str) -> Series:
        return self._result.recorded(name, "pins are written with it")


def _stacked(of_pins: list[Series], shape: tuple[int, ...]) -> Series:
    """Arrays of this shape, one of each pin, also if there is no pin."""
    return np.array(of_pins).reshape(len(of_pins), *shape)


def _shown(pin: PlacedPin) -> End:
    """The end at which it is shown: the journal of a loose pin; of an ideal one both are at the same place."""
    return pin.first if pin.loose is None else pin.journal
