"""A reader of ADAMS datasets of the tests' own, and the planar equations of motion that a dataset states."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

HEAD = re.compile(r"([A-Z]+)/(\d*)$")
FUNCTIONS = ("FUNCTION", "FX", "FY", "FZ", "TX", "TY", "TZ", *(f"F{n}" for n in range(1, 9)))


@dataclass
class Statement:
    """A statement: its arguments by name; those without a value have an empty one."""

    kind: str
    number: int
    arguments: dict[str, str] = field(default_factory=dict)

    def id(self, name: str) -> int:
        return int(self.arguments[name])

    def numbers(self, name: str) -> list[float]:
        return [float(one) for one in self.arguments[name].split(",")]

    def words(self, name: str) -> list[str]:
        return [one.strip().strip('"') for one in self.arguments[name].split(",")]


class Dataset(dict[tuple[str, int], Statement]):
    """The statements of a dataset by kind and number; named: by the names in the comments before them."""

    def __init__(self) -> None:
        super().__init__()
        self.named: dict[str, Statement] = {}

    def of(self, kind: str) -> dict[int, Statement]:
        return {number: one for (name, number), one in self.items() if name == kind}


def read_dataset(text: str) -> Dataset:
    """The statements of a text; what is none of the forms that the manuals show is refused."""
    title, *lines = text.splitlines()
    assert "/" not in title.partition(":")[0].replace("ADAMS/View", "")
    assert lines[-1] == "END"
    found, now, name = Dataset(), Statement("", 0), ""
    for line in lines[:-1]:
        assert len(line) < 80 or line.startswith("!")
        assert line.isascii()
        if line.startswith("!"):
            name = line.partition("adams_view_name='")[2].rstrip("'")
            continue
        if head := HEAD.match(line):
            now = Statement(head[1], int(head[2] or 0))
            assert (now.kind, now.number) not in found
            found[now.kind, now.number] = now
            if now.number:
                assert name not in found.named
                found.named[name] = now
            continue
        assert line.startswith(", ")
        _argument(now, line[2:])
    for one in found.values():
        functions = [name for name in one.arguments if name in FUNCTIONS]
        ends = [one.arguments[name].endswith("\\") for name in functions]
        assert ends == [True] * (len(ends) - 1) + [False] * bool(ends), one
        if functions:
            assert list(one.arguments)[-1] == functions[-1]
    return found


def _argument(now: Statement, text: str) -> None:
    name, equals, value = (part.strip() for part in text.partition("="))
    if equals and name.isidentifier():
        now.arguments[name] = value
    elif now.arguments and list(now.arguments.values())[-1].endswith(","):  # a list goes on
        last = list(now.arguments)[-1]
        now.arguments[last] += " " + text
    else:
        now.arguments[text] = ""


def _if(test: float, less: float, equal: float, more: float) -> float:
    return less if test < 0.0 else equal if test == 0.0 else more


def _step(x: float, x0: float, h0: float, x1: float, h1: float) -> float:
    share = min(1.0, max(0.0, (x - x0) / (x1 - x0)))
    return h0 + (h1 - h0) * share * share * (3.0 - 2.0 * share)


PLAIN: Mapping[str, Any] = {
    "IF": _if, "STEP": _step, "MAX": max, "MIN": min, "ABS": abs, "SQRT": math.sqrt,
    "SIGN": lambda a, b: math.copysign(abs(a), 1.0 if b >= 0.0 else -1.0), "__builtins__": {},
}  # fmt: skip


def evaluated(expression: str, names: Mapping[str, Any]) -> float:
    """The value of a function expression. Its operators and their order are those of Python."""
    return float(eval(expression.rstrip("\\").replace(":", ","), {**PLAIN, **names}))


@dataclass
class Motion:
    """Where parts are and how they move: x, y, turn of each by number, and rates; and remembered speeds."""

    position: Mapping[int, np.ndarray]
    velocity: Mapping[int, np.ndarray]
    time: float = 0.0
    remembered: Mapping[int, float] = field(default_factory=dict)


class PlanarModel:
    """The equations of motion that a dataset states, in its plane."""

    def __init__(self, data: Dataset) -> None:
        self.data = data
        self.parts = [number for number, one in data.of("PART").items() if "GROUND" not in one.arguments]
        self.place = {part: 3 * n for n, part in enumerate(self.parts)}
        self.markers = data.of("MARKER")

    def start(self) -> Motion:
        """The start, at rest."""
        still = {part: np.zeros(3) for part in self._all()}
        at = {part: np.zeros(3) for part in self._all()}
        for part in self.parts:
            at[part] = np.array([*self.data["PART", part].numbers("QG")[:2], 0.0])
        return Motion(at, still)

    def _all(self) -> list[int]:
        return list(self.data.of("PART"))

    def part_of(self, marker: int) -> int:
        return self.markers[marker].id("PART")

    def arm(self, marker: int, motion: Motion) -> np.ndarray:
        x, y, z = self.markers[marker].numbers("QP")
        assert z == 0.0
        turn = motion.position[self.part_of(marker)][2]
        c, s = math.cos(turn), math.sin(turn)
        return np.array([c * x - s * y, s * x + c * y])

    def at(self, marker: int, motion: Motion) -> np.ndarray:
        return motion.position[self.part_of(marker)][:2] + self.arm(marker, motion)

    def speed(self, marker: int, motion: Motion) -> np.ndarray:
        vx, vy, spin = motion.velocity[self.part_of(marker)]
        x, y = self.arm(marker, motion)
        return np.array([vx - spin * y, vy + spin * x])

    def along(self, marker: int, motion: Motion) -> np.ndarray:
        """Direction of the marker's z axis, which lies in the plane."""
        psi, theta, phi = self.markers[marker].numbers("REULER")
        assert abs(theta - 0.5 * math.pi) < 1e-15
        assert phi == 0.0
        angle = psi - 0.5 * math.pi + motion.position[self.part_of(marker)][2]
        return np.array([math.cos(angle), math.sin(angle)])

    def names(self, motion: Motion, more: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """What function expressions know of a motion."""

        def apart(n: int, of: Callable[[int, Motion], np.ndarray]) -> Callable[..., float]:
            def component(i: int, j: int, axes: int) -> float:
                assert self.part_of(axes) == 1
                return float((of(i, motion) - of(j, motion))[n])

            return component

        def variable(number: int) -> float:
            if number not in known:
                known[number] = evaluated(self.data["VARIABLE", number].arguments["FUNCTION"], names)
            return known[number]

        known: dict[int, float] = {}
        names: dict[str, Any] = {
            "TIME": motion.time,
            "DX": apart(0, self.at),
            "DY": apart(1, self.at),
            "VX": apart(0, self.speed),
            "VY": apart(1, self.speed),
            "DM": lambda i, j: float(np.hypot(*(self.at(i, motion) - self.at(j, motion)))),
            "WZ": lambda i: float(motion.velocity[self.part_of(i)][2]),
            "AZ": lambda i, j: float(motion.position[self.part_of(i)][2] - motion.position[self.part_of(j)][2]),
            "VARVAL": variable,
            "DIF": lambda i: motion.remembered[i],
            **(more or {}),
        }
        return names

    def forces(self, motion: Motion) -> np.ndarray:
        """Weight and general forces on all coordinates."""
        found, names = np.zeros(3 * len(self.parts)), self.names(motion)
        weight = self.data["ACCGRAV", 0].arguments
        for part in self.parts:
            mass = float(self.data["PART", part].arguments["MASS"])
            for n, name in enumerate(("IGRAV", "JGRAV")):
                found[self.place[part] + n] += mass * float(weight[name])
        for force in self.data.of("GFORCE").values():
            fx, fy, moment = (evaluated(force.arguments[name], names) for name in ("FX", "FY", "TZ"))
            here = self.at(force.id("I"), motion)
            for marker, sign in ((force.id("I"), 1.0), (force.id("JFLOAT"), -1.0)):
                part = self.part_of(marker)
                if part in self.place:
                    x, y = here - motion.position[part][:2]  # the floating marker is where I is
                    push = sign * np.array([fx, fy, moment + x * fy - y * fx])
                    found[self.place[part] : self.place[part] + 3] += push
        return found

    def constraints(self, motion: Motion) -> tuple[np.ndarray, np.ndarray, dict[tuple[str, int], int]]:
        """Rows, what they give with the accelerations, and the first row of each joint and motion."""
        rows: list[np.ndarray] = []
        right: list[float] = []
        first: dict[tuple[str, int], int] = {}
        joints = [*self.data.of("JOINT").values(), *self.data.of("JPRIM").values()]
        for joint in joints:
            first[joint.kind, joint.number] = len(rows)
            i, j = joint.id("I"), joint.id("J")
            if {"REVOLUTE", "INLINE"} & joint.arguments.keys():
                for n in (0, 1):
                    self._across(np.eye(2)[n], np.zeros(2), i, j, motion, rows, right)
            elif "TRANSLATIONAL" in joint.arguments:
                x, y = self.along(j, motion)
                self._turning(i, j, rows, right)
                self._across(np.array([-y, x]), np.array([-x, -y]), i, j, motion, rows, right)
            else:
                assert "PLANAR" in joint.arguments
        for number, moved in self.data.of("MOTION").items():
            first["MOTION", number] = len(rows)
            joint = self.data["JOINT", moved.id("JOINT")]
            i, j = joint.id("I"), joint.id("J")
            x, y = self.along(j, motion)
            self._across(np.array([x, y]), np.array([-y, x]), i, j, motion, rows, right)
            right[-1] += self._second(moved.arguments["FUNCTION"], motion.time)
        return np.array(rows), np.array(right), first

    @staticmethod
    def _second(function: str, t: float) -> float:
        """The second derivative of a motion, which is a cubic between its breaks."""
        h = 1e-3
        values = [evaluated(function, {"TIME": t + n * h}) for n in (-1, 0, 1)]
        return (values[0] - 2.0 * values[1] + values[2]) / h**2

    def _turning(self, i: int, j: int, rows: list[np.ndarray], right: list[float]) -> None:
        row = np.zeros(3 * len(self.parts))
        for marker, sign in ((i, 1.0), (j, -1.0)):
            if self.part_of(marker) in self.place:
                row[self.place[self.part_of(marker)] + 2] += sign
        rows.append(row)
        right.append(0.0)

    def _across(
        self,
        u: np.ndarray,
        du: np.ndarray,
        i: int,
        j: int,
        motion: Motion,
        rows: list[np.ndarray],
        right: list[float],
    ) -> None:
        """The row of u . (P_i - P_j), with u turning with the part of j by du per radian, or not at all."""
        row, rest = np.zeros(3 * len(self.parts)), 0.0
        for marker, sign in ((i, 1.0), (j, -1.0)):
            part, arm = self.part_of(marker), self.arm(marker, motion)
            if part in self.place:
                at = self.place[part]
                row[at : at + 3] += sign * np.array([*u, u[1] * arm[0] - u[0] * arm[1]])
                rest += sign * motion.velocity[part][2] ** 2 * (u @ arm)
        turning = self.part_of(j)
        if turning in self.place and du.any():
            apart = self.at(i, motion) - self.at(j, motion)
            spin = motion.velocity[turning][2]
            row[self.place[turning] + 2] += du @ apart
            rest += spin**2 * (u @ apart) - 2.0 * spin * (du @ (self.speed(i, motion) - self.speed(j, motion)))
        rows.append(row)
        right.append(rest)

    def solved(self, motion: Motion) -> tuple[dict[int, np.ndarray], dict[str, Any]]:
        """Accelerations of all parts, and what the functions JOINT, JPRIM and MOTION give."""
        rows, right, first = self.constraints(motion)
        mass = np.concatenate(
            [
                [float(one.arguments["MASS"])] * 2 + [one.numbers("IP")[2]]
                for one in (self.data["PART", part] for part in self.parts)
            ]
        )
        size, count = mass.size, len(rows)
        system = np.zeros((size + count, size + count))
        system[:size, :size] = np.diag(mass)
        system[:size, size:], system[size:, :size] = -rows.T, rows
        solution = np.linalg.solve(system, np.concatenate([self.forces(motion), right]))
        reaction = solution[size:]

        def of(kind: str) -> Callable[[int, int, int, int], float]:
            def component(number: int, flag: int, part: int, axes: int) -> float:
                assert flag == 0
                if kind == "MOTION":  # along z of a marker that lies along the motion
                    assert part == 4
                    assert axes == self.data["JOINT", self.data[kind, number].id("JOINT")].id("I")
                    return float(reaction[first[kind, number]])
                assert axes == 0
                return float(reaction[first[kind, number] + {2: 0, 3: 1}[part]])

            return component

        found = {part: solution[at : at + 3] for part, at in self.place.items()}
        return found, {kind: of(kind) for kind in ("JOINT", "JPRIM", "MOTION")}
