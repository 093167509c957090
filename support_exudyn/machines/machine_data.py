"""What a machine's data file holds: the machine, and what a scenario may ask for besides."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.machine import Machine


@dataclass(frozen=True)
class MachineData:
    """A machine as its file describes it.

    machine: bodies, pivots, masses. name: what it is called. bore_radii: of pins [m], by name, for scenarios
    that give a pin a clearance. actuators: masses of linear actuators, by name, for scenarios that model them
    as two bodies. stroke: by how much its actuators extend from the start posture on in use [m], None if it is
    not said.
    sources: where the data come from, by what they are of. kind: as the file says. assumed: what was assumed
    because the file does not say it, in sentences.
    """

    machine: Machine
    name: str = ""
    bore_radii: Mapping[str, float] = field(default_factory=dict)
    actuators: Mapping[str, CylinderAndRod] = field(default_factory=dict)
    stroke: float | None = None
    sources: Mapping[str, str] = field(default_factory=dict)
    kind: str = ""
    assumed: tuple[str, ...] = ()
