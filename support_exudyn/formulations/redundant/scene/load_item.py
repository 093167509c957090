# ruff: noqa: N803 - the engine goes by the names of arguments
"""Loads in the engine: a connector between the loaded point and what it is loaded from."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
from exudyn.advancedUtilities import CreateSymbolicUserFunction
from exudyn.itemInterface import ObjectConnectorCartesianSpringDamper

from support_exudyn.formulations.redundant.clearance.symbolic_force import engine, is_formula, real, unknown
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.trajectory import LoadSeries, Series
from support_exudyn.model.loads.load import Load, LoadedPoint, Powers
from user_forces.lawful import ROUNDING, LawError

HANGS_BY = 0.01  # [m] that the spring would give under what hangs, if it were to carry it
NAME = "springForceUserFunction"  # the engine's, of its Cartesian spring


@dataclass(frozen=True)
class LoadItem:
    """A load in the engine: its data, its connector, and the force, which must live as long as it."""

    mbs: Any
    load: Load
    object: Any
    function: Any

    def powers(self, t: float) -> Powers:
        """Powers [W] at the end of a step, t [s]."""
        return self.load.powers(self._at(t))

    def probe(self, t: float, name: str) -> None:
        """Raise LawError if the load has no finite force at a time t [s] where the point is now."""
        along, up = self.load.force(self._at(t))
        if not math.isfinite(along + up):
            raise LawError(f"{name}: {type(self.load).__name__} has a force of {along:g}, {up:g} N")

    def look(self, t: float, name: str) -> None:
        """Raise LawError if the load gives at t [s] what it should lose, but for rounding, or no number."""
        at = self._at(t)
        work, loss = self.load.powers(at)
        size = abs(work) + math.hypot(*self.load.force(at)) * math.hypot(at.vx, at.vy)
        if not loss >= -ROUNDING * size:
            raise LawError(f"{name}: {type(self.load).__name__} loses {loss:.6g} W; allowed: >= 0")

    def longest_step(self, t: float, number: int) -> float:
        """How long the step from t [s] on may be [s], with so many in an impact."""
        return self.load.longest_step(self._at(t), number)

    @contextmanager
    def hung(self, weight: Any) -> Iterator[None]:
        """What the load brings along hangs, without its weight, over its point for as long as this lasts.

        weight: of it, a load of the engine. A spring that nothing stretches keeps it there.
        """
        pull = self.mbs.GetLoadParameter(weight, "loadVector")
        stiffness = float(np.linalg.norm(pull)) / HANGS_BY
        self.mbs.SetLoadParameter(weight, "loadVector", [0.0, 0.0, 0.0])
        self.mbs.SetObjectParameter(self.object, NAME, 0)
        self.mbs.SetObjectParameter(self.object, "stiffness", [0.0, stiffness, 0.0])
        try:
            yield
        finally:
            self.mbs.SetObjectParameter(self.object, "stiffness", [0.0, 0.0, 0.0])
            self.mbs.SetObjectParameter(self.object, NAME, self.function)
            self.mbs.SetLoadParameter(weight, "loadVector", pull)

    def _at(self, t: float) -> LoadedPoint:
        """The loaded point at the end of a step, t [s]."""
        output = exudyn.OutputVariableType
        x, y, _ = self.mbs.GetObjectOutput(self.object, output.Displacement)
        vx, vy, _ = self.mbs.GetObjectOutput(self.object, output.Velocity)
        return LoadedPoint(t, float(x), float(y), float(vx), float(vy))


def add_load(mbs: Any, load: Load, origin: Any, point: Any) -> LoadItem:
    """Let a load act between a marker on what it acts against and one on the body, both at the loaded point.

    It is a connector and no load of the engine's, for those have no Jacobian, without which Newton's method
    does not get along with a stiff one.
    """
    connector = mbs.AddObject(ObjectConnectorCartesianSpringDamper(markerNumbers=[origin, point]))
    function: Any = _pull(load)
    if is_formula(lambda *known: load.force(LoadedPoint(*known)), len(LoadedPoint._fields)):
        function = CreateSymbolicUserFunction(mbs, _expression(load), NAME, connector)
    mbs.SetObjectParameter(connector, NAME, function)
    return LoadItem(mbs, load, connector, function)


def _pull(load: Load) -> Callable[..., list[float]]:
    """The force with which the connector pulls its ends together, of the engine's signature, in Python."""

    def pull(mbs: Any, t: float, item: int, displacement: Any, velocity: Any, *others: Any) -> list[float]:
        x, y, _ = displacement
        vx, vy, _ = velocity
        fx, fy = load.force(LoadedPoint(t, x, y, vx, vy))
        return [-fx, -fy, 0.0]

    return pull


def _expression(load: Load) -> Callable[..., Any]:
    """The pull as a function that the engine calls once with its symbols; it goes by the names of arguments."""

    def pull(t: Any, displacement: Any, velocity: Any) -> Any:
        known = (t, displacement[0], displacement[1], velocity[0], velocity[1])
        fx, fy = load.force(LoadedPoint(*map(unknown, known)))
        return engine.Vector([real(-fx), real(-fy), engine.Real(0.0)])

    return lambda mbs, t, itemNumber, displacement, velocity, stiffness, damping, offset: pull(
        t, displacement, velocity
    )


def load_series(name: str, load: Load, motion: BodyMotion, time: Series) -> LoadSeries:
    """The load of this name at the records [s]."""
    point, origin = (motion.point(body, load.point) for body in (load.body, load.against(name)))
    way, velocity = point.position - origin.position, point.velocity - origin.velocity
    found = [
        LoadedPoint(*row) for row in zip(time.tolist(), *way.T.tolist(), *velocity.T.tolist(), strict=True)
    ]
    observed = [load.observed(at) for at in found]
    return LoadSeries(
        np.array([load.force(at) for at in found]).reshape(-1, 2),
        np.array([load.stored(at) for at in found]),
        {name: np.array([values[name] for values in observed]) for name in load.channels},
    )
