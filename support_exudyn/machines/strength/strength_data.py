"""What a machine's file says of its strength: cylinders and their pressures, stages, pins, the base frame."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field
from typing import Annotated

from pydantic import Field, model_validator

from user_forces.materials import STEEL, STEEL_35CRMO
from user_forces.values.units import Kilograms, Metres, Newtons, Pascals
from user_forces.values.value import NonNegative, Positive, Real, Value, Vector2, Whole, value

assert STEEL.yield_strength is not None
assert STEEL_35CRMO.yield_strength is not None
PIN_YIELD, EYE_YIELD = STEEL_35CRMO.yield_strength, STEEL.yield_strength  # [Pa]
Count = Annotated[Whole, Field(ge=1, le=100)]


@value
class CylinderStage(Value):
    """A stage of a cylinder: a tube, or a solid rod.

    Arguments:
        outer_diameter: [m], > 0.
        inner_diameter: [m], >= 0 and below the outer one; 0 by default, a solid rod.
        length: how much of it is seen when the cylinder is drawn out whole [m], > 0; of the first stage, its
            length from the pin of the foot on; of the last, up to the pin of the head.
    """

    outer_diameter: Metres[Positive]
    length: Metres[Positive]
    inner_diameter: Metres[NonNegative] = 0.0

    @model_validator(mode="after")
    def _has_a_wall(self) -> CylinderStage:
        if self.inner_diameter >= self.outer_diameter:
            raise ValueError(
                f"inner_diameter = {self.inner_diameter:.10g} m: allowed: below outer_diameter = "
                f"{self.outer_diameter:.10g} m"
            )
        return self

    @property
    def area(self) -> float:
        """Area of the section of steel [m^2]."""
        return 0.25 * math.pi * (self.outer_diameter**2 - self.inner_diameter**2)

    @property
    def second_moment(self) -> float:
        """Second moment of area of the section about a diameter [m^4]."""
        return math.pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)


@value
class CylinderStrength(Value):
    """Cylinders that an actuator of the plane stands for, all alike.

    Arguments:
        count: how many stand side by side, 2 by default.
        bore: diameter on which the pressure of the valve acts [m], > 0.
        rod: diameter of the rod in the bore [m], > 0 and below it, of a cylinder that also pulls; None by
            default: it pushes only.
        yield_pressure: at which the yield valve opens [Pa], > 0.
        setting_pressure: with which it is set [Pa], > 0 and at most the yield pressure; None: not known.
        stages: from the foot to the head, with their sections; none by default: buckling is not reckoned.
        yield_stress: of the steel of the stages [Pa], > 0; None: not known.
        elastic_modulus: of the steel of the stages [Pa], > 0; 2.06e11 by default.
    """

    bore: Metres[Positive]
    yield_pressure: Pascals[Positive]
    setting_pressure: Pascals[Positive] | None = None
    count: Count = 2
    rod: Metres[Positive] | None = None
    stages: tuple[CylinderStage, ...] = ()
    yield_stress: Pascals[Positive] | None = None
    elastic_modulus: Pascals[Positive] = 2.06e11

    @model_validator(mode="after")
    def _fits(self) -> CylinderStrength:
        if self.rod is not None and self.rod >= self.bore:
            raise ValueError(f"rod = {self.rod:.10g} m: allowed: below bore = {self.bore:.10g} m")
        if self.setting_pressure is not None and self.setting_pressure > self.yield_pressure:
            raise ValueError(
                f"setting_pressure = {1e-6 * self.setting_pressure:.10g} MPa: allowed: at most yield_pressure "
                f"= {1e-6 * self.yield_pressure:.10g} MPa"
            )
        return self

    @property
    def area(self) -> float:
        """Area of all bores together [m^2]."""
        return self.count * 0.25 * math.pi * self.bore**2

    @property
    def push(self) -> float:
        """Force of all of them at the yield pressure [N]."""
        return self.yield_pressure * self.area

    @property
    def pull(self) -> float:
        """Largest pull of all of them, at the yield pressure on the ring around the rod [N]; 0 without one."""
        if self.rod is None:
            return 0.0
        return self.yield_pressure * self.count * 0.25 * math.pi * (self.bore**2 - self.rod**2)


@value
class PinStrength(Value):
    """A pin in its eyes: one middle eye between two outer ones. A pin of the plane may be several in truth.

    Arguments:
        count: how many pins share the force, 1 by default.
        diameter: [m], > 0; None by default: that of the bore.
        middle: width of the middle eye [m], > 0.
        outer: width of each outer eye [m], > 0.
        gap: between the middle eye and an outer one [m], >= 0; 0 by default.
        pin_yield_stress: of the pin [Pa], > 0; None: not known, see `yields`.
        eye_yield_stress: of the eyes [Pa], > 0; None: not known, see `yields`.
    """

    middle: Metres[Positive]
    outer: Metres[Positive]
    gap: Metres[NonNegative] = 0.0
    count: Count = 1
    diameter: Metres[Positive] | None = None
    pin_yield_stress: Pascals[Positive] | None = None
    eye_yield_stress: Pascals[Positive] | None = None

    @property
    def yields(self) -> tuple[float, float]:
        """Yield stresses of pin and eyes [Pa].

        If not known, those of tempered 35CrMo (GB/T 3077), and of S355 plates of 16 to 40 mm (EN 10025-2).
        """
        return self.pin_yield_stress or PIN_YIELD, self.eye_yield_stress or EYE_YIELD


@value
class BaseFrame(Value):
    """The base on the floor, which the plane takes as the ground.

    Arguments:
        rear, front: x of the edges about which it would tip [m]; front > rear.
        width: distance of its left and right edges [m], > 0.
        mass: [kg], > 0.
        centre: of its mass, x and y [m].
        floor: y of the floor [m], 0 by default.
    """

    rear: Metres[Real]
    front: Metres[Real]
    width: Metres[Positive]
    mass: Kilograms[Positive]
    centre: Metres[Vector2]
    floor: Metres[Real] = 0.0

    @model_validator(mode="after")
    def _has_length(self) -> BaseFrame:
        if self.front <= self.rear:
            raise ValueError(f"front = {self.front:.10g} m: allowed: > rear = {self.rear:.10g} m")
        return self


@value
class StrengthData(Value):
    """What is known of the strength of a machine.

    Arguments:
        cylinders: by actuator.
        pins: by pin; of others the eyes are assumed from the length of the pin and the bore.
        base: the base on the floor; None: not known, and no tipping is reckoned.
        rated_force: rated support force [N], > 0; None: that of all legs at their yield pressure, added up.
        canopy: name of the body that carries the roof.
    """

    cylinders: Mapping[str, CylinderStrength]
    pins: Mapping[str, PinStrength] = field(default_factory=dict)
    base: BaseFrame | None = None
    rated_force: Newtons[Positive] | None = None
    canopy: str = "canopy"
