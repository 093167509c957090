"""The support on Exudyn without this package's solver: a bare scene, and three ways to give it a contact.

- The stock recipe, as users of Exudyn write a pin with clearance: the engine's rigid-body connector calls a
  function of plain floats, the initial impact velocity is noted at the end of the step in which the surfaces
  met, and generalised alpha makes equal steps. Nothing is located.
- The engine's own contact in C++, a ball in a hollow ball, under equal steps.
- In its place the user function of our connector alone, or a `ClearanceJoint`, which also follows impacts, the
  largest force and how long steps might be.
"""

import math
import time
from collections.abc import Callable
from typing import Any, Literal

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
    ObjectContactSphereSphere,
    ObjectGround,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
)

from studies.benchmarking.peers.plain_support import (
    COLUMN_LINK,
    JOURNAL_LINK,
    JournalForce,
    Link,
    PeerRun,
    contact_numbers,
    journal_force,
    plain_support,
    undisturbed,
)
from support_exudyn.scenario.scenario import Scenario
from user_forces import ClearanceJoint
from user_forces.connector.bodies import mount
from user_forces.connector.contact_connector import FIRST
from user_forces.connector.item import JointItem
from user_forces.contact import JournalContact
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError, Vector2

SPECTRAL_RADIUS = 0.5
ASIDE = 1e-12  # of the bore from its journal, so that the engine's own contact has a normal [m]
UNDAMPED = 1e30  # impact velocity [m/s] against which every rate is nothing
Evaluator = Literal["built_in", "function", "joint"]


class BareScene:
    """The support as rigid bodies of the engine with constraints; nothing is in its clearance pin yet.

    mbs: the engine's system. contact: of the clearance pin. ends: the body and the centre's place in its
    frame [m], of bore and journal.

    Arguments:
        scenario: see `plain_support`.
    """

    def __init__(self, scenario: Scenario) -> None:
        support = plain_support(scenario)
        self.scenario, self.contact, self._links = scenario, support.contact, support.links
        self.container = exudyn.SystemContainer()  # owns the system, and must live as long as that
        self.mbs = self.container.AddSystem()
        self._driven = 0.0  # extension that the engine has [m]
        self._objects = [*(self._body(link, support.gravity) for link in support.links)]
        self._objects.append(self.mbs.AddObject(ObjectGround()))  # the last, which -1 means
        for n, link in enumerate(support.links):
            ends = [self.marker(self._end(body, link.pin)) for body in (link.parent, n)]
            self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=ends))
        self._columns = []
        for column in support.columns:
            ends = [self.marker(self._end(-1, column.foot)), self.marker(self._end(COLUMN_LINK, column.head))]
            item = ObjectConnectorDistance(markerNumbers=ends, distance=column.length)
            self._columns.append((self.mbs.AddObject(item), column.length))
        self.ends = self._end(-1, support.bore), self._end(JOURNAL_LINK, support.bore)

    def _body(self, link: Link, gravity: Vector2) -> Any:
        node = self.mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[*link.centre, 0.0]))
        item = self.mbs.AddObject(ObjectRigidBody2D(mass=link.mass, inertia=link.inertia, nodeNumber=node))
        centre = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=item, localPosition=[0, 0, 0]))
        weight = [link.mass * gravity[0], link.mass * gravity[1], 0.0]
        self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))
        return item

    def _end(self, body: int, point: Vector2) -> tuple[Any, list[float]]:
        """The engine's number of a link, -1 for the ground, and the place of a point in its frame [m]."""
        x, y = self._links[body].centre if body >= 0 else (0.0, 0.0)
        return self._objects[body], [point[0] - x, point[1] - y, 0.0]

    def marker(self, end: tuple[Any, list[float]], aside: float = 0.0) -> Any:
        """A marker at an end, moved along x [m]."""
        number, (x, y, z) = end
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=number, localPosition=[x + aside, y, z]))

    def solve(self, step: float, before_step: Callable[[], None]) -> float:
        """Solve by generalised alpha with equal steps [s]; returns the processor time [s].

        before_step: is called before every step.

        Raises RuntimeError if the solver does not finish.
        """

        def driven(mbs: Any, t: float) -> bool:
            before_step()
            extension = self.scenario.drive.extension(t)
            if extension != self._driven:
                self._driven = extension
                for item, length in self._columns:
                    self.mbs.SetObjectParameter(item, "distance", length + extension)
            return True

        self.mbs.Assemble()
        self.mbs.SetPreStepUserFunction(driven)
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.endTime = self.scenario.duration
        settings.timeIntegration.numberOfSteps = round(self.scenario.duration / step)
        settings.timeIntegration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
        settings.timeIntegration.newton.useModifiedNewton = True
        settings.timeIntegration.adaptiveStep = False
        settings.timeIntegration.verboseMode = 0
        settings.solution.file.write = False
        # else it stops at the first contact of the engine
        settings.timeIntegration.discontinuous.useRecommendedStepSize = False
        self.mbs.sys["simulationSettings"] = settings  # where `ClearanceJoint` reads that steps are fixed
        solver: Any = exudyn.MainSolverImplicitSecondOrder()
        began = time.process_time()
        with undisturbed():
            finished = solver.SolveSystem(self.mbs, settings)
        if not finished:
            raise RuntimeError(f"the solver gave up at t = {solver.it.currentTime} s")
        return time.process_time() - began


