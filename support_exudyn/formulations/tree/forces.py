"""The generalised forces of a tree: what the engine asks for at every stage of a step."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix, Tree
from support_exudyn.formulations.tree.loads import FORCE, WIDTH, evaluate
from support_exudyn.formulations.tree.loose import LoosePin
from support_exudyn.mechanics.oil_column import FilledColumn
from support_exudyn.model.linkage import GROUND
from support_exudyn.scenario.scenario import Scenario
from user_forces.lawful import LawError
from user_forces.normal.law import LoadError
from user_forces.values.value import Vector2


class Forces:
    """Forces of loose pins and columns of oil on the coordinates; gravity is the engine's.

    (Connectors of the engine between markers of a tree do the same, with Python's or symbolic functions, and
    take three times as long: each marker goes through the whole tree again.)

    Arguments:
        tree: the bodies.
        scenario: loose pins.
        columns: of oil.
    """

    def __init__(self, tree: Tree, scenario: Scenario, columns: dict[str, FilledColumn]) -> None:
        loose = scenario.clearance_pins
        ends = [_ends(tree, name, loose[name].bore == "first") for name in loose]
        ends += [
            ((c.column.foot, c.column.foot_point), (c.column.head, c.column.head_point))
            for c in columns.values()
        ]
        self.tree = tree
        self.links = _links(tree)
        self.points = _points(tree, [end for pair in ends for end in pair])
        self.columns = np.array([_column(filled) for filled in columns.values()]).reshape(-1, 4)
        self.cubic: Matrix = np.zeros((len(columns), 5))  # of their drives, see `loads`
        self.work: Matrix = np.zeros((len(self.links) + len(self.points), WIDTH))
        arrays = self.links, self.points, self.work
        self.pins = {
            name: LoosePin(pin, n, *arrays, _angle(tree, ends[n][0][0]))
            for n, (name, pin) in enumerate(loose.items())
        }
        self.touching: list[tuple[str, LoosePin]] = []
        # what a law has raised since this was last set to None
        self.trouble: LoadError | ArithmeticError | None = None
        self.position: list[float] = []  # that were evaluated last: coordinates [rad] and rates [rad/s]
        self.velocity: list[float] = []
        self.evaluations = 0
        self._arrays = self.links, self.points, self.columns, self.cubic, self.work
        self._force = self.work[: len(self.links), FORCE]

    def __call__(
        self, mbs: Any, t: float, item: int, position: list[float], velocity: list[float]
    ) -> list[float]:
        """Generalised forces [N m] at t [s]; the engine's user function."""
        self.position, self.velocity = position, velocity
        self.evaluations += 1
        name = ""
        evaluate(*self._arrays, t, *position, *velocity)
        try:
            for name, pin in self.touching:  # noqa: B007 - is told if one fails
                pin.add_force()
        except (LoadError, ArithmeticError) as error:  # perhaps only because the step is too long
            if self.trouble is None:  # what follows from it are no numbers
                self.trouble = error.at(name) if isinstance(error, LawError) else error
            return [math.nan] * len(position)
        return self._force.tolist()  # type: ignore[no-any-return]

    def moments(self) -> Matrix:
        """Generalised forces so far [N m], shape (n,)."""
        return self._force.copy()

    def watch(self) -> None:
        """Look anew which pins touch."""
        self.touching = [(name, pin) for name, pin in self.pins.items() if pin.memory.in_contact]


def _ends(tree: Tree, name: str, bore_first: bool) -> tuple[tuple[str, Vector2], tuple[str, Vector2]]:
    """Body and centre of the bore, then of the journal."""
    place = tree.linkage.pins[name]
    first, second = (place.first, place.first_point), (place.second, place.second_point)
    return (first, second) if bore_first else (second, first)


def _angle(tree: Tree, body: str) -> float:
    """Angle of a body's axes at the start [rad]."""
    return 0.0 if body == GROUND else tree.linkage.bodies[body].angle


def _links(tree: Tree) -> Matrix:
    rows = [(link.carrier, *tree.arm(link.carrier, link.joint)) for link in tree.links]
    return np.array(rows, dtype=np.float64)


def _points(tree: Tree, ends: list[tuple[str, Vector2]]) -> Matrix:
    rows = [(number := tree.number(body), *tree.arm(number, point)) for body, point in ends]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _column(filled: FilledColumn) -> tuple[float, float, float, float]:
    model = filled.model
    return (
        model.bulk_modulus * model.bore_area,
        model.oil_length,
        model.damping_time,
        filled.natural_length(0.0),
    )
