"""What a machine's data file holds: the machine, and what a scenario may ask for besides."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from support_exudyn.machines.strength.strength_data import StrengthData
from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.machine import Machine
from user_forces.values.names import Named
from user_forces.values.sourced import SourcedNumber


@dataclass(frozen=True)
class MachineData:
    """A machine as its file describes it.

    machine: bodies, pivots, masses. name: what it is called. bore_radii: of pins [m], by name, for scenarios
    that give a pin a clearance. blocks: length along and height across of what slides in a guide [m], by guide.
    actuators: masses of linear actuators, by name, for scenarios that model them
    as two bodies. stroke: by how much its actuators extend from the start posture on in use [m], None if it is
    not said.
    sources: where the data come from, by what they are of. kind: as the file says. assumed: what was assumed
    because the file does not say it, in sentences. warnings: what in the file is contradictory, in sentences,
    with how far. sourced: numbers of the file that say their range or their
    source, by their dotted keys, such as "parts.shield.1.mass_kg", in the units of these. strength: bores,
    pressures, stages, eyes and base, for what it must stand; None if the file does not say them.
    """

    machine: Machine
    name: str = ""
    bore_radii: Mapping[str, float] = field(default_factory=dict)
    blocks: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    actuators: Mapping[str, CylinderAndRod] = field(default_factory=dict)
    stroke: float | None = None
    sources: Mapping[str, str] = field(default_factory=dict)
    kind: str = ""
    assumed: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    sourced: Mapping[str, SourcedNumber] = field(default_factory=dict)
    strength: StrengthData | None = None

    def __post_init__(self) -> None:
        """Let what is asked for by a wrong name be told with those that look like it."""
        object.__setattr__(self, "bore_radii", Named(self.bore_radii, "pin with a bore_radius_mm"))
        object.__setattr__(self, "actuators", Named(self.actuators, "actuator with masses"))
