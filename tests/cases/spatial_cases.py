"""Machines in space of a test's own, and what a run of one shows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from support_exudyn import Body, LinearActuator, Linkage, Machine, PinPlace, Scenario
from support_exudyn.formulations.exudyn.run import run
from support_exudyn.mechanics.observed_run import Outcome, Trajectory
from support_exudyn.model.spatial_linkage import Bearing, SpatialBody, SpatialLinkage
from user_forces import (
    Ambrosio,
    FrictionLaw,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    value,
)

Vector = tuple[float, float, float]
CLEARANCE, LENGTH = 1e-3, 0.1  # of bearings of the tests' own [m]
STIFFNESS = 1e9  # [N/m^1.5]


@value
class InSpace(Machine):
    """A machine that is known in space; its plane has the same names."""

    space: SpatialLinkage

    def linkage(self) -> Linkage:
        """Its shadow on the plane, with pins that fit."""
        space = self.space
        return Linkage(
            bodies={
                name: Body(mass=body.mass, inertia=body.inertia[2], centre=body.centre[:2])
                for name, body in space.bodies.items()
            },
            pins={
                b.pin: PinPlace(
                    first=b.first,
                    second=b.second,
                    first_point=b.first_point[:2],
                    second_point=b.first_point[:2],
                )
                for b in space.bearings.values()
            },
            actuators={
                c.actuator: LinearActuator(
                    foot=c.foot, head=c.head, foot_point=c.foot_point[:2], head_point=c.head_point[:2]
                )
                for c in space.actuators.values()
            },
        )

    def in_space(self, linkage: Linkage) -> SpatialLinkage:
        """As it is."""
        return self.space


def contact(friction: float = 0.0, by_depth: bool = False) -> JournalContact:
    """The paper's law with a rest velocity of 1 mm/s, or the default."""
    law: FrictionLaw = Ambrosio(sliding_coefficient=friction) if friction else Frictionless()
    return JournalContact(
        bearing=JournalBearing(bore_radius=0.02, clearance=CLEARANCE),
        normal=LankaraniNikravesh(
            stiffness=STIFFNESS,
            restitution=0.8,
            rest_velocity=1e-2 if by_depth else 1e-3,
        ),
        friction=law,
    )


def observed(scenario: Scenario) -> tuple[Trajectory, Outcome]:
    """A run, with the motion that no channel shows."""
    outcome = run(scenario, lambda share: None)
    return outcome.trajectory, outcome


def matrix_of(inertia: tuple[float, ...]) -> np.ndarray:
    """Tensor from xx, yy, zz, yz, xz, xy."""
    xx, yy, zz, yz, xz, xy = inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def momenta(context: Trajectory, about: Vector = (0.0, 0.0, 0.0)) -> tuple[np.ndarray, np.ndarray]:
    """Linear and angular momentum of all bodies (n, 3), the latter about a fixed point."""
    motion = context.motion
    linear, angular = np.zeros((2, motion.count, 3))
    for n, body in enumerate(motion.linkage.bodies.values()):
        place = np.array(body.centre) + motion.displacement[:, n] - np.array(about)
        momentum = body.mass * motion.centre_velocity[:, n]
        turn, spin = motion.rotations[:, n], motion.spins[:, n]
        own = np.einsum("nij,jk,nlk,nl->ni", turn, matrix_of(body.inertia), turn, spin)
        linear += momentum
        angular += np.cross(place, momentum) + own
    return linear, angular


# --- random placements ---


def _between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_subnormal=False)


def vectors(size: float) -> st.SearchStrategy[Vector]:
    """With components up to a size."""
    return st.tuples(*[_between(-size, size)] * 3)


@st.composite
def directions(draw: st.DrawFn) -> Vector:
    """Unit vectors anywhere."""
    z, turn = draw(_between(-1.0, 1.0)), draw(_between(-math.pi, math.pi))
    across = math.sqrt(1.0 - z * z)
    found = np.array([across * math.cos(turn), across * math.sin(turn), z])
    x, y, z = (found / np.linalg.norm(found)).tolist()
    return x, y, z


@st.composite
def inertias(draw: st.DrawFn) -> tuple[float, ...]:
    """Of a bar-like or plate-like body with any principal axes [kg m^2]."""
    moments = np.array(draw(st.tuples(*[_between(0.005, 0.03)] * 3)))  # integrals of x^2, y^2, z^2
    axes = turned_frame(draw(directions()), draw(_between(-3.0, 3.0)))
    j = axes @ np.diag(moments.sum() - moments) @ axes.T
    return tuple(float(j[k]) for k in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)))


def turned_frame(axis: Vector, angle: float) -> np.ndarray:
    """Rotation matrix about an axis by Rodrigues' formula."""
    x, y, z = axis
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k


@st.composite
def placements(draw: st.DrawFn, on_ground: bool = False) -> SpatialLinkage:
    """Two bodies, or one and the ground, and a clearance bearing between them, eccentric and tilted at the
    start.

    The edges are inside the clearance or pressed in by up to a tenth of it.
    """
    one, two = (
        SpatialBody(
            mass=draw(_between(1.0, 5.0)),
            inertia=draw(inertias()),
            centre=draw(vectors(0.2)),
            velocity=draw(vectors(0.2)),
            spin=draw(vectors(4.0)),
        )
        for _ in range(2)
    )
    axis, point = np.array(draw(directions())), np.array(draw(vectors(0.2)))
    across = np.cross(axis, np.array(draw(directions())))
    size = float(np.linalg.norm(across))
    across = across / size if size > 1e-3 else np.zeros(3)
    shift = CLEARANCE * draw(_between(0.0, 0.7))
    tilted = axis + np.cross(axis, across) * draw(_between(-0.4, 0.4)) * CLEARANCE / (0.5 * LENGTH)
    tilted /= np.linalg.norm(tilted)
    holds = draw(st.sampled_from([frozenset(), frozenset({"along"})]))
    if holds:  # velocities that the stop allows
        rate = sum(
            sign * axis @ (np.array(body.velocity) + np.cross(body.spin, point + place - body.centre))
            for body, sign, place in (
                (one, 0.0 if on_ground else -1.0, 0.0 * across),
                (two, 1.0, shift * across),
            )
        )
        # the axis turns with the first body
        rate += 0.0 if on_ground else float(np.cross(one.spin, axis) @ (shift * across))
        two = replace(two, velocity=tuple((np.array(two.velocity) - rate * axis).tolist()))
    bearing = Bearing(
        first="ground" if on_ground else "one",
        second="two",
        first_point=tuple(point.tolist()),
        second_point=tuple((point + shift * across).tolist()),
        first_axis=tuple(axis.tolist()),
        second_axis=tuple(tilted.tolist()),
        length=LENGTH,
        holds=holds,
        pin="pin",
    )
    bodies: Mapping[str, SpatialBody] = {"two": two} if on_ground else {"one": one, "two": two}
    return SpatialLinkage(bodies=bodies, bearings={"pin": bearing})
