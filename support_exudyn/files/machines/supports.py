"""Files of four-bar shield supports: pivots, parts, columns, bores and widths."""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Literal

from support_exudyn.files.machines.parts import ColumnData, PartData
from support_exudyn.files.toml.shapes import Names
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.shield_layout import BODIES, FRAME, PINS, RODS, TAIL
from support_exudyn.machines.strength.strength_data import StrengthData
from support_exudyn.machines.two_leg_shield import TwoLegShield
from support_exudyn.model.linkage import GROUND, Part, bar
from support_exudyn.model.to_space import Width
from user_forces.values.units import Kilograms, Metres
from user_forces.values.value import InputError, NonNegative, Positive, Value, Vector2, value

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
BORES = {
    **{name: PLACES[name] for name in FRAME if name in PINS},
    "shield_canopy": "shield beam on canopy",
    "shield_tail": "tail beam on shield beam",
}


def pivots(columns: Mapping[str, str]) -> Names:
    """The pivots of a support; columns: the ends of its columns, with what they are."""
    return Names({**PLACES, **columns, **TAIL_PLACES}, required=(*PLACES, *columns))


def masses(columns: Mapping[str, str]) -> Names:
    """Bodies of which the mass alone is told, and rods of columns; columns: names, with what they are."""
    bars = {name: f"{told}: a uniform bar from {' to '.join(BARS[name])}" for name, told in BODY_NAMES.items()}
    return Names(bars | {name + RODS: f"rods of the {told}, at its head" for name, told in columns.items()})


def widths(columns: Mapping[str, str]) -> Names:
    """The lateral dimensions that a support has; columns: names, with what they are."""
    bodies = {**BODY_NAMES, TAIL: "tail beam"}
    for name, told in columns.items():
        bodies |= {f"{name}_{part}": f"{part} of the {told}" for part in ("cylinder", "rod")}
    evenly = "width over which its mass is spread evenly; of a pair, of each"
    return Names(
        {
            "bodies": {name: f"{told}: {evenly}" for name, told in bodies.items()},
            "pairs": {"front_link": "distance of the two front links"},
            "columns": {name: f"distance of the two {told}" for name, told in columns.items()},
            "pins": dict.fromkeys((*PINS, "shield_tail"), "length of the pin"),
            "points": {"tip": "distance of two more of it, left and right"},
        }
    )


@value
class SupportFile(Value, ABC):
    """The file of a four-bar shield support; a kind of support narrows what depends on its columns.

    Arguments:
        kind: what the machine is.
        name: what it is called.
        sources: where the data come from: texts, by what they are of.
        start_hinge_height: height of the hinge at the start, with a level canopy [m], > 0.
        stroke: by how much the columns (legs) extend from the start on, in use [m], > 0.
        pivots: all pivots in one reference posture, x forward, y up, [x, y] [m].
        masses: of bodies of which the mass alone is known: uniform bars [kg], > 0.
        parts: what bodies are made of, in the reference posture.
        bore_radius: radii of the bores of pins, for pins with clearance [m], > 0.
        columns: masses of columns, for scenarios that model them as two bodies.
        width: lateral dimensions, for the spatial model [m].
        strength: bores, pressures, stages, eyes and base, for `stand`.
    """

    kind: str
    pivots: Mapping[str, Vector2]
    start_hinge_height: Metres[Positive]
    name: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)
    stroke: Metres[Positive] | None = None
    masses: Mapping[str, Positive] = field(default_factory=dict)
    parts: Annotated[Mapping[str, tuple[PartData, ...]], Names(BODY_NAMES)] = field(default_factory=dict)
    bore_radius: Metres[Annotated[Mapping[str, Positive], Names(BORES)]] = field(default_factory=dict)
    columns: Mapping[str, ColumnData] = field(default_factory=dict)
    width: Mapping[str, Mapping[str, NonNegative]] | None = None
    strength: StrengthData | None = None

    @classmethod
    @abstractmethod
    def machine_class(cls) -> type[FourBarShield]:
        """The class of the machines that these files hold."""

    def data(self) -> MachineData:
        """The support. Raises InputError if it cannot be built."""
        parts = {body: self._parts(body) for body in BODIES}
        try:
            machine = self.machine_class()(
                parts=parts, start_hinge_height=self.start_hinge_height, width=self._width(), **self.pivots
            )
        except InputError as error:
            raise InputError(re.sub(rf"^{self.machine_class().__name__}(: |\.)", "", str(error))) from None
        return MachineData(
            machine,
            self.name,
            bore_radii=self.bore_radius,
            actuators={name: column.column() for name, column in self.columns.items()},
            stroke=self.stroke,
            sources=self.sources,
            kind=self.kind,
            assumed=tuple(self._assumed()),
            strength=self.strength,
        )

    def _width(self) -> Width | None:
        if self.width is None:
            return None
        for kind in self.width.keys() - {"bodies"}:
            for name, size in self.width[kind].items():
                if size == 0.0:
                    raise InputError(f"width_mm.{kind}.{name} = 0: allowed: > 0")
        given = {
            kind: dict(self.width.get(kind, {})) for kind in ("bodies", "pairs", "columns", "pins", "points")
        }
        evenly = 1.0 / math.sqrt(12.0)
        return Width(
            spreads={
                name: evenly * (1e3 * size) / 1e3 for name, size in given["bodies"].items()
            },  # rounded as in mm
            pairs={name: 0.5 * size for name, size in given["pairs"].items()},
            actuators={name: 0.5 * size for name, size in given["columns"].items()},
            lengths=given["pins"],
            points={name: 0.5 * size for name, size in given["points"].items()},
        )

    def _parts(self, body: str) -> tuple[Part, ...]:
        """The parts of a body: those that the file describes, or a bar; with the rods of columns on it."""
        given, mass = self.parts.get(body, ()), self.masses.get(body)
        described = tuple(one.part(self.pivots, f"parts.{body}[{n}]") for n, one in enumerate(given))
        if described and mass is not None:
            raise _said_twice(body, mass, body)
        if not described and mass is None:
            raise InputError(f"masses_kg.{body}: missing; allowed: this, or parts: [[parts.{body}]]")
        bars = () if mass is None else (bar(mass, *(self.pivots[end] for end in BARS[body])),)
        return (*described, *bars, *self._rods(body))

    def _rods(self, body: str) -> list[Part]:
        """The rods of columns whose heads are on a body, as points, as far as their masses alone are told."""
        found = []
        for name, strut in self.machine_class().STRUTS.items():
            rods = name + RODS
            if strut.head[0] != body or rods not in self.masses:
                continue
            if any(part.name == rods for part in self.parts.get(body, ())):
                raise _said_twice(rods, self.masses[rods], body)
            found.append(Part(mass=self.masses[rods], centre=self.pivots[strut.head[1]], name=rods))
        return found

    def _assumed(self) -> list[str]:
        """The assumptions for what the file does not say, in sentences."""
        found = [
            f"{name}: its {self.masses[name]:.10g} kg are a uniform bar from {' to '.join(BARS[name])}"
            for name in BODIES
            if name in self.masses
        ]
        named = {*self.masses, *(part.name for parts in self.parts.values() for part in parts)}
        for name, strut in self.machine_class().STRUTS.items():
            if strut.head[0] != GROUND and name + RODS not in named:
                found.append(f"{name}: its rods weigh nothing")
        return found


