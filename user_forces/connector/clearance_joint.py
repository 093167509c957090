"""A clearance joint for any Exudyn model: a journal of one body in the bore of another.

    joint = ClearanceJoint(mbs, bore=(link, [0.5, 0, 0]), journal=(ground, [0, 0, 0]), bore_radius=0.0655,
                           clearance=0.0015, normal=LankaraniNikravesh(stiffness=2.7e10, restitution=0.9))
    mbs.Assemble()
    mbs.SolveDynamic(settings)
    joint.impacts, joint.largest_force

The stock solver locates impacts by the connector's post-Newton step: a step in which the surfaces touch is
repeated so that it ends at the impact. With fixed steps (`adaptiveStep = False`) impacts count from the end of
the step. `solve_located` adds steps on a grid, growth of steps, and an error estimate.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import exudyn
from exudyn.itemInterface import NodeGenericData

from user_forces.connector.bodies import SPATIAL, draw, free_inverse_mass, mount
from user_forces.connector.contact_connector import ContactConnector
from user_forces.connector.item import JointItem
from user_forces.contact import JournalContact, SlotContact
from user_forces.contact_state import InverseMass, Onset
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.impact_steps import ImpactSteps
from user_forces.journal import JournalBearing, Slot
from user_forces.normal.law import NormalLaw
from user_forces.values.value import InputError

REPEAT = 1e6  # error above any tolerance of the engine's discontinuous iteration: the step is repeated
SHORTEST = 1e-12  # step [s] to which one is cut at most
FEWEST = 2  # steps in an impact
TOO_LONG = 1.01  # times the longest step, by which a step in contact is repeated
JOINTS = "clearance joints"  # of a model, in `mbs.variables`
End = tuple[Any, Sequence[float]]


class EngineContact(ContactConnector):
    """A contact in a user's own model, with the post-Newton step by which the stock solver locates impacts.

    `impacts` lists `Onset`s: time [s], impact velocity [m/s], and of those that have separated their time and
    velocity of separation. `largest_force` [N] is the largest contact force at any time. `connector` and `node`
    are the engine's numbers of the connector, for sensors, and of the node whose data are: whether the surfaces
    are in contact, impact velocity [m/s], indentation [m], its rate [m/s], time [s].
    """

    def __init__(
        self,
        mbs: Any,
        contact: JournalContact | SlotContact,
        bore: End,
        journal: End,
        axis: Sequence[float],
        impact_steps: int,
        show: bool,
        along: Sequence[float] | None = None,
        names: tuple[str, str] = ("bore", "journal"),
    ) -> None:
        if isinstance(impact_steps, bool) or not isinstance(impact_steps, int) or impact_steps < FEWEST:
            raise InputError(f"impact_steps = {impact_steps!r}: allowed: a whole number from {FEWEST}")
        bore_mount = mount(mbs, bore, axis, along, names[0])
        journal_mount = mount(mbs, journal, axis, along, names[1])
        if int(bore[0]) == int(journal[0]):
            raise InputError(f"{names[1]} = {journal!r}: allowed: another body than that of the {names[0]}")
        self.mbs = mbs
        self.node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.0] * 5, numberOfDataCoordinates=5))
        item = JointItem(
            mbs,
            contact,
            bore_mount,
            journal_mount,
            is_round=any(mbs.GetObject(body)["objectType"] == SPATIAL for body in (bore[0], journal[0])),
            nodeNumber=self.node,
            postNewtonStepUserFunction=self._post_newton,
        )
        self._bodies = bore[0], journal[0]
        super().__init__(item, self._inverse_mass_now, impact_steps)
        item.set_force(self._force_of_try)
        self.connector = item.object
        self.is_driven = False  # by `solve_located`, which decides on steps itself
        self._end = self._start = math.nan  # of the step being tried [s]
        mbs.variables.setdefault(JOINTS, []).append(self)
        if show:
            draw(mbs, bore_mount, journal_mount, contact.bearing)

    @property
    def impacts(self) -> tuple[Onset, ...]:
        """The impacts so far."""
        self._accept_pending(self.mbs.systemData.GetTime())
        return tuple(self.onsets)

    def reset(self) -> None:
        """Forget the last run: the next begins in the model's initial state."""
        self.onsets.clear()
        self.clamped_steps, self.largest_force, self.largest_force_time = 0, 0.0, 0.0
        self._end = self._start = math.nan
        self.impact_steps = ImpactSteps(self.contact.normal, self.impact_steps.number)
        self.start(self._inverse_mass_now(exudyn.ConfigurationType.Initial))
        self.begin_impact()

    def _inverse_mass_now(self, state: Any = exudyn.ConfigurationType.Current) -> InverseMass:
        return free_inverse_mass(self.mbs, self._bodies, self.item, state)

    # --- called by the stock solver ---

    def _force_of_try(self, mbs: Any, t: float, *motion: Any) -> list[float]:
        """The user function, which sees where the engine begins to try another step."""
        if t != self._end and not self.is_driven:
            self._begin(t)
        return self.item.moved(mbs, t, *motion)

    def _begin(self, t: float) -> None:
        """Begin to try a step to t [s] from the last accepted state."""
        begin = self.mbs.systemData.GetTime(exudyn.ConfigurationType.StartOfStep)
        if t <= begin or math.isnan(self._start):  # the engine's first evaluation
            settings = self.mbs.sys.get("simulationSettings")  # of the stock solver
            self.locates = settings is None or settings.timeIntegration.adaptiveStep
            self.reset()
            self._start = begin
        self._accept_pending(begin)
        self._end = t
        self.begin_try(t - begin)

    def _accept_pending(self, begin: float) -> None:
        """The step that was tried last stands if the engine has gone on from its end."""
        if begin == self._end != self._start:
            self.accept(begin)
            self._start = begin

    def _post_newton(self, mbs: Any, t: float, item: int, data: Any, *motion: Any) -> list[float]:
        """Error, recommended step and data: the step may stand, or is to be repeated, perhaps shorter."""
        if self.is_driven:
            return [0.0, -1.0, *self._data(t)]
        step = self.after_newton(t)
        if step is None and self.locates and self._step > TOO_LONG * self.longest_step:
            step = self.longest_step
        if step is None:
            return [0.0, -1.0, *self._data(t)]
        if step == math.inf:
            return [REPEAT, -1.0, *data]
        return [REPEAT, max(step, SHORTEST), *data]

    def _data(self, t: float) -> list[float]:
        memory = self.reached
        return [float(memory.in_contact), memory.impact_velocity, memory.depth, memory.rate, t]


