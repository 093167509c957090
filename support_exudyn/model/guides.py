r"""The kinds of guides: ideal, with clearance, whatever derives from `Guide`. A field of the scenario chooses.

              upper wall
    ----------------------------------
      upper_left .------. upper_right         gaps: from block to upper and to lower wall at the start
                 |  o---+--> direction        o: the guide's point on the body
      lower_left '------' lower_right
    ----------------------------------
              lower wall

Upper is the side to which a quarter turn counterclockwise leads from the direction of the guide.
"""

from __future__ import annotations

import math
from abc import ABC
from collections.abc import Mapping
from typing import ClassVar, NamedTuple

from pydantic import model_validator

from support_exudyn.model.pins import fields_of, friction_of, law_with
from user_forces.contact import FaceContact, SlotContact
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.journal import Slot, end_loads, larger_load
from user_forces.materials import STEEL, STEEL_35CRMO, Material, plane_contact_stiffness
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_laws import Exact
from user_forces.values.units import Metres
from user_forces.values.value import InputError, NonNegative, Positive, Value, Vector2, short, value

CORNERS = {"upper_left": (-1, 1), "upper_right": (1, 1), "lower_left": (-1, -1), "lower_right": (1, -1)}
PIN = "pin"  # the name of the contact of a round pin
ROUNDING = 0.1  # radius of a corner over the block's height, where nothing is said of it
Gaps = tuple[NonNegative, NonNegative]


class GuideContact(NamedTuple):
    """A corner of a block, or a pin, between the walls of a guide; x along the guide, y across.

    point: of the corner or the pin's centre from the guide's point [m]. middle: y of the slot's middle line
    [m]. contact: geometry and laws; of a guide with one wall alone those of a face.
    """

    point: Vector2
    middle: float
    contact: SlotContact | FaceContact


class Guide(Value, ABC):
    """What guides a point of a body along a line of another."""

    holds: ClassVar[bool]  # whether constraints hold the point on the line; else forces follow from the motion

    def refused_in_space(self) -> tuple[str, str] | None:
        """What of the guide is of the plane alone, and what is allowed, in words; None: nothing."""
        return None

    def misfit(self, turns: bool) -> str:
        """What does not fit a slide whose body may turn, or not, and what would; empty if nothing."""
        if turns and getattr(self, "block", None) is not None:
            return "has a block; allowed: pin_radius, for its body may turn"
        if not turns and getattr(self, "pin_radius", None) is not None:
            return "has a pin_radius; allowed: block, for its body does not turn"
        return ""

    def contacts(self) -> Mapping[str, GuideContact]:
        """What may make contact and part, by name."""
        return {}

    def losses(self) -> dict[str, object]:
        """What of the guide loses energy, by the channel that counts it: "damping_loss" and "friction_loss"."""
        return {}


@value
class IdealGuide(Guide):
    """A point stays on the line, and a block keeps its angle: constraints, whose multipliers are the forces.

    With friction the guide's force F across and its moment M press the ends of the block on the walls by N1 and
    N2, and each end rubs with law(slip, N) at its wall:

        N1 + N2 = F,    (N1 - N2) length / 2 = M - the moment of both friction forces

    Without a block F alone presses, and friction by the moment is left out. A pin in a slot rubs at its radius.

    Arguments:
        friction: law of the friction along the guide; None: none at all.
        block: length and height of the block, in whose middle the guide's point is [m]; with friction only.
        pin_radius: of a pin in place of a block [m]; with friction only.
    """

    holds: ClassVar[bool] = True
    friction: FrictionLaw | None = None
    block: Metres[tuple[Positive, Positive]] | None = None
    pin_radius: Metres[Positive] | None = None

    @model_validator(mode="after")
    def _shape_goes_with_friction(self) -> IdealGuide:
        if self.block is not None and self.pin_radius is not None:
            raise ValueError(f"block = {self.block}, pin_radius = {self.pin_radius}: allowed: one of them")
        if self.friction is None and (self.block is not None or self.pin_radius is not None):
            raise ValueError("friction = None: a block or a pin_radius serves friction only; allowed: a law")
        return self

    def refused_in_space(self) -> tuple[str, str] | None:
        """Friction is of the plane alone."""
        return None if self.friction is None else ("IdealGuide with friction", "IdealGuide without")

    def lever(self, across: float) -> float:
        """Arm [m] of the friction force about the guide's point, for a force of the guide across [N]."""
        return math.copysign(self.pin_radius, across) if self.pin_radius is not None else 0.0

    def friction_force(self, across: float, moment: float, slip: float, deflection: float = 0.0) -> float:
        """Friction force on the body [N] along the guide.

        Arguments:
            across, moment: of the guide on the body [N], [N m].
            slip: of the body on the guide [m/s]. deflection: state of the law [m].
        """
        law = self.friction
        if law is None:
            return 0.0
        if self.block is None:
            return float(law(slip, abs(across), deflection))
        half_length, half_height = 0.5 * self.block[0], 0.5 * self.block[1]
        larger = larger_load(across, moment, half_length)
        ratio = law(slip, larger, deflection) / larger if larger > 0.0 else 0.0
        ends = end_loads(across, moment, ratio, half_length, half_height)
        return float(sum(law(slip, end, deflection) for end in ends))

    def losses(self) -> dict[str, object]:
        """An ideal guide loses energy by friction."""
        return {} if self.friction is None else {"friction_loss": self.friction}


