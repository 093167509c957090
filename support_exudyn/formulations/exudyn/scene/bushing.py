"""A bushing in the engine: its own spring-dampers, one in the axes of the ground and one about the pin."""

import math
import sys
from typing import Any

import exudyn
from exudyn.itemInterface import ObjectConnectorCartesianSpringDamper, ObjectConnectorCoordinateSpringDamper

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.bushing import bushing_series
from support_exudyn.mechanics.trajectory import CompliantSeries
from support_exudyn.model.bushing_pin import BushingPin
from support_exudyn.model.linkage import PinPlace

ROUNDINGS = 8.0  # of a point's coordinates, from which the deflection is computed


class BushingItem:
    """A bushing in the engine. Being a spring it needs nothing in a search for static equilibrium.

    Arguments:
        mbs: the engine's system.
        pin: its data.
        place: where it is in the linkage.
        points: markers of the first and the second body's point.
        rotations: markers of both bodies' turns.
    """

    def __init__(
        self, mbs: Any, pin: BushingPin, place: PinPlace, points: list[Any], rotations: list[Any]
    ) -> None:
        self.pin = pin
        self.place = place
        self._mbs = mbs
        spring = ObjectConnectorCartesianSpringDamper(
            markerNumbers=points, stiffness=[*pin.stiffness, 0.0], damping=[*pin.damping, 0.0]
        )
        torsion = ObjectConnectorCoordinateSpringDamper(
            markerNumbers=rotations, stiffness=pin.rotational_stiffness, damping=pin.rotational_damping
        )
        self._spring, self._torsion = mbs.AddObject(spring), mbs.AddObject(torsion)

    @property
    def rounding(self) -> float:
        """The force by which rounding of positions lets the spring scatter [N]."""
        size = max(map(abs, (*self.place.first_point, *self.place.second_point)))
        return ROUNDINGS * sys.float_info.epsilon * math.hypot(*self.pin.stiffness) * size

    def loss(self) -> float:
        """The power that is dissipated now [W]."""
        velocity = exudyn.OutputVariableType.Velocity
        vx, vy, _ = self._mbs.GetObjectOutput(self._spring, velocity)
        spin = float(self._mbs.GetObjectOutput(self._torsion, velocity))
        along, up = self.pin.damping
        return float(along * vx * vx + up * vy * vy) + self.pin.rotational_damping * spin * spin

    def series(self, motion: BodyMotion) -> CompliantSeries:
        """Force, moment and deflection at the records, from the motion of all bodies."""
        return bushing_series(self.pin, self.place, motion)
