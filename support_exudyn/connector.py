"""The engine's side of a pin with clearance: data node, markers and connector.

The connector is the engine's rigid-body connector in its intrinsic form, which applies force and moment
in the middle between both marker points, so that they act at one point on both bodies. That is exact
only while both marker frames are parallel: with frames turned by an angle a against each other the
engine's displacement is longer than the distance of the points by (a/2)/sin(a/2), and as much angular
momentum is lost. The journal's marker frame is therefore turned along, so that a stays small.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

from exudyn.itemInterface import MarkerBodyRigid, NodeGenericData, ObjectConnectorRigidBodySpringDamper

from support_exudyn.onset import PinMemory
from user_forces.values import Vector2

# Largest turn between the marker frames before they are lined up again [rad]: the displacement is then
# right within 4e-10 of itself, and the rest is corrected.
FRAME_TURN = 1e-4
FORCE = "springForceTorqueUserFunction"  # the engine's name for the force's user function


class PinConnector:
    """Node, markers and connector of one clearance pin in the engine.

    Arguments:
        mbs: the engine's system.
        bore, journal: the engine's body and the centre on it, in the body's axes [m].
        turn: of the journal's body relative to the bore's [rad].
        after_newton: the engine's post-Newton user function.
    """

    def __init__(
        self,
        mbs: Any,
        bore: tuple[Any, Vector2],
        journal: tuple[Any, Vector2],
        turn: float,
        after_newton: Callable[..., list[float]],
    ) -> None:
        self.mbs = mbs
        self._arm = journal[1]
        self._frame_turn = -turn  # of the journal's marker frame on its body
        size = len(PinMemory._fields)
        self.node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.0] * size, numberOfDataCoordinates=size))
        self.bore_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=bore[0], localPosition=[*bore[1], 0.0]))
        self.journal_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=journal[0], localHT=self._frame()))
        self.object = mbs.AddObject(
            ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[self.bore_marker, self.journal_marker],
                nodeNumber=self.node,
                useIntrinsicFormulation=True,
                postNewtonStepUserFunction=after_newton,
            )
        )

    @cached_property
    def slots(self) -> slice:
        """Where the pin's memory stands in the engine's vector of data coordinates, once assembled."""
        first = int(self.mbs.systemData.GetNodeLTGData(self.node)[0])
        return slice(first, first + len(PinMemory._fields))

    def set_force(self, function: Any) -> None:
        """Let this user function, Python's or symbolic, give force and moment."""
        self.mbs.SetObjectParameter(self.object, FORCE, function)

    def set_after_newton(self, function: Callable[..., list[float]]) -> None:
        """Let this user function judge a step that has been tried."""
        self.mbs.SetObjectParameter(self.object, "postNewtonStepUserFunction", function)

    def line_up(self, turn: float) -> bool:
        """Line up the marker frames if the journal's will have turned by so much [rad]; whether it was done."""
        if abs(turn) <= FRAME_TURN:
            return False
        self._frame_turn = math.remainder(self._frame_turn - turn, 2.0 * math.pi)
        self.mbs.SetMarkerParameter(self.journal_marker, "localHT", self._frame())
        return True

    def _frame(self) -> list[list[float]]:
        c, s = math.cos(self._frame_turn), math.sin(self._frame_turn)
        x, y = self._arm
        return [[c, -s, 0.0, x], [s, c, 0.0, y], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]


def recalled(data: Sequence[float]) -> PinMemory:
    """A pin's memory from its data coordinates."""
    return PinMemory(data[0] > 0.5, *data[1:])


def displacement_scale(turn: float) -> float:
    """Distance of the marker points over the engine's displacement, see the top of this file.

    sin(a/2)/(a/2) of the turn a [rad] by its series: right to rounding as long as frames are lined up.
    """
    square = 0.25 * turn * turn
    return 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0))
