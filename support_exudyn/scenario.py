"""Everything that determines a run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field, replace
from typing import Annotated, Literal

from pydantic import Field, model_validator

from support_exudyn.columns import ColumnModel, OilColumn
from support_exudyn.drives import Drive, Held
from support_exudyn.machine import Linkage, Machine
from support_exudyn.pins import ClearancePin, Pin
from user_forces.values import Fraction, Positive, Real, Value, Vector2, value


@value
class SolverSettings(Value):
    """Settings of the generalised-alpha solver.

    Arguments:
        spectral_radius: rho at infinite frequency, from 0 (all high-frequency content damped out in a
            step) to 1 (none). At 0.5 the joint forces are quiet at small steps; at 0.9 rounding
            shows in them below a step of 0.2 ms.
        newton_tolerance: relative tolerance of Newton's residual, > 0.
        impact_steps: how many steps an impact takes at least, from the touch to the parting of an undamped
            one of the same speed; 16 to 10000. Steps are so short from the touch until the surfaces part, or
            until the depth swings little any more. Errors are of second order; 512 delivers any
            restitution within 1e-5.
        backend: what evaluates the force of clearance pins: "python", a Python function, or "symbolic", the
            same law as an expression of the engine. Python still watches the contact once a step.
    """

    spectral_radius: Fraction = 0.5
    newton_tolerance: Annotated[Real, Field(gt=0, le=1e-3)] = 1e-8
    impact_steps: Annotated[int, Field(ge=16, le=10000)] = 512
    backend: Literal["python", "symbolic"] = "python"


@value
class Scenario(Value):
    """One run: a machine, its pins, how it starts and is driven, and how finely it is computed.

    Arguments:
        machine: what is simulated.
        pins: for each pin that is not ideal (or to say so), what it is, by name.
        columns: for each column that is not rigid (or to say so), what it is, by name.
        drive: how all driven parts move: columns extend [m], cranks turn [rad]. Into an oil column it lets oil.
        duration: end time [s], > 0; the run starts at 0.
        start: "concentric": every journal in the middle of its bore, velocities as the machine says and as
            the drive has them with ideal pins; "settled": at rest in static equilibrium under gravity.
        gravity: acceleration [m/s^2].
        step: largest time step [s], > 0. Steps are equal parts of the time between two records; they are
            cut at impacts.
        record_period: time between records [s], > 0.
        solver: settings of the time integration.
    """

    machine: Machine
    pins: Mapping[str, Pin] = field(default_factory=dict)
    columns: Mapping[str, ColumnModel] = field(default_factory=dict)
    drive: Drive = field(default_factory=Held)
    duration: Positive
    start: Literal["concentric", "settled"] = "concentric"
    gravity: Vector2 = (0.0, -9.81)
    step: Annotated[Real, Field(gt=0, le=0.1)] = 5e-4
    record_period: Positive = 1e-3
    solver: SolverSettings = field(default_factory=SolverSettings)

    @model_validator(mode="after")
    def _fits_the_machine(self) -> Scenario:
        linkage = self.machine.linkage()
        places = linkage.pins
        for name in self.pins:
            if name not in places:
                raise ValueError(
                    f"pins.{name}: the machine has no such pin; allowed: {', '.join(places) or 'none'}"
                )
        for name, place in places.items():
            apart = math.dist(place.first_point, place.second_point)
            if apart > 1e-9 and name not in self.clearance_pins:
                raise ValueError(
                    f"pins.{name}: its points on both bodies are {apart:.3g} m apart at the start; "
                    "allowed for an ideal pin: 0, for a clearance pin: any"
                )
        if self.record_period > self.duration:
            raise ValueError(
                f"record_period = {self.record_period} s: allowed: at most the duration, {self.duration} s"
            )
        if self.start == "settled" and self.drive.initial_speed != 0.0:
            raise ValueError(
                "start = 'settled': is at rest, but the drive moves from the start on "
                f"({self.drive.initial_speed} per s); allowed with this drive: 'concentric'"
            )
        self._check_columns(linkage)
        self.machine.check_extension(*self.drive.span(self.duration))
        return self

    def _check_columns(self, linkage: Linkage) -> None:
        for name, column in self.columns.items():
            if name not in linkage.columns:
                raise ValueError(
                    f"columns.{name}: the machine has no such column; "
                    f"allowed: {', '.join(linkage.columns) or 'none'}"
                )
            column.check_extension(self.drive.span(self.duration)[0], name)

    def refined(self, factor: int = 2) -> Scenario:
        """The same run with all steps, also those of impacts, so many times shorter.

        The difference between both runs is the numerical error that studies report.
        """
        finer = replace(self.solver, impact_steps=factor * self.solver.impact_steps)
        # steps never reach over a record
        return replace(self, step=min(self.step, self.record_period) / factor, solver=finer)

    @property
    def clearance_pins(self) -> dict[str, ClearancePin]:
        """The pins that have clearance, by name."""
        return {name: pin for name, pin in self.pins.items() if isinstance(pin, ClearancePin)}

    @property
    def oil_columns(self) -> dict[str, OilColumn]:
        """The columns that give, by name."""
        return {name: column for name, column in self.columns.items() if isinstance(column, OilColumn)}
