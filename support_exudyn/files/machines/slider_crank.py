"""Files of slider-cranks."""

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Literal

from support_exudyn.files.toml.shapes import Names
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.slider_crank import SliderCrank
from user_forces.values.units import Kilograms, KilogramSquareMetres, Metres, Radians
from user_forces.values.value import InputError, Positive, Real, Value, value

PINS = {"main": "crank on ground", "crank_pin": "crank on rod", "slider_pin": "rod on slider"}


@value
class SliderCrankFile(Value):
    """A slider-crank; crank and rod have their centres of mass in the middle.

    Arguments:
        kind: what the machine is.
        name: what it is called.
        sources: where the data come from: texts, by what they are of.
        crank_length: [m], > 0. rod_length: [m], more than that of the crank.
        crank_mass, rod_mass, slider_mass: [kg], > 0.
        crank_inertia, rod_inertia: about the middle [kg m^2], > 0; else of a uniform bar.
        start_angle: of the crank at the start, from +x [rad].
        bore_radius: radii of the bores of pins, for pins with clearance [m], > 0.
    """

    kind: Literal["slider_crank"]
    name: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)
    crank_length: Metres[Positive]
    rod_length: Metres[Positive]
    crank_mass: Kilograms[Positive]
    rod_mass: Kilograms[Positive]
    slider_mass: Kilograms[Positive]
    crank_inertia: KilogramSquareMetres[Positive] | None = None
    rod_inertia: KilogramSquareMetres[Positive] | None = None
    start_angle: Radians[Real] = SliderCrank.start_angle
    bore_radius: Metres[Annotated[Mapping[str, Positive], Names(PINS)]] = field(default_factory=dict)

    def data(self) -> MachineData:
        """The machine. Raises InputError if it cannot be built."""
        crank, rod = self.crank_length, self.rod_length
        if rod <= crank:
            raise InputError(
                f"rod_length_mm = {1e3 * rod:.10g}: allowed: > crank_length_mm = {1e3 * crank:.10g}, "
                "else the crank cannot turn right round"
            )
        machine = SliderCrank(
            crank_length=crank,
            rod_length=rod,
            crank_mass=self.crank_mass,
            rod_mass=self.rod_mass,
            slider_mass=self.slider_mass,
            crank_inertia=_inertia(self.crank_inertia, self.crank_mass, crank),
            rod_inertia=_inertia(self.rod_inertia, self.rod_mass, rod),
            start_angle=self.start_angle,
        )
        given = {"crank": self.crank_inertia, "rod": self.rod_inertia}
        return MachineData(
            machine,
            self.name,
            bore_radii=self.bore_radius,
            sources=self.sources,
            kind=self.kind,
            assumed=tuple(
                f"{name}: its mass is spread evenly over its length"
                for name, one in given.items()
                if one is None
            ),
        )


def _inertia(said: float | None, mass: float, length: float) -> float:
    """The inertia that the file says, or that of a uniform bar [kg m^2]."""
    return mass * length**2 / 12.0 if said is None else said
