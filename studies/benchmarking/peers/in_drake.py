"""The support in Drake: a continuous plant of four hinged bodies, columns and contact a system of one's own.

Drake's own contact has no journal in a bore, and its continuous plants take no closed loops but by stiff
bushings. So a `LeafSystem` gives generalised forces: the law of contact in plain floats, and the forces in
the columns from d'Alembert's principle with Drake's mass matrix and bias, so that both lengths follow the
drive. Drift is drawn back as by Baumgarte. Drake's default integrator, of order three, chooses its steps by
their error. A witness function finds where the surfaces meet, and what it triggers notes the initial impact
velocity; another ends a step where they part.
"""

import time
from typing import Any

import numpy as np
import numpy.typing as npt

from studies.benchmarking.peers.plain_support import (
    COLUMN_LINK,
    JOURNAL_LINK,
    JournalLog,
    PeerRun,
    PlainSupport,
    plain_support,
    undisturbed,
)
from support_exudyn.scenario.scenario import Scenario

LARGEST_STEP, SMALLEST_STEP = 1e-3, 1e-12  # [s]
FOUND_WITHIN = 1e-11  # an impact or separation is located to [s]
ALONE = 1e-9  # of two steps that end so close together one is noted: their depths differ by rounding [s]
DRAWN_BACK = 50.0  # rate at which the drift of the columns' lengths decays [1/s]


def run_drake(scenario: Scenario, accuracy: float) -> PeerRun:
    """Run with error control.

    Arguments:
        scenario: see `plain_support`; its own step and solver are not used.
        accuracy: what Drake calls so, of a step.

    Raises InputError if the scenario is not covered, ImportError if there is no Drake.
    """
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
    from pydrake.systems.framework import DiagramBuilder

    support = plain_support(scenario)
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(time_step=0.0))
    _add_links(plant, support)
    force = builder.AddSystem(_force_system(plant, support))
    builder.Connect(plant.get_state_output_port(), force.state)
    builder.Connect(force.get_output_port(), plant.get_applied_generalized_force_input_port())
    simulator = Simulator(builder.Build())
    context = simulator.get_mutable_context()
    ResetIntegratorFromFlags(simulator, "runge_kutta3", LARGEST_STEP)
    integrator = simulator.get_mutable_integrator()
    integrator.set_fixed_step_mode(False)
    integrator.set_target_accuracy(accuracy)
    integrator.set_requested_minimum_step_size(SMALLEST_STEP)
    context.SetAccuracy(FOUND_WITHIN)  # of witness functions, as a share of a second
    log = JournalLog(support)

    def note(root: Any) -> None:
        force.move_to(plant.GetPositionsAndVelocities(plant.GetMyContextFromRoot(root)))
        if log.steps and root.get_time() - log.steps[-1][0] < ALONE:
            log.steps.pop()
        log.note(root.get_time(), *force.journal())

    simulator.set_monitor(note)
    with undisturbed():
        began = time.process_time()
        simulator.Initialize()
        for end in (*(t for t in scenario.drive.breaks if 0.0 < t < scenario.duration), scenario.duration):
            simulator.AdvanceTo(end)
        took = time.process_time() - began
    return log.run(took)


def _add_links(plant: Any, support: PlainSupport) -> None:
    """Links and their hinges; all joints are zero at the start."""
    from pydrake.math import RigidTransform
    from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, RotationalInertia, SpatialInertia

    bodies = [plant.world_body()]
    for link in support.links:
        (px, py), (cx, cy) = link.pin, link.centre
        about_centre = RotationalInertia(link.inertia, link.inertia, link.inertia)
        spatial = SpatialInertia.MakeFromCentralInertia(link.mass, [cx - px, cy - py, 0.0], about_centre)
        bodies.append(plant.AddRigidBody(link.name, spatial))
        parent = bodies[link.parent + 1]
        ox, oy = support.links[link.parent].pin if link.parent >= 0 else (0.0, 0.0)
        offset = RigidTransform([px - ox, py - oy, 0.0])
        pin = plant.AddFrame(FixedOffsetFrame(f"{link.name} pin", parent, offset))
        plant.AddJoint(RevoluteJoint(link.name, pin, bodies[-1].body_frame(), [0.0, 0.0, 1.0]))
    plant.mutable_gravity_field().set_gravity_vector([*support.gravity, 0.0])
    plant.Finalize()


