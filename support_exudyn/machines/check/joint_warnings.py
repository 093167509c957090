"""What a linkage does not model where a user may expect it: relative motors, tooth forces, ends of guides."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from support_exudyn.machines.check.drive_way import Moved
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.model.linkage import GROUND, Linkage, Slide

PRESSURE_ANGLE = math.radians(20.0)  # of usual teeth
NONE: Mapping[str, float] = MappingProxyType({})


def joint_warnings(linkage: Linkage, moments: Mapping[str, float] = NONE) -> Iterator[str]:
    """Warnings on cranks and gears.

    Arguments:
        linkage: the mechanism.
        moments: largest moments of gears on their second wheels [N m], by name, as far as they are known.
    """
    pairs = [(a, b) for (part, _), ((a, _), (b, _)) in linkage.joints.items() if part != "actuators"]
    for name, crank in linkage.cranks.items():
        others = dict.fromkeys(
            body for pair in pairs if crank.body in pair for body in pair if body != crank.body
        )
        if GROUND not in others:
            yield (
                f'cranks.{name}: turns {crank.body} against the ground (on = "ground"), and not against '
                f"{' or '.join(others) or 'another body'}; motors between two moving bodies are not covered"
            )
    for name, gear in linkage.gears.items():
        radius, moment, known = linkage.pitch_radius(gear), moments.get(name), []
        if moment is not None:
            known.append(f"moment up to {abs(moment):.4g} N m")
        if radius is not None:
            known.append(f"pitch radius of {gear.second} {1e3 * radius:.4g} mm")
        if moment is not None and radius is not None:
            force, steep = abs(moment) / radius, abs(moment) / radius / math.cos(PRESSURE_ANGLE)
            known.append(
                f"tooth force up to {force:.4g} N along the pitch line, {steep:.4g} N "
                f"at a pressure angle of {math.degrees(PRESSURE_ANGLE):.0f} degrees"
            )
        yield (
            f"gears.{name}: acts by moments on {gear.first} and {gear.second}; their pins carry no tooth force"
            + (f" ({'; '.join(known)})" if known else "")
        )


def guide_warnings(motion: BodyMotion) -> Iterator[str]:
    """Warnings on guided points that pass an end of their lines in a motion, and on slots without ends."""
    for name, slide in motion.linkage.slides.items():
        if slide.turns and slide.ends is None:
            said = _range_along(motion, slide)
            yield f"guides.{name}: {said}; its ends are not known; allowed: along = [point, point]"
        beyond = 1e3 * motion.past_ends(slide).max(initial=0.0)
        if beyond > 0.0:
            what = "a run is refused there" if slide.turns else "nothing stops it there"
            yield (
                f"guides.{name}: {slide.body} goes {beyond:.4g} mm beyond an end of its line, which is "
                f"{1e3 * slide.length:.4g} mm long; {what}"
            )


def _range_along(motion: BodyMotion, slide: Slide) -> str:
    """The range of a guided point along its line, from where it starts."""
    along = np.round(1e3 * motion.along(slide), 6) + 0.0
    return f"{slide.body} moves from {along.min():.4g} to {along.max():.4g} mm along its line"


def of_joints(linkage: Linkage, moved: Sequence[Moved]) -> tuple[list[str], list[str]]:
    """Facts on cranks and guides, and all warnings on joints, of postures with their static forces."""
    facts = [f'{k}: turns {one.body} against the ground (on = "ground")' for k, one in linkage.cranks.items()]
    if not moved:
        return facts, list(joint_warnings(linkage))
    position = np.array([one.position for one in moved])
    motion = BodyMotion(linkage, position, np.zeros_like(position))
    facts += [f"guides.{name}: {_range_along(motion, slide)}" for name, slide in linkage.slides.items()]
    moments = {name: max(abs(one.forces.gears[name]) for one in moved) for name in linkage.gears}
    return facts, [*joint_warnings(linkage, moments), *guide_warnings(motion)]
