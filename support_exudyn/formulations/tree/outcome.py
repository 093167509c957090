"""What a finished run says: all forces at chosen instants, motion at the records, integrals, largest forces."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from support_exudyn.formulations.contract import Failure, SimulationError
from support_exudyn.formulations.time_grid import record_times
from support_exudyn.formulations.tree.branches import Matrix, Numbers, Tree
from support_exudyn.formulations.tree.drive_pieces import extension, speed
from support_exudyn.formulations.tree.dynamics import PointForce, TreePosture, accelerations
from support_exudyn.formulations.tree.integration import Integration
from support_exudyn.formulations.tree.within_steps import POINTS, Ends, Look, largest, motion_within, running
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import DataNeeds
from support_exudyn.mechanics.contact_history import acting, contact_series, ends, of_depth
from support_exudyn.mechanics.joint_forces import JointForces, PinForce, open_joint_forces
from support_exudyn.mechanics.oil_column import OilSeries, PreloadedActuator
from support_exudyn.mechanics.trajectory import ContactSeries, Counts, Outcome, Trajectory
from support_exudyn.model.linkage import PinPlace
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import SHALLOWEST
from user_forces.lawful import UNLAWFUL, LawError, look
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class Instants:
    """Where and how the run is looked at.

    time (m,) [s]. posture: at these times. cubic: of the drives of all actuators (m, c, 5), see `loads`.
    memories: of clearance pins, by name (m, fields of PinMemory).
    """

    time: Matrix
    posture: TreePosture
    cubic: Matrix
    memories: Mapping[str, Matrix]


@dataclass(frozen=True)
class TreeObservation:
    """What is to be seen at some instants.

    Arguments:
        at: the instants.
        with_clearance: clearance pins, by name.
        filled: actuators, by name.
        gravity: [m/s^2].
    """

    at: Instants
    with_clearance: Mapping[str, ClearancePin]
    preloaded: Mapping[str, PreloadedActuator]
    gravity: Vector2

    @cached_property
    def motion(self) -> BodyMotion:
        """The motion of all bodies; accelerations are left out."""
        return self.at.posture.motion()

    @cached_property
    def contacts(self) -> dict[str, ContactSeries]:
        """Clearance pins by name."""
        return {
            name: contact_series(self.motion, self._place(name), pin, self.at.memories[name])
            for name, pin in self.with_clearance.items()
        }

    @cached_property
    def actuators(self) -> dict[str, OilSeries]:
        """Actuators by name."""
        return {
            name: self._actuator(n, preloaded) for n, (name, preloaded) in enumerate(self.preloaded.items())
        }

    @cached_property
    def pin_forces(self) -> dict[str, PointForce]:
        """Forces of clearance pins, of the first body on the second, where they act."""
        found = {}
        for name, pin in self.with_clearance.items():
            place = self._place(name)
            push = acting(self.motion, place, pin, self.contacts[name])
            found[name] = PointForce(place.first, place.second, push.force, push.point)
        return found

    def accelerations(self) -> Matrix:
        """q'' [rad/s^2] by the equations of motion, shape (m, n)."""
        return accelerations(
            self.at.posture, self.gravity, [*self.pin_forces.values(), *self._actuator_forces()]
        )

    def powers(self) -> Matrix:
        """The powers of the drive, of damping and of friction [W], shape (3, m)."""
        total = np.zeros((3, len(self.at.time)))
        for actuator in self.actuators.values():
            total[0] += actuator.work
            total[1] += actuator.loss
        for name, contact in self.contacts.items():
            bore, journal = ends(self.motion, self._place(name), self.with_clearance[name])
            offset, relative = journal.position - bore.position, journal.velocity - bore.velocity
            away = np.maximum(np.linalg.norm(offset, axis=1), SHALLOWEST)
            rate = np.einsum("mx,mx->m", offset, relative) / away
            pressed = (self.at.memories[name][:, 0] > 0.5) & (contact.depth > 0.0)
            law = self.with_clearance[name].contact.normal
            elastic = of_depth(law.elastic_force, np.maximum(contact.depth, SHALLOWEST))
            lost = np.where(pressed, (contact.normal_force - elastic) * rate, 0.0)
            rubbed = contact.friction_force * contact.slip
            total[1] += lost
            total[2] -= rubbed
            odd = pressed & ~((lost >= 0.0) & (rubbed <= 0.0) & (elastic >= 0.0))
            for n in np.flatnonzero(odd).tolist():
                context = (
                    contact.depth,
                    rate,
                    contact.slip,
                    contact.normal_force,
                    contact.friction_force,
                    elastic,
                )
                self._look(name, n, *(float(values[n]) for values in context))
        return total

    def _look(self, name: str, n: int, *context: float) -> None:
        """Raise SimulationError if what a pin's laws gave at an instant cannot be a force, see `look`."""
        depth, rate, slip, normal, friction, elastic = context
        try:
            look(self.with_clearance[name].contact, depth, rate, slip, normal, friction, elastic, name)
        except LawError as error:
            failure = Failure(str(error), UNLAWFUL, float(self.at.time[n]))
            raise SimulationError(failure) from error

    def _place(self, name: str) -> PinPlace:
        return self.motion.linkage.pins[name]

    def _actuator(self, number: int, preloaded: PreloadedActuator) -> OilSeries:
        cubic = self.at.cubic[:, number]
        let_in = extension(cubic, self.at.time), speed(cubic, self.at.time)
        return preloaded.series(self.motion, *let_in)

    def _actuator_forces(self) -> list[PointForce]:
        found = []
        for name, preloaded in self.preloaded.items():
            foot, head = (end.position for end in preloaded.ends(self.motion))
            along = (head - foot) / np.linalg.norm(head - foot, axis=1)[:, None]
            force = self.actuators[name].force[:, None] * along
            found.append(PointForce(preloaded.actuator.foot, preloaded.actuator.head, force, head))
        return found


