"""Geometry, normal law and friction law together: force of a bore on its journal, or of a wall on a corner.

The contact kernels are functions of numbers. The engine's user function, the compiled formulation, the static
equilibrium and the records all call the same ones, so the force in a report is the force of the run.
"""

from __future__ import annotations

import math
from abc import ABC
from collections.abc import Callable
from dataclasses import replace
from functools import cache, cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from pydantic import model_validator

from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.journal import ContactGeometry, Face, JournalBearing, Slot
from user_forces.kernel import Formula, compiled_or_plain, kernel, numbers
from user_forces.normal.law import NormalLaw
from user_forces.values.value import Value, value

SHALLOWEST = 1e-30  # depth [m] with which a law is evaluated where there is no contact
GEOMETRY = 2  # constants of a geometry that come first, see `ContactGeometry.constants`


class ContactForce(NamedTuple):
    """State of a journal in its bore and the force of the bore on the journal.

    x and y are the axes in which the displacement was given.
    """

    depth: float  # [m], negative: gap
    rate: float  # of depth [m/s]
    slip: float  # of the journal's surface on the bore's, along t [m/s]
    normal_force: float  # [N] >= 0, along -n
    friction_force: float  # [N], along t
    force_x: float  # [N]
    force_y: float  # [N]
    journal_arm: float  # of the contact point from the journal's centre, along n [m]
    clamped: bool  # the law asked for tension, which was cut to zero
    deflection: float  # state of the friction law, 0 if it has none [m]

    @property
    def journal_moment(self) -> float:
        """Moment [N m] of the force about the journal's centre."""
        return self.journal_arm * self.friction_force


class SlipHistory(NamedTuple):
    """What a friction law with a state needs of the step that is being made.

    deflection: at its start [m]. slip: at its start [m/s]. step: its length [s].
    """

    deflection: float
    slip: float
    step: float


Array = npt.NDArray[np.float64]
AT_REST = SlipHistory(0.0, 0.0, 0.0)
Kernel = Callable[..., Any]


class Contact(Value, ABC):
    """Contact of a journal in what encloses it: geometry, normal law and friction law."""

    bearing: ContactGeometry
    normal: NormalLaw
    friction: FrictionLaw

    @cached_property
    def constants(self) -> tuple[float, ...]:
        """Numbers of geometry and laws that `force_kernel` takes last."""
        return (*self.bearing.constants, *self.law_constants)

    @cached_property
    def law_constants(self) -> tuple[float, ...]:
        """Numbers of the laws that `law_kernel` takes last."""
        return (self.normal.largest_depth, *(number for part in self._formulas for number in part.parameters))

    @property
    def _formulas(self) -> tuple[Formula, ...]:
        """Force, elastic force, friction, and of a friction law with a state its rate and its advance."""
        normal, friction = self.normal, self.friction
        stateless = normal.force_formula, normal.elastic_formula, friction.force_formula
        if not friction.has_state:
            return stateless
        return *stateless, friction.rate_formula, friction.advance_formula

    @cached_property
    def law_kernel(self) -> Kernel:
        """Both laws as one function of numbers, see `law_kernel_of`."""
        functions = [part.function for part in self._formulas]
        counts = [len(part.parameters) for part in self._formulas]
        normal, elastic, friction = functions[:3]
        rate = functions[3] if self.friction.has_state else None
        return law_kernel_of(normal, elastic, friction, rate, tuple(counts[:4]))

    @cached_property
    def force_kernel(self) -> Kernel:
        """Kinematics and laws as one function of numbers, see `force_kernel_of`."""
        advance = self.friction.advance_formula if self.friction.has_state else None
        return force_kernel_of(
            self.bearing.kinematics,
            self.law_kernel,
            advance.function if advance else None,
            len(self.constants) - (len(advance.parameters) if advance else 0),
            len(advance.parameters) if advance else 0,
        )

    def force(
        self,
        x: float,
        y: float,
        vx: float,
        vy: float,
        bore_spin: float,
        journal_spin: float,
        impact_velocity: float | None,
        history: SlipHistory = AT_REST,
    ) -> ContactForce:
        """Force of the bore on the journal.

        Arguments:
            x, y: journal's centre minus bore's centre [m], in any axes; of a slot 0 and the distance from the
                middle line, of a face 0 and that from the line in front of it.
            vx, vy: velocity of the journal's centre minus that of the bore's centre [m/s], same axes;
                the plain difference, not the rate seen by an observer who turns with the bore. Of a slot along
                and across: the plain difference from any point of the middle line, less along y what the
                slot's turning moves the walls across at the place of the corner.
            bore_spin, journal_spin: angular velocities of both bodies [rad/s].
            impact_velocity: of the present contact [m/s], see `NormalLaw`; None while the surfaces are
                separated, and then there is no force whatever the depth.
            history: for friction laws with a state, the step whose end this is.

        Returns:
            ContactForce. The force acts at the same point of space on both bodies, so linear and angular
            momentum are conserved: on the journal `journal_arm` from its centre along n, which is
            `journal_arm` plus the eccentricity from the bore's. From the middle every direction leads outwards:
            there the rate is the speed.

        Raises LoadError beyond the depth for which the normal law is valid.
        """
        closed, speed = impact_velocity is not None, impact_velocity or 0.0
        motion = (x, y, vx, vy, bore_spin, journal_spin)
        result = ContactForce(*self.force_kernel(*motion, closed, speed, *history, self.constants))
        if closed:
            self.normal.check(result.depth)
        return result

    def forces(self, rows: Array) -> ContactForce:
        """Forces at many instants, (n,) each.

        Arguments:
            rows: arguments of `force_kernel` without its constants, shape (n, 11).
        """
        out = np.empty((len(rows), len(ContactForce._fields)))
        rows_kernel_of(self.force_kernel)(np.ascontiguousarray(rows), np.array(self.constants), out)
        columns: list[Any] = [*out.T]
        return ContactForce(*columns)

    def energies(self, depths: Array) -> Array:
        """Stored energy (n,) [J] at depths (n,) [m]."""
        energy, out = self.normal.energy_formula, np.empty(len(depths))
        over = energies_kernel_of(energy.function, len(energy.parameters))
        over(np.ascontiguousarray(depths), np.array(energy.parameters), out)
        return out


