"""Transmission angles: how well a coupler drives the link behind it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.machines.check.drive_way import DriveWay
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.closing import Conditions, moved_on
from support_exudyn.mechanics.trajectory import Series

LEAST = math.radians(40.0)  # below it, or above 180 degrees less it, forces are large and play is felt
NOTHING = 1e-12  # [rad]
DEFINITION = (
    "transmission angle: at the pin between a coupler and the link that it drives, from the coupler's line to "
    "the link's; of what slides, from the coupler's line to the guide's normal"
)


@dataclass(frozen=True)
class TransmissionAngle:
    """The transmission angle between a coupler and what it drives, over the way of a drive.

    Arguments:
        pin: between both. coupler, output: names of the bodies.
        angles: by posture of the way [rad], 0 to pi.
        least, largest: travel of the drive from the start on [rad], [m], and angle there [rad].
    """

    pin: str
    coupler: str
    output: str
    angles: Sequence[float]
    least: tuple[float, float]
    largest: tuple[float, float]

    @property
    def worst(self) -> float:
        """The least, counted from the coupler's line either way [rad]."""
        return min(self.least[1], math.pi - self.largest[1])

    def said(self, way: DriveWay) -> str:
        """Least and largest of it, with where they are."""
        least, most = (
            f"{math.degrees(angle):.2f} degrees ({way.at(travel)})"
            for travel, angle in (self.least, self.largest)
        )
        return f"transmission angle at pin {self.pin}, {self.coupler} drives {self.output}: {least} to {most}"

    def data(self) -> dict[str, Any]:
        """Plain data [rad]."""
        return {
            "pin": self.pin,
            "coupler": self.coupler,
            "output": self.output,
            "least_rad": self.least[1],
            "largest_rad": self.largest[1],
        }


def transmission_angles(conditions: Conditions, way: DriveWay) -> Iterator[TransmissionAngle]:
    """Those of all couplers between two links that turn or slide on what rests while this drive moves."""
    for name, pin in way.linkage.pins.items():
        for coupler, output in ((pin.first, pin.second), (pin.second, pin.first)):
            if coupler in way.resting or way.reach.get(output, -1) != way.reach.get(coupler, -3) + 1:
                continue
            angle = _angle_at(way, name, coupler, output)
            if angle:
                angles = angle(way.motion).tolist()
                least, largest = (_extreme(conditions, way, angles, angle, sign) for sign in (-1.0, 1.0))
                yield TransmissionAngle(name, coupler, output, angles, least, largest)


def _angle_at(way: DriveWay, name: str, coupler: str, output: str) -> Callable[[BodyMotion], Series] | None:
    """What gives the angles (n,) [rad] at a pin in the postures of a motion.

    None unless the coupler has a pin on a link that moves it and is joined to what rests, and the output is
    pinned to what rests, or slides on it.
    """
    pins, linkage = {key: dict(pin.sides) for key, pin in way.linkage.pins.items()}, way.linkage
    behind = None
    for key, sides in pins.items():
        link = next((body for body in sides if body != coupler), "") if coupler in sides and key != name else ""
        if behind is None and link and way.reach.get(link, -3) == way.reach[coupler] - 1:
            frame = {body for one in pins.values() if link in one for body in one} - {link}
            frame |= {one.against for one in linkage.slides.values() if one.body == link}
            behind = sides[coupler] if frame & {*way.resting} else None
    if behind is None:
        return None
    foot, top, start = behind, pins[name][coupler], pins[name][output]
    for sides in pins.values():
        if output in sides and sides[output] != start and ({*sides} - {output}) & {*way.resting}:
            end = sides[output]
            return lambda motion: _between(
                motion.place(coupler, foot) - motion.place(coupler, top),
                motion.place(output, end) - motion.place(output, start),
            )
    for slide in linkage.slides.values():
        if slide.body == output and slide.against in way.resting:
            normal = np.array([[-math.sin(slide.direction), math.cos(slide.direction)]])

            def to_normal(motion: BodyMotion, normal: Series = normal) -> Series:
                angles = _between(motion.place(coupler, foot) - motion.place(coupler, top), normal)
                return np.asarray(np.minimum(angles, math.pi - angles))

            return to_normal
    return None


def _between(one: Series, other: Series) -> Series:
    """Angles between lines (n, 2) [rad], 0 to pi."""
    (x, y), (u, v) = one.T, other.T
    return np.asarray(np.abs(np.arctan2(x * v - y * u, x * u + y * v)))


def _extreme(
    conditions: Conditions,
    way: DriveWay,
    angles: Sequence[float],
    angle: Callable[[BodyMotion], Series],
    sign: float,
) -> tuple[float, float]:
    """Travel and value of an extreme over a way; sign: 1 of the largest, -1 of the least."""
    from scipy.optimize import minimize_scalar  # slow to import

    number = int(np.argmax(np.multiply(sign, angles)))
    near, value = way.moved[number], angles[number]
    between = [one.travel for one in way.moved[max(number - 1, 0) : number + 2]]
    if len(between) < 2:
        return near.travel, value

    def at(travel: float) -> float:
        other = number + 1 if travel > near.travel else number - 1
        along = (way.moved[other].position - near.position) * conditions.arms
        start, travels = near.position * conditions.arms, dict.fromkeys(way.drives, travel)
        moved = moved_on(conditions, start, travels, along)[0]
        return float(angle(conditions.kinetics.motion(moved / conditions.arms))[0])

    found = minimize_scalar(
        lambda travel: -sign * at(travel),
        bounds=(between[0], between[-1]),
        method="bounded",
        options={"xatol": 1e-9 * max(map(abs, between))},
    )
    better = float(-sign * found.fun)
    return (float(found.x), better) if sign * (better - value) > NOTHING else (near.travel, value)
