# ruff: noqa: N803 - the engine goes by the names of arguments
"""A contact's force as an expression that the engine evaluates by itself.

The laws are called once, with `Symbol`s in place of numbers; what comes back is the expression of the same
formulas. What changes from step to step (the impact, the state of friction) stands in named variables of the
expression, which Python sets before a step is tried.
"""

from __future__ import annotations

import itertools
import operator
from collections.abc import Callable, Iterable
from typing import Any, cast

import exudyn
from exudyn.advancedUtilities import CreateSymbolicUserFunction

from support_exudyn.formulations.redundant.clearance.connector import user_function
from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    Relative,
    displacement_scale,
    in_slot,
    line_force,
    rough_force,
    slot_directions,
    straightened,
)
from support_exudyn.mechanics.contact_state import PinMemory
from user_forces.contact import Contact, SlipHistory
from user_forces.expressions.scalar import Expression, where

engine: Any = getattr(exudyn, "symbolic")  # noqa: B009 - its stubs lack the module
APART = 1e300  # [m], deeper than any pin
_numbers = itertools.count()  # names of variables differ between all pins of all scenes of a process


def _both_ways(operation: Callable[[Any, Any], Any]) -> tuple[Any, Any]:
    """An operator of a symbol with another or a number, and the same the other way round."""
    return (
        lambda this, other: Symbol(operation(this.real, real(other))),
        lambda this, other: Symbol(operation(real(other), this.real)),
    )


class Symbol(Expression):
    """An expression of the engine."""

    __slots__ = ("real",)

    def __init__(self, real: Any) -> None:
        self.real = real

    def function(self, name: str) -> Symbol:
        """sqrt, exp, log, tanh, cos, sin, abs or sign of it."""
        return Symbol(getattr(engine, name)(self.real))

    def hypotenuse(self, other: Expression | float) -> Symbol:
        """Square root of the sum of both squares."""
        return Symbol(engine.Vector([self.real, real(other)]).NormL2())

    def choose(self, yes: Expression | float, no: Expression | float) -> Symbol:
        """`yes` where this condition holds, else `no`."""
        return Symbol(engine.IfThenElse(self.real, real(yes), real(no)))

    def larger(self, other: Expression | float) -> Symbol:
        """The larger of both."""
        return Symbol(engine.max(self.real, real(other)))

    def smaller(self, other: Expression | float) -> Symbol:
        """The smaller of both."""
        return Symbol(engine.min(self.real, real(other)))

    def __pow__(self, exponent: float) -> Symbol:
        return Symbol(engine.pow(self.real, engine.Real(exponent)))

    def __neg__(self) -> Symbol:
        return Symbol(-self.real)

    __add__, __radd__ = _both_ways(operator.add)
    __sub__, __rsub__ = _both_ways(operator.sub)
    __mul__, __rmul__ = _both_ways(operator.mul)
    __truediv__, __rtruediv__ = _both_ways(operator.truediv)
    __lt__, __gt__ = _both_ways(operator.lt)[0], _both_ways(operator.gt)[0]
    __le__, __ge__ = _both_ways(operator.le)[0], _both_ways(operator.ge)[0]


def real(item: Any) -> Any:
    """The engine's own expression of a symbol or a number."""
    return item.real if isinstance(item, Symbol) else engine.Real(float(item))


def unknown(real: Any) -> float:
    """A symbol where a number is expected."""
    return cast(float, Symbol(real))


def is_formula(function: Callable[..., Any], count: int) -> bool:
    """Whether a function of so many numbers takes expressions, see `scalar.Expression`."""
    try:
        function(*(unknown(engine.Real(0.0)) for _ in range(count)))
    except TypeError:
        return False
    return True


