"""The slider-crank in minimal coordinates with the engine's own contact, under an explicit method.

One kinematic tree: crank, rod on the crank, slider on a guide. The clearance pin cuts the loop, so no algebraic
variables are left, which explicit solvers refuse. The crank keeps its speed by an inertia beside which all else
is nothing. DOPRI5 chooses its steps by their error.
"""

import math
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import MarkerKinematicTreeRigid, NodeGenericODE2, ObjectKinematicTree, SensorNode

from studies.benchmarking.peers.bare_scene import joint_start, smooth_slider_crank
from studies.benchmarking.peers.peer_run import (
    ASIDE,
    PeerRun,
    PinSeries,
    add_ball,
    cubic,
    impacts,
    pin_sensors,
    record_times,
)
from studies.benchmarking.peers.stock import solved
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact

engine: Any = exudyn  # its stubs lack the arguments of its lists
FLYWHEEL = 1e8  # inertia of the crank [kg m^2]; a moment of 100 N m changes its speed by 1e-8 rad/s in 10 ms
SMALLEST_STEP, LARGEST_STEP = 1e-13, 2e-5  # [s]
ITERATION_TOLERANCE = 1.0  # of the engine's discontinuous iteration [N]


def run_tree(scenario: Scenario, tolerance: float) -> PeerRun:
    """Run under DOPRI5.

    Arguments:
        scenario: SliderCrank driven by Steady, slider pin with clearance without friction and with its bore in
            the slider, no gravity, start "concentric"; its own step and solver are not used.
        tolerance: of a step, relative and absolute alike (coordinates in rad and m, rates in rad/s and m/s).

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    machine, speed, contact = smooth_slider_crank(scenario)
    container = exudyn.SystemContainer()
    mbs: Any = container.AddSystem()
    sensors = _build(mbs, machine, speed, contact)
    mbs.Assemble()
    took = solved(exudyn.MainSolverExplicit(), mbs, _settings(scenario.duration, tolerance))
    return _run(scenario, contact, mbs, sensors, took)


def _build(mbs: Any, m: SliderCrank, speed: float, contact: JournalContact) -> tuple[Any, ...]:
    """Add tree and contact; return sensors of journal, bore and of the coordinates."""
    places, rates = joint_start(m, speed)
    node = mbs.AddNode(
        NodeGenericODE2(
            referenceCoordinates=[0.0, 0.0, 0.0],
            initialCoordinates=places,
            initialCoordinates_t=rates,
            numberOfODE2Coordinates=3,
        )
    )
    kinds = exudyn.JointType
    tree = mbs.AddObject(
        ObjectKinematicTree(
            nodeNumber=node,
            jointTypes=[kinds.RevoluteZ, kinds.RevoluteZ, kinds.PrismaticX],
            linkParents=[-1, 0, -1],
            jointTransformations=engine.Matrix3DList([np.eye(3)] * 3),
            jointOffsets=engine.Vector3DList([[0, 0, 0], [m.crank_length, 0, 0], [0, 0, 0]]),
            linkInertiasCOM=engine.Matrix3DList(
                [np.diag([0, 0, inertia]) for inertia in (FLYWHEEL, m.rod_inertia, 0.0)]
            ),
            linkCOMs=engine.Vector3DList([[0.5 * m.crank_length, 0, 0], [0.5 * m.rod_length, 0, 0], [0, 0, 0]]),
            linkMasses=[m.crank_mass, m.rod_mass, m.slider_mass],
        )
    )
    journal = mbs.AddMarker(
        MarkerKinematicTreeRigid(objectNumber=tree, linkNumber=1, localPosition=[m.rod_length, 0, 0])
    )
    bore = mbs.AddMarker(MarkerKinematicTreeRigid(objectNumber=tree, linkNumber=2, localPosition=[ASIDE, 0, 0]))
    add_ball(mbs, contact, journal, bore)
    accelerations = SensorNode(
        nodeNumber=node,
        outputVariableType=exudyn.OutputVariableType.Coordinates_tt,
        storeInternal=True,
        writeToFile=False,
    )
    return (*pin_sensors(mbs, journal, bore), mbs.AddSensor(accelerations))


def _settings(duration: float, tolerance: float) -> Any:
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.solverType = exudyn.DynamicSolverType.DOPRI5
    integration.endTime = duration
    integration.numberOfSteps = math.ceil(duration / LARGEST_STEP)
    integration.automaticStepSize = True
    integration.adaptiveStep = True
    integration.relativeTolerance = tolerance
    integration.absoluteTolerance = tolerance
    integration.minimumStepSize = SMALLEST_STEP
    integration.initialStepSize = 1e-7
    integration.discontinuous.iterationTolerance = ITERATION_TOLERANCE
    integration.discontinuous.ignoreMaxIterations = False
    integration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = SMALLEST_STEP
    return settings


def _run(
    scenario: Scenario, contact: JournalContact, mbs: Any, sensors: tuple[Any, ...], took: float
) -> PeerRun:
    """The outcome: the slider by cubic interpolation between steps, all else linearly."""
    pin, accelerations = PinSeries.read(mbs, contact, sensors[:-1]), mbs.GetSensorStoredData(sensors[-1])
    t = pin.time
    wanted = np.minimum(record_times(scenario), t[-1])
    return PeerRun(
        time=wanted,
        force=np.interp(wanted, t, pin.force),
        angular_acceleration=np.interp(wanted, t, accelerations[:, 1] + accelerations[:, 2]),
        x=cubic(wanted, t, pin.bore, pin.bore_speed),
        y=np.zeros(len(wanted)),
        onsets=impacts(t.tolist(), pin.depth.tolist(), pin.rate.tolist()),
        largest_force=float(pin.force.max()),
        solve_time=took,
        steps=len(t) - 1,
        user_function_calls=0,
        newton_iterations=0,
    )
