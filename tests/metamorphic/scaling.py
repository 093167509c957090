"""Scenes in other units of length, mass and time: what a field or a channel is, its unit says."""

from __future__ import annotations

import typing
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from pint import UnitRegistry

from support_exudyn import Result, Scenario
from tests.strategies import fields_of
from user_forces import Value
from user_forces.values.units import Unit

REGISTRY = UnitRegistry()


@dataclass(frozen=True)
class Scale:
    """What becomes of a metre, a kilogram and a second."""

    length: float
    mass: float
    time: float

    def of(self, unit: str, **extra: float) -> float:
        """What becomes of a unit, in pint's words; extra: powers of dimensions besides."""
        powers = dict(REGISTRY.Unit(unit or "dimensionless").dimensionality.items())
        factor = 1.0
        for dimension in ("length", "mass", "time"):
            power = float(powers.pop(f"[{dimension}]", 0.0)) + extra.get(dimension, 0.0)
            factor *= getattr(self, dimension) ** power
        assert not powers
        return factor

    def factors(self, result: Result) -> dict[str, float]:
        """What becomes of every channel of a run."""
        return {name: self.of(result.unit(name)) for name in result.channels}

    def scene(self, scenario: Scenario) -> Scenario:
        """The scene in these units."""
        made: Scenario = self._value(scenario)
        return made

    def _value(self, item: Value) -> Any:
        new = {}
        for name, field in fields_of(type(item)).items():
            unit = _unit(field.annotation, field.metadata)
            old = getattr(item, name)
            if unit is None:
                new[name] = self._parts(old)
            elif unit.symbol:
                new[name] = _times(old, self.of(unit.symbol.partition(" or ")[0]))
            else:  # K of a law K depth^n
                new[name] = old * self.of("N", length=-typing.cast(Any, item).exponent)
        return replace(typing.cast(Any, item), **new)

    def _parts(self, item: Any) -> Any:
        if isinstance(item, Value):
            return self._value(item)
        if isinstance(item, Mapping):
            return {name: self._parts(one) for name, one in item.items()}
        return tuple(map(self._parts, item)) if isinstance(item, tuple) else item


def _unit(annotation: Any, metadata: typing.Sequence[Any]) -> Unit | None:
    """Of a field, or of all that it holds."""
    for one in metadata:
        if isinstance(one, Unit):
            return one
    inner = getattr(annotation, "__metadata__", ())
    found = [_unit(argument, ()) for argument in typing.get_args(annotation) if not inner]
    if inner:
        found = [_unit(typing.get_args(annotation)[0], inner)]
    return next((one for one in found if one is not None), None)


def _times(item: Any, factor: float) -> Any:
    """Numbers in lists and tables, and numbers, times a factor."""
    if isinstance(item, Mapping):
        return {name: _times(one, factor) for name, one in item.items()}
    if isinstance(item, tuple):
        return tuple(_times(one, factor) for one in item)
    return item if item is None else factor * item
