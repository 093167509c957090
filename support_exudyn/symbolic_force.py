"""A contact's force as an expression that the engine evaluates by itself.

The laws are called once, with `Symbol`s in place of numbers; what comes back is the expression of the same
formulas. What changes from step to step (the touch, the state of friction) stands in named variables of the
expression, which Python sets before a step is tried.
"""

from __future__ import annotations

import itertools
from typing import Any, cast

import exudyn
from exudyn.advancedUtilities import CreateSymbolicUserFunction

from support_exudyn.connector import FORCE, displacement_scale
from support_exudyn.onset import Mobility, PinMemory
from user_forces.contact import SMALLEST, JournalContact, SlipHistory
from user_forces.normal.law import Touch
from user_forces.scalar import Expression, hypot, maximum, where

engine: Any = getattr(exudyn, "symbolic")  # noqa: B009 - its stubs lack the module
_numbers = itertools.count()  # names of variables differ between all pins of all scenes of a process


class Symbol(Expression):
    """An expression of the engine."""

    __slots__ = ("real",)

    def __init__(self, real: Any) -> None:
        self.real = real

    def function(self, name: str) -> Symbol:
        """sqrt, exp, log, tanh, abs or sign of it."""
        return Symbol(getattr(engine, name)(self.real))

    def hypotenuse(self, other: Expression | float) -> Symbol:
        """Square root of the sum of both squares."""
        return Symbol(engine.Vector([self.real, _real(other)]).NormL2())

    def choose(self, yes: Expression | float, no: Expression | float) -> Symbol:
        """`yes` where this condition holds, else `no`."""
        return Symbol(engine.IfThenElse(self.real, _real(yes), _real(no)))

    def larger(self, other: Expression | float) -> Symbol:
        """The larger of both."""
        return Symbol(engine.max(self.real, _real(other)))

    def smaller(self, other: Expression | float) -> Symbol:
        """The smaller of both."""
        return Symbol(engine.min(self.real, _real(other)))

    def __add__(self, other: Any) -> Symbol:
        return Symbol(self.real + _real(other))

    def __radd__(self, other: Any) -> Symbol:
        return Symbol(_real(other) + self.real)

    def __sub__(self, other: Any) -> Symbol:
        return Symbol(self.real - _real(other))

    def __rsub__(self, other: Any) -> Symbol:
        return Symbol(_real(other) - self.real)

    def __mul__(self, other: Any) -> Symbol:
        return Symbol(self.real * _real(other))

    def __rmul__(self, other: Any) -> Symbol:
        return Symbol(_real(other) * self.real)

    def __truediv__(self, other: Any) -> Symbol:
        return Symbol(self.real / _real(other))

    def __rtruediv__(self, other: Any) -> Symbol:
        return Symbol(_real(other) / self.real)

    def __pow__(self, exponent: float) -> Symbol:
        return Symbol(engine.pow(self.real, engine.Real(exponent)))

    def __neg__(self) -> Symbol:
        return Symbol(-self.real)

    def __lt__(self, other: Any) -> Symbol:
        return Symbol(self.real < _real(other))

    def __le__(self, other: Any) -> Symbol:
        return Symbol(self.real <= _real(other))

    def __gt__(self, other: Any) -> Symbol:
        return Symbol(self.real > _real(other))

    def __ge__(self, other: Any) -> Symbol:
        return Symbol(self.real >= _real(other))


def _real(item: Any) -> Any:
    return item.real if isinstance(item, Symbol) else engine.Real(float(item))


def _unknown(real: Any) -> float:
    """A symbol where a number is expected."""
    return cast(float, Symbol(real))


class SymbolicForce:
    """Force and moment of one clearance pin as a symbolic user function of the engine.

    Arguments:
        mbs: the engine's system.
        contact: bearing and laws.
        journal_on_ground: the journal's body is the ground.
    """

    def __init__(self, mbs: Any, contact: JournalContact, journal_on_ground: bool) -> None:
        number = next(_numbers)

        def variable(name: str) -> Any:
            return engine.Real(f"pin{number}_{name}", 0.0)

        self._in_contact = variable("in_contact")
        self._speed = variable("speed")
        self._mobility = [variable(f"mobility_{axes}") for axes in ("xx", "xy", "yy")]
        self._slip = variable("slip")
        self._deflection = variable("deflection")
        self._step = variable("step")
        self._bore_spin = variable("bore_spin")
        self._scale = variable("scale")
        self._contact = contact
        self._journal_on_ground = journal_on_ground
        # kept alive here: the engine's function refers to it
        self.function = CreateSymbolicUserFunction(
            mbs, self._expression(), FORCE, itemTypeName="ObjectConnectorRigidBodySpringDamper"
        )

    def load(self, memory: PinMemory, step: float, bore_spin: float, turn: float) -> None:
        """Set what the force depends on besides the motion.

        Arguments:
            memory: of the pin, at the start of the step.
            step: its length [s].
            bore_spin: expected at its end [rad/s].
            turn: between the marker frames, expected at its end [rad].
        """
        self._scale.SetValue(displacement_scale(turn))
        self._in_contact.SetValue(float(memory.in_contact))
        self._speed.SetValue(memory.approach_speed)
        for variable, item in zip(self._mobility, memory.mobility, strict=True):
            variable.SetValue(item)
        self._slip.SetValue(memory.slip)
        self._deflection.SetValue(memory.deflection)
        self._step.SetValue(step)
        self._bore_spin.SetValue(bore_spin)

    def _expression(self) -> Any:
        """A function of the engine's signature, to be called once with the engine's symbols."""
        contact = self._contact
        speed = _unknown(self._speed)
        mobility = Mobility(*(_unknown(variable) for variable in self._mobility))
        history = SlipHistory(_unknown(self._deflection), _unknown(self._slip), _unknown(self._step))
        scale = _unknown(self._scale)
        in_contact, spin = _unknown(self._in_contact), _unknown(self._bore_spin)
        journal_on_ground = self._journal_on_ground

        def force(  # type: ignore[no-untyped-def]
            mbs,
            t,
            itemNumber,  # noqa: N803
            displacement,
            rotation,
            velocity,
            angularVelocity,  # noqa: N803
            stiffness,
            damping,
            rotJ0,  # noqa: N803
            rotJ1,  # noqa: N803
            offset,
        ):
            x, y = scale * _unknown(displacement[0]), scale * _unknown(displacement[1])
            vx, vy = _unknown(velocity[0]), _unknown(velocity[1])
            turning = _unknown(angularVelocity[2])
            touch = Touch(speed, mobility.mass(x, y))
            bore_spin = -turning if journal_on_ground else spin
            found = contact.force(x, y, vx, vy, bore_spin, bore_spin + turning, touch, history)
            eccentricity = hypot(x, y)
            away = maximum(eccentricity, SMALLEST)
            nx, ny = x / away, y / away
            arm = found.journal_arm + 0.5 * eccentricity
            # one product each, so that the engine evaluates normal force and friction once
            along = engine.Vector([_real(nx), _real(ny), *_zeros(4)])
            across = engine.Vector([_real(ny), _real(-nx), *_zeros(3), _real(-arm)])
            closed = in_contact > 0.5
            normal = where(closed, where(found.depth > 0.0, found.normal_force, 0.0), 0.0)
            friction = where(closed, where(found.depth > 0.0, found.friction_force, 0.0), 0.0)
            return along * _real(normal) + across * _real(friction)

        return force


def _zeros(count: int) -> list[Any]:
    return [engine.Real(0.0)] * count
