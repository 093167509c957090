"""A pin with clearance in the engine: the connector, its user functions and its memory.

The connector is the engine's rigid-body connector in its intrinsic form, which applies force and moment
in the middle between both marker points, so that they act at one point on both bodies. That is exact
only while both marker frames are parallel: with frames turned by an angle a against each other the
engine's displacement is longer than the distance of the points by (a/2)/sin(a/2), and as much angular
momentum is lost. The journal's marker frame is therefore turned along, so that a stays small.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import exudyn
from exudyn.itemInterface import MarkerBodyRigid, NodeGenericData, ObjectConnectorRigidBodySpringDamper

from support_exudyn.onset import Action, Onset, PinMemory, judge
from user_forces.contact import JournalContact
from user_forces.friction.frictionless import Frictionless
from user_forces.values import Vector2

# Largest turn between the marker frames before they are lined up again [rad]: the displacement is then
# right within 4e-8 of itself.
FRAME_TURN = 1e-3
SMALL_TURN = 1e-7  # below it there is no difference to rounding [rad]
# An impact that does not end by parting counts as over after so many swings of the depth, deep and back.
SWINGS = 2
REPEAT_ERROR = 1e6  # above any tolerance of the engine's discontinuous iteration: the step is repeated


class LoosePin:
    """One clearance pin of a scene. Its memory lives in a data node of the engine, which puts it back
    when a step is rejected; what is kept here is a copy of it for the step being tried.
    """

    def __init__(self, mbs: Any, contact: JournalContact, bore_on_ground: bool, bore_node: Any) -> None:
        self.mbs = mbs
        self.contact = contact
        self.node: Any = None
        self.bore_marker: Any = None
        self.journal_marker: Any = None
        self.bore_node = bore_node
        self.bore_on_ground = bore_on_ground
        self.arm: Vector2 = (0.0, 0.0)  # of the journal's centre on its body
        self.frame_turn = 0.0  # of the journal's marker frame on its body
        self.needs_spin = bore_node is not None and not isinstance(contact.friction, Frictionless)
        self.turn, self.turn_rate = 0.0, 0.0  # between the marker frames at the last accepted step
        self.swings_left = 0  # of the depth in an impact that is going on; 0: there is none
        self._opening = False
        # the step being tried
        self.memory = PinMemory(False, 0.0, 0.0, 0.0)
        self.force = contact.force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None)
        self.onset: Onset | None = None
        self.tried_turn = (0.0, 0.0)
        self.wants_cut = False
        self.expected_onset = math.inf  # seen in a step that was then cut [s]
        # over the run
        self.onsets: list[Onset] = []
        self.calls = 0
        self.clamped_steps = 0
        self.largest_force = 0.0
        # while the static equilibrium is sought: a spring that keeps a free journal near the middle
        self.settling = False
        self.centring_stiffness = 0.0
        self.step_sizes: Callable[[], tuple[float, float]] = lambda: (math.nan, math.nan)  # by the solver

    @classmethod
    def add(
        cls,
        mbs: Any,
        contact: JournalContact,
        *,
        bore: tuple[Any, Vector2],
        journal: tuple[Any, Vector2],
        turn: float,
        bore_node: Any,
        bore_on_ground: bool,
    ) -> LoosePin:
        """Add the connector between two bodies.

        Arguments:
            bore, journal: the engine's body and the centre on it, in the body's axes [m].
            turn: of the journal's body relative to the bore's [rad].
            bore_node: node of the bore's body if both bodies move, else None.
            bore_on_ground: the bore's body is the ground.
        """
        pin = cls(mbs, contact, bore_on_ground, bore_node)
        pin.arm = journal[1]
        pin.frame_turn = -turn
        pin.node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.0] * 4, numberOfDataCoordinates=4))
        pin.bore_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=bore[0], localPosition=[*bore[1], 0.0]))
        pin.journal_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=journal[0], localHT=pin._frame()))
        mbs.AddObject(
            ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[pin.bore_marker, pin.journal_marker],
                nodeNumber=pin.node,
                useIntrinsicFormulation=True,
                springForceTorqueUserFunction=pin._connector_force,
                postNewtonStepUserFunction=pin._after_newton,
            )
        )
        return pin

    # --- memory ---

    @cached_property
    def slots(self) -> slice:
        """Where the pin's memory stands in the engine's vector of data coordinates, once assembled."""
        first = int(self.mbs.systemData.GetNodeLTGData(self.node)[0])
        return slice(first, first + len(PinMemory._fields))

    def begin_try(self, data: list[float], step: float) -> None:
        """Before a step is tried: take the memory from the engine, line up the frames.

        Arguments:
            data: the pin's data coordinates, as the engine has them.
            step: length of the step [s].
        """
        self.memory = recalled(data)
        self.onset = None
        self.wants_cut = False
        turn = self.turn + self.turn_rate * step  # expected at the end of the step
        if abs(turn) > FRAME_TURN:
            self.frame_turn = math.remainder(self.frame_turn - turn, 2.0 * math.pi)
            self.turn -= turn
            self.mbs.SetMarkerParameter(self.journal_marker, "localHT", self._frame())

    def accept(self) -> None:
        """After a step has been accepted: keep what happened in it."""
        self.turn, self.turn_rate = self.tried_turn
        self._follow_impact()
        if self.onset is not None:
            self.onsets.append(self.onset)
            self.onset = None
        self.clamped_steps += self.force.clamped
        self.largest_force = max(
            self.largest_force, math.hypot(self.force.normal_force, self.force.friction_force)
        )

    def begin_impact(self) -> None:
        """From now on the depth swings: at a touch, and when the columns' speed jumps under a closed pin."""
        self.swings_left, self._opening = SWINGS, False

    def _follow_impact(self) -> None:
        if self.onset is not None:
            self.begin_impact()
        elif self.force.depth <= 0.0:
            self.swings_left = 0
        elif self._opening and self.force.rate >= 0.0:
            self.swings_left, self._opening = max(0, self.swings_left - 1), False
        elif self.force.rate < 0.0:
            self._opening = True

    # --- called by the engine ---

    def _connector_force(
        self,
        mbs: Any,
        t: float,
        item: int,
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *unused: Any,
    ) -> list[float]:
        """Force and moment of the connector, which act on the bore and, reversed, on the journal."""
        self.calls += 1
        x, y = _true_displacement(displacement[0], displacement[1], rotation[2])
        if self.settling:
            return self._settling_force(x, y)
        bore_spin = journal_spin = 0.0
        if self.needs_spin:
            bore_spin = float(mbs.GetNodeOutput(self.bore_node, exudyn.OutputVariableType.Coordinates_t)[2])
            journal_spin = bore_spin + angular_velocity[2]
        elif self.bore_on_ground:
            journal_spin = angular_velocity[2]
        else:
            bore_spin = -angular_velocity[2]
        memory = self.memory
        force = self.contact.force(
            x,
            y,
            velocity[0],
            velocity[1],
            bore_spin,
            journal_spin,
            memory.approach_speed if memory.in_contact else None,
        )
        self.force = force
        # the engine moves the force to the middle between both centres, eccentricity/2 from the journal's
        arm = force.journal_arm + 0.5 * math.hypot(x, y)
        return [-force.force_x, -force.force_y, 0.0, 0.0, 0.0, -arm * force.friction_force]

    def _after_newton(
        self,
        mbs: Any,
        t: float,
        item: int,
        data: list[float],
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *unused: Any,
    ) -> list[float]:
        """[error, recommended step, new memory]: accept the step, repeat it, or ask for a shorter one."""
        if self.settling:
            return [0.0, -1.0, *data]
        self.tried_turn = (rotation[2], angular_velocity[2])
        x, y = _true_displacement(displacement[0], displacement[1], rotation[2])
        depth, rate = self.contact.gap_state(x, y, velocity[0], velocity[1])
        verdict = judge(recalled(data), depth, rate, t, *self.step_sizes())
        if verdict.action is Action.CUT:
            self.wants_cut = True
            self.expected_onset = verdict.onset.time if verdict.onset else math.inf
            return [REPEAT_ERROR, verdict.step, *data]
        if verdict.onset is not None:
            self.onset = verdict.onset
            self.expected_onset = math.inf
        memory = [float(item) for item in verdict.memory]
        if verdict.action is Action.REPEAT:
            self.memory = verdict.memory
            return [REPEAT_ERROR, -1.0, *memory]
        return [0.0, -1.0, *memory]

    def _settling_force(self, x: float, y: float) -> list[float]:
        """Elastic contact and the centring spring, without damping and friction."""
        eccentricity = math.hypot(x, y)
        pull = self.centring_stiffness
        depth = self.contact.bearing.depth(eccentricity)
        if depth > 0.0:
            pull += self.contact.normal.elastic_force(depth) / eccentricity
        return [pull * x, pull * y, 0.0, 0.0, 0.0, 0.0]

    def _frame(self) -> list[list[float]]:
        c, s = math.cos(self.frame_turn), math.sin(self.frame_turn)
        x, y = self.arm
        return [[c, -s, 0.0, x], [s, c, 0.0, y], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]


def recalled(data: list[float]) -> PinMemory:
    """A pin's memory from its data coordinates."""
    return PinMemory(data[0] > 0.5, data[1], data[2], data[3])


def _true_displacement(x: float, y: float, turn: float) -> tuple[float, float]:
    """Distance vector of the marker points from the engine's displacement, see the top of this file."""
    if abs(turn) < SMALL_TURN:
        return x, y
    scale = math.sin(0.5 * turn) / (0.5 * turn)
    return scale * x, scale * y
