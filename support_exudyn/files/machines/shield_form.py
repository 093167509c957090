"""What files of four-bar shield supports hold: pivots, parts, columns, bores and widths."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar

from pydantic import Field, model_validator

from support_exudyn.files.machines.form import (
    Degrees,
    Inertia,
    MachineForm,
    Mass,
    Millimetres,
    Place,
    Size,
    Table,
    metres,
    point,
    radians,
    told,
)
from support_exudyn.files.toml.millimetres import in_millimetres
from support_exudyn.machines.four_bar_shield import FRAME, PINS, FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.shield_layout import BODIES, RODS, TAIL
from support_exudyn.model.columns import TwoBodyColumn
from support_exudyn.model.lateral_dimensions import Width
from support_exudyn.model.linkage import GROUND, Part, bar
from user_forces.values.value import InputError, Vector2

PLACES = {
    "rear_base": "rear link on base",
    "front_base": "front link on base",
    "rear_shield": "rear link on shield beam",
    "front_shield": "front link on shield beam",
    "hinge": "shield beam on canopy",
    "tip": "foremost point of the canopy",
}
TAIL_PLACES = {
    "tail_hinge": "tail beam on shield beam, where the tail beam is a body of its own",
    "tail_jack_foot": "its jack on the shield beam",
    "tail_jack_head": "its jack on the tail beam",
}
BODY_NAMES = {
    "rear_link": "rear link",
    "front_link": "front links, both together",
    "shield": "shield beam, with the tail beam if it is no body of its own",
    "canopy": "canopy",
}
BARS = {  # ends of the uniform bars that stand for bodies of which the mass alone is known
    "rear_link": ("rear_base", "rear_shield"),
    "front_link": ("front_base", "front_shield"),
    "shield": ("rear_shield", "hinge"),
    "canopy": ("hinge", "tip"),
}
SAYS_UNIT_TWICE = re.compile(r"(_mm = [^ :]+) mm\b")


def places(columns: Mapping[str, str]) -> dict[str, str]:
    """All pivots of a support, with what they are; columns: those of its columns."""
    return {**PLACES, **columns, **TAIL_PLACES}


def masses(columns: Mapping[str, str]) -> dict[str, str]:
    """Keys of `masses_kg`; columns: names, with what they are."""
    bars = {name: f"{said}: a uniform bar from {' to '.join(BARS[name])}" for name, said in BODY_NAMES.items()}
    return bars | {name + RODS: f"rods of the {said}, at its head" for name, said in columns.items()}


class PartForm(Table):
    """A rigid part of a body: a uniform bar between two pivots or about its centre, or a point."""

    name: str = Field("", description="By which a scenario knows it: tail_beam, COLUMN_rods.", strict=True)
    mass_kg: Mass
    between: list[str] | None = Field(None, description="Two pivots: a bar from one to the other.", strict=True)
    centre_mm: Place | None = None
    length_mm: Size | None = None
    direction_deg: Degrees | None = None
    inertia_kg_m2: Inertia | None = None

    @model_validator(mode="after")
    def _has_one_place(self) -> PartForm:
        if self.between is None and self.centre_mm is None:
            raise ValueError("centre_mm or between: missing; a part needs one of them")
        if self.between is not None:
            for name in ("centre_mm", "length_mm", "direction_deg"):
                if getattr(self, name) is not None:
                    raise ValueError(f"between and {name}: allowed: one of them")
        if self.length_mm is not None and self.inertia_kg_m2 is not None:
            raise ValueError("length_mm and inertia_kg_m2: allowed: one of them")
        return self

    def part(self, pivots: Mapping[str, Vector2], where: str) -> Part:
        """The part, in SI. Raises InputError if a pivot is not there; where: the part stands in the file."""
        mass = float(self.mass_kg)
        if self.between is not None:
            if len(self.between) != 2 or not all(name in pivots for name in self.between):
                raise InputError(f"{where}.between = {told(self.between)}: allowed: two of {', '.join(pivots)}")
            one = bar(mass, *(pivots[name] for name in self.between))
        else:
            assert self.centre_mm is not None  # checked
            length = metres(self.length_mm) if self.length_mm is not None else 0.0
            along = radians(self.direction_deg) if self.direction_deg is not None else 0.0
            half = 0.5 * length * math.cos(along), 0.5 * length * math.sin(along)
            # not its ends: rounding would move its centre
            one = replace(bar(mass, (-half[0], -half[1]), half), centre=point(self.centre_mm))
        if self.inertia_kg_m2 is not None:
            one = replace(one, inertia=float(self.inertia_kg_m2), moments=None)
        return replace(one, name=self.name)


class ColumnForm(Table):
    """A column with mass, both of a pair together: cylinder and rod, each a uniform bar from its pin on."""

    cylinder_mass_kg: Mass
    cylinder_length_mm: Size
    rod_mass_kg: Mass
    rod_length_mm: Size

    def column(self) -> TwoBodyColumn:
        """In SI."""
        cylinder, rod = float(self.cylinder_mass_kg), float(self.rod_mass_kg)
        cylinder_length, rod_length = metres(self.cylinder_length_mm), metres(self.rod_length_mm)
        return TwoBodyColumn(
            cylinder_mass=cylinder,
            cylinder_centre=0.5 * cylinder_length,
            cylinder_inertia=cylinder * cylinder_length**2 / 12,
            rod_mass=rod,
            rod_centre=0.5 * rod_length,
            rod_inertia=rod * rod_length**2 / 12,
        )


class WidthForm(Table):
    """Lateral dimensions, for the spatial model."""

    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = {}

    bodies: dict[str, Millimetres] = Field(
        default_factory=dict, description="Widths over which masses are spread evenly; of a pair, of each."
    )
    pairs: dict[str, Size] = Field(default_factory=dict, description="Distance of the two front links.")
    columns: dict[str, Size] = Field(default_factory=dict, description="Distance of the two of a pair.")
    pins: dict[str, Size] = Field(default_factory=dict, description="Lengths of pins.")
    points: dict[str, Size] = Field(
        default_factory=dict, description="Distance of two more of it, left and right."
    )

    @classmethod
    def names(cls, columns: Mapping[str, str]) -> dict[str, dict[str, str]]:
        """`NAMES` of a support with these columns."""
        cylinders = {
            f"{name}_{part}": f"{part} of the {said}"
            for name, said in columns.items()
            for part in ("cylinder", "rod")
        }
        return {
            "bodies": {**BODY_NAMES, TAIL: "tail beam", **cylinders},
            "pairs": {"front_link": "front links"},
            "columns": dict(columns),
            "pins": dict.fromkeys((*PINS, "shield_tail"), ""),
            "points": {"tip": "tip"},
        }

    def width(self) -> Width:
        """In SI."""
        evenly = 1.0 / math.sqrt(12.0)
        return Width(
            spreads={name: evenly * float(size) / 1e3 for name, size in self.bodies.items()},
            pairs={name: 0.5 * metres(size) for name, size in self.pairs.items()},
            columns={name: 0.5 * metres(size) for name, size in self.columns.items()},
            lengths={name: metres(size) for name, size in self.pins.items()},
            points={name: 0.5 * metres(size) for name, size in self.points.items()},
        )


class ShieldForm(MachineForm):
    """What all four-bar shield supports have in their files; a kind of them adds its columns."""

    MACHINE: ClassVar[type[FourBarShield[Any]]]

    start_hinge_height_mm: Size = Field(
        description="Height of the hinge at the start, with a level canopy [mm]."
    )
    stroke_mm: Size | None = Field(
        None, description="By how much the columns (legs) extend from the start on, in use [mm]."
    )
    pivots_mm: dict[str, Place] = Field(
        description="All pivots in one reference posture, x forward, y up, [x, y] [mm]."
    )
    masses_kg: dict[str, Mass] = Field(
        default_factory=dict, description="Bodies of which the mass alone is known: uniform bars."
    )
    parts: dict[str, list[PartForm]] = Field(
        default_factory=dict, description="What bodies are made of, in the reference posture."
    )
    bore_radius_mm: dict[str, Size] = Field(
        default_factory=dict, description="Radii of the bores of pins, for pins with clearance."
    )
    columns: dict[str, ColumnForm] = Field(
        default_factory=dict, description="Masses of columns, for scenarios that model them as two bodies."
    )

    @classmethod
    def tables(cls, pivots: Mapping[str, str], columns: Mapping[str, str]) -> dict[str, Mapping[str, str]]:
        """`NAMES` of a support with these pivots and columns."""
        return {
            "pivots_mm": pivots,
            "masses_kg": masses(columns),
            "parts": BODY_NAMES,
            "bore_radius_mm": {**PINS_SAID, "shield_tail": "tail beam on shield beam"},
            "columns": columns,
        }

    def _width(self) -> Width | None:
        width: WidthForm | None = getattr(self, "width_mm", None)
        return None if width is None else width.width()

    def data(self) -> MachineData:
        """The support, in SI. Raises InputError if it cannot be built."""
        pivots = {name: point(place) for name, place in self.pivots_mm.items()}
        parts = {body: self._parts(body, pivots) for body in BODIES}
        try:
            machine = self.MACHINE(
                parts=parts,
                start_hinge_height=metres(self.start_hinge_height_mm),
                width=self._width(),
                **pivots,
            )
        except InputError as error:
            raise InputError(self._in_file_units(str(error))) from None
        return MachineData(
            machine,
            self.name,
            bore_radii={name: metres(radius) for name, radius in self.bore_radius_mm.items()},
            columns={name: column.column() for name, column in self.columns.items()},
            stroke=None if self.stroke_mm is None else metres(self.stroke_mm),
            sources=self.sources,
            kind=self.kind,
            assumed=tuple(self._assumed()),
        )

    def _parts(self, body: str, pivots: Mapping[str, Vector2]) -> tuple[Part, ...]:
        """Parts of a body: those that the file describes, or a bar; with the rods of columns on it."""
        described = tuple(
            item.part(pivots, f"parts.{body}[{n}]") for n, item in enumerate(self.parts.get(body, ()))
        )
        mass = self.masses_kg.get(body)
        if described and mass is not None:
            raise InputError(f"masses_kg.{body} = {mass}: parts.{body} says it too; allowed: one of them")
        if not described and mass is None:
            raise InputError(f"masses_kg.{body}: missing; allowed: this, or parts: [[parts.{body}]]")
        bars = () if mass is None else (bar(float(mass), *(pivots[end] for end in BARS[body])),)
        return (*described, *bars, *self._rods(body, pivots))

    def _rods(self, body: str, pivots: Mapping[str, Vector2]) -> list[Part]:
        """Rods of columns whose heads are on a body, as points, as far as their masses alone are told."""
        found = []
        for name, strut in self.MACHINE.STRUTS.items():
            mass = self.masses_kg.get(name + RODS)
            if strut.head[0] != body or mass is None:
                continue
            if any(part.name == name + RODS for part in self.parts.get(body, ())):
                raise InputError(
                    f"masses_kg.{name}{RODS} = {mass}: parts.{body} says it too; allowed: one of them"
                )
            found.append(Part(mass=float(mass), centre=pivots[strut.head[1]], name=name + RODS))
        return found

    def _assumed(self) -> list[str]:
        """What was assumed because the file does not say it, in sentences."""
        bars = [name for name in BODIES if name in self.masses_kg]
        found = [
            f"{name}: its {self.masses_kg[name]} kg are a uniform bar from {' to '.join(BARS[name])}"
            for name in bars
        ]
        heavy = {name for name in self.MACHINE.STRUTS if name + RODS in self.masses_kg}
        named = {part.name for parts in self.parts.values() for part in parts}
        for name, strut in self.MACHINE.STRUTS.items():
            if strut.head[0] != GROUND and name not in heavy and name + RODS not in named:
                found.append(f"{name}: its rods weigh nothing")
        return found

    def _in_file_units(self, message: str) -> str:
        """What the machine says in metres by the names of its fields, in mm by the keys of the file."""
        message = message.removeprefix(f"{self.MACHINE.__name__}: ").removeprefix(f"{self.MACHINE.__name__}.")
        for name in (*self.MACHINE.pivots(),):
            message = re.sub(rf"(?<![\w.]){name} = \((\S+), (\S+)\)(?: m\b)?", _pivot_in_mm(name), message)
        message = message.replace("start_hinge_height = ", "start_hinge_height_mm = ")
        return SAYS_UNIT_TWICE.sub(r"\1", in_millimetres(message))


PINS_SAID = {
    **{name: PLACES[name] for name in FRAME if name in PINS},
    "shield_canopy": "shield beam on canopy",
}


def _pivot_in_mm(name: str) -> Any:
    return lambda found: f"pivots_mm.{name} = [{1e3 * float(found[1]):g}, {1e3 * float(found[2]):g}]"
