"""What oil columns and hydraulic cylinders can have besides their oil."""

from __future__ import annotations

from abc import ABC, abstractmethod

from support_exudyn.model.actuator_model import ActuatorModel
from support_exudyn.model.hydraulics.lines import Line
from support_exudyn.model.hydraulics.motion import EndStops, SealFriction, SecondStage
from support_exudyn.model.hydraulics.oil import ATMOSPHERE, TrappedAir
from support_exudyn.model.hydraulics.sharing import Shared
from support_exudyn.model.hydraulics.valves import YieldValve
from user_forces.values.units import Pascals
from user_forces.values.value import InputError, Positive, Real, value

ELEMENTS = (  # fields of a leg that make it more than its oil
    "yield_valve",
    "vapour_pressure",
    "trapped_air",
    "line",
    "seal_friction",
    "end_stops",
    "second_stage",
    "setting_pressure",
    "check_valve",
    "rod_relief",
)


@value
class HydraulicLeg(Shared, ActuatorModel, ABC):
    """An actuator on oil, and what it has besides; each is None by default, which leaves it out.

    Pressures are those above the atmosphere's. Where an element takes part, the oil in each chamber is counted,
    and its pressure follows from that and the chamber's volume.

    Arguments:
        yield_valve: lets oil out of the piston side above a pressure.
        vapour_pressure: below which no pressure falls [Pa], > -101325: there the oil boils, and a cavity grows
            until it is filled again; -99e3 for water. None: oil pulls as well as it pushes.
        trapped_air: in the piston side.
        line: between the inlet, or what a drive lets in, and the piston side.
        seal_friction: of seals and guide rings.
        end_stops: where the stroke ends.
        second_stage: the inner stage, if the leg is telescopic.
        setting_pressure: of the piston side at the start [Pa], > 0, with the tank's on the rod side; None: what
            carries the static load of the start posture with ideal pins.
    """

    yield_valve: YieldValve | None = None
    vapour_pressure: Pascals[Real] | None = None
    trapped_air: TrappedAir | None = None
    line: Line | None = None
    seal_friction: SealFriction | None = None
    end_stops: EndStops | None = None
    second_stage: SecondStage | None = None
    setting_pressure: Pascals[Positive] | None = None

    @property
    def hydraulic(self) -> HydraulicLeg:
        """It holds its length by oil itself."""
        return self

    @property
    def elements(self) -> tuple[str, ...]:
        """Names of the fields that make it more than its oil."""
        return tuple(name for name in ELEMENTS if getattr(self, name, None) is not None)

    @abstractmethod
    def stiffness(self, extension: float) -> float:
        """Stiffness of the closed oil [N/m] at an extension since the start [m]."""

    def check_elements(self, where: str) -> None:
        """Raise InputError if they do not go together; where: path of the leg."""
        lowest = self.vapour_pressure
        if lowest is not None and lowest <= -ATMOSPHERE:
            raise InputError(
                f"{where}.vapour_pressure = {lowest} Pa: allowed: > -{ATMOSPHERE} Pa, which is no "
                "pressure at all"
            )
        if self.second_stage is not None and self.end_stops is None:
            raise InputError(
                f"{where}.end_stops = None: allowed with a second stage: stops of the outer one, "
                "whose lowest place releases the foot valve"
            )
