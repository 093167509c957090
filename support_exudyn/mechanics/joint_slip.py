"""How ideal pins and guides with friction slide, and what their friction is called in a trajectory."""

from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.guides import IdealGuide
from support_exudyn.model.pins import IdealPin


class RubbingJoints(Protocol):
    """Ideal joints with friction, by name."""

    @property
    def friction_pins(self) -> dict[str, IdealPin]:
        """The pins."""
        ...

    @property
    def friction_guides(self) -> dict[str, IdealGuide]:
        """The guides."""
        ...


def joint_slips(motion: BodyMotion, joints: RubbingJoints) -> Iterator[Series]:
    """Slips (n,) [m/s] of ideal pins with friction, then of guides; of pins in slots without their turning."""
    for name, pin in joints.friction_pins.items():
        place = motion.linkage.pins[name]
        yield (pin.radius or 0.0) * (motion.spin(place.second) - motion.spin(place.first))
    for name in joints.friction_guides:
        yield motion.sliding(motion.linkage.slides[name])[1]


def friction_series(joints: RubbingJoints, forces: Mapping[str, Series]) -> dict[str, Any]:
    """Fields of a `Trajectory` from friction forces (n,) [N] by "pins.NAME" and "guides.NAME"; none without."""
    if not forces:
        return {}
    pins, guides = joints.friction_pins, joints.friction_guides
    return {
        "friction_moments": {name: (pin.radius or 0.0) * forces[f"pins.{name}"] for name, pin in pins.items()},
        "friction_forces": {name: forces[f"guides.{name}"] for name in guides},
    }
