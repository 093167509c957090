"""The slider-crank in Drake, its contact a system of one's own beside the plant.

Drake's own contact has no journal in a bore: no shape is hollow, and the forces of walls that are set around
a journal add up where it lies in two of them. Its law is that of a linear spring, too. So the force is computed
by a `LeafSystem`, in plain floats, and goes into the plant as generalised forces. The plant is continuous, and
Drake's default integrator, of order three, chooses its steps by their error. A witness function finds where the
surfaces meet, and what it triggers notes the initial impact velocity; another looks for where they part, so
that no step goes across.

The crank keeps its speed by an inertia beside which all else is nothing.
"""

import math
import time
from typing import Any

import numpy as np

from studies.benchmarking.peers.bare_scene import joint_start, smooth_slider_crank
from studies.benchmarking.peers.peer_run import PeerRun, StepLog, contact_numbers, undisturbed
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact

FLYWHEEL = 1e8  # inertia of the crank [kg m^2]; a moment of 100 N m changes its speed by 1e-8 rad/s in 10 ms
LARGEST_STEP, SMALLEST_STEP = 2e-5, 1e-14  # [s]
FOUND_WITHIN = 1e-11  # an impact or separation is located to [s]
ALONE = 1e-9  # of two steps that end so close together one is noted: their depths differ by rounding [s]


def run_drake(scenario: Scenario, accuracy: float) -> PeerRun:
    """Run with error control.

    Arguments:
        scenario: see `smooth_slider_crank`; its own step and solver are not used.
        accuracy: what Drake calls so, of a step.

    Raises InputError if the scenario is not covered, ImportError if there is no Drake.
    """
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
    from pydrake.systems.framework import DiagramBuilder

    machine, speed, contact = smooth_slider_crank(scenario)
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(time_step=0.0))
    _add_bodies(plant, machine)
    force = builder.AddSystem(_contact_system(machine, contact))
    builder.Connect(plant.get_state_output_port(), force.state)
    builder.Connect(force.get_output_port(), plant.get_applied_generalized_force_input_port())
    simulator = Simulator(builder.Build())
    context = simulator.get_mutable_context()
    places, rates = joint_start(machine, speed)
    plant.SetPositionsAndVelocities(plant.GetMyMutableContextFromRoot(context), [*places, *rates])
    ResetIntegratorFromFlags(simulator, "runge_kutta3", LARGEST_STEP)
    integrator = simulator.get_mutable_integrator()
    integrator.set_fixed_step_mode(False)
    integrator.set_target_accuracy(accuracy)
    integrator.set_requested_minimum_step_size(SMALLEST_STEP)
    context.SetAccuracy(FOUND_WITHIN)  # of witness functions, as a share of a second
    log = StepLog()

    def note(root: Any) -> None:
        state = plant.GetPositionsAndVelocities(plant.GetMyContextFromRoot(root)).tolist()
        depth, rate, _ = force.pin(state)
        if log.time and root.get_time() - log.time[-1] < ALONE:
            log.drop_last()
        log.time.append(root.get_time())
        log.depth.append(depth)
        log.rate.append(rate)
        log.slider.append(state[2])
        log.velocity.append(state[5])

    simulator.set_monitor(note)
    with undisturbed():
        began = time.process_time()
        simulator.Initialize()
        simulator.AdvanceTo(scenario.duration)
        took = time.process_time() - began
    return log.run(scenario, contact, took, force.calls)


