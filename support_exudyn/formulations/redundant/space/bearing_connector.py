"""A clearance bearing in the engine: one connector for all of its sections, whose force Python gives."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from exudyn.itemInterface import ObjectGenericODE2, VObjectGenericODE2

from support_exudyn.formulations.redundant.clearance.connector import PinConnector
from support_exudyn.formulations.redundant.clearance.connector_force import Attachment, Relative
from support_exudyn.formulations.redundant.clearance.pin_frames import PinFrames
from support_exudyn.formulations.redundant.clearance.pin_motion import Moving
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce
from support_exudyn.formulations.redundant.clearance.steep_friction import EngineForce
from support_exudyn.formulations.redundant.space.bearing_source import (
    LINE,
    MEMORY,
    PARTS,
    BearingGeometry,
    force_source,
    names,
    spring_source,
)
from support_exudyn.mechanics.contact_state import PinMemory
from user_forces.compilation.flat import compiled
from user_forces.contact import JournalContact
from user_forces.values.value import Vector2

FUNCTION = "forceUserFunction"  # the engine's name


class BearingConnector:
    """The connector of a bearing.

    Arguments:
        mbs: the engine's system.
        bearing: where it is.
        contacts: of its sections.
        nodes: the engine's, of the bodies that move, the bore's first.
    """

    def __init__(
        self, mbs: Any, bearing: BearingGeometry, contacts: Sequence[JournalContact], nodes: Sequence[Any]
    ) -> None:
        source = force_source(bearing, contacts) + spring_source(bearing)
        self.names = compiled(source, contacts[0], stiffness=self._stiffness, **names(bearing))
        for n, contact in enumerate(contacts):
            self.names[f"normal_law{n}"] = contact.normal
            self.names[f"too_deep{n}"] = contact.normal.elastic_force  # which says so
        self.mbs, self.bearing = mbs, bearing
        self._springs: dict[int, Callable[[float], float]] = {}  # while an equilibrium is looked for
        self.object = mbs.AddObject(
            ObjectGenericODE2(
                nodeNumbers=nodes,
                forceUserFunction=self.names["force"],
                visualization=VObjectGenericODE2(show=False),
            )
        )
        self.sections = [SectionConnector(self, n, contact) for n, contact in enumerate(contacts)]

    def settle(self, n: int, stiffness: Callable[[float], float]) -> None:
        """Let a spring act at a section, its stiffness [N/m] given by the distance [m]."""
        self._springs[n] = stiffness
        self.mbs.SetObjectParameter(self.object, FUNCTION, self.names["spring"])

    def act(self) -> None:
        """Let the contacts act."""
        if self._springs:
            self._springs.clear()
            self.mbs.SetObjectParameter(self.object, FUNCTION, self.names["force"])

    def _stiffness(self, n: int, distance: float) -> float:
        return self._springs[n](distance)

    @property
    def middle(self) -> Vector2:
        """The place of the journal's middle in the bore at the last call, in the axes of the force [m]."""
        last = self.names["last"]
        first = PARTS * len(self.sections)
        return last[first], last[first + 1]


class SectionConnector(PinConnector):
    """What one section has of the connector of its bearing.

    Arguments:
        whole: that connector.
        number: of the section, from 0 on.
        contact: its own.
    """

    def __init__(self, whole: BearingConnector, number: int, contact: JournalContact) -> None:
        self.whole, self.number, self.contact = whole, number, contact
        self.mbs, self.object = whole.mbs, whole.object
        self.clearance = contact.bearing.clearance
        self.at, self.bore_on_ground = whole.bearing.at, whole.bearing.bore.first is None

    def set_force(self, function: Any) -> None:
        """Let the contact act; function: of a `SectionForce`."""
        function()
        self.whole.act()

    def _set_spring(self, stiffness: Callable[[float], float]) -> None:
        self.whole.settle(self.number, stiffness)

    def slide(self, bore: float, journal: float) -> None:
        """Let the force act beside both centres, by so much along bore and journal [m]."""
        place, known = self.whole.bearing.places[self.number], self.whole.names
        known[f"bore_place{self.number}"] = place + bore
        known[f"journal_place{self.number}"] = place + journal


class SectionForce(PythonForce):
    """The force of one section; straight: with a line in place of friction, see `friction_line`."""

    def __init__(self, connector: SectionConnector, straight: bool) -> None:
        number = connector.number
        self._names, self._first = connector.whole.names, PARTS * number
        self._has_state = connector.contact.friction.has_state
        self._counts = number == 0 and not straight
        self._impact = [f"{name}{number}" for name in ("in_contact", *MEMORY[:1])]
        self._history = [f"{name}{number}" for name in MEMORY[1:]]
        self._line = [f"{name}{number}" for name in LINE]
        self.function = partial(self._names.__setitem__, f"straight{number}", straight)

    @property
    def calls(self) -> int:
        """How often the engine has asked for the force of all sections; counted with the first."""
        return super().calls if self._counts else 0

    @property
    def last(self) -> tuple[float, ...]:
        """The motion when the engine asked last: x, y, z and their rates [m], [m/s]."""
        found: tuple[float, ...] = self._names["last"][self._first : self._first + PARTS]
        return found

    @property
    def spins(self) -> tuple[float, float]:
        """The spin of the bore then, and that of the journal against it [rad/s]."""
        bore, turning = self._names["last"][-2:]
        return bore, turning

    def load(self, memory: PinMemory, step: float, *others: float) -> None:
        """See `PythonForce`."""
        self._names.update(zip(self._impact, memory[:2], strict=True))
        if self._has_state:
            self._names.update(zip(self._history, (memory.deflection, memory.slip, step), strict=True))

    def lay(self, offset: float, slope: float) -> None:
        """See `PythonForce`."""
        self._names.update(zip(self._line, (offset, slope), strict=True))


class SectionFrames(PinFrames):
    """The axes in which a section's force is given, which are those of the bore at every moment.

    Half-way tilted to those of the journal where the force acts in the middle. Nothing has to be guessed.
    """

    def __init__(self, connector: PinConnector, moving: Moving, bore_spin: Callable[[], float]) -> None:
        super().__init__(connector, moving, bore_spin)
        self.follows = False

    def relative(self, force: EngineForce) -> Relative:
        """See `PinFrames`."""
        assert isinstance(force, SectionForce)
        x, y, z, vx, vy, vz = force.last
        if self.at is Attachment.LINE:
            distance = math.sqrt(x * x + y * y + z * z)
            if distance == 0.0:
                return Relative(0.0, 0.0, math.hypot(vx, vy), 0.0)
            return Relative(distance, 0.0, (x * vx + y * vy + z * vz) / distance, 0.0)
        bore, turning = force.spins
        return Relative(x, y, vx, vy, turning, bore)