def _said_twice(name: str, mass: float, body: str) -> InputError:
    return InputError(f"masses_kg.{name} = {mass:.10g}: parts.{body} says it too; allowed: one of them")


FOUR_COLUMNS = {"front_column": "front columns", "rear_column": "rear columns"}
FOUR_COLUMN_ENDS = {
    "front_foot": "front column on base",
    "front_head": "front column on canopy",
    "rear_foot": "rear column on base",
    "rear_head": "rear column on canopy",
}
LEGS = {"leg": "legs", "ram": "stabilising ram"}
LEG_ENDS = {
    "leg_foot": "leg on base",
    "leg_head": "leg on canopy",
    "ram_foot": "stabilising ram on shield beam",
    "ram_head": "stabilising ram on canopy",
}


@value
class FourColumnSupportFile(SupportFile):
    """A four-bar shield support on two pairs of columns between base and canopy."""

    kind: Literal["four_column_support"]
    pivots: Metres[Annotated[Mapping[str, Vector2], pivots(FOUR_COLUMN_ENDS)]]
    masses: Kilograms[Annotated[Mapping[str, Positive], masses(FOUR_COLUMNS)]] = field(default_factory=dict)
    columns: Annotated[Mapping[str, ColumnData], Names(FOUR_COLUMNS)] = field(default_factory=dict)
    width: Metres[Annotated[Mapping[str, Mapping[str, NonNegative]], widths(FOUR_COLUMNS)]] | None = None

    @classmethod
    def machine_class(cls) -> type[FourBarShield]:
        """The class of the machines that these files hold."""
        return HydraulicSupport


@value
class TwoLegShieldFile(SupportFile):
    """A four-bar shield support on a pair of legs, with a stabilising ram between shield beam and canopy."""

    kind: Literal["two_leg_shield"]
    pivots: Metres[Annotated[Mapping[str, Vector2], pivots(LEG_ENDS)]]
    masses: Kilograms[Annotated[Mapping[str, Positive], masses(LEGS)]] = field(default_factory=dict)
    columns: Annotated[Mapping[str, ColumnData], Names(LEGS)] = field(default_factory=dict)
    width: Metres[Annotated[Mapping[str, Mapping[str, NonNegative]], widths(LEGS)]] | None = None

    @classmethod
    def machine_class(cls) -> type[FourBarShield]:
        """The class of the machines that these files hold."""
        return TwoLegShield
