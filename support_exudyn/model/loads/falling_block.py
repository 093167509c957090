"""A block of rock that falls on a machine."""

import math
from dataclasses import replace
from functools import cached_property
from typing import Annotated

import numpy as np
from pydantic import Field

from support_exudyn.model.linkage import GROUND, Body, Linkage, Slide
from support_exudyn.model.loads.load import AnyLoad
from support_exudyn.model.plane_geometry import minus, rotated
from support_exudyn.model.spatial_linkage import UP, Bearing, SpatialBody, SpatialLinkage
from support_exudyn.model.to_space import at
from user_forces.contact import FaceContact
from user_forces.journal import Face
from user_forces.normal.power_laws import Exact
from user_forces.values.units import (
    Kilograms,
    KilogramsPerCubicMetre,
    Metres,
    MetresPerSecond,
    NewtonsPerMetreToN,
    Radians,
)
from user_forces.values.value import NonNegative, Positive, Real, Restitution, Vector2, value

STEEPEST = math.radians(80.0)  # slope of a face; one that stands upright cannot be fallen on


@value
class FallingBlock(AnyLoad):
    """A block that falls on a point of a body, upright on a guide, bounces and comes to rest on it.

        F = K depth^n (1 + chi rate / w),   cut at 0,   rate = d depth/dt
        chi (1 + e) = ln((1 + chi)/(1 - chi e)),   w: see `Hysteresis`

    depth is how far the point is behind the block's face. The law is `user_forces.Exact`: without weight every
    bounce, whatever its speed and the masses, gives back the restitution e; with e = 1 the force is K depth^n
    exactly. Weight takes a little of a bounce, the more the softer it is.

    The face keeps its slope, for the block does not turn, and there is no friction along it: the force acts
    along its normal, and the guide carries what of it is forward. Give the face the slope of the plate that it
    falls on; level, it pushes straight down.

    The block is a body of the machine with the load's name, so that channels such as NAME.y (of its centre) and
    NAME.velocity_y tell its motion. Its face is a contact, as a clearance pin is: its blows are located, and
    `Result` has them by the load's name. Channels of its own: NAME.force, NAME.gap, NAME.impact_velocity.

    It starts at t = 0 and strikes at sqrt(2 height/g) if it starts at rest and the point stands still; with no
    height, speed and weight it waits to be struck.

    Arguments:
        body, point: what it falls on, and where, start posture [m].
        lateral: how far to the right of the machine's plane that is in space [m]; without effect in the plane.
        mass: of the block [kg], > 0.
        height: of its face straight over the point in the start posture [m], >= 0.
        stiffness: K [N/m^n], > 0.
        restitution: e of every bounce [-], > 0 and <= 1.
        exponent: n [-], from 1 to 3; 1.5 for round faces, 1 for a cushion.
        speed: with which it starts downward [m/s], >= 0.
        slope: of the face from level, anticlockwise [rad], up to 80 degrees either way.
        density: by which its size is told from its mass [kg/m^3], > 0.
    """

    point: Metres[Vector2]
    lateral: Metres[Real] = 0.0
    mass: Kilograms[Positive]
    height: Metres[NonNegative]
    stiffness: NewtonsPerMetreToN[Positive]
    restitution: Restitution
    exponent: Annotated[Real, Field(ge=1, le=3)] = 1.5
    speed: MetresPerSecond[NonNegative] = 0.0
    slope: Radians[Annotated[Real, Field(ge=-STEEPEST, le=STEEPEST)]] = 0.0
    density: KilogramsPerCubicMetre[Positive] = 2600.0

    def first_depth(self, gravity: Vector2) -> float:
        """Depth [m] of the first blow on what stands still, undamped, under gravity [m/s^2]; 0: none."""
        energy = self.mass * (0.5 * self.speed**2 - gravity[1] * self.height)
        return self.contact.normal.turning_depth(max(0.0, energy))

    @property
    def side(self) -> float:
        """Side of a cube of the block's mass and density [m]."""
        return float(np.cbrt(self.mass / self.density))

    @property
    def inertia(self) -> float:
        """Inertia of that cube about its middle [kg m^2]."""
        return self.mass * self.side**2 / 6.0

    @property
    def centre(self) -> Vector2:
        """Its middle in the start posture [m]."""
        x, y = self.point
        return x, y + self.height + 0.5 * self.side

    @cached_property
    def contact(self) -> FaceContact:
        """Geometry and law of its face."""
        law = Exact(stiffness=self.stiffness, restitution=self.restitution, exponent=self.exponent)
        return FaceContact(bearing=Face(clearance=self.side), normal=law)

    @property
    def reference(self) -> Vector2:
        """The point of the block from which its contact measures, in front of its face, start posture [m]."""
        x, y = self.point
        return minus((x, y + self.height), rotated((0.0, self.side), self.slope))

    @property
    def start_depth(self) -> float:
        """How far the point is behind the face in the start posture, negative [m]."""
        return -self.height * math.cos(self.slope)

    def joined(self, linkage: Linkage, name: str) -> Linkage:
        """The linkage with the block and its upright guide, NAME_guide."""
        block = Body(mass=self.mass, inertia=self.inertia, centre=self.centre, velocity=(0.0, -self.speed))
        guide = Slide(body=name, point=self.centre, direction=0.5 * math.pi)
        return replace(
            linkage,
            bodies={**linkage.bodies, name: block},
            slides={**linkage.slides, f"{name}_guide": guide},
        )

    def joined_in_space(self, linkage: SpatialLinkage, name: str) -> SpatialLinkage:
        """The linkage in space with the block and its guide, which lets it turn about no axis."""
        inertia, centre = self.inertia, at(self.centre, self.lateral)
        block = SpatialBody(
            mass=self.mass,
            inertia=(inertia, inertia, inertia, 0.0, 0.0, 0.0),
            centre=centre,
            velocity=(0.0, -self.speed, 0.0),
        )
        guide = Bearing(
            first=GROUND,
            second=name,
            first_point=centre,
            second_point=centre,
            first_axis=UP,
            second_axis=UP,
            holds=frozenset({"tilt", "turn"}),
            pin=f"{name}_guide",
            is_guide=True,
        )
        return replace(
            linkage,
            bodies={**linkage.bodies, name: block},
            bearings={**linkage.bearings, guide.pin: guide},
        )

    def against(self, name: str) -> str:
        """The opposite force acts on the block."""
        return name
