"""The tree in the engine, its explicit solver, of which every step is chosen here, and the steps of a run."""

from dataclasses import dataclass, field
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import NodeGenericODE2, ObjectKinematicTree

from support_exudyn.formulations.tree.branches import Matrix, Tree
from support_exudyn.formulations.tree.forces import Forces
from support_exudyn.mechanics.contact_state import PinMemory
from user_forces.values.value import Vector2

SMALLEST_STEP = 1e-13  # [s]
GROWTH = 5.0  # largest factor between two steps


class Engine:
    """A system of the engine with one kinematic tree, whose branches may stand in the ground at several places.

    Arguments:
        tree: the bodies.
        forces: on the coordinates.
        gravity: [m/s^2].
        position, velocity: coordinates [rad] and rates [rad/s] at the start, shape (n,).
    """

    def __init__(
        self, tree: Tree, forces: Forces, gravity: Vector2, position: Matrix, velocity: Matrix
    ) -> None:
        self.container = exudyn.SystemContainer()  # owns the system: must live as long as it
        self.mbs = self.container.AddSystem()
        count = len(tree.links)
        node = self.mbs.AddNode(
            NodeGenericODE2(
                referenceCoordinates=[0.0] * count,
                initialCoordinates=position.tolist(),
                initialCoordinates_t=velocity.tolist(),
                numberOfODE2Coordinates=count,
            )
        )
        bodies = [link.body for link in tree.links]
        centres = [[*tree.arm(n, body.centre), 0.0] for n, body in enumerate(bodies)]
        joints = [[*tree.arm(link.carrier, link.joint), 0.0] for link in tree.links]
        vectors: Any = exudyn.Vector3DList  # stubs lack what they are made of
        matrices: Any = exudyn.Matrix3DList
        self.mbs.AddObject(
            ObjectKinematicTree(
                nodeNumber=node,
                jointTypes=[exudyn.JointType.RevoluteZ] * count,
                linkParents=[link.carrier for link in tree.links],
                jointTransformations=matrices([np.eye(3)] * count),
                jointOffsets=vectors(joints),
                linkInertiasCOM=matrices([np.diag([0.0, 0.0, body.inertia]) for body in bodies]),
                linkCOMs=vectors(centres),
                linkMasses=[body.mass for body in bodies],
                gravity=[*gravity, 0.0],
                forceUserFunction=forces,
            )
        )
        self.mbs.Assemble()
        self.solver: Any = exudyn.MainSolverExplicit()  # its stubs lack self

    def release(self) -> None:
        """Let go of the user functions: what they refer to would never be freed."""
        mbs: Any = self.mbs
        mbs.SetPreStepUserFunction(0)
        mbs.SetPostNewtonUserFunction(0)
        mbs.SetPostStepUserFunction(0)
        self.container.Reset()


def settings(duration: float, error: float, first_step: float) -> Any:
    """Settings of a run of this length [s] with this root mean square error of a step [rad], [rad/s]."""
    chosen: Any = exudyn.SimulationSettings()
    integration = chosen.timeIntegration
    integration.solverType = exudyn.DynamicSolverType.DOPRI5
    integration.endTime = duration
    integration.numberOfSteps = 1  # a step may be as long as the run
    integration.automaticStepSize = True
    integration.initialStepSize = first_step
    integration.minimumStepSize = SMALLEST_STEP
    integration.stepSizeMaxIncrease = GROWTH
    integration.adaptiveStepRecoverySteps = 2**30  # the engine never lengthens a step by itself
    integration.absoluteTolerance = error
    # the engine's relative scale is that of signed coordinates: too small where they are negative
    integration.relativeTolerance = 0.0
    # the last stage of the method is the end of the step
    integration.explicit.computeEndOfStepAccelerations = False
    # a step that is refused is tried anew from its start at once
    integration.discontinuous.maxIterations = 1
    integration.discontinuous.ignoreMaxIterations = False
    integration.verboseMode = 0
    chosen.solution.file.write = False
    return chosen


@dataclass
class TreeHistory:
    """The accepted steps of a run, filled by it.

    time, position, velocity: at the start of the run and at the end of every step. piece: of the drive; memory:
    of the clearance pins, number in `memories`; both for every step.
    """

    time: list[float]
    position: list[list[float]]
    velocity: list[list[float]]
    piece: list[int] = field(default_factory=list)
    memory: list[int] = field(default_factory=list)
    memories: list[tuple[PinMemory, ...]] = field(default_factory=list)

    def add(self, time: float, position: list[float], velocity: list[float], piece: int) -> None:
        """Add a step by its end; the memory is the last one."""
        self.time.append(time)
        self.position.append(position)
        self.velocity.append(velocity)
        self.piece.append(piece)
        self.memory.append(len(self.memories) - 1)

    def pin_memory(self, pin: int) -> Matrix:
        """Memory of a pin in every step, shape (steps, fields of PinMemory)."""
        table = np.array([memories[pin] for memories in self.memories], dtype=np.float64)
        return np.asarray(table[self.memory])