def _force_system(plant: Any, support: PlainSupport) -> Any:
    """The system that pushes; its class can only be made once Drake is there."""
    from pydrake.multibody.tree import JacobianWrtVariable
    from pydrake.systems.framework import (
        EventStatus,
        LeafSystem,
        UnrestrictedUpdateEvent,
        WitnessFunctionDirection,
    )

    world, here = plant.world_frame(), plant.CreateDefaultContext()
    by_rates = JacobianWrtVariable.kV
    canopy, rear_link = (
        (plant.GetFrameByName(support.links[n].name), support.links[n].pin) for n in (COLUMN_LINK, JOURNAL_LINK)
    )
    heads = np.array([[*np.subtract(one.head, canopy[1]), 0.0] for one in support.columns]).T
    feet = np.array([one.foot for one in support.columns]).T
    lengths = np.array([one.length for one in support.columns])
    journal = np.array([*np.subtract(support.bore, rear_link[1]), 0.0])
    names = [one.name for one in support.links]
    spins = np.zeros(len(names))  # how the rear link's spin follows from the joints' rates
    n = JOURNAL_LINK
    while n >= 0:
        spins[n], n = 1.0, support.links[n].parent

    class Forces(LeafSystem):  # type: ignore[misc]  # of a module without types
        """From the plant's state to generalised forces; the initial impact velocity is a discrete state."""

        def __init__(self) -> None:
            super().__init__()
            self.state = self.DeclareVectorInputPort("state", 2 * len(names))
            self.DeclareDiscreteState([0.0])
            self.DeclareVectorOutputPort("force", len(names), self.push)
            meets, parts = (
                WitnessFunctionDirection.kNegativeThenNonNegative,
                WitnessFunctionDirection.kPositiveThenNonPositive,
            )
            notes = UnrestrictedUpdateEvent(system_callback=Forces.note)
            leaves = UnrestrictedUpdateEvent(system_callback=Forces.leave)
            self.watched = [
                self.MakeWitnessFunction("depth", meets, self.depth, notes),
                self.MakeWitnessFunction("depth", parts, self.depth, leaves),
            ]

        def DoGetWitnessFunctions(self, context: Any) -> list[Any]:  # noqa: N802
            return self.watched

        def move_to(self, state: npt.NDArray[np.float64]) -> None:
            """Put the plant of this system into a state."""
            plant.SetPositionsAndVelocities(here, state)

        def journal(self) -> tuple[list[float], list[float], float]:
            """Place [m] and velocity [m/s] of the journal in its bore, and its spin [rad/s]."""
            rates = plant.GetVelocities(here)
            place = plant.CalcPointsPositions(here, rear_link[0], journal, world)[:2, 0] - support.bore
            return place.tolist(), (self.along() @ rates).tolist(), float(spins @ rates)

        def along(self) -> npt.NDArray[np.float64]:
            """How the journal's velocity follows from the joints' rates, shape (2, 4)."""
            found: npt.NDArray[np.float64] = plant.CalcJacobianTranslationalVelocity(
                here, by_rates, rear_link[0], journal, world, world
            )[:2]
            return found

        def depth(self, context: Any) -> float:
            self.move_to(self.state.Eval(context))
            place = plant.CalcPointsPositions(here, rear_link[0], journal, world)[:2, 0] - support.bore
            return float(np.hypot(*place)) - support.clearance

        def note(self, context: Any, event: Any, state: Any) -> Any:
            self.move_to(self.state.Eval(context))
            (x, y), (vx, vy), _ = self.journal()
            rate = (x * vx + y * vy) / support.clearance
            state.get_mutable_discrete_state().set_value(np.array([max(rate, 0.0)]))
            return EventStatus.Succeeded()

        def leave(self, context: Any, event: Any, state: Any) -> Any:
            return EventStatus.Succeeded()

        def push(self, context: Any, forces: Any) -> None:
            self.move_to(self.state.Eval(context))
            (x, y), (vx, vy), spin = self.journal()
            speed = context.get_discrete_state_vector().GetAtIndex(0)
            fx, fy, moment = support.force(x, y, vx, vy, spin, speed)
            pushed = spins * moment
            if fx or fy:
                pushed = pushed + self.along().T @ (fx, fy)
            forces.SetFromVector(pushed + self.columns(context.get_time(), pushed))

        def columns(self, t: float, pushed: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
            """Generalised forces of the columns, which give both lengths the acceleration of the drive."""
            extension, rate, second = support.motion(t)
            rates = plant.GetVelocities(here)
            places = plant.CalcPointsPositions(here, canopy[0], heads, world)[:2] - feet
            along = plant.CalcJacobianTranslationalVelocity(here, by_rates, canopy[0], heads, world, world)
            bias = plant.CalcBiasTranslationalAcceleration(here, by_rates, canopy[0], heads, world, world)[:2]
            rows = np.stack([along[0:2], along[3:5]])  # by column, then x and y
            length = np.hypot(*places)
            unit = places / length
            by_length = np.einsum("ik,kij->kj", unit, rows)
            velocity = np.einsum("kij,j->ik", rows, rates)
            lengthening = (unit * velocity).sum(axis=0)
            across = ((velocity**2).sum(axis=0) - lengthening**2) / length + (unit * bias).sum(axis=0)
            off, drift = length - lengths - extension, lengthening - rate
            wanted = second - across - 2.0 * DRAWN_BACK * drift - DRAWN_BACK**2 * off
            mass = plant.CalcMassMatrix(here)
            free = pushed + plant.CalcGravityGeneralizedForces(here) - plant.CalcBiasTerm(here)
            solved = np.linalg.solve(mass, np.column_stack([free, by_length.T]))
            found: npt.NDArray[np.float64] = by_length.T @ np.linalg.solve(
                by_length @ solved[:, 1:], wanted - by_length @ solved[:, 0]
            )
            return found

    return Forces()
