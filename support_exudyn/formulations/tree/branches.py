"""Who carries whom: bodies that hang on the ground by ideal pins.

          ground
         /      \
    link 0      link 2
      |
    link 1

Coordinate of a link: its turn against the one that carries it [rad], 0 at the start.
"""

from collections.abc import Container
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from support_exudyn.model.linkage import GROUND, Body, Linkage
from user_forces.values.value import Vector2

Matrix = npt.NDArray[np.float64]
Numbers = npt.NDArray[np.intp]


class LoopError(ValueError):
    """An ideal pin that joins two bodies which other ideal pins join already; its name."""


class ClearanceError(ValueError):
    """A body that no chain of ideal pins joins to the ground; its name."""


@dataclass(frozen=True)
class Link:
    """A body of a tree: its name, that of its pin to the one that carries it, where that is, and who that is.

    joint: centre of the pin in the start posture [m]. carrier: number of the link, -1: the ground.
    """

    name: str
    body: Body
    pin: str
    joint: Vector2
    carrier: int


@dataclass(frozen=True)
class Tree:
    """All links of a linkage, each after the one that carries it."""

    linkage: Linkage
    links: tuple[Link, ...]

    def number(self, body: str) -> int:
        """Number of a body's link; -1 for the ground."""
        return -1 if body == GROUND else [link.name for link in self.links].index(body)

    def movers(self, body: str) -> list[int]:
        """Numbers of the coordinates that move a body."""
        number = self.number(body)
        return [] if number < 0 else np.flatnonzero(self.carried[number]).tolist()

    def arm(self, link: int, point: Vector2) -> Vector2:
        """A point of the start posture from a link's joint [m]; from the origin for the ground."""
        joint = (0.0, 0.0) if link < 0 else self.links[link].joint
        return point[0] - joint[0], point[1] - joint[1]

    @cached_property
    def carried(self) -> Matrix:
        """1 where the coordinate of the column moves the link of the row, shape (n, n); else 0."""
        table = np.eye(len(self.links))
        for n, link in enumerate(self.links):
            if link.carrier >= 0:
                table[n] += table[link.carrier]
        return table

    @cached_property
    def order(self) -> list[int]:
        """Numbers of the links in the order of the linkage's bodies."""
        return [self.number(name) for name in self.linkage.bodies]

    @cached_property
    def order_of_links(self) -> list[int]:
        """Numbers of the linkage's bodies in the order of the links."""
        return [list(self.linkage.bodies).index(link.name) for link in self.links]


def branches(linkage: Linkage, with_clearance: Container[str]) -> Tree:
    """The tree of all bodies by the pins without clearance. Raises LoopError or LooseError if it is none."""
    links: list[Link] = []
    numbers = {GROUND: -1}
    waiting = {name: pin for name, pin in linkage.pins.items() if name not in with_clearance}
    while waiting:
        reached = [n for n, pin in waiting.items() if pin.first in numbers or pin.second in numbers]
        if not reached:
            break
        name = reached[0]
        pin = waiting.pop(name)
        if pin.first in numbers and pin.second in numbers:
            raise LoopError(name)
        carrier, body = (pin.first, pin.second) if pin.first in numbers else (pin.second, pin.first)
        numbers[body] = len(links)
        joint = pin.first_point if body == pin.second else pin.second_point
        links.append(Link(body, linkage.bodies[body], name, joint, numbers[carrier]))
    for body in linkage.bodies:
        if body not in numbers:
            raise ClearanceError(body)
    return Tree(linkage, tuple(links))