class SymbolicForce:
    """Force and moment of one clearance pin as a symbolic user function of the engine.

    Arguments:
        mbs: the engine's system.
        contact: bearing and laws.
        at: what the force acts on.
        straight: whether friction follows a line, see `friction_line`, that is laid by `lay`.
    """

    calls = 0  # in Python

    def __init__(self, mbs: Any, contact: Contact, at: Attachment, straight: bool = False) -> None:
        number = next(_numbers)

        def variable(name: str, value: float = 0.0) -> Any:
            return engine.Real(f"pin{number}_{name}", value)

        self._surface = variable("surface", APART)  # depth beyond which there is a force [m]
        self._speed_of_impact = variable("speed")
        self._history = [variable("deflection"), variable("slip"), variable("step")]
        self._bore_spin = variable("bore_spin")
        self._scale = variable("scale", 1.0)
        self._line = [variable("offset"), variable("slope")]
        self._contact = straightened(contact, *map(unknown, self._line)) if straight else contact
        self._at = at
        self._loaded: tuple[object, ...] = ()
        item, self.name = user_function(at)
        # kept alive here: the engine's function refers to it
        self.function = CreateSymbolicUserFunction(mbs, self.expression(), self.name, itemTypeName=item)

    def load(self, memory: PinMemory, step: float, bore_spin: float, turn: float) -> None:
        """Set what the force depends on besides the motion.

        Arguments:
            memory: of the pin, at the start of the step.
            step: its length [s].
            bore_spin: expected at its end [rad/s].
            turn: between the marker frames, expected at its end [rad].
        """
        impact = memory.in_contact, memory.impact_velocity  # seldom changes, and setting takes time
        if impact != self._loaded:
            self._loaded = impact
            self._surface.SetValue(0.0 if memory.in_contact else APART)
            self._speed_of_impact.SetValue(memory.impact_velocity)
        if self._contact.friction.has_state:
            _set(self._history, (memory.deflection, memory.slip, step))
        if self._at is Attachment.MIDDLE:
            self._scale.SetValue(displacement_scale(turn))
            self._bore_spin.SetValue(bore_spin)

    def lay(self, offset: float, slope: float) -> None:
        """Set the line that friction follows."""
        _set(self._line, (offset, slope))

    def expression(self) -> Callable[..., Any]:
        """A function of the engine's signature, to be called once with the engine's symbols.

        The engine goes by the names and the number of its arguments. It evaluates an expression as often as it
        stands in others; products with a vector keep that rare.
        """
        if self._at is Attachment.LINE:
            return lambda mbs, t, itemNumber, deltaL, deltaL_t, stiffness, damping, force: self._line_force(
                deltaL, deltaL_t
            )
        is_slot = self._contact.bearing.is_slot

        def rigid(  # type: ignore[no-untyped-def]
            mbs,
            t,
            itemNumber,
            displacement,
            rotation,
            velocity,
            angularVelocity,
            stiffness,
            damping,
            rotJ0,
            rotJ1,
            offset,
        ):
            if is_slot:
                return self._in_slot(displacement, rotation, velocity, angularVelocity)
            return self._rigid(displacement, velocity, angularVelocity)

        return rigid

    def _line_force(self, depth: Any, rate: Any) -> Any:
        """The force from depth and rate alone."""
        push = line_force(self._contact, unknown(depth), unknown(rate), self._speed)
        return real(self._if_pressed(Symbol(depth), push))

    def _rigid(self, displacement: Any, velocity: Any, angular_velocity: Any) -> Any:
        """Force and moment of the rigid-body connector."""
        x, y = unknown(displacement[0]), unknown(displacement[1])
        if self._at is Attachment.MIDDLE:
            x, y = unknown(self._scale) * x, unknown(self._scale) * y
        vx, vy = unknown(velocity[0]), unknown(velocity[1])
        motion = Relative(x, y, vx, vy, unknown(angular_velocity[2]), unknown(self._bore_spin))
        history = SlipHistory(*(unknown(variable) for variable in self._history))
        found, arm = rough_force(self._contact, self._at, motion, self._speed, history)
        _, nx, ny = self._contact.bearing.outwards(x, y)
        along = engine.Vector([real(nx), real(ny), *_zeros(4)])
        across = engine.Vector([real(ny), real(-nx), *_zeros(3), real(-arm)])
        normal = self._if_pressed(found.depth, found.normal_force)
        friction = self._if_pressed(found.depth, found.friction_force)
        return along * real(normal) + across * real(friction)

    def _in_slot(self, displacement: Any, rotation: Any, velocity: Any, angular_velocity: Any) -> Any:
        """Force and moment of the rigid-body connector at a corner in its slot."""
        turn = unknown(rotation[2])
        scale = displacement_scale(turn) if self._at is Attachment.MIDDLE else 1.0
        x, y = (scale * unknown(displacement[n]) for n in (0, 1))
        vx, vy = (unknown(velocity[n]) for n in (0, 1))
        motion = Relative(x, y, vx, vy, unknown(angular_velocity[2]), unknown(self._bore_spin))
        along, moving = in_slot(self._at, motion, 0.5 * turn)
        history = SlipHistory(*(unknown(variable) for variable in self._history))
        found, arm = rough_force(self._contact, self._at, moving, self._speed, history)
        forces = found.normal_force, found.friction_force
        side = self._contact.bearing.outwards(0.0, moving.y)[2]
        directions = slot_directions(self._at, along, side, arm, 0.5 * turn)
        pushed, rubbed = (
            engine.Vector([real(fx), real(fy), *_zeros(3), real(moment)])
            * real(self._if_pressed(found.depth, one))
            for one, (fx, fy, moment) in zip(forces, directions, strict=True)
        )
        return pushed + rubbed

    def _if_pressed(self, depth: Any, force: float) -> Any:
        """A force where the depth is beyond the surface, else 0."""
        return where(cast(Any, depth > unknown(self._surface)), force, 0.0)

    @property
    def _speed(self) -> float:
        return unknown(self._speed_of_impact)


def _set(variables: Iterable[Any], values: Iterable[object]) -> None:
    for variable, value in zip(variables, values, strict=True):
        variable.SetValue(value)


def _zeros(count: int) -> list[Any]:
    return [engine.Real(0.0)] * count
