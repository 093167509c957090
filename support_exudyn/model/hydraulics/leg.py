"""Legs: actuators on oil. A drive lets oil into an `OilColumn`, a valve into a `HydraulicCylinder`.

Both are settings of the same leg, whose physics `scene/hydraulics` computes. In a cylinder

    dp0/dt = B / V0 (Q0 - A0 v),    V0 = A0 (h0 + e) + H0      piston side
    dp1/dt = B / V1 (Q1 + A1 v),    V1 = A1 (h1 - e) + H1      rod side
    F = p0 A0 - p1 A1 - d v

e is the extension since the start, v its rate; F pushes the ends apart. Flows follow from the opening o:

    Q = o Qn sqrt(|dp| / dpn) sign(dp),   dp: pump less chamber, or chamber less tank
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import field, fields
from functools import cached_property
from typing import ClassVar

from support_exudyn.model.hydraulics.elements import (
    ATMOSPHERE,
    EndStops,
    SealFriction,
    SecondStage,
    Shared,
    TrappedAir,
)
from support_exudyn.model.hydraulics.inlets import ClosedInlet, Inlet
from support_exudyn.model.hydraulics.valves import (
    NO_CHECK,
    SMOOTH,
    CheckValve,
    LegValve,
    Line,
    Path,
    Room,
    YieldValve,
    let_in,
    pass_foot,
)
from user_forces.kernel import Formula
from user_forces.values.units import (
    CubicMetres,
    CubicMetresPerSecond,
    Metres,
    NewtonSecondsPerMetre,
    Pascals,
    SquareMetres,
)
from user_forces.values.value import InputError, NonNegative, Positive, Real, Value, value

CHECK_OPEN = "check valve open"
TAKEN = (  # names of parts of a leg
    *("piston", "rod", "tube", "line", "tank", "supply"),
    *("inlet", "rod_inlet", "yield_valve", "rod_relief", "foot"),
)


class ActuatorModel(Value, ABC):
    """How a driven actuator holds its length."""

    def check_extension(self, lowest: float, name: str) -> None:
        """Raise InputError if the actuator cannot be drawn in so far [m]; by default any can."""
        del lowest, name

    def check_elements(self, where: str) -> None:
        """Raise InputError if what it consists of does not go together; by default it does.

        Arguments:
            where: its path in the scenario, `actuators.front_column`.
        """
        del where

    @property
    def hydraulic(self) -> ActuatorModel | None:
        """What holds its length by oil; None if nothing gives."""
        return None


@value
class HydraulicLeg(Shared, ActuatorModel, ABC):
    """An actuator on oil, and what it has besides; each is None by default, which leaves it out.

    Pressures are those above the atmosphere's. The oil in each chamber is counted, and its pressure follows
    from that and the chamber's volume.

    Arguments:
        bore_area: of the piston, all legs of a pair together [m^2], > 0.
        oil_length: of the oil under the piston at the start [m], > 0.
        bulk_modulus: of the oil or emulsion [Pa], > 0.
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
        valves: others, by name, see `LegValve`; what is recorded of them is named leg.valve.flow and so on.
    """

    extensive: ClassVar[tuple[str, ...]] = ("bore_area",)

    bore_area: SquareMetres[Positive]
    oil_length: Metres[Positive]
    bulk_modulus: Pascals[Positive]
    yield_valve: YieldValve | None = None
    vapour_pressure: Pascals[Real] | None = None
    trapped_air: TrappedAir | None = None
    line: Line | None = None
    seal_friction: SealFriction | None = None
    end_stops: EndStops | None = None
    second_stage: SecondStage | None = None
    setting_pressure: Pascals[Positive] | None = None
    valves: Mapping[str, LegValve] = field(default_factory=dict, hash=False)  # a table has no hash

    @property
    def hydraulic(self) -> HydraulicLeg:
        """It holds its length by oil itself."""
        return self

    @property
    def elements(self) -> tuple[str, ...]:
        """Names of the fields, left out by default, that make it more than its oil."""
        optional = [one.name for one in fields(self) if one.default is None or one.name == "valves"]
        return tuple(name for name in optional if getattr(self, name) not in (None, {}))

    @property
    def sources(self) -> dict[str, float]:
        """Constant pressures that oil comes from or goes to [Pa], by name."""
        return {"tank": 0.0}

    @property
    def check(self) -> tuple[float, ...]:
        """Numbers of the check valve, see `CheckValve.numbers`."""
        return NO_CHECK

    @cached_property
    def rooms(self) -> dict[str, Room]:
        """Rooms of the leg by name."""
        return self._rooms()

    @cached_property
    def paths(self) -> dict[str, Path]:
        """Ways of the oil by name; of two that are recorded as the same flow the last one is."""
        return self._paths()

    # a cached property of a base class would be seen by other threads in place of the leg's own
    def _rooms(self) -> dict[str, Room]:
        found = {"piston": Room(self.bore_area * self.oil_length, self.bore_area, air=self.trapped_air)}
        if (stage := self.second_stage) is not None:
            found["tube"] = Room(stage.bore_area * stage.oil_length, -stage.bore_area, stage.bore_area)
        of_valves = {"line": self.line, **self.valves}
        return found | {name: valve.room for name, valve in of_valves.items() if valve and valve.room}

    def _paths(self) -> dict[str, Path]:
        found = {}
        if (line := self.line) is not None:
            path = line.path("line")._replace(flow="flow", passed="", loss="line_loss", event=CHECK_OPEN)
            found["line"] = path._replace(formula=line.behind(self.check), joins=self.check == NO_CHECK)
        if self.yield_valve is not None:
            found["yield_valve"] = self.yield_valve.path("yield_valve")._replace(
                flow="yield_flow", passed="yielded", loss="yield_loss", event="yield valve open"
            )
        if (stage := self.second_stage) is not None and self.end_stops is not None:
            numbers = stage.nominal_flow / math.sqrt(stage.nominal_drop), SMOOTH * stage.nominal_drop
            foot = Formula(pass_foot, (*numbers, self.end_stops.lowest, stage.release))
            found["foot"] = Path(foot, "piston", "tube", loss="stage_loss")
        return found | {name: valve.path(name) for name, valve in self.valves.items()}

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
        known = [*self.sources, *self.rooms]
        for name, valve in self.valves.items():
            if name in TAKEN or not name.isidentifier():
                raise InputError(
                    f"{where}.valves.{name}: allowed: a name of letters, none of {', '.join(TAKEN)}"
                )
            path = valve.path(name)
            for end in (path.before, path.after):
                if end not in known:
                    raise InputError(
                        f"{where}.valves.{name}: joins {end!r}, which the leg does not have; allowed: "
                        f"{', '.join(known)}"
                    )


@value
class OilColumn(HydraulicLeg):
    """A massless linear actuator whose column of oil is compressible; the drive lets oil into it.

        F = k u,   k = B A / (h + extension)

    u is by how much the oil is compressed: length at the start + precompression + extension - length. The
    precompression carries the static load of the start posture with ideal pins, so that a machine at rest
    stays there. k is that of a closed volume of oil; steel, seals and hoses are taken as stiff. Nothing damps,
    and the oil pulls as well as it pushes. Elements change that, see `HydraulicLeg`: with a `line` the drive's
    oil comes through a hose whose resistance damps, with a `vapour_pressure` oil that is pulled boils.

    Arguments:
        bore_area: A, area of the piston, all actuators of a pair together [m^2], > 0.
        oil_length: h, length of the oil under the piston at the start [m], > 0.
        bulk_modulus: B of the oil or emulsion [Pa], > 0; 1.96e9 by the published stiffness of four shields.
    """

    removed: ClassVar[Mapping[str, str]] = {
        "damping_time": "allowed: a line, whose resistance damps the column: its volume, nominal_flow and "
        "nominal_drop"
    }

    def stiffness(self, extension: float) -> float:
        """k [N/m] of the closed oil at an extension from the start [m]."""
        return self.bulk_modulus * self.bore_area / (self.oil_length + extension)

    def check_extension(self, lowest: float, name: str) -> None:
        """Raise InputError if no oil would be left under the piston."""
        if self.oil_length + lowest <= 0.0:
            raise InputError(
                f"actuators.{name}.oil_length = {self.oil_length} m: the drive draws the actuator in by "
                f"{-lowest:.4g} m and no oil is left; allowed: more than that"
            )


@value
class HydraulicCylinder(HydraulicLeg):
    """A massless actuator that is a hydraulic cylinder: it moves by the oil that its valve lets in.

    No drive moves it. Until the valve opens, the oil in both chambers carries the static load of the start
    posture with ideal pins: the chamber that the load presses has the pressure for it, the other one that of
    the tank. Pipe, valve and fittings are one resistance. Without a check valve oil flows back where a
    chamber has more pressure than the pump. Oil pulls as well as it pushes unless a `vapour_pressure` says
    where it boils. A run in which the piston comes to an end of its cylinder is refused.

    Arguments: those of `HydraulicLeg`, and
        rod_side_area: the annulus around the rod, all together [m^2], > 0.
        oil_length: length of the oil under the piston at the start [m], > 0, less than the actuator.
        rod_side_length: length of the oil around the rod at the start [m], > 0: by so much it can extend.
        bulk_modulus: of the oil or emulsion, with what hoses and cylinders give [Pa], > 0.
        system_pressure: of the pump [Pa], > tank_pressure.
        nominal_flow: through the fully open valve at `nominal_drop`, all cylinders together, either side
            [m^3/s], > 0.
        nominal_drop: of the pressure, at which that flows [Pa], > 0, 1 MPa by default.
        tank_pressure: [Pa], >= 0, 0 by default.
        hose_volume: between valve and piston side, all together [m^3], > 0, 1 litre by default.
        rod_side_hose_volume: between valve and rod side, all together [m^3], > 0, 1 litre by default.
        damping: viscous, of the seals, all together [N s/m], >= 0, 0 by default.
        inlet: how the valve opens over time; closed by default.
        check_valve: holds the oil of the piston side; None: where it has more pressure than the pump, oil flows
            back.
        rod_relief: lets oil out of the rod side above a pressure; None: nothing does.
    """

    extensive: ClassVar[tuple[str, ...]] = (
        "bore_area",
        "rod_side_area",
        "nominal_flow",
        "hose_volume",
        "rod_side_hose_volume",
        "damping",
    )

    rod_side_area: SquareMetres[Positive]
    rod_side_length: Metres[Positive]
    system_pressure: Pascals[Positive]
    nominal_flow: CubicMetresPerSecond[Positive]
    nominal_drop: Pascals[Positive] = 1e6
    tank_pressure: Pascals[NonNegative] = 0.0
    hose_volume: CubicMetres[Positive] = 1e-3
    rod_side_hose_volume: CubicMetres[Positive] = 1e-3
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0
    inlet: Inlet = field(default_factory=ClosedInlet)
    check_valve: CheckValve | None = None
    rod_relief: YieldValve | None = None

    def check_length(self, length: float, name: str) -> None:
        """Raise InputError if the cylinder does not fit into an actuator of this length [m] at the start."""
        if self.oil_length >= length:
            raise InputError(
                f"actuators.{name}.oil_length = {self.oil_length} m: the actuator is {length:.4g} m long at "
                "the start; allowed: less than that"
            )
        if self.system_pressure <= self.tank_pressure:
            raise InputError(
                f"actuators.{name}.system_pressure = {self.system_pressure} Pa: allowed: > tank_pressure = "
                f"{self.tank_pressure} Pa"
            )

    def past_end(self, extension: float, name: str) -> str:
        """The message that an extension since the start [m] is beyond an end of the cylinder; empty: it is not.

        A second stage has stops of its own.
        """
        low, high = -self.oil_length, self.rod_side_length
        if self.second_stage is not None or low <= extension <= high:
            return ""
        return (
            f"{name} is {'drawn in' if extension < low else 'extended'} by {abs(extension):.4g} m, beyond its "
            f"cylinder's end; allowed: {low:.4g} to {high:.4g} m from the start"
        )

    def check_elements(self, where: str) -> None:
        """Raise InputError if elements do not go together; where: path of the cylinder."""
        super().check_elements(where)
        if self.rod_relief is not None and self.rod_relief.poppet is not None:
            raise InputError(f"{where}.rod_relief.poppet: allowed: none; the rod side's valve opens at once")
        for name, valve in (("yield_valve", self.yield_valve), ("rod_relief", self.rod_relief)):
            if valve is not None and valve.closes_at < self.tank_pressure:
                raise InputError(
                    f"{where}.tank_pressure = {self.tank_pressure} Pa: oil would come in through {name}, which "
                    f"is open down to {valve.closes_at} Pa; allowed: at most that"
                )

    @property
    def sources(self) -> dict[str, float]:
        """Pressures of tank and pump [Pa]."""
        return {"tank": self.tank_pressure, "supply": self.system_pressure}

    @property
    def check(self) -> tuple[float, ...]:
        """Numbers of the check valve."""
        return NO_CHECK if self.check_valve is None else self.check_valve.numbers

    def _rooms(self) -> dict[str, Room]:
        """The piston side with its hose, the rod side, which both stages share, and the others."""
        others, stage = super()._rooms(), self.second_stage
        piston = others.pop("piston")
        area, length = (0.0, 0.0) if stage is None else (stage.rod_side_area, stage.rod_side_length)
        volume = self.rod_side_area * self.rod_side_length + self.rod_side_hose_volume + area * length
        rod = Room(volume, area - self.rod_side_area, -area)
        return {"piston": piston._replace(volume=piston.volume + self.hose_volume), "rod": rod} | others

    def _paths(self) -> dict[str, Path]:
        """Both sides of the inlet, and the others."""
        numbers = self.nominal_flow / math.sqrt(self.nominal_drop), SMOOTH * self.nominal_drop
        there, check = ("piston", self.check) if self.line is None else ("line", NO_CHECK)
        inlet = Path(
            Formula(let_in, (*numbers, *check)), "supply", there, "tank",
            flow="flow", passed="let_in", loss="valve_loss", event=CHECK_OPEN,
        )  # fmt: skip
        rod = inlet._replace(formula=Formula(let_in, (*numbers, *NO_CHECK)), flow="rod_flow")
        found = {"inlet": inlet, "rod_inlet": rod._replace(before="tank", after="rod", back="supply")}
        if self.rod_relief is not None:
            found["rod_relief"] = self.rod_relief.path("rod_relief")._replace(
                before="rod", flow="relief_flow", passed="relieved", loss="yield_loss", event="rod relief open"
            )
        return found | super()._paths()

    def stiffness(self, extension: float) -> float:
        """Stiffness of the closed chambers [N/m] at an extension since the start [m]."""
        piston = self.bore_area * (self.oil_length + extension) + self.hose_volume
        rod = self.rod_side_area * (self.rod_side_length - extension) + self.rod_side_hose_volume
        return self.bulk_modulus * (self.bore_area**2 / piston + self.rod_side_area**2 / rod)
