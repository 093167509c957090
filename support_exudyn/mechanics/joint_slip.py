"""How fast the surfaces of ideal pins and guides slide on each other."""

from collections.abc import Iterator, Mapping

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.guides import IdealGuide
from support_exudyn.model.pins import IdealPin


def joint_slips(
    motion: BodyMotion, pins: Mapping[str, IdealPin], guides: Mapping[str, IdealGuide]
) -> Iterator[Series]:
    """Slips (n,) [m/s] of ideal pins with friction, then of guides; of pins in slots without their turning."""
    for name, pin in pins.items():
        place = motion.linkage.pins[name]
        yield (pin.radius or 0.0) * (motion.spin(place.second) - motion.spin(place.first))
    for name in guides:
        yield motion.sliding(motion.linkage.slides[name])[1]