@value
class JournalContact(Contact):
    """Contact of a journal in a bore: geometry, normal law and friction law.

    Arguments:
        bearing: radii and clearance.
        normal: law for the normal force.
        friction: law for the tangential force; none by default.
    """

    bearing: JournalBearing
    normal: NormalLaw
    friction: FrictionLaw = Frictionless()

    @model_validator(mode="after")
    def _law_is_of_this_bearing(self) -> JournalContact:
        own = getattr(self.normal, "bearing", self.bearing)
        if own != self.bearing:
            here, there = (f"({one.bore_radius}, {one.clearance}) m" for one in (own, self.bearing))
            raise ValueError(
                f"normal.bearing = {here} of bore radius and clearance: is another than that of the contact; "
                f"allowed: {there}"
            )
        return self

    def with_clearance(self, clearance: float) -> JournalContact:
        """The same bore and laws with another radial clearance [m], > 0."""
        bearing = replace(self.bearing, clearance=clearance)
        own = {"bearing": bearing} if hasattr(self.normal, "bearing") else {}
        return replace(self, bearing=bearing, normal=replace(self.normal, **own))  # type: ignore[type-var]


@value
class SlotContact(Contact):
    """Contact of a corner or a round pin with the walls of a slot: geometry, normal law and friction law.

    Arguments:
        bearing: the slot's geometry.
        normal: law for the normal force; one that depends on the radii of a bore does not fit.
        friction: law for the tangential force; none by default.
    """

    bearing: Slot
    normal: NormalLaw
    friction: FrictionLaw = Frictionless()

    @model_validator(mode="after")
    def _law_is_of_walls(self) -> SlotContact:
        _check_straight(self.normal)
        return self


@value
class FaceContact(Contact):
    """Contact of a point with a straight face: geometry and normal law; there is no friction along the face.

    Arguments:
        bearing: the face.
        normal: law for the normal force; one that depends on the radii of a bore does not fit.
    """

    bearing: Face
    normal: NormalLaw
    friction: Frictionless = Frictionless()

    @model_validator(mode="after")
    def _law_is_of_a_face(self) -> FaceContact:
        _check_straight(self.normal)
        return self


