"""Transmission angles: how well a coupler drives the link behind it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.machines.check.drive_way import DriveWay
from support_exudyn.mechanics.closing import Conditions, moved_on
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import PinPlace
from user_forces.values.value import Vector2

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
            behind = _driver_pin(way, coupler, name)
            angle = behind and _angle_at(conditions, way, (behind, name), coupler, output)
            if not angle:
                continue
            angles = [angle(one.position) for one in way.moved]
            least, largest = (
                _extreme(conditions, way, int(np.argmax(np.multiply(sign, angles))), angle, sign)
                for sign in (-1.0, 1.0)
            )
            yield TransmissionAngle(name, coupler, output, angles, least, largest)


def _driver_pin(way: DriveWay, coupler: str, ahead: str) -> str | None:
    """The pin by which a coupler is moved, by a body that is joined to what rests; None if there is no such."""
    pins, slides = way.linkage.pins.items(), way.linkage.slides.values()
    for name, pin in pins:
        other = _other(pin, coupler)
        if name != ahead and other and way.reach.get(other, -3) == way.reach[coupler] - 1:
            frame = [_other(one, other) for _, one in pins] + [
                one.against for one in slides if one.body == other
            ]
            if any(one in way.resting for one in frame):
                return name
    return None


def _angle_at(
    conditions: Conditions, way: DriveWay, pins: tuple[str, str], coupler: str, output: str
) -> Callable[[Matrix], float] | None:
    """The angle [rad] in a posture at an output that is pinned to what rests, or slides on it; else None."""
    linkage, kinetics = way.linkage, conditions.kinetics
    foot, top = (_point(linkage.pins[name], coupler) for name in pins)

    def line(position: Matrix, body: str, first: Vector2, second: Vector2) -> Matrix:
        span: Matrix = kinetics.point(position, body, second)[0] - kinetics.point(position, body, first)[0]
        return span

    start = _point(linkage.pins[pins[1]], output)
    for pin in linkage.pins.values():
        if _other(pin, output) in way.resting and _point(pin, output) != start:
            end = _point(pin, output)
            return lambda at: _between(line(at, coupler, top, foot), line(at, output, start, end))
    for slide in linkage.slides.values():
        if slide.body == output and slide.against in way.resting:
            normal = np.array([-math.sin(slide.direction), math.cos(slide.direction)])

            def to_normal(position: Matrix, normal: Matrix = normal) -> float:
                angle = _between(line(position, coupler, top, foot), normal)
                return min(angle, math.pi - angle)

            return to_normal
    return None


def _extreme(
    conditions: Conditions, way: DriveWay, number: int, angle: Callable[[Matrix], float], sign: float
) -> tuple[float, float]:
    """Travel and value of an extreme that lies about a posture; sign: 1 of the largest, -1 of the least."""
    from scipy.optimize import minimize_scalar  # slow to import

    near = way.moved[number]
    value = angle(near.position)
    between = [one.travel for one in way.moved[max(number - 1, 0) : number + 2]]
    if len(between) < 2:
        return near.travel, value

    def at(travel: float) -> float:
        other = number + 1 if travel > near.travel else number - 1
        along = (way.moved[other].position - near.position) * conditions.arms
        start, travels = near.position * conditions.arms, dict.fromkeys(way.drives, travel)
        moved = moved_on(conditions, start, travels, along)[0]
        return angle(moved / conditions.arms)

    found = minimize_scalar(
        lambda travel: -sign * at(travel), bounds=(between[0], between[-1]), method="bounded",
        options={"xatol": 1e-9 * max(map(abs, between))},
    )  # fmt: skip
    better = float(-sign * found.fun)
    return (float(found.x), better) if sign * (better - value) > NOTHING else (near.travel, value)


def _other(pin: PinPlace, body: str) -> str:
    """The other body of a pin; empty if it does not hold this one."""
    return {pin.first: pin.second, pin.second: pin.first}.get(body, "")


def _point(pin: PinPlace, body: str) -> Vector2:
    return pin.first_point if pin.first == body else pin.second_point


def _between(one: Matrix, other: Matrix) -> float:
    """Angle between two lines [rad], 0 to pi."""
    return float(abs(math.atan2(one[0] * other[1] - one[1] * other[0], float(one @ other))))
