"""Files of slider-cranks."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import ClassVar, Literal

from pydantic import Field

from support_exudyn.files.machines.form import Degrees, Inertia, MachineForm, Mass, Size, metres, radians
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.slider_crank import SliderCrank
from user_forces.values.value import InputError

PINS = {"main": "crank on ground", "crank_pin": "crank on rod", "slider_pin": "rod on slider"}


class Form(MachineForm):
    """A slider-crank; crank and rod have their centres of mass in the middle."""

    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = {"bore_radius_mm": PINS}

    kind: Literal["slider_crank"] = Field(description="What the machine is.")
    crank_length_mm: Size
    rod_length_mm: Size = Field(description="More than that of the crank [mm].")
    crank_mass_kg: Mass
    rod_mass_kg: Mass
    slider_mass_kg: Mass
    crank_inertia_kg_m2: Inertia | None = Field(
        None, description="About its middle [kg m^2]; else a uniform bar."
    )
    rod_inertia_kg_m2: Inertia | None = Field(
        None, description="About its middle [kg m^2]; else a uniform bar."
    )
    start_angle_deg: Degrees = Field(Decimal(0), description="Of the crank at the start, from +x [degrees].")
    bore_radius_mm: dict[str, Size] = Field(
        default_factory=dict, description="Radii of the bores of pins, for pins with clearance."
    )

    def data(self) -> MachineData:
        """The machine, in SI. Raises InputError if it cannot be built."""
        crank, rod = metres(self.crank_length_mm), metres(self.rod_length_mm)
        if rod <= crank:
            raise InputError(
                f"rod_length_mm = {self.rod_length_mm}: allowed: > crank_length_mm = {self.crank_length_mm}, "
                "else the crank cannot turn right round"
            )
        machine = SliderCrank(
            crank_length=crank,
            rod_length=rod,
            crank_mass=float(self.crank_mass_kg),
            rod_mass=float(self.rod_mass_kg),
            slider_mass=float(self.slider_mass_kg),
            crank_inertia=_inertia(self.crank_inertia_kg_m2, self.crank_mass_kg, crank),
            rod_inertia=_inertia(self.rod_inertia_kg_m2, self.rod_mass_kg, rod),
            start_angle=radians(self.start_angle_deg),
        )
        return MachineData(
            machine,
            self.name,
            bore_radii={name: metres(radius) for name, radius in self.bore_radius_mm.items()},
            sources=self.sources,
            kind=self.kind,
            assumed=tuple(
                f"{name}: its mass is spread evenly over its length"
                for name in ("crank", "rod")
                if getattr(self, f"{name}_inertia_kg_m2") is None
            ),
        )


def _inertia(said: Decimal | None, mass: Decimal, length: float) -> float:
    """As said, or of a uniform bar [kg m^2]."""
    return float(mass) * length**2 / 12.0 if said is None else float(said)