# --- the stock recipe ---


class _StockContact:
    """The connector's two user functions, what they remember, and what they note at the ends of all steps."""

    def __init__(self, force: JournalForce, clearance: float) -> None:
        self.on_journal, self.clearance = force, clearance
        self.speed = 0.0  # of approach, 0 in free flight [m/s]
        self.noted = [(0.0, 0.0)]  # time, force

    def force(  # type: ignore[no-untyped-def]
        self, mbs, t, item, displacement, rotation, velocity, angular_velocity, *unused
    ) -> list[float]:
        """Force and moment of the connector: those of the journal on the bore."""
        fx, fy, moment = self.on_journal(
            displacement[0], displacement[1], velocity[0], velocity[1], angular_velocity[2], self.speed
        )
        return [-fx, -fy, 0.0, 0.0, 0.0, -moment]

    def after_newton(  # type: ignore[no-untyped-def]
        self, mbs, t, item, data, displacement, rotation, velocity, angular_velocity, *unused
    ) -> list[float]:
        """The post-Newton function: note the initial impact velocity once a step."""
        x, y = displacement[0], displacement[1]
        eccentricity = math.hypot(x, y)
        depth = eccentricity - self.clearance
        rate = (x * velocity[0] + y * velocity[1]) / (eccentricity or 1.0)
        self.speed = (self.speed or rate) if depth > 0.0 else 0.0
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
    scene = BareScene(scenario)
    contact = _StockContact(journal_force(scene.contact), scene.contact.bearing.clearance)
    node = scene.mbs.AddNode(NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    scene.mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(
            markerNumbers=[scene.marker(end) for end in scene.ends],
            nodeNumber=node,
            springForceTorqueUserFunction=contact.force,
            postNewtonStepUserFunction=contact.after_newton,
        )
    )
    took = scene.solve(step, lambda: None)
    time, force = np.array(contact.noted).T
    return PeerRun(time, force, took)


# --- the engine's own contact, and ours in its place ---


class _Function:
    """The user function of our connector without the bookkeeping of a joint.

    As the built-in contact does, it pushes whenever there is depth; the impact velocity is that at the end of
    the step in which the surfaces met, which itself is undamped.
    """

    def __init__(self, scene: BareScene) -> None:
        bore, journal = (mount(scene.mbs, end, (0.0, 0.0, 1.0)) for end in scene.ends)
        self.force = JointItem(scene.mbs, scene.contact, bore, journal, 0.0).own_force()
        self.force.closed, self.force.speed = True, UNDAMPED

    def before_step(self) -> None:
        """Note the impact velocity, with what the last step ended."""
        depth, rate, *_ = self.force.last[FIRST:]
        if depth <= 0.0:
            self.force.speed = UNDAMPED
        elif self.force.speed == UNDAMPED:
            self.force.speed = rate


def run_connector(scenario: Scenario, step: float, contact: Evaluator) -> tuple[float, np.ndarray]:
    """Run with generalised alpha; the contacts differ in the program that computes the force.

    Arguments:
        scenario: see `plain_support`, without friction; its own step and solver are not used.
        step: length of all steps [s].
        contact: of the pin.

    Returns the processor time of the solver [s] and the coordinates of all bodies at the end.
    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    scene = BareScene(scenario)
    law = scene.contact
    if not isinstance(law.friction, Frictionless):
        raise InputError("friction: the engine's own contact has another law; allowed here: Frictionless")
    before_step: Callable[[], None] = lambda: None  # noqa: E731
    if contact == "built_in":
        bore, journal = scene.marker(scene.ends[0], ASIDE), scene.marker(scene.ends[1])
        _add_ball(scene.mbs, law, journal, bore)
    elif contact == "function":
        before_step = _Function(scene).before_step
    else:
        ClearanceJoint(
            scene.mbs,
            bore=scene.ends[0],
            journal=scene.ends[1],
            normal=law.normal,
            bore_radius=law.bearing.bore_radius,
            clearance=law.bearing.clearance,
        )
    took = scene.solve(step, before_step)
    return took, np.array(scene.mbs.systemData.GetODE2Coordinates())


def _add_ball(mbs: Any, contact: JournalContact, journal: Any, bore: Any) -> None:
    """Add the engine's own contact: a ball in a hollow ball is a journal in a bore.

    Its Hunt-Crossley factor 3 (1 - e)/2 equals Lankarani and Nikravesh's 3 (1 - e^2)/4 if its restitution is
    set to 1 - (1 - e^2)/2. It notes the initial impact velocity at the end of the step that noticed the
    contact, and it has no normal at the centre, so it starts beside it.
    """
    stiffness, _, floor = contact_numbers(contact)
    bearing, restitution = contact.bearing, contact.normal.restitution  # type: ignore[attr-defined]
    node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4))
    mbs.AddObject(
        ObjectContactSphereSphere(
            markerNumbers=[journal, bore],
            nodeNumber=node,
            spheresRadii=[bearing.journal_radius, bearing.bore_radius],
            isHollowSphere1=True,
            contactStiffness=stiffness,
            contactStiffnessExponent=1.5,
            restitutionCoefficient=1.0 - 0.5 * (1.0 - restitution**2),
            impactModel=1,
            minimumImpactVelocity=floor,
        )
    )
