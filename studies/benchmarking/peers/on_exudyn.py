"""The support on Exudyn without this package's solver: the stock recipe of a pin with clearance.

The engine's rigid-body connector calls a function of plain floats. The initial impact velocity is noted at the
end of the step in which the surfaces met, and generalised alpha makes equal steps. No impact is located.
"""

import math
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyPosition,
    MarkerBodyRigid,
    NodeGenericData,
    NodeRigidBody2D,
    ObjectConnectorDistance,
    ObjectConnectorRigidBodySpringDamper,
    ObjectGround,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
)

from studies.benchmarking.peers.plain_support import (
    COLUMN_LINK,
    JOURNAL_LINK,
    PeerRun,
    PlainSupport,
    plain_support,
    undisturbed,
)
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

SPECTRAL_RADIUS = 0.5


class _StockContact:
    """The connector's two user functions, the impact velocity, and the force at the ends of all steps."""

    def __init__(self, support: PlainSupport) -> None:
        self.support = support
        self.speed = 0.0  # of approach, 0 in free flight [m/s]
        self.noted = [(0.0, 0.0)]  # time [s], force [N]

    def force(  # type: ignore[no-untyped-def]
        self, mbs, t, item, displacement, rotation, velocity, angular_velocity, *unused
    ) -> list[float]:
        """Force and moment of the connector: those of the journal on the bore."""
        fx, fy, moment = self.support.force(
            displacement[0], displacement[1], velocity[0], velocity[1], angular_velocity[2], self.speed
        )
        return [-fx, -fy, 0.0, 0.0, 0.0, -moment]

    def after_newton(  # type: ignore[no-untyped-def]
        self, mbs, t, item, data, displacement, rotation, velocity, angular_velocity, *unused
    ) -> list[float]:
        """The post-Newton function: note the initial impact velocity once a step."""
        x, y = displacement[0], displacement[1]
        eccentricity = math.hypot(x, y)
        rate = (x * velocity[0] + y * velocity[1]) / (eccentricity or 1.0)
        self.speed = (self.speed or rate) if eccentricity > self.support.clearance else 0.0
        fx, fy, *_ = self.force(mbs, t, item, displacement, rotation, velocity, angular_velocity)
        self.noted.append((t, math.hypot(fx, fy)))
        return [0.0, -1.0, 0.0]


def run_stock(scenario: Scenario, step: float) -> PeerRun:
    """Run the stock recipe.

    Arguments:
        scenario: see `plain_support`; its own step and solver are not used.
        step: length of all steps [s].

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    support = plain_support(scenario)
    contact = _StockContact(support)
    container = exudyn.SystemContainer()  # owns the system, and must live as long as that
    mbs = container.AddSystem()
    columns = _add_linkage(mbs, support, contact)

    def drive(mbs: Any, t: float) -> bool:
        for item, length in columns:
            mbs.SetObjectParameter(item, "distance", length + scenario.drive.extension(t))
        return True

    mbs.Assemble()
    mbs.SetPreStepUserFunction(drive)
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = scenario.duration
    settings.timeIntegration.numberOfSteps = round(scenario.duration / step)
    settings.timeIntegration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.timeIntegration.adaptiveStep = False
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    # otherwise it stops at the first contact
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False
    solver: Any = exudyn.MainSolverImplicitSecondOrder()
    with undisturbed():
        finished = solver.SolveSystem(mbs, settings)
    if not finished:
        raise RuntimeError(f"the solver gave up at t = {solver.it.currentTime} s")
    return PeerRun(*np.array(contact.noted).T)


def _add_linkage(mbs: Any, support: PlainSupport, contact: _StockContact) -> list[tuple[Any, float]]:
    """Add links, pins, columns and the contact; returns items and lengths of the columns [m]."""
    objects = []
    for link in support.links:
        node = mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[*link.centre, 0.0]))
        objects.append(mbs.AddObject(ObjectRigidBody2D(mass=link.mass, inertia=link.inertia, nodeNumber=node)))
        centre = mbs.AddMarker(MarkerBodyPosition(bodyNumber=objects[-1], localPosition=[0, 0, 0]))
        weight = [link.mass * support.gravity[0], link.mass * support.gravity[1], 0.0]
        mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))
    objects.append(mbs.AddObject(ObjectGround()))  # the last, of index -1

    def markers(first: int, second: int, start: Vector2, end: Vector2) -> list[Any]:
        places = []
        for body, point in ((first, start), (second, end)):
            x, y = support.links[body].centre if body >= 0 else (0.0, 0.0)
            local = [point[0] - x, point[1] - y, 0.0]
            places.append(mbs.AddMarker(MarkerBodyRigid(bodyNumber=objects[body], localPosition=local)))
        return places

    for n, link in enumerate(support.links):
        ends = markers(link.parent, n, link.pin, link.pin)
        mbs.AddObject(ObjectJointRevolute2D(markerNumbers=ends))
    columns = []
    for column in support.columns:
        ends = markers(-1, COLUMN_LINK, column.foot_point, column.head_point)
        item = ObjectConnectorDistance(markerNumbers=ends, distance=column.start_length)
        columns.append((mbs.AddObject(item), column.start_length))
    mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(
            markerNumbers=markers(-1, JOURNAL_LINK, support.bore, support.bore),
            nodeNumber=mbs.AddNode(NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1)),
            springForceTorqueUserFunction=contact.force,
            postNewtonStepUserFunction=contact.after_newton,
        )
    )
    return columns