def _add_bodies(plant: Any, m: SliderCrank) -> None:
    """Crank, rod on the crank, slider on its guide; no gravity."""
    from pydrake.math import RigidTransform
    from pydrake.multibody.tree import (
        FixedOffsetFrame,
        PrismaticJoint,
        RevoluteJoint,
        RotationalInertia,
        SpatialInertia,
    )

    def body(name: str, mass: float, inertia: float, centre: float) -> Any:
        about_centre = RotationalInertia(inertia, inertia, inertia)
        spatial = SpatialInertia.MakeFromCentralInertia(mass, [centre, 0.0, 0.0], about_centre)
        return plant.AddRigidBody(name, spatial)

    crank = body("crank", m.crank_mass, FLYWHEEL, 0.5 * m.crank_length)
    rod = body("rod", m.rod_mass, m.rod_inertia, 0.5 * m.rod_length)
    slider = body("slider", m.slider_mass, m.crank_inertia, 0.0)
    end = plant.AddFrame(FixedOffsetFrame("end", crank, RigidTransform([m.crank_length, 0.0, 0.0])))
    world = plant.world_frame()
    plant.AddJoint(RevoluteJoint("crank", world, crank.body_frame(), [0.0, 0.0, 1.0]))
    plant.AddJoint(RevoluteJoint("rod", end, rod.body_frame(), [0.0, 0.0, 1.0]))
    plant.AddJoint(PrismaticJoint("slider", world, slider.body_frame(), [1.0, 0.0, 0.0]))
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
    plant.Finalize()


def _contact_system(machine: SliderCrank, contact: JournalContact) -> Any:
    """The system that pushes; its class can only be made once Drake is there."""
    from pydrake.systems.framework import (
        EventStatus,
        LeafSystem,
        UnrestrictedUpdateEvent,
        WitnessFunctionDirection,
    )

    crank, rod = machine.crank_length, machine.rod_length
    clearance = contact.bearing.clearance
    stiffness, factor, floor = contact_numbers(contact)

    class PinForce(LeafSystem):  # type: ignore[misc]  # of a module without types
        """From the plant's state to generalised forces; the initial impact velocity is a discrete state."""

        def __init__(self) -> None:
            super().__init__()
            self.calls = 0
            self.state = self.DeclareVectorInputPort("state", 6)
            self.DeclareDiscreteState([floor])
            self.DeclareVectorOutputPort("force", 3, self.push)
            depth = "depth"
            meets, parts = (
                WitnessFunctionDirection.kNegativeThenNonNegative,
                WitnessFunctionDirection.kPositiveThenNonPositive,
            )
            notes = UnrestrictedUpdateEvent(system_callback=PinForce.note)
            leaves = UnrestrictedUpdateEvent(system_callback=PinForce.leave)
            self.watched = [
                self.MakeWitnessFunction(depth, meets, self.depth, notes),
                self.MakeWitnessFunction(depth, parts, self.depth, leaves),
            ]

        def DoGetWitnessFunctions(self, context: Any) -> list[Any]:  # noqa: N802
            return self.watched

        def depth(self, context: Any) -> float:
            return self.pin(self.state.Eval(context).tolist())[0]

        def note(self, context: Any, event: Any, state: Any) -> Any:
            rate = self.pin(self.state.Eval(context).tolist())[1]
            state.get_mutable_discrete_state().set_value(np.array([max(rate, floor)]))
            return EventStatus.Succeeded()

        def leave(self, context: Any, event: Any, state: Any) -> Any:
            return EventStatus.Succeeded()

        def pin(self, state: list[float]) -> tuple[float, float, list[float]]:
            """Depth [m], its rate [m/s] and how the eccentricity changes with every joint."""
            angle, bend, place, spin, bending, velocity = state
            bx, by = crank * math.cos(angle), crank * math.sin(angle)
            ux, uy = rod * math.cos(angle + bend), rod * math.sin(angle + bend)
            x, y = bx + ux - place, by + uy
            eccentricity = math.hypot(x, y)
            nx, ny = (x / eccentricity, y / eccentricity) if eccentricity else (1.0, 0.0)
            by_rod = ny * ux - nx * uy
            by_crank = by_rod + ny * bx - nx * by
            rate = by_crank * spin + by_rod * bending - nx * velocity
            return eccentricity - clearance, rate, [by_crank, by_rod, -nx]

        def push(self, context: Any, forces: Any) -> None:
            self.calls += 1
            depth, rate, along = self.pin(self.state.Eval(context).tolist())
            force = 0.0
            if depth > 0.0:
                speed = context.get_discrete_state_vector().GetAtIndex(0)
                force = max(0.0, stiffness * depth * math.sqrt(depth) * (1.0 + factor * rate / speed))
            forces.SetFromVector([-force * one for one in along])

    return PinForce()
