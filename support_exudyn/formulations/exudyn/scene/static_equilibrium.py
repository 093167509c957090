"""Static equilibrium of the engine's model, so that a run can start settled."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import exudyn
import numpy as np

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.formulations.exudyn.scene.engine_scene import INITIAL, EngineScene
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.scene.equilibrium import SMOOTH_SHIFT, CentringSpring, centring_spring, find_equilibrium
from user_forces.connector.contact_connector import ContactConnector
from user_forces.connector.item import connector_kernel
from user_forces.normal.law import LoadError


def find_static_equilibrium(scene: EngineScene) -> None:
    """Make the static equilibrium under gravity the initial state of the scene, at rest.

    Elastic contact without friction. Velocities the machine asks for are set to zero. Blocks that are to fall
    hang over their points meanwhile, and start from there as they were to start.

    Raises SimulationError if there is no equilibrium or it is not found.
    """
    data = scene.mbs.systemData
    with ExitStack() as for_a_while, quiet_engine():
        for_a_while.enter_context(scene.legs.settling())
        balance = EngineBalance(scene)
        for_a_while.callback(balance.finish)
        found = find_equilibrium(balance, data.GetODE2Coordinates(INITIAL), scene.scenario)
        data.SetODE2Coordinates(found, INITIAL)
    velocity = 0.0 * data.GetODE2Coordinates_t(INITIAL)
    for name in scene.scenario.blocks:
        item = scene.bodies[name]
        velocity[item.first : item.first + 2] = item.body.velocity[:2]
    data.SetODE2Coordinates_t(velocity, INITIAL)
    scene.legs.begin()
    scene.reset_memory()


class EngineBalance:
    """The balance of forces and constraints that the engine computes, see `scene.equilibrium.Balance`.

    Until `finish`, other kernels give the forces of contacts. The engine's own static solver would do without
    the stiffness of constraints that turn.
    """

    def __init__(self, scene: EngineScene) -> None:
        self.scene, self.mbs = scene, scene.mbs
        self._springs: dict[str, CentringSpring] = {}
        self.centre(1.0)
        for name, pin in scene.clearance_joints.items():
            pin.item.use(self._held(name, pin))
        engine: Any = exudyn  # the stubs of its solvers lack self
        self._solver, self._settings = engine.MainSolverStatic(), engine.SimulationSettings()
        self._settings.solution.file.write = False
        self._settings.staticSolver.verboseMode = 0
        self._solver.InitializeSolver(self.mbs, self._settings)
        self._size, self.joints = self._solver.GetODE2size(), self._solver.GetAEsize()
        self._first = self._size + self._solver.GetODE1size()  # of the constraints among all equations
        self._zeros = np.zeros((self._first + self.joints, self._first + self.joints))
        self._lift = np.zeros(self._size)  # forces that make blocks weightless
        for name in scene.scenario.blocks:
            item = scene.bodies[name]
            self._lift[item.first : item.first + 2] = -item.body.mass * np.array(scene.scenario.gravity)

    def finish(self) -> None:
        """Let contacts give their own forces again."""
        self._solver.FinalizeSolver(self.mbs, self._settings)
        for pin in self.scene.clearance_joints.values():
            pin.item.use()
            pin.item.calls = 0  # those of a run are counted

    def centre(self, share: float) -> None:
        """See `Balance`; journals stay where they have shifted to along their bores."""
        for name, pin in self.scene.clearance_joints.items():
            self._springs[name] = centring_spring(self.scene.scenario, name, pin.contact, share)
        self.scene.reset_memory()

    def linear(self, q: Matrix, multipliers: Matrix) -> tuple[Matrix, Matrix]:
        """See `Balance`."""
        size, mbs, solver = self._size, self.mbs, self._solver
        turned = [
            (self._rows(q - step).T - self._rows(q + step).T) @ multipliers / (2.0 * SMOOTH_SHIFT)
            for step in SMOOTH_SHIFT * np.eye(size)
        ]
        mbs.systemData.SetODE2Coordinates(q, INITIAL)
        rows = self._rows(q)
        solver.ComputeAlgebraicEquations(mbs, False)
        gaps = solver.GetSystemResidual()[self._first :]
        try:
            solver.ComputeJacobianODE2RHS(mbs, 1.0, 0.0, 1.0, 1)
            solver.ComputeODE2RHS(mbs)  # last, for legs keep how they rest where they are asked
        except exudyn.ExudynError as error:
            if error.__cause__ is not None:  # a function of ours raised
                raise error.__cause__ from None
            raise LoadError(str(error)) from None
        forces = solver.GetSystemResidual()[:size] + self._lift - rows.T @ multipliers
        slope = solver.GetSystemJacobian()[:size, :size] + np.transpose(turned)
        return np.concatenate([forces, gaps]), np.vstack([slope, rows])

    def _rows(self, q: Matrix) -> Matrix:
        """Jacobian of the constraints (joints, n) at coordinates q (n,), which the engine has from then on."""
        self.mbs.systemData.SetODE2Coordinates(q)
        self._solver.SetSystemJacobian(self._zeros)
        self._solver.ComputeJacobianAE(self.mbs)
        return np.asarray(self._solver.GetSystemJacobian()[self._first :, : self._size])

    def _held(self, name: str, pin: ContactConnector) -> Callable[..., Any]:
        """The kernel of a contact that its spring holds, as its user function calls it."""
        kinematics, known = pin.contact.bearing.kinematics, pin.contact.bearing.constants
        law = pin.contact.normal

        def pull(depth: float) -> float:
            spring = self._springs[name]
            elastic = law.elastic_force(min(depth, spring.deepest)) if depth > 0.0 else 0.0
            return spring.force(depth, elastic)

        def tension(depth: float, *motion: Any) -> tuple[float]:
            return (pull(depth),)

        def force(x: float, y: float, vx: float, vy: float, *spins: Any) -> tuple[float, ...]:
            depth, rate, slip, nx, ny, arm = kinematics(x, y, vx, vy, spins[0], spins[1], *known)
            normal = pull(depth)
            return depth, rate, slip, normal, 0.0, -normal * nx, -normal * ny, arm, False, 0.0

        return (
            tension if pin.item.on_line else connector_kernel(force, pin.item.at, pin.contact.bearing.is_slot)
        )
