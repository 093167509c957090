"""One leg with all its elements in plain numbers, written from the docstrings of `model.hydraulics` alone.

It shares no line with the program: what the program computes is compared with it. Every kink and jump has a
switch, a number whose sign says on which side the leg is; `integrated` finds where the signs change.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from support_exudyn import HydraulicCylinder, OilColumn, SealFriction, TrappedAir, YieldValve
from support_exudyn.model.hydraulics.elements import EndStops, PumpStation

ATMOSPHERE = 101325.0
ROUNDED = 1e-3  # of the nominal drop: below it the root of an orifice is rounded
SEAT = 100.0  # times as stiff as the spring
NEVER = -math.inf
State = dict[str, float]
Sides = dict[str, bool]  # on which side of every switch


def orifice(drop: float, nominal_flow: float, nominal_drop: float) -> float:
    """Flow through a sharp edge, the root rounded about zero."""
    small = ROUNDED * nominal_drop
    return nominal_flow / math.sqrt(nominal_drop) * drop / (drop * drop + small * small) ** 0.25


def stribeck(seal: SealFriction | None, rate: float) -> float:
    if seal is None:
        return 0.0
    bump = (seal.static - seal.coulomb) * math.exp(-((rate / seal.stribeck_speed) ** 2))
    return (seal.coulomb + bump) * math.tanh(rate / seal.transition_speed)


@dataclass
class Chamber:
    """A volume of oil: what it holds, from what it held at the start.

    linear: whether the pressure is B (W - V)/reference or B ln(W/V). start: its pressure and volume.
    """

    linear: bool
    modulus: float
    volume: float
    pressure: float
    air: TrappedAir | None = None
    lowest: float | None = None
    held: float = field(init=False)

    def __post_init__(self) -> None:
        liquid = self.volume - self._air(self.pressure)
        strain = self.pressure / self.modulus
        self.held = liquid + strain * self.volume if self.linear else liquid * math.exp(strain)

    def _air(self, p: float) -> float:
        if self.air is None:
            return 0.0
        return self.air.volume * (ATMOSPHERE / (p + ATMOSPHERE)) ** (1.0 / self.air.exponent)

    def mass(self, flow: float, pressure: float) -> float:
        """What a volume at a pressure counts as oil."""
        return flow if self.linear else flow * math.exp(pressure / self.modulus)

    def lawful(self, more: float, volume: float, reference: float) -> float:
        """Pressure before any boiling; more: oil since the start."""
        if self.air is not None:
            return self._with_air(self.held + more, volume, reference)
        over = (self.held - self.volume) + more - (volume - self.volume)
        return self.modulus * (over / reference if self.linear else math.log1p(over / volume))

    def _with_air(self, oil: float, volume: float, reference: float) -> float:
        """Root of liquid + air = volume: convex and falling, so that Newton from the left comes to it."""
        assert self.air is not None
        n, b = self.air.exponent, self.modulus
        p = ATMOSPHERE * math.expm1(-n * math.log(volume / self.air.volume))
        for _ in range(200):
            air = self._air(p)
            liquid = oil - p * reference / b if self.linear else oil * math.exp(-p / b)
            slope = -(reference if self.linear else liquid) / b - air / (n * (p + ATMOSPHERE))
            change = (liquid + air - volume) / slope
            p -= change
            if abs(change) <= 1e-15 * (abs(p) + ATMOSPHERE):
                return p
        return p

    def cut(self, p: float, liquid: bool) -> float:
        return p if liquid or self.lowest is None else self.lowest


class Leg:
    """A leg under a mass on an upright guide.

    Arguments:
        name: prefix of its states and switches.
        model: the values.
        mass, gravity, rate: of what stands on it, and with which it starts [m/s].
        drive: of an oil column.
        pump: whose oil is a state of its own.
    """

    def __init__(
        self,
        name: str,
        model: Any,
        mass: float,
        gravity: float,
        rate: float,
        drive: Any,
        pump: PumpStation | None,
    ) -> None:
        self.name, self.model, self.mass, self.gravity, self.pump = name, model, mass, gravity, pump
        self.drive = drive
        self.linear = isinstance(model, OilColumn)
        self.valve: HydraulicCylinder | None = None if self.linear else model
        self.area = model.bore_area
        self.rod_area = 0.0 if self.valve is None else self.valve.rod_side_area
        self.hose = 0.0 if self.valve is None else self.valve.hose_volume
        self.damping = 0.0 if self.valve is None else self.valve.damping
        self.stage, self.stops = model.second_stage, model.end_stops
        self.inner_rod_area = 0.0 if self.stage is None else self.stage.rod_side_area
        self._fill(mass * gravity)
        self.start: State = {"e": 0.0, "v": rate, "w": 0.0, "out": 0.0, "in": 0.0}
        if self.valve is not None:
            self.start |= {"w1": 0.0, "out1": 0.0, "in1": 0.0}
        if model.line is not None:
            self.start["wl"] = 0.0
        if self.stage is not None:
            self.start |= {"s": 0.0, "sr": 0.0, "w2": 0.0}
        for key, valve, chamber in (("y", model.yield_valve, self.piston), ("y1", self.relief, self.rod)):
            if valve is not None and valve.poppet is not None:
                over = chamber.pressure - valve.opening_pressure
                self.start |= {key: over if over > 0.0 else over / SEAT, f"{key}r": 0.0}

    @property
    def relief(self) -> YieldValve | None:
        return None if self.valve is None else self.valve.rod_relief

    def _fill(self, load: float) -> None:
        """Chambers at the start: they carry the load, or have the setting pressure."""
        model, stage = self.model, self.stage
        tank = 0.0 if self.valve is None else self.valve.tank_pressure
        piston, rod = (load + tank * self.rod_area) / self.area, tank
        if stage is not None:
            inner = (load + tank * self.inner_rod_area) / stage.bore_area
        if self.valve is not None and load < tank * (self.area - self.rod_area):
            piston, rod = tank, (tank * self.area - load) / self.rod_area
        if model.setting_pressure is not None:
            piston, rod = model.setting_pressure, tank
            if stage is not None:
                inner = (
                    piston * self.area - tank * self.rod_area + tank * self.inner_rod_area
                ) / stage.bore_area
        low = model.vapour_pressure
        volume, around = self.volumes(0.0, 0.0)
        self.piston = Chamber(self.linear, model.bulk_modulus, volume, piston, model.trapped_air, low)
        self.rod = (
            Chamber(self.linear, model.bulk_modulus, around, rod, None, low) if self.valve else self.piston
        )
        if model.line is not None:
            self.line = Chamber(self.linear, model.bulk_modulus, model.line.volume, piston, None, low)
        if stage is not None:
            inside = stage.bore_area * stage.oil_length
            self.tube = Chamber(self.linear, model.bulk_modulus, inside, inner, None, low)

    def volumes(self, outer: float, inner: float) -> tuple[float, float]:
        """Of piston side and rod sides, at extensions of both stages."""
        piston = self.area * (self.model.oil_length + outer) + self.hose
        if self.valve is None:
            return piston, 0.0
        around = self.rod_area * (self.valve.rod_side_length - outer) + self.valve.rod_side_hose_volume
        if self.stage is not None:
            around += self.stage.rod_side_area * (self.stage.rod_side_length - inner)
        return piston, around

    # --- pressures ---

    def lawful(self, t: float, y: State) -> State:
        """Pressures of all chambers by their laws."""
        outer = y["s"] if self.stage is not None else y["e"]
        inner = y["e"] - outer
        piston, around = self.volumes(outer, inner)
        reference = piston
        if self.linear:
            reference = self.area * (self.model.oil_length + self.drive.extension(t))
        found = {"p": self.piston.lawful(y["w"], piston, reference)}
        if self.valve is not None:
            found["p1"] = self.rod.lawful(y["w1"], around, around)
        if self.model.line is not None:
            found["pl"] = self.line.lawful(y["wl"], self.line.volume, self.line.volume)
        if self.stage is not None:
            inside = self.stage.bore_area * (self.stage.oil_length + inner)
            found["p2"] = self.tube.lawful(y["w2"], inside, self.tube.volume if self.linear else inside)
        return found

    def pressures(self, lawful: State, sides: Sides) -> State:
        low = self.model.vapour_pressure
        return {key: p if low is None or sides[f"liquid {key}"] else low for key, p in lawful.items()}

    def opening(self, t: float, after: bool) -> float:
        """Of the inlet; after: whether a jump at t is over."""
        assert self.valve is not None
        inlet = self.valve.inlet
        return inlet.opening(t) + (inlet.opening_jump(t) if after else 0.0)

    def supplies(self, opening: float, pump_pressure: float) -> tuple[float, float]:
        assert self.valve is not None
        above = pump_pressure if self.pump is not None else self.valve.system_pressure
        both = (above, self.valve.tank_pressure)
        return both if opening >= 0.0 else both[::-1]

    # --- switches ---

    def switches(self, t: float, y: State, sides: Sides, pump_pressure: float, after: bool) -> State:
        lawful = self.lawful(t, y)
        low = self.model.vapour_pressure
        found = {} if low is None else {f"liquid {key}": p - low for key, p in lawful.items()}
        liquid = {key: value > 0.0 for key, value in found.items()} | sides
        p = self.pressures(lawful, liquid)
        for key, valve, pressure in (
            ("y", self.model.yield_valve, p["p"]),
            ("y1", self.relief, p.get("p1", 0.0)),
        ):
            if valve is not None and valve.poppet is not None:
                found[f"lifted {key}"] = y[key]
            elif valve is not None:
                open_now = sides.get(f"open {key}", False)
                found[f"open {key}"] = pressure - (valve.closes_at if open_now else valve.opening_pressure)
        outer, rate = (y["s"], y["sr"]) if self.stage is not None else (y["e"], y["v"])
        found |= _stop_switches("", self.stops, outer, rate)
        if self.stage is not None:
            found |= _stop_switches("inner ", self.stage.stops, y["e"] - outer, y["v"] - rate)
            lowest = NEVER if self.stops is None else self.stops.lowest
            found["into the tube"] = p["p"] - p["p2"]
            found["at its bottom"] = lowest + self.stage.release - y["s"]
            found["on its bottom"] = lowest - y["s"]
        if self.valve is not None and self.valve.check_valve is not None:
            opening = self.opening(t, after)
            found |= self._check_switches(p, *self.supplies(opening, pump_pressure))
        return found

    def _check_switches(self, p: State, supply: float, pilot: float) -> State:
        check = self.valve.check_valve  # type: ignore[union-attr]
        before = p.get("pl", supply)
        release = check.pilot_ratio * pilot - p["p"]
        return {
            "in": before - p["p"] - check.cracking_pressure,
            "back": p["p"] - before,
            "release": release,
            "released": release - check.pilot_range,
        }

    # --- rates ---

    def rates(
        self, t: float, y: State, sides: Sides, pump_pressure: float, after: bool, on_top: float = 0.0
    ) -> tuple[State, float]:
        """Rates of all states, and what is drawn from the pump, as mass; on_top: force pushing down."""
        p = self.pressures(self.lawful(t, y), sides)
        d = dict.fromkeys(y, 0.0)
        out = self._valve_flow("y", self.model.yield_valve, p["p"], y, d, sides)
        d["out"] = self.piston.mass(out, p["p"])
        d["w"] -= d["out"]
        drawn = self._inlets(t, p, d, sides, pump_pressure, after)
        if self.valve is not None:
            out1 = self._valve_flow("y1", self.relief, p["p1"], y, d, sides)
            d["out1"] = self.rod.mass(out1, p["p1"])
            d["w1"] -= d["out1"]
        seal, rod = self.model.seal_friction, p.get("p1", 0.0)
        outer_force = p["p"] * self.area - rod * self.rod_area
        if self.stage is None:
            force = outer_force + _stop_force("", self.stops, y["e"], y["v"], sides)
            force -= stribeck(seal, y["v"]) + self.damping * y["v"]
        else:
            stage, inner_rate = self.stage, y["v"] - y["sr"]
            force = p["p2"] * stage.bore_area - rod * stage.rod_side_area
            force += _stop_force("inner ", stage.stops, y["e"] - y["s"], inner_rate, sides)
            force -= stribeck(seal, inner_rate) + self.damping * inner_rate
            below = outer_force + _stop_force("", self.stops, y["s"], y["sr"], sides)
            below -= stribeck(seal, y["sr"]) + (self.damping + stage.damping) * y["sr"]
            d["s"], d["sr"] = y["sr"], (below - force) / stage.tube_mass
            self._foot_valve(p, y, d, sides)
        d["e"], d["v"] = y["v"], (force - on_top) / self.mass - self.gravity
        return d, drawn

    def _valve_flow(
        self, key: str, valve: YieldValve | None, p: float, y: State, d: State, sides: Sides
    ) -> float:
        if valve is None:
            return 0.0
        if valve.poppet is None:
            return valve.slope * (p - valve.closes_at) if sides[f"open {key}"] else 0.0
        lifted, lift, rate = sides[f"lifted {key}"], y[key], y[f"{key}r"]
        square, over = valve.poppet.stiffness / valve.poppet.mass, p - valve.opening_pressure
        d[key] = rate
        if lifted:
            d[f"{key}r"] = square * (over - lift) - valve.poppet.damping / valve.poppet.mass * rate
            tank = 0.0 if self.valve is None else self.valve.tank_pressure
            pressed = (p - tank) / (0.1 * valve.opening_pressure)  # hardly any: the oil drains
            return valve.slope * lift * min(1.0, max(0.0, pressed))
        d[f"{key}r"] = square * (over - SEAT * lift) - 2.0 * math.sqrt(SEAT * square) * rate
        return 0.0

    def _inlets(self, t: float, p: State, d: State, sides: Sides, pump_pressure: float, after: bool) -> float:
        """Oil into piston side, line and rod side; what the pump gives."""
        if self.valve is None:
            let_in = self.area * (self.drive.speed(t) + (self.drive.speed_jump(t) if after else 0.0))
            d["in"] = let_in
            if self.model.line is None:
                d["w"] += let_in
            else:
                through = (p["pl"] - p["p"]) / self.model.line.resistance
                d["wl"], d["w"] = let_in - through, d["w"] + through
            return 0.0
        valve, opening = self.valve, self.opening(t, after)
        supply, pilot = self.supplies(opening, pump_pressure)
        wide = abs(opening) * valve.nominal_flow
        if self.model.line is None:
            q = self._checked(supply, p["p"], pilot, sides, lambda dp: orifice(dp, wide, valve.nominal_drop))
            d["in"] = self.piston.mass(q, p["p"])
            d["w"] += d["in"]
        else:
            q = self._checked(p["pl"], p["p"], pilot, sides, lambda dp: dp / self.model.line.resistance)
            through = self.piston.mass(q, max(p["pl"], p["p"]))
            d["in"] = self.line.mass(orifice(supply - p["pl"], wide, valve.nominal_drop), p["pl"])
            d["wl"], d["w"] = d["in"] - through, d["w"] + through
        d["in1"] = self.rod.mass(orifice(pilot - p["p1"], wide, valve.nominal_drop), p["p1"])
        d["w1"] += d["in1"]
        return d["in"] if opening >= 0.0 else d["in1"]

    def _checked(self, before: float, p: float, pilot: float, sides: Sides, flow: Any) -> float:
        """Flow through the check valve, if there is one."""
        check = self.valve.check_valve  # type: ignore[union-attr]
        if check is None:
            return flow(before - p)
        if sides["in"]:
            return flow(before - p - check.cracking_pressure)
        if not (sides["back"] and sides["release"]):
            return 0.0
        share = 1.0 if sides["released"] else (check.pilot_ratio * pilot - p) / check.pilot_range
        return share * flow(before - p)

    def _foot_valve(self, p: State, y: State, d: State, sides: Sides) -> None:
        stage, share = self.stage, 1.0
        if not sides["into the tube"]:
            share = 0.0
            if sides["at its bottom"]:
                share = 1.0 if sides["on its bottom"] else 1.0 + (self.stops.lowest - y["s"]) / stage.release
        q = share * orifice(p["p"] - p["p2"], stage.nominal_flow, stage.nominal_drop)
        through = self.piston.mass(q, max(p["p"], p["p2"]))
        d["w"], d["w2"] = d["w"] - through, through


def _stop_switches(key: str, stops: EndStops | None, extension: float, rate: float) -> State:
    if stops is None:
        return {}
    return {
        f"{key}foot": stops.lowest - extension,
        f"{key}foot pushes": 1.0 - stops.damping * rate,
        f"{key}gland": extension - stops.highest,
        f"{key}gland pushes": 1.0 + stops.damping * rate,
    }


def _stop_force(key: str, stops: EndStops | None, extension: float, rate: float, sides: Sides) -> float:
    if stops is None:
        return 0.0
    found = 0.0
    if sides[f"{key}foot"] and sides[f"{key}foot pushes"]:
        found += stops.stiffness * (stops.lowest - extension) * (1.0 - stops.damping * rate)
    if sides[f"{key}gland"] and sides[f"{key}gland pushes"]:
        found -= stops.stiffness * (extension - stops.highest) * (1.0 + stops.damping * rate)
    return found