@value
class ClearanceGuide(Guide):
    """A block, or a round pin, that is free between two straight walls and pushed by contact.

    Every corner of the block may meet either wall; a face that lies on a wall touches by both its corners.

    Arguments:
        gaps: from the block or the pin to the upper and to the lower wall at the start [m], >= 0, not both 0.
        normal: law of the normal force at every corner.
        friction: law of the friction force at every corner; none by default.
        block: length and height of the block, in whose middle the guide's point is [m].
        pin_radius: of a pin in place of a block, about the guide's point [m]; for guides that let turn.
    """

    holds: ClassVar[bool] = False
    gaps: Metres[Gaps]
    normal: NormalLaw
    friction: FrictionLaw = Frictionless()
    block: Metres[tuple[Positive, Positive]] | None = None
    pin_radius: Metres[Positive] | None = None

    @model_validator(mode="after")
    def _has_play_and_a_shape(self) -> ClearanceGuide:
        if sum(self.gaps) == 0.0:
            raise ValueError(
                f"gaps = {self.gaps} m: allowed: at least one > 0; without play make an IdealGuide"
            )
        if (self.block is None) == (self.pin_radius is None):
            raise ValueError(f"block = {self.block}, pin_radius = {self.pin_radius}: allowed: one of them")
        self.contacts()
        return self

    @classmethod
    def simple(
        cls,
        *,
        gaps: float | Gaps,
        block: tuple[float, float] | None = None,
        pin_radius: float | None = None,
        restitution: float | None = None,
        friction: float | FrictionLaw = 0.0,
        law: type[NormalLaw] = Exact,
        rest_velocity: float | None = None,
        stiffness: float | None = None,
        corner_radius: float | None = None,
        wall_material: Material = STEEL,
        block_material: Material = STEEL_35CRMO,
    ) -> ClearanceGuide:
        """A guide with clearance in few words, as scenario files have it; the rest has usual values.

            ClearanceGuide.simple(gaps=1e-3, block=(0.1, 0.05), restitution=0.4, friction=0.01)

        Arguments:
            gaps: to the upper and to the lower wall at the start [m], one number for both.
            block: its length and height [m]. pin_radius: of a pin in its place [m].
            restitution: of an impact, > 0 and <= 1; 0.9 if nothing is said.
            friction: sliding coefficient of Ambrosio's law, >= 0, 0: none; or a friction law.
            law: class of the normal force, one that needs nothing but a stiffness and a restitution.
            rest_velocity: smallest velocity that the damping is scaled with [m/s], > 0; the law's own if None.
            stiffness: K of K depth^1.5 [N/m^1.5], > 0; by default Hertz's of a sphere on a plane.
            corner_radius: of that sphere [m], > 0; by default the pin's, or a tenth of the block's height.
            wall_material, block_material: for the stiffness.

        Raises InputError that names what does not fit, its value and what is allowed.
        """
        both = (gaps, gaps) if isinstance(gaps, (int, float)) else gaps
        if stiffness is not None and corner_radius is not None:
            raise InputError(
                f"stiffness = {short(stiffness)}, corner_radius = {short(corner_radius)} m: "
                "allowed: one of them"
            )
        if stiffness is None and "stiffness" in fields_of(law):
            radius = corner_radius or pin_radius or (ROUNDING * block[1] if block else None)
            if radius is None:
                raise InputError("block: missing; allowed: length and height [m], or pin_radius")
            stiffness = plane_contact_stiffness(radius, wall_material, block_material)
        return cls(
            gaps=both,
            normal=law_with(law, stiffness=stiffness, restitution=restitution, rest_velocity=rest_velocity),
            friction=friction_of(friction),
            block=block,
            pin_radius=pin_radius,
        )

    @property
    def play(self) -> float:
        """Half of the way between the walls [m], as the clearance of a pin is."""
        return 0.5 * sum(self.gaps)

    def refused_in_space(self) -> tuple[str, str] | None:
        """Clearance in a guide is of the plane alone."""
        return (type(self).__name__, "IdealGuide")

    def contacts(self) -> Mapping[str, GuideContact]:
        """The corners of the block, or the pin, by name."""
        upper, lower = self.gaps
        middle, radius = 0.5 * (upper - lower), self.pin_radius or 0.0
        half_length, half_height = (0.5 * size for size in self.block or (0.0, 0.0))
        slot = Slot(clearance=half_height + self.play, radius=radius)
        contact = SlotContact(bearing=slot, normal=self.normal, friction=self.friction)
        places = {PIN: (0, 0)} if self.block is None else CORNERS
        return {
            name: GuideContact((x * half_length, y * half_height), middle, contact)
            for name, (x, y) in places.items()
        }

    def losses(self) -> dict[str, object]:
        """A guide with clearance loses energy by the damping and the friction of its contacts."""
        return {"damping_loss": self.normal, "friction_loss": self.friction}
