"""Drives as people write them: a mode of the paper, or a table in a file."""

from __future__ import annotations

from typing import Literal

from pydantic import model_validator

from support_exudyn.drives import CubicStep, Stroke, UniformSpeed
from user_forces.quantity import Metres, Seconds
from user_forces.values import NonNegative, Positive, Real, Value, value


@value
class DriveMode(Value):
    """A stroke in one of the paper's drive modes.

    Arguments:
        mode: 1: constant speed from rest, without transition (`UniformSpeed`); 2: a smooth inlet (`CubicStep`).
        stroke: [m], 0.5 if nothing is said; negative to lower.
        start, end: of the stroke [s], 3 and 5 if nothing is said; end > start >= 0.
    """

    mode: Literal[1, 2]
    stroke: Metres[Real] = 0.5
    start: Seconds[NonNegative] = 3.0
    end: Seconds[Positive] = 5.0

    @model_validator(mode="after")
    def _is_a_stroke(self) -> DriveMode:
        if self.end <= self.start:
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s")
        return self

    @property
    def drive(self) -> Stroke:
        """The drive in full."""
        kind = UniformSpeed if self.mode == 1 else CubicStep
        return kind(stroke=self.stroke, start=self.start, end=self.end)


@value
class DriveFile(Value):
    """A displacement over time from a CSV file, whose first line names columns with units: `time_s,extension_mm`.

    Arguments:
        table: path of the file, from the folder of the scenario's file on.
        column: name of its column, without unit; may be left out if there is one besides the time.
        between: how the points are joined: "smooth", or "linear", at constant speeds that jump.
    """

    table: str
    column: str | None = None
    between: Literal["smooth", "linear"] = "smooth"


@value
class DrivesFile(Value):
    """Drives of several columns from one CSV file, `time_s,front_column_mm,rear_column_mm`.

    Arguments:
        table, between: as of `DriveFile`; each of its columns drives the part of the machine by its name.
    """

    table: str
    between: Literal["smooth", "linear"] = "smooth"
