"""Parts of bodies, and columns with mass, as machine files describe them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from pydantic import model_validator

from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.linkage import Part, bar
from user_forces.values.names import nearest
from user_forces.values.units import Kilograms, KilogramSquareMetres, Metres, Radians
from user_forces.values.value import InputError, Positive, Real, Value, Vector2, value


def check_known(where: str, name: str, known: Iterable[str], what: str) -> None:
    """Raise InputError that names the place in the file unless a name is one of those that are known."""
    names = list(known)
    if name not in names:
        raise InputError(f"{where} = {name!r}: {what}; {nearest(name, names)}")


@value
class PartData(Value):
    """A rigid part of a body: a uniform bar between two pivots or about its centre, or a point.

    Arguments:
        mass: [kg], > 0.
        name: by which a scenario knows it: tail_beam, COLUMN_rods.
        between: two pivots: a bar from one to the other.
        centre: [m], of a bar or a point that is not between pivots.
        length: of a bar about its centre [m], > 0.
        direction: of that bar, from +x [rad].
        inertia: about its centre, in place of that of a bar [kg m^2], > 0.
    """

    mass: Kilograms[Positive]
    name: str = ""
    between: tuple[str, ...] | None = None
    centre: Metres[Vector2] | None = None
    length: Metres[Positive] | None = None
    direction: Radians[Real] | None = None
    inertia: KilogramSquareMetres[Positive] | None = None

    @model_validator(mode="after")
    def _has_one_place(self) -> PartData:
        if self.between is None and self.centre is None:
            raise ValueError("centre_mm or between: missing; a part needs one of them")
        for key in ("centre_mm", "length_mm", "direction_deg"):
            if self.between is not None and getattr(self, key.rpartition("_")[0]) is not None:
                raise ValueError(f"between and {key}: allowed: one of them")
        if self.length is not None and self.inertia is not None:
            raise ValueError("length_mm and inertia_kg_m2: allowed: one of them")
        return self

    def part(self, places: Mapping[str, Vector2], where: str) -> Part:
        """The part. Raises InputError if a pivot is not there; where: the part stands in the file."""
        if self.between is not None:
            if len(self.between) != 2 or not all(name in places for name in self.between):
                raise InputError(f"{where}.between = {list(self.between)}: allowed: two of {', '.join(places)}")
            one = bar(self.mass, *(places[name] for name in self.between))
        else:
            assert self.centre is not None  # checked
            length, along = self.length or 0.0, self.direction or 0.0
            half = 0.5 * length * math.cos(along), 0.5 * length * math.sin(along)
            # not its ends: rounding would move its centre
            one = replace(bar(self.mass, (-half[0], -half[1]), half), centre=self.centre)
        if self.inertia is not None:
            one = replace(one, inertia=self.inertia, moments=None)
        return replace(one, name=self.name)


@value
class ColumnData(Value):
    """A column with mass, both of a pair together: cylinder and rod, each a uniform bar from its pin on.

    Arguments:
        cylinder_mass, rod_mass: [kg], > 0.
        cylinder_length, rod_length: [m], > 0.
    """

    cylinder_mass: Kilograms[Positive]
    cylinder_length: Metres[Positive]
    rod_mass: Kilograms[Positive]
    rod_length: Metres[Positive]

    def column(self) -> CylinderAndRod:
        """The column as two bodies."""
        return CylinderAndRod(
            cylinder_mass=self.cylinder_mass,
            cylinder_centre=0.5 * self.cylinder_length,
            cylinder_inertia=self.cylinder_mass * self.cylinder_length**2 / 12,
            rod_mass=self.rod_mass,
            rod_centre=0.5 * self.rod_length,
            rod_inertia=self.rod_mass * self.rod_length**2 / 12,
        )
