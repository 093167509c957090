"""What tests of loads share: a ram on an upright guide, and the reference support under a roof."""

from __future__ import annotations

import math
from dataclasses import replace

from support_exudyn import (
    Body,
    CubicStep,
    Drive,
    Held,
    Line,
    Linkage,
    Load,
    Machine,
    OilColumn,
    Roof,
    Scenario,
    Slide,
    bore_area,
    reference_support,
)
from support_exudyn.model.loads.load import AnyLoad
from user_forces import value
from user_forces.kernel import kernel
from user_forces.values.value import Vector2

MASS, STIFFNESS = 1000.0, 1e6
TOP = (0.0, 1.0)
OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
ON_OIL = {"front_column": OIL, "rear_column": OIL}
# behind so much oil in lines that vibrations die out
LINE_VOLUME = 0.1  # [m^3]
LINE = Line(volume=LINE_VOLUME, nominal_flow=5e-3, nominal_drop=5e5)
DAMPED = {name: replace(oil, line=LINE) for name, oil in ON_OIL.items()}
# of the support [m]: over the middle between both actuators' heads, in the start posture
OVER_THE_COLUMNS = (1.37, 1.993)
HARD = 1e9  # [N/m]
GAP = 0.0123  # [m]
TEN_MEGANEWTONS = 1e7
# by how much the support gives under it [m]: two columns of oil side by side, of 2.9e8 N/m each
GIVES_ON_OIL = TEN_MEGANEWTONS / 5.89e8
GIVES_DAMPED = GIVES_ON_OIL * (1.0 + LINE_VOLUME / (OIL.bore_area * OIL.oil_length))  # lines give, too


@value
class Ram(Machine):
    """A ram of 1 t that moves up and down and does not turn."""

    speed: float = 0.0

    def linkage(self) -> Linkage:
        ram = Body(mass=MASS, inertia=1.0, centre=TOP, velocity=(0.0, self.speed))
        return Linkage(
            bodies={"ram": ram}, slides={"guide": Slide(body="ram", point=TOP, direction=0.5 * math.pi)}
        )


@value
class DeadLoad(Load):
    """A force that stays as it is: what a new kind of load takes."""

    vector: Vector2

    @staticmethod
    @kernel
    def action(
        t: float, x: float, y: float, vx: float, vy: float, z: float, vz: float, *vector: float
    ) -> tuple[float, ...]:
        return vector[0], vector[1], 0.0, -vector[0] * x - vector[1] * y, 0.0, 0.0


def over_the_ram(gap: float = 0.01, damping: float = 0.0, descent: Drive | None = None) -> Roof:
    return Roof(body="ram", point=TOP, gap=gap, stiffness=STIFFNESS, damping=damping, descent=descent or Held())


def thrown(gap: float, step: float, damping: float = 0.0) -> Scenario:
    """The ram flies up to the roof at 1 m/s, without weight, and back."""
    return Scenario(
        machine=Ram(speed=1.0),
        loads={"roof": over_the_ram(gap, damping)},
        duration=0.2,
        record_period=0.2,
        step=step,
        gravity=(0.0, 0.0),
    )


def over_the_canopy(down: float, start: float = 0.02, end: float = 0.12, **changes: object) -> Roof:
    """A hard roof that comes down on the reference support."""
    fields: dict[str, object] = {
        "body": "canopy",
        "point": OVER_THE_COLUMNS,
        "gap": GAP,
        "stiffness": HARD,
        "descent": CubicStep(stroke=down, start=start, end=end),
    }
    return Roof(**fields | changes)


def pressed_support(roof: AnyLoad, **changes: object) -> Scenario:
    """The reference support under a roof."""
    fields: dict[str, object] = {
        "machine": reference_support(),
        "loads": {"roof": roof},
        "duration": 0.3,
        "record_period": 1e-3,
        "step": 2.5e-4,
    }
    return Scenario(**fields | changes)
