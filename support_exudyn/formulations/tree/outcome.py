"""What a finished run says: motion and forces at the records, integrals, largest forces."""

from __future__ import annotations

import numpy as np

from support_exudyn.formulations.time_grid import record_times
from support_exudyn.formulations.tree.branches import Matrix, Numbers, Tree
from support_exudyn.formulations.tree.dynamics import Posture
from support_exudyn.formulations.tree.integration import Integration
from support_exudyn.formulations.tree.observation import Instants, Observation
from support_exudyn.formulations.tree.path import Ends, motion_within
from support_exudyn.formulations.tree.quadrature import POINTS, Look, largest, running
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import Part
from support_exudyn.mechanics.joint_forces import JointForces, PinForce, open_joint_forces
from support_exudyn.mechanics.oil_column import FilledColumn
from support_exudyn.mechanics.trajectory import Counts, Outcome, Trajectory
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario

CLOSE = 1e-12  # [s]: a record so little behind the end of a step belongs to it


class Aftermath:
    """A finished run, to be looked at anywhere.

    Accelerations and forces are those of the equations of motion at the place and velocity looked at.

    Arguments:
        tree: the bodies.
        scenario: loose pins, gravity, records.
        filled: columns of oil, by name.
        run: that is finished.
    """

    def __init__(
        self, tree: Tree, scenario: Scenario, filled: dict[str, FilledColumn], run: Integration
    ) -> None:
        self.tree, self.scenario, self.filled, self.run = tree, scenario, filled, run
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
        return Outcome(
            trajectory=self._trajectory(inside, needed),
            onsets={name: tuple(pin.onsets) for name, pin in run.pins.items()},
            largest_force={
                name: largest(_sizes(inside, name).reshape(-1, len(POINTS)), self._force_of(name))
                for name in inside.contacts
            },
            impulses=(),  # all columns give, so nothing is struck
            counts=Counts(
                steps=run.steps,
                cut_steps=run.cut_steps,
                evaluations=run.forces.evaluations,
                user_function_calls=sum(pin.calls for pin in pins),
                clamped_steps=sum(pin.clamped_steps for pin in pins),
            ),
        )

    def _trajectory(self, inside: Observation, needed: Part) -> Trajectory:
        """At the records; what is not needed is left out. inside: at the points of quadrature of all steps."""
        time = record_times(self.scenario.duration, self.scenario.record_period)
        number = np.clip(np.searchsorted(self.time, time - CLOSE) - 1, 0, len(self.step) - 1)
        fraction = np.clip((time - self.time[number]) / self.step[number], 0.0, 1.0)
        integrals = np.zeros((3, len(time)))
        if Part.INTEGRALS in needed:
            powers = inside.powers().reshape(3, -1, len(POINTS))
            integrals = running(powers, self.step, number, fraction)
        seen = self._within(number, fraction)
        motion, joints = seen.motion, JointForces()
        if needed & (Part.ACCELERATION | Part.JOINTS):
            motion = seen.at.posture.motion(seen.accelerations())
        if Part.JOINTS in needed:
            joints = self._joint_forces(seen, motion)
        oil = seen.columns if Part.OIL in needed else {}
        return Trajectory(
            time=time,
            position=motion.position,
            velocity=motion.velocity,
            acceleration=motion.acceleration,
            ideal_pins={n: force for n, force in joints.pins.items() if n not in self.scenario.clearance_pins},
            contacts=seen.contacts if Part.CONTACTS in needed else {},
            columns={name: column.force for name, column in oil.items()},
            cranks={},
            slides={},
            oil_energy=sum((column.energy for column in oil.values()), np.zeros_like(time)),
            work=integrals[0],
            damping_loss=integrals[1],
            friction_loss=integrals[2],
        )

    def _joint_forces(self, seen: Observation, motion: BodyMotion) -> JointForces:
        columns = {name: column.force for name, column in seen.columns.items()}
        known = {name: PinForce(pin.force, pin.point) for name, pin in seen.pin_forces.items()}
        return open_joint_forces(motion, self.scenario.gravity, columns, known)

    def _force_of(self, pin: str) -> Look:
        """Magnitude of the force [N] of a loose pin at fractions of steps."""
        return lambda number, fraction: _sizes(self._within(number, fraction), pin)

    def _end_of_steps(self, fraction: float, position: Matrix, velocity: Matrix) -> Ends:
        each = np.arange(len(self.step))
        seen = self._look(each, np.full(len(each), fraction), position, velocity)
        return Ends(position, velocity, seen.accelerations())

    def _within(self, number: Numbers, fraction: Matrix) -> Observation:
        """At fractions of steps."""
        return self._look(number, fraction, *motion_within(self._start, self._end, self.step, number, fraction))

    def _look(self, number: Numbers, fraction: Matrix, position: Matrix, velocity: Matrix) -> Observation:
        instants = Instants(
            time=self.time[number] + fraction * self.step[number],
            posture=Posture(self.tree, position, velocity),
            cubic=self._cubic[number],
            memories={name: memory[number] for name, memory in self._memories.items()},
        )
        return Observation(instants, self.scenario.clearance_pins, self.filled, self.scenario.gravity)


def _sizes(seen: Observation, pin: str) -> Matrix:
    """Magnitudes of the force of a loose pin [N]."""
    contact = seen.contacts[pin]
    return np.asarray(np.hypot(contact.normal_force, contact.friction_force))
