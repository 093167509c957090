"""Drives as people write them: a mode of the paper, or a table in a file."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from pydantic import model_validator

from support_exudyn.model.drives.drive import CubicStep, Stroke, UniformSpeed
from support_exudyn.model.drives.table_drive import TableDrive
from user_forces.values.units import Metres, Seconds
from user_forces.values.value import NonNegative, Positive, Real, Value, value


@value
class DriveMode(Value):
    """A stroke in one of the paper's drive modes.

    Arguments:
        mode: 1: constant speed from rest, without transition (`UniformSpeed`); 2: a smooth inlet (`CubicStep`).
        stroke: [m]; if nothing is said the machine's, else that of `Stroke`; negative to lower.
        start, end: of the stroke [s], those of `Stroke` if nothing is said; end > start >= 0.
    """

    mode: Literal[1, 2]
    stroke: Metres[Real] | None = None
    start: Seconds[NonNegative] = Stroke.start
    end: Seconds[Positive] = Stroke.end

    @model_validator(mode="after")
    def _is_a_stroke(self) -> DriveMode:
        if self.end <= self.start:
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s")
        return self

    def drive(self, stroke: float | None = None) -> Stroke:
        """The drive in full; stroke: of the machine's file [m], if this has none."""
        kind = UniformSpeed if self.mode == 1 else CubicStep
        chosen = stroke if self.stroke is None else self.stroke
        whole = kind(start=self.start, end=self.end)
        return whole if chosen is None else replace(whole, stroke=chosen)


@value
class DriveFile(Value):
    """A displacement over time from a CSV file, whose first line names columns as in `time_s,extension_mm`.

    Arguments:
        table: path of the file, from the folder of the scenario's file on.
        column: name of its column, without unit; may be left out if there is one besides the time.
        between: how the points are joined: "smooth", or "linear", at constant speeds that jump.
    """

    table: str
    column: str | None = None
    between: Literal["smooth", "linear"] = TableDrive.between


@value
class DrivesFile(Value):
    """Drives of several columns from one CSV file, `time_s,front_column_mm,rear_column_mm`.

    Arguments:
        table, between: as of `DriveFile`; each of its columns drives the part of the machine by its name.
    """

    table: str
    between: Literal["smooth", "linear"] = TableDrive.between
