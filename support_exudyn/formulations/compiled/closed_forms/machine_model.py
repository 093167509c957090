"""What closed forms need of a machine, and the bodies of one at the records."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np

from support_exudyn.formulations.compiled.closed_forms.layout import Matrix, Vector
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import Linkage


class BodyPlace(NamedTuple):
    """A body: centre of mass [m] and turn from the start [rad], their rates, and the rates of those; (n,)."""

    x: Vector
    y: Vector
    turn: Vector
    vx: Vector
    vy: Vector
    spin: Vector
    ax: Vector
    ay: Vector
    spin_rate: Vector


@dataclass(frozen=True)
class Bodies:
    """All bodies at the records, as in `Trajectory`; actuators: forces (n,) [N]; pin_force: of an ideal pin."""

    position: Vector
    velocity: Vector
    acceleration: Vector
    actuators: Mapping[str, Vector]
    pin_force: tuple[Vector, Vector] | None = None


def moved(
    base: tuple[Vector, Vector, Vector, Vector, Vector, Vector],
    arm: tuple[Vector, Vector],
    turn: Vector,
    spin: Vector,
    spin_rate: Vector,
) -> BodyPlace:
    """A body from the motion of one of its points.

    Arguments:
        base: x, y of the point, their rates, and the rates of those.
        arm: from the point to the centre of mass.
    """
    x, y, vx, vy, ax, ay = base
    rx, ry = arm
    square = spin * spin
    return BodyPlace(
        x + rx,
        y + ry,
        turn,
        vx - spin * ry,
        vy + spin * rx,
        spin,
        ax - spin_rate * ry - square * rx,
        ay + spin_rate * rx - square * ry,
        spin_rate,
    )


def placed(
    linkage: Linkage,
    places: Sequence[BodyPlace],
    actuators: Mapping[str, Vector],
    pin_force: tuple[Vector, Vector] | None = None,
) -> Bodies:
    """All bodies, in the order of the linkage's."""
    count = np.asarray(places[0].turn).size

    def together(rows: Sequence[Sequence[Vector]]) -> Vector:
        return np.column_stack([np.broadcast_to(item, (count,)) for row in rows for item in row])

    centres = [body.centre for body in linkage.bodies.values()]
    return Bodies(
        together([(p.x - c[0], p.y - c[1], p.turn) for p, c in zip(places, centres, strict=True)]),
        together([(p.vx, p.vy, p.spin) for p in places]),
        together([(p.ax, p.ay, p.spin_rate) for p in places]),
        actuators,
        pin_force,
    )


class MachineModel(Protocol):
    """What a machine's module offers. PIN: the pin that may be with clearance; DRIVES: that it covers."""

    PIN: str
    DRIVES: tuple[type[Drive], ...]

    def start(self, machine: Any) -> tuple[float, float]:
        """The free coordinates at the start."""

    def shifted(self, before: Linkage, after: Linkage) -> tuple[float, float]:
        """By how much the free coordinates differ between two postures of the linkage."""

    def reaches(self, machine: Any) -> tuple[float, float]:
        """The displacement of the journal per unit of the free coordinates."""

    def fall(self, machine: Any, speed: float) -> float:
        """Acceleration of the journal without its contact besides gravity's [m/s^2] at a speed of the drive."""

    def parameters(self, machine: Any) -> dict[str, float]:
        """Parameters by name, see `layout`."""

    def bodies(
        self, machine: Any, linkage: Linkage, p: list[float], rows: Matrix, accelerations: Matrix | None
    ) -> Bodies:
        """Bodies and actuators at the records."""
