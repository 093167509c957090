"""The slider-crank: the field's first example of a joint with clearance.

          rod
     .-----------.
B   /             `-.      crank AB turns at constant speed, angle from +x
   / crank            `-.
  /                      `-.   C
A o-------------------------[#]------ guide along +x through A
"""

from __future__ import annotations

import math

from pydantic import model_validator

from support_exudyn.model.linkage import GROUND, Body, Crank, Linkage, PinPlace, Slide, TracePoint, pinned
from support_exudyn.model.machine import Machine
from user_forces.values.units import Kilograms, KilogramSquareMetres, Metres, Radians
from user_forces.values.value import Positive, Real, value


@value
class SliderCrank(Machine):
    """A slider-crank in the plane. Crank and rod have their centres of mass in the middle.

    Pins: `main` (ground, crank), `crank_pin` (crank, rod), `slider_pin` (slider, rod). Driven: `crank`,
    by a drive in rad (`Steady`). Guide: `guide`. Point: `slider`. With ideal pins the machine moves in one way
    only, and in closed form:

        x = r cos(a) + sqrt(l^2 - r^2 sin(a)^2)

    Arguments:
        crank_length: r [m], > 0. rod_length: l [m], > r.
        crank_mass, rod_mass, slider_mass: [kg], > 0.
        crank_inertia, rod_inertia: about the centre of mass [kg m^2], > 0.
        start_angle: of the crank at the start [rad].
    """

    crank_length: Metres[Positive]
    rod_length: Metres[Positive]
    crank_mass: Kilograms[Positive]
    rod_mass: Kilograms[Positive]
    slider_mass: Kilograms[Positive]
    crank_inertia: KilogramSquareMetres[Positive]
    rod_inertia: KilogramSquareMetres[Positive]
    start_angle: Radians[Real] = 0.0

    @model_validator(mode="after")
    def _turns_right_round(self) -> SliderCrank:
        if self.rod_length <= self.crank_length:
            raise ValueError(
                f"rod_length = {self.rod_length} m: allowed: > crank_length = {self.crank_length} m, "
                "else the crank cannot turn right round"
            )
        return self

    def slider_position(self, angle: float) -> float:
        """x of the slider [m] at a crank angle [rad], ideal pins."""
        return self.crank_length * math.cos(angle) + self._rod_along(angle)

    def slider_speed(self, angle: float, speed: float) -> float:
        """Rate of the slider's x [m/s] at a crank angle [rad] and a speed of the crank [rad/s]."""
        return -speed * self._height(angle) * (1.0 + self._crank_along(angle) / self._rod_along(angle))

    def slider_acceleration(self, angle: float, speed: float) -> float:
        """Acceleration of the slider [m/s^2] at a crank angle [rad] and a constant crank speed [rad/s]."""
        along, height, rod = self._crank_along(angle), self._height(angle), self._rod_along(angle)
        bend = (along**2 - height**2) / rod + (height * along) ** 2 / rod**3
        return -(speed**2) * (along + bend)

    def _crank_along(self, angle: float) -> float:
        return self.crank_length * math.cos(angle)

    def _height(self, angle: float) -> float:
        return self.crank_length * math.sin(angle)

    def _rod_along(self, angle: float) -> float:
        return math.sqrt(self.rod_length**2 - self._height(angle) ** 2)

    def linkage(self) -> Linkage:
        """The mechanism at the start angle, at rest; the drive sets it in motion."""
        a = self.start_angle
        b = (self._crank_along(a), self._height(a))
        c = (self.slider_position(a), 0.0)
        return Linkage(
            bodies={
                "crank": Body(
                    mass=self.crank_mass,
                    inertia=self.crank_inertia,
                    centre=(0.5 * b[0], 0.5 * b[1]),
                    angle=a,
                ),
                "rod": Body(
                    mass=self.rod_mass,
                    inertia=self.rod_inertia,
                    centre=(0.5 * (b[0] + c[0]), 0.5 * b[1]),
                    angle=math.atan2(-b[1], c[0] - b[0]),
                ),
                # it cannot turn, so its inertia has no influence
                "slider": Body(mass=self.slider_mass, inertia=self.rod_inertia, centre=c),
            },
            pins={
                "main": pinned(GROUND, "crank", (0.0, 0.0)),
                "crank_pin": pinned("crank", "rod", b),
                "slider_pin": PinPlace(first="slider", second="rod", first_point=c, second_point=c),
            },
            points={"slider": TracePoint(body="slider", point=c)},
            cranks={"crank": Crank(body="crank")},
            slides={"guide": Slide(body="slider", point=c)},
        )


def ravn_slider_crank() -> SliderCrank:
    """The machine on which joints with clearance are commonly shown: r = 50 mm, l = 120 mm.

    Source: Ravn, Multibody Syst. Dyn. 2 (1998) 1-24; Flores and Ambrosio, Comput. Struct. 82 (2004) 1359-1369.
    Run there at 5000 rpm with a bearing of 10 mm radius and a journal of 9.5 mm at the slider.
    """
    return SliderCrank(
        crank_length=0.05,
        rod_length=0.12,
        crank_mass=0.30,
        rod_mass=0.21,
        slider_mass=0.14,
        crank_inertia=1.0e-4,
        rod_inertia=2.5e-4,
    )
