"""Supports on trapped oil under a roof load, pushed slowly to the front, to the rear and to the front again."""

from __future__ import annotations

from dataclasses import dataclass

from studies.common.loose_supports import loose_pins, support, tight_pins
from studies.common.support_legs import PAIRS, legs_data
from support_exudyn import OilColumn, Pin, Scenario
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.model.loads.applied import AppliedForce, TableCourse
from user_forces.values.value import Vector2

MACHINES = ("reference", "zf18000")
CLEARANCES_MM = (0.0, 0.25, 0.5, 1.0, 1.5, 2.0)  # radial, in all five pins; 0: ideal
ROOF_SHARES = (0.1, 0.3, 0.6)  # of the rated force
FRICTION = 0.25  # in all pins, ideal or not
PUSH = 0.3  # of the roof load, either way; underground 0.20 to 0.35 of it were measured (Barczak 1984)
ROOF_IS_ON, BEGIN = 0.3, 0.5  # when all of the roof load is there, and when the push begins [s]
QUARTER = 1.0  # of a loop [s]
PERIOD = 2e-3  # between records [s]
SLOW = ("reference", 0.5, 0.3, FRICTION)  # the case that is pushed half as fast, too


@dataclass(frozen=True)
class PushedSupport:
    """A support that is pushed.

    clearance_mm: of all pins. roof_share: roof load over the rated force. quarter: of a loop [s].
    """

    machine: str
    clearance_mm: float
    roof_share: float
    friction: float
    quarter: float = QUARTER

    @property
    def name(self) -> str:
        """What the study calls it."""
        size = f"{self.clearance_mm:g} mm" if self.clearance_mm else "ideal"
        pins = f"{size}, mu_d = {self.friction:g}"
        slow = "" if self.quarter == QUARTER else ", half as fast"
        return f"{self.machine}, roof {self.roof_share:g}, {pins}{slow}"

    @property
    def roof_load(self) -> float:
        """Roof load [N]."""
        leg = legs_data().of(self.machine).cylinder
        assert leg.yield_valve is not None
        return self.roof_share * len(PAIRS) * leg.bore_area * leg.yield_valve.opening_pressure

    @property
    def push(self) -> float:
        """Largest horizontal force [N]."""
        return PUSH * self.roof_load

    @property
    def place(self) -> Vector2:
        """Where roof load and push act in the start posture [m]: on the canopy, between the legs' heads."""
        start = support(self.machine).start()
        front, rear = start.ends["front_head"], start.ends["rear_head"]
        return 0.5 * (front[0] + rear[0]), 0.5 * (front[1] + rear[1])

    def time(self, quarters: float) -> float:
        """The time at which so many quarters of a loop are over [s]."""
        return BEGIN + quarters * self.quarter

    def scenario(self) -> Scenario:
        """The run: roof load first, then the push from 0 to the front, to the rear and to the front."""
        leg = legs_data().of(self.machine).cylinder
        oil = OilColumn(bore_area=leg.bore_area, oil_length=leg.oil_length, bulk_modulus=leg.bulk_modulus)
        size, pins = self.clearance_mm, dict[str, Pin]()
        if size:
            pins |= loose_pins(self.machine, size, self.friction, PINS)
        elif self.friction:
            pins |= tight_pins(self.machine, self.friction, PINS)
        times = (0.0, *(self.time(n) for n in (0, 1, 3, 5)))
        course = TableCourse(times=times, shares=(0.0, 0.0, 1.0, -1.0, 1.0), between="linear")
        roof = AppliedForce(body="canopy", point=self.place, full_force=(0.0, -self.roof_load), end=ROOF_IS_ON)
        push = AppliedForce(body="canopy", point=self.place, full_force=(self.push, 0.0), course=course)
        return Scenario(
            machine=support(self.machine),
            actuators=dict.fromkeys(PAIRS, oil),
            pins=pins,
            loads={"roof": roof, "push": push},
            duration=self.time(5),
            record_period=PERIOD,
            formulation="compiled",
            accuracy="draft",
        )


def cases() -> list[PushedSupport]:
    """All cases; without friction the ideal pins, and the reference support under the middle roof load."""
    found = [
        PushedSupport(machine, size, share, FRICTION)
        for machine in MACHINES
        for share in ROOF_SHARES
        for size in CLEARANCES_MM
    ]
    smooth = [PushedSupport(MACHINES[0], size, ROOF_SHARES[1], 0.0) for size in CLEARANCES_MM if size]
    tight = [PushedSupport(machine, 0.0, share, 0.0) for machine in MACHINES for share in ROOF_SHARES]
    return [*found, *smooth, *tight, PushedSupport(*SLOW, quarter=2.0 * QUARTER)]
