"""A guide with clearance as people write it: clearance, restitution, friction; the rest has usual values."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any

from pydantic import model_validator

from support_exudyn.files.scenarios.short_laws import (
    NamedMaterial,
    fields_of_law,
    friction_in_full,
    friction_in_short,
    law_in_full,
    material_of,
    simple_friction_laws,
    simple_laws,
)
from support_exudyn.files.toml.shapes import GroupShape, Names
from support_exudyn.model.guides import ClearanceGuide, Gaps, Guide, IdealGuide
from support_exudyn.model.simple_laws import friction_of
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.materials import STEEL, STEEL_35CRMO, Material
from user_forces.normal.hysteresis import without_damping_speed
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_laws import Exact
from user_forces.values.units import Metres, MetresPerSecond, NewtonsPerMetreToN
from user_forces.values.value import Coefficient, InputError, NonNegative, Positive, Restitution, Value, value

_law_in_full = partial(law_in_full, where="in [guides.NAME] normal = ")


@value
class ShortGuide(Value):
    """A guide with clearance, in few words.

    Arguments:
        clearance: gap between block and wall at the start [m], >= 0, on either side; or gaps to the upper and
            the lower wall; 0 is an ideal guide, which keeps its friction and shape and ignores all else. Upper
            is the side to which a quarter turn counterclockwise leads from the direction of the guide.
        block: length and height of the block [m], > 0; the machine's file may say it for the guide.
        pin_radius: of a round pin in place of a block [m], > 0; for guides that let turn.
        restitution: of an impact, > 0 and <= 1; 0.9 if nothing is said.
        friction: sliding coefficient of Ambrosio's law, >= 0 and <= 5, 0: none; or a friction law as a table.
        friction_law: one that needs a single coefficient, which `friction` is; Ambrosio's if nothing is said.
            Of one's own by its place, "my_laws.py:MyFriction".
        law: of the normal force: one that needs a stiffness and a restitution only; Exact if nothing is said.
            Of one's own by its place, "my_laws.py:MyLaw".
        rest_velocity: smallest velocity that the damping is scaled with [m/s], > 0; the law's own by default.
        stiffness: K of K depth^1.5 at every corner [N/m^1.5], > 0; Hertz's of a sphere on a plane if nothing is
            said.
        corner_radius: of that sphere [m], > 0; the pin's, or a tenth of the block's height if nothing is said.
        wall_material, block_material: names or tables; steel and 35CrMo if nothing is said.
    """

    clearance: Metres[NonNegative | Gaps]
    block: Metres[tuple[Positive, Positive]] | None = None
    pin_radius: Metres[Positive] | None = None
    restitution: Restitution | None = None
    friction: Coefficient | FrictionLaw = 0.0
    friction_law: Annotated[str, Names(simple_friction_laws, instead=friction_in_full)] | None = None
    law: Annotated[str, Names(simple_laws, instead=_law_in_full)] | None = None
    rest_velocity: MetresPerSecond[Positive] | None = None
    stiffness: NewtonsPerMetreToN[Positive] | None = None
    corner_radius: Metres[Positive] | None = None
    wall_material: NamedMaterial | Material | None = None
    block_material: NamedMaterial | Material | None = None

    @classmethod
    def _of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        return without_damping_speed(given)

    @model_validator(mode="after")
    def _nothing_is_left_unused(self) -> ShortGuide:
        for name in ("restitution", "rest_velocity"):
            if self.law and getattr(self, name) is not None and name not in fields_of_law(self.law):
                raise ValueError(f"{name}: the law {self.law} has none; allowed with it: to leave this out")
        if self.friction_law is not None and isinstance(self.friction, FrictionLaw):
            raise ValueError("friction_law: and a law as friction are two; allowed: one of them")
        if self.block is not None and self.pin_radius is not None:
            raise ValueError("block: and pin_radius are two shapes; allowed: one of them")
        for name in ("corner_radius", "wall_material", "block_material"):
            if getattr(self, name) is not None and self.stiffness is not None:
                raise ValueError(f"{name}: would be left unused beside a stiffness; allowed: one of them")
        return self

    def guide(self, block: tuple[float, float] | None = None) -> Guide:
        """The guide in full; block: length and height of the machine's file [m], if this has none."""
        shape = self.block or (None if self.pin_radius else block)
        if self.clearance in (0.0, (0.0, 0.0)):  # as at the end of a sweep over clearances
            friction = friction_of(friction_in_short(self.friction, self.friction_law))
            if isinstance(friction, Frictionless):
                return IdealGuide()
            return IdealGuide(friction=friction, block=shape, pin_radius=self.pin_radius)
        if shape is None and self.pin_radius is None:
            raise InputError(
                "block_mm: missing, and the machine's file says none for this guide; "
                "allowed: [length, height], or pin_radius_mm of a pin"
            )
        law: Any = Exact if self.law is None else GroupShape((NormalLaw,)).kinds[self.law]
        return ClearanceGuide.simple(
            gaps=self.clearance,
            block=shape,
            pin_radius=self.pin_radius,
            restitution=self.restitution,
            friction=friction_in_short(self.friction, self.friction_law),
            law=law,
            rest_velocity=self.rest_velocity,
            stiffness=self.stiffness,
            corner_radius=self.corner_radius,
            wall_material=material_of(self.wall_material, STEEL),
            block_material=material_of(self.block_material, STEEL_35CRMO),
        )