class ClearanceJoint(EngineContact):
    """A journal of one body in the bore of another, planar or spatial.

    Arguments:
        mbs: the Exudyn system, not yet assembled.
        bore, journal: body number, and position of the centre in the body's frame [m] (3). Bodies are rigid
            bodies, planar or spatial, or the ground.
        bore_radius: R2 [m]. clearance: radial clearance R2 - R1 [m].
        normal, friction: laws; no friction by default.
        axis: of the bore in the model's reference configuration, global frame (3).
        impact_steps: steps in an undamped impact.
        show: whether Exudyn's viewer shows both on their bodies.

    Raises InputError for arguments outside their range, and for bodies that are not rigid.
    """

    def __init__(
        self,
        mbs: Any,
        *,
        bore: End,
        journal: End,
        bore_radius: float,
        clearance: float,
        normal: NormalLaw,
        friction: FrictionLaw | None = None,
        axis: Sequence[float] = (0.0, 0.0, 1.0),
        impact_steps: int = 128,
        show: bool = True,
    ) -> None:
        bearing = JournalBearing(bore_radius=bore_radius, clearance=clearance)
        contact = JournalContact(bearing=bearing, normal=normal, friction=friction or Frictionless())
        super().__init__(mbs, contact, bore, journal, axis, impact_steps, show)


class ClearanceGuide(EngineContact):
    """A round pin of one body, or a corner, between the walls of a straight slot of another.

    Arguments:
        mbs: the Exudyn system, not yet assembled.
        slot: body number, and a point of the slot's middle line in the body's frame [m] (3).
        pin: body number, and the pin's centre in its body's frame [m] (3).
        direction: of the slot in the model's reference configuration, global frame (3).
        clearance: distance from the middle line at which the pin makes contact [m].
        normal, friction: laws; no friction by default. pin_radius: [m]; 0: a corner.
        axis: across the plane of motion, global frame (3).
        impact_steps: steps in an undamped impact.
        show: whether Exudyn's viewer shows both on their bodies.
    """

    def __init__(
        self,
        mbs: Any,
        *,
        slot: End,
        pin: End,
        direction: Sequence[float],
        clearance: float,
        normal: NormalLaw,
        friction: FrictionLaw | None = None,
        pin_radius: float = 0.0,
        axis: Sequence[float] = (0.0, 0.0, 1.0),
        impact_steps: int = 128,
        show: bool = True,
    ) -> None:
        walls = Slot(clearance=clearance, radius=pin_radius)
        contact = SlotContact(bearing=walls, normal=normal, friction=friction or Frictionless())
        super().__init__(mbs, contact, slot, pin, axis, impact_steps, show, direction, ("slot", "pin"))
