"""What the solver needs of a model in the engine, be it in the plane or in space."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import exudyn

from support_exudyn.formulations.redundant.clearance.clearance_pin import LoosePin
from support_exudyn.formulations.redundant.scene.cylinder_item import CylinderItem
from support_exudyn.formulations.redundant.scene.driven_parts import DrivenParts
from support_exudyn.formulations.redundant.scene.load_item import LoadItem
from support_exudyn.formulations.redundant.scene.pin_friction import PinFriction
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.trajectory import CompliantSeries, Impulse, Series
from support_exudyn.model.linkage import PinPlace
from support_exudyn.scenario.scenario import Scenario

INITIAL = exudyn.ConfigurationType.Initial
CURRENT = exudyn.ConfigurationType.Current


class InEngine:
    """What every model in the engine can do.

    container: owns the system, and must live as long as it. mbs: the system. driven: all columns and cranks, by
    the drive that they follow. cylinders: the columns that follow none.
    """

    container: Any
    mbs: Any
    driven: tuple[DrivenParts, ...]
    cylinders: dict[str, CylinderItem]

    def release(self) -> None:
        """Let go of the engine's model: what its user functions know would never be freed."""
        mbs: Any = self.mbs
        mbs.SetPreStepUserFunction(0)
        mbs.SetPostNewtonUserFunction(0)
        mbs.SetPostStepUserFunction(0)
        self.container.Reset()

    def drive_to(self, t: float) -> None:
        """Set every column, crank and valve to where it is at time t [s]."""
        for parts in self.driven:
            parts.move_to(t)
        for cylinder in self.cylinders.values():
            cylinder.open_to(t)


class Massive(Protocol):
    """A body that has a mass."""

    @property
    def mass(self) -> float:
        """[kg]."""
        ...


class MassiveItem(Protocol):
    """A body in the engine."""

    @property
    def body(self) -> Massive:
        """Its data."""
        ...


class CompliantItem(Protocol):
    """A pin in the engine whose force follows from its deflection without contact."""

    @property
    def rounding(self) -> float:
        """The force by which rounding of positions lets it scatter [N]."""
        ...

    @property
    def place(self) -> PinPlace:
        """Where it is in the linkage."""
        ...

    def loss(self) -> float:
        """The power that is dissipated now [W]."""
        ...

    def series(self, motion: BodyMotion) -> CompliantSeries:
        """Force, moment and deflection at the records, from the motion of all bodies."""
        ...


class EngineScene(Protocol):
    """The model of one scenario, assembled and ready for the solver."""

    @property
    def scenario(self) -> Scenario:
        """What is modelled."""
        ...

    @property
    def mbs(self) -> Any:
        """The engine's system."""
        ...

    @property
    def bodies(self) -> Mapping[str, MassiveItem]:
        """All that move, by name."""
        ...

    @property
    def loose_pins(self) -> Mapping[str, LoosePin]:
        """Everything that may touch and part, by name."""
        ...

    @property
    def compliant_pins(self) -> Mapping[str, CompliantItem]:
        """Pins whose force follows from their deflection, by name."""
        ...

    @property
    def frictions(self) -> Mapping[str, PinFriction]:
        """Friction of ideal pins, by name."""
        ...

    @property
    def loads(self) -> Mapping[str, LoadItem]:
        """What presses on the machine, by name."""
        ...

    @property
    def weights(self) -> Mapping[str, Any]:
        """The engine's loads that are weights, by body."""
        ...

    @property
    def driven(self) -> tuple[DrivenParts, ...]:
        """All columns and cranks, by the drive that they follow."""
        ...

    @property
    def cylinders(self) -> Mapping[str, CylinderItem]:
        """Columns that are hydraulic cylinders, by name."""
        ...

    def drive_to(self, t: float) -> None:
        """Set every column and crank to where its drive has it at time t [s]."""

    def release(self) -> None:
        """Let go of the engine's model."""

    def jump(self, time: float) -> Impulse | None:
        """Give the bodies the velocities that belong to drives whose speed has jumped at a break [s]."""

    def align(self, time: float) -> float:
        """Give the bodies velocities that the constraints have at a time [s]; work of the drives in it [J]."""
        ...

    def refresh_memory(self) -> None:
        """Tell every loose pin that velocities have jumped."""

    def reset_memory(self) -> None:
        """Give every loose pin the memory that belongs to the initial state of the bodies."""

    def spins(self) -> dict[str, float]:
        """Angular velocity of every body [rad/s]."""
        ...

    def coordinate_masses(self) -> Series:
        """A mass for each of the engine's coordinates [kg], [kg m^2]."""
        ...


def slide(scene: EngineScene, rest: float) -> None:
    """Move on by a time [s] that is not worth a step, by the rates that the last one has ended with.

    Positions are then off by third order in it, and velocities and pressures by second. See
    `time_grid`.
    """
    data = scene.mbs.systemData
    velocity, acceleration = data.GetODE2Coordinates_t(), data.GetODE2Coordinates_tt()
    data.SetODE2Coordinates(data.GetODE2Coordinates() + rest * (velocity + 0.5 * rest * acceleration))
    data.SetODE2Coordinates_t(velocity + rest * acceleration)
    if scene.cylinders:
        data.SetODE1Coordinates(data.GetODE1Coordinates() + rest * data.GetODE1Coordinates_t())
    scene.refresh_memory()