@cache
def law_kernel_of(
    normal: Kernel, elastic: Kernel, friction: Kernel, rate_of: Kernel | None, counts: tuple[int, ...]
) -> Kernel:
    """Both laws of a contact as one function of numbers, the same for all parameters.

        law(depth, rate, slip, speed, deflection, constants)

    gives the normal force [N] that the normal law asks for (negative: tension; NaN beyond the largest depth),
    its elastic part [N], the friction force [N], and the rate [m/s] of the deflection of a friction law with a
    state. speed: impact velocity [m/s]. constants: largest depth, then the parameters. counts: of these.
    """
    of_force, of_elastic, of_friction, of_rate = (*counts, 0)[:4]
    at_elastic = 1 + of_force
    at_friction = at_elastic + of_elastic
    at_rate = at_friction + of_friction

    def law(
        depth: float, rate: float, slip: float, speed: float, deflection: float, constants: Any
    ) -> tuple[float, float, float, float]:
        if depth > constants[0]:
            return math.nan, math.nan, math.nan, math.nan
        asked = normal(depth, rate, speed, *numbers(constants, 1, of_force))
        held = elastic(depth, *numbers(constants, at_elastic, of_elastic))
        pressed = 0.0 if asked < 0.0 else asked
        if rate_of is None:
            return asked, held, friction(slip, pressed, *numbers(constants, at_friction, of_friction)), 0.0
        bends = rate_of(deflection, slip, *numbers(constants, at_rate, of_rate))
        rubs = friction(slip, pressed, deflection, *numbers(constants, at_friction, of_friction))
        return asked, held, rubs, bends

    return kernel(law)


@cache
def force_kernel_of(
    kinematics: Kernel, law: Kernel, advance: Kernel | None, at_advance: int, of_advance: int
) -> Kernel:
    """The force of a contact as one function of numbers, the same for all parameters.

        force(x, y, vx, vy, bore_spin, journal_spin, closed, speed, deflection, slip, step, constants)

    gives the numbers of `ContactForce`. closed: whether the surfaces are in contact; speed: of their impact
    [m/s]; deflection [m], slip [m/s], step [s]: see `SlipHistory`. constants: of `Contact`.
    """

    def force(
        x: float,
        y: float,
        vx: float,
        vy: float,
        bore_spin: float,
        journal_spin: float,
        closed: bool,
        speed: float,
        deflection: float,
        slip_before: float,
        step: float,
        constants: Any,
    ) -> tuple[float, float, float, float, float, float, float, float, bool, float]:
        depth, rate, slip, nx, ny, arm = kinematics(
            x, y, vx, vy, bore_spin, journal_spin, constants[0], constants[1]
        )
        if not closed or depth <= 0.0:
            return depth, rate, slip, 0.0, 0.0, 0.0, 0.0, arm, False, 0.0
        bent = 0.0
        if advance is not None:
            mean_slip = 0.5 * (slip_before + slip)
            bent = advance(deflection, mean_slip, step, *numbers(constants, at_advance, of_advance))
        asked, _, friction, _ = law(depth, rate, slip, speed, bent, constants[GEOMETRY:])
        normal = 0.0 if asked < 0.0 else asked
        fx, fy = -normal * nx - friction * ny, -normal * ny + friction * nx
        return depth, rate, slip, normal, friction, fx, fy, arm, asked < 0.0, bent

    return kernel(force)


@cache
def rows_kernel_of(force: Kernel) -> Kernel:
    """A force kernel over many instants, as machine code if numba can compile it."""

    def over(rows: Any, constants: Any, out: Any) -> None:
        for n in range(rows.shape[0]):
            motion, memory = numbers(rows[n], 0, 6), numbers(rows[n], 7, 4)
            result = force(*motion, rows[n, 6] > 0.5, *memory, constants)
            depth, rate, slip, normal, friction, fx, fy, arm, clamped, deflection = result
            out[n, 0], out[n, 1], out[n, 2], out[n, 3], out[n, 4] = depth, rate, slip, normal, friction
            out[n, 5], out[n, 6], out[n, 7], out[n, 8], out[n, 9] = fx, fy, arm, clamped, deflection

    return compiled_or_plain(over, (np.zeros((1, 1)), np.zeros(1), np.zeros((1, 1))))


@cache
def energies_kernel_of(energy: Kernel, count: int) -> Kernel:
    """A stored energy over many depths, as machine code if numba can compile it; count: of its parameters."""

    def over(depths: Any, parameters: Any, out: Any) -> None:
        for n in range(depths.size):
            out[n] = energy(depths[n], *numbers(parameters, 0, count)) if depths[n] > 0.0 else 0.0

    return compiled_or_plain(over, (np.zeros(1), np.zeros(1), np.zeros(1)))


def _check_straight(law: NormalLaw) -> None:
    """Raise ValueError if a law depends on the radii of a pin in its bore."""
    if hasattr(law, "bearing"):
        raise ValueError(
            f"normal = {type(law).__name__}: is of a pin in its bore; "
            "allowed: laws of a stiffness, such as Exact"
        )
