"""Static equilibrium with clearance pins, so that a run can start settled."""

import math
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import exudyn

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.formulations.exudyn.scene.engine_scene import INITIAL, EngineScene
from support_exudyn.formulations.exudyn.scene.scene import Scene
from support_exudyn.formulations.exudyn.scene.settling import settling
from support_exudyn.mechanics.acting_loads import forces_at_rest
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.mechanics.resting import resting
from support_exudyn.scene.contract import Failure, SimulationError
from support_exudyn.scene.limits import CENTRING
from user_forces.normal.law import LoadError

# The engine solves at the end of its only step of loads, 1 s by default: drives and loads, which are told the
# time, would be settled as they are then.
AT_THE_START = 1e-30  # [s]
# A journal in the middle of its bore has no stiffness. A centring spring in every clearance pin is there at
# first, stiff enough to hold the weight of the machine within the clearance, and is then taken away.
# What Newton's method still changes tells whether it is done. What is left of the forces does not: contacts are
# so stiff that the rounding of coordinates of 300 m is thousands of times what is left of them near the origin.
BY_CHANGES = 1  # the engine's number for that
CLOSE = 1e-11  # [m]
ROUNDINGS = 64.0  # of the coordinates
HANGS_BY = 0.01  # [m] that the spring by which a block hangs would give under the weight of all bodies
LEAST = 1.0  # [N], stands for that weight where there is none


def find_static_equilibrium(scene: EngineScene) -> None:
    """Make the static equilibrium under gravity the initial state of the scene, at rest.

    Elastic contact without friction. Velocities the machine asks for are set to zero. Blocks that are to fall
    hang over their points meanwhile, and start from there as they were to start.

    Raises SimulationError if there is no equilibrium or it is not found.
    """
    data = scene.mbs.systemData
    weight = sum(item.body.mass for item in scene.bodies.values()) * _norm(scene.scenario.gravity)
    share = CENTRING[0]

    if (held := _held_by_loads(scene)) is not None:
        data.SetODE2Coordinates(held, INITIAL)
    with ExitStack() as for_a_while:
        for_a_while.enter_context(_weightless(scene))
        for name, pin in scene.clearance_joints.items():
            block = scene.scenario.blocks.get(name)
            hangs = (max(weight, LEAST) / HANGS_BY, block.start_depth) if block is not None else None
            for_a_while.enter_context(settling(pin, weight, lambda: share, hangs))
        for cylinder in scene.cylinders.values():
            for_a_while.enter_context(cylinder.settling())
        for_a_while.enter_context(scene.legs.settling())
        for share in CENTRING if held is None else ():  # noqa: B007
            _solve(scene)
            data.SetODE2Coordinates(data.GetODE2Coordinates(), INITIAL)
            for cylinder in scene.cylinders.values():
                cylinder.follow()
            scene.reset_memory()  # of where journals have shifted to along their bores
    velocity = 0.0 * data.GetODE2Coordinates_t(INITIAL)
    for name in scene.scenario.blocks:
        item = scene.bodies[name]
        velocity[item.first : item.first + 2] = item.body.velocity[:2]
    data.SetODE2Coordinates_t(velocity, INITIAL)
    scene.legs.begin()
    scene.reset_memory()


def _held_by_loads(scene: EngineScene) -> Matrix | None:
    """Coordinates at which a linkage rests that nothing but loads holds, such as springs; None if it is none.

    The engine's Newton method knows no stiffness of constraints that turn, and would not find there.
    """
    if not isinstance(scene, Scene) or not scene.loads:
        return None
    compliant = (
        scene.clearance_joints,
        scene.compliant_pins,
        scene.oil_columns,
        scene.cylinders,
        scene.legs.names,
    )
    if any(compliant):
        return None
    closed, acting = scene.closed_kinetics, scene.scenario.acting_loads
    weight = closed.weight(scene.scenario.gravity)

    def forces(position: Matrix) -> Matrix:
        return weight + forces_at_rest(closed, acting, position, AT_THE_START)

    return resting(closed, forces, scene.mbs.systemData.GetODE2Coordinates(INITIAL))


@contextmanager
def _weightless(scene: EngineScene) -> Iterator[None]:
    """Blocks that fall on the machine have no weight for as long as this lasts."""
    mbs = scene.mbs
    weights = [scene.weights[name] for name in scene.scenario.blocks if name in scene.weights]
    pulls = [mbs.GetLoadParameter(weight, "loadVector") for weight in weights]
    for weight in weights:
        mbs.SetLoadParameter(weight, "loadVector", [0.0, 0.0, 0.0])
    try:
        yield
    finally:
        for weight, pull in zip(weights, pulls, strict=True):
            mbs.SetLoadParameter(weight, "loadVector", pull)


def _solve(scene: EngineScene) -> None:
    solver: Any = exudyn.MainSolverStatic()
    settings: Any = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.loadStepDuration = AT_THE_START
    if scene.repeats:
        settings.linearSolver.solverType = exudyn.LinearSolverType.EigenDense
        settings.linearSolver.ignoreSingularJacobian = True
    newton = settings.staticSolver.newton
    newton.residualMode, newton.relativeTolerance = BY_CHANGES, 1e-10
    newton.absoluteTolerance = max(CLOSE, ROUNDINGS * math.ulp(scene.scenario.linkage.farthest))
    try:
        with quiet_engine():
            found = solver.SolveSystem(scene.mbs, settings)
    except exudyn.ExudynError as error:
        cause = error.__cause__  # set if a function of ours raised
        if cause is not None and not isinstance(cause, (ArithmeticError, LoadError)):
            raise cause from None
        found = False
    if not found:
        raise SimulationError(
            Failure(
                "no static equilibrium was found",
                "Is every body held by pins and actuators, and does gravity press the clearance pins? "
                "Otherwise start concentric.",
                0.0,
            )
        )


def _norm(vector: tuple[float, float]) -> float:
    return float((vector[0] ** 2 + vector[1] ** 2) ** 0.5)
