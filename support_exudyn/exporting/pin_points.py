"""The pins of a run as points that move, with what happens in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support_exudyn.drawing.poses import Poses
from support_exudyn.exporting.mesh_series import Frame, MeshSeries
from support_exudyn.exporting.names import Named, numbered
from support_exudyn.result import Result
from support_exudyn.scenario import Scenario
from support_exudyn.spatial.lift import at
from support_exudyn.trajectory import Series
from user_forces.values import InputError, Vector3


@dataclass(frozen=True)
class PinPoint:
    """A pin: its name in the channels, the body whose point it is, the point in the start posture [m]."""

    name: str
    body: str
    point: Vector3
    loose: bool


def pin_points_of(scenario: Scenario) -> list[PinPoint]:
    """All pins; in space all bearings.

    Of a loose pin the journal's centre, in space its middle; of an ideal one the point that both bodies share.
    In the plane a pin stands for those of a pair, and lies between them (z = 0).
    """
    loose = scenario.clearance_pins
    found = []
    for name, pin, place in _places(scenario):
        first = pin not in loose or loose[pin].bore == "second"
        body, point = (place[0], place[1]) if first else (place[2], place[3])
        found.append(PinPoint(name, body, point, pin in loose))
    return found


Ends = tuple[str, Vector3, str, Vector3]


def _places(scenario: Scenario) -> list[tuple[str, str, Ends]]:
    """Name in the channels, name of the planar pin, and both bodies with their points."""
    if scenario.dimensions == 3:
        bearings = scenario.space.bearings.items()
        return [
            (name, b.pin, (b.first, b.first_point, b.second, b.second_point))
            for name, b in bearings
            if not b.is_guide
        ]
    return [
        (name, name, (p.first, at(p.first_point, 0.0), p.second, at(p.second_point, 0.0)))
        for name, p in scenario.linkage.pins.items()
    ]


class PinPoints:
    """All pins of a run.

    Raises InputError if the run has not recorded a force, depth or slip.
    """

    def __init__(self, result: Result) -> None:
        self._result = result
        self._pins = pin_points_of(result.scenario)
        poses = Poses(result)
        rows = result.time.size
        self._places = _stacked([poses.of(pin.body).path(pin.point) for pin in self._pins], (rows, 3))
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
                "loose": np.array([pin.loose for pin in self._pins], dtype=np.int32),
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

    def _force(self, pin: PinPoint) -> Series:
        axes = "xyz" if self._result.scenario.dimensions == 3 else "xy"
        force = np.zeros((self._result.time.size, 3))
        for k, axis in enumerate(axes):
            force[:, k] = self._channel(f"pin.{pin.name}.force_{axis}")
        return force

    def _contact(self, pin: PinPoint, what: str) -> Series:
        if not pin.loose:
            return np.full(self._result.time.size, np.nan)
        return self._channel(f"pin.{pin.name}.{what}")

    def _channel(self, name: str) -> Series:
        if name not in self._result.channels:
            raise InputError(
                f"channel {name!r}: was not recorded, and pins are written with it; allowed: runs of a "
                "scenario with channels = ('*',)"
            )
        return self._result[name]


def _stacked(of_pins: list[Series], shape: tuple[int, ...]) -> Series:
    """Arrays of this shape, one of each pin, also if there is no pin."""
    return np.array(of_pins).reshape(len(of_pins), *shape)