CLOSE = 1e-12  # [s]: a record so little behind the end of a step belongs to it


class EvaluatedRun:
    """A finished run, to be looked at anywhere.

    Accelerations and forces are those of the equations of motion at the place and velocity looked at.

    Arguments:
        tree: the bodies.
        scenario: clearance pins, gravity, records.
        filled: columns of oil, by name.
        run: that is finished.
    """

    def __init__(
        self, tree: Tree, scenario: Scenario, preloaded: dict[str, PreloadedActuator], run: Integration
    ) -> None:
        self.tree, self.scenario, self.preloaded, self.run = tree, scenario, preloaded, run
        history = run.history
        self.time = np.array(history.time)
        self.step = np.diff(self.time)
        self._cubic = np.array([piece.cubic for piece in run.pieces])[history.piece]
        self._memories = {name: history.pin_memory(n) for n, name in enumerate(run.pins)}
        position, velocity = np.array(history.position), np.array(history.velocity)
        self._start = self._end_of_steps(0.0, position[:-1], velocity[:-1])
        self._end = self._end_of_steps(1.0, position[1:], velocity[1:])

    def outcome(self) -> Outcome:
        """Everything that is asked of a run."""
        run, steps = self.run, np.arange(len(self.step))
        needed = needs(self.scenario)
        inside = self._within(np.repeat(steps, len(POINTS)), np.tile(POINTS, len(steps)))
        pins = run.pins.values()
        tops = {
            name: largest(_sizes(inside, name).reshape(-1, len(POINTS)), self._force_of(name))
            for name in inside.contacts
        }
        return Outcome(
            trajectory=self._trajectory(inside, needed),
            onsets={name: tuple(pin.onsets) for name, pin in run.pins.items()},
            largest_force={name: top for name, (top, _) in tops.items()},
            largest_force_time={
                name: float(self.time[step + 1]) if top > 0.0 else 0.0 for name, (top, step) in tops.items()
            },
            impulses=(),  # all actuators give, so nothing is struck
            counts=Counts(
                steps=run.steps,
                cut_steps=run.cut_steps,
                evaluations=run.forces.evaluations,
                user_function_calls=sum(pin.calls for pin in pins),
                clamped_steps=sum(pin.clamped_steps for pin in pins),
            ),
        )

    def _trajectory(self, inside: TreeObservation, needed: DataNeeds) -> Trajectory:
        """At the records; what is not needed is left out. inside: at the points of quadrature of all steps."""
        time = record_times(self.scenario.duration, self.scenario.record_period)
        number = np.clip(np.searchsorted(self.time, time - CLOSE) - 1, 0, len(self.step) - 1)
        fraction = np.clip((time - self.time[number]) / self.step[number], 0.0, 1.0)
        integrals = np.zeros((3, len(time)))
        if DataNeeds.INTEGRALS in needed:
            powers = inside.powers().reshape(3, -1, len(POINTS))
            integrals = running(powers, self.step, number, fraction)
        context = self._within(number, fraction)
        motion, joints = context.motion, JointForces()
        if needed & (DataNeeds.ACCELERATION | DataNeeds.JOINTS):
            motion = context.at.posture.motion(context.accelerations())
        if DataNeeds.JOINTS in needed:
            joints = self._joint_forces(context, motion)
        oil = context.actuators if DataNeeds.OIL in needed else {}
        return Trajectory(
            time=time,
            position=motion.position,
            velocity=motion.velocity,
            acceleration=motion.acceleration,
            ideal_pins={n: force for n, force in joints.pins.items() if n not in self.scenario.clearance_pins},
            contacts=context.contacts if DataNeeds.CONTACTS in needed else {},
            actuators={name: actuator.force for name, actuator in oil.items()},
            cranks={},
            slides={},
            oil_energy=sum((actuator.energy for actuator in oil.values()), np.zeros_like(time)),
            work=integrals[0],
            damping_loss=integrals[1],
            friction_loss=integrals[2],
        )

    def _joint_forces(self, context: TreeObservation, motion: BodyMotion) -> JointForces:
        actuators = {name: actuator.force for name, actuator in context.actuators.items()}
        known = {name: PinForce(pin.force, pin.point) for name, pin in context.pin_forces.items()}
        return open_joint_forces(motion, self.scenario.gravity, actuators, known)

    def _force_of(self, pin: str) -> Look:
        """Magnitude of the force [N] of a clearance pin at fractions of steps."""
        return lambda number, fraction: _sizes(self._within(number, fraction), pin)

    def _end_of_steps(self, fraction: float, position: Matrix, velocity: Matrix) -> Ends:
        each = np.arange(len(self.step))
        context = self._look(each, np.full(len(each), fraction), position, velocity)
        return Ends(position, velocity, context.accelerations())

    def _within(self, number: Numbers, fraction: Matrix) -> TreeObservation:
        """At fractions of steps."""
        return self._look(number, fraction, *motion_within(self._start, self._end, self.step, number, fraction))

    def _look(self, number: Numbers, fraction: Matrix, position: Matrix, velocity: Matrix) -> TreeObservation:
        instants = Instants(
            time=self.time[number] + fraction * self.step[number],
            posture=TreePosture(self.tree, position, velocity),
            cubic=self._cubic[number],
            memories={name: memory[number] for name, memory in self._memories.items()},
        )
        return TreeObservation(instants, self.scenario.clearance_pins, self.preloaded, self.scenario.gravity)


def _sizes(context: TreeObservation, pin: str) -> Matrix:
    """Magnitudes of the force of a clearance pin [N]."""
    contact = context.contacts[pin]
    return np.asarray(np.hypot(contact.normal_force, contact.friction_force))
