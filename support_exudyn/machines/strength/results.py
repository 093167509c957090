"""The results of what a support must stand, section by section, and as plain data; SI."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

from support_exudyn.machines.strength.parts import PinStresses, Tipping
from support_exudyn.machines.strength.roof_forces import RoofContact, RoofForce
from support_exudyn.machines.strength.strength_data import CylinderStrength

UNITS = {  # of fields of results: plain data have them in the keys
    "N": "force rated nominal worst rubbed euler johnson",
    "m": "stroke x rear front height length centre",
    "Pa": "bearing shear bending yields",
    "kg": "mass",
    "rad": "angles",
}
UNIT_OF = {name: unit for unit, names in UNITS.items() for name in names.split()}


@dataclass(frozen=True)
class SupportForce:
    """Support force in one posture, all legs at a pressure and rams without force; None where none balances.

    Arguments:
        stroke: of the legs from the start on [m].
        contact: where the roof lies.
        setting: at the setting pressure, None without one. yielding: at the yield pressure.
        rubbed: at the yield pressure with the roof's friction, by its coefficient.
        pull, push: at the yield pressure with rams at their largest pull and push; None without rams.
        over: at places on the canopy, the largest force there that opens no valve and lifts no leg.
        largest: of all places.
    """

    stroke: float
    contact: RoofContact
    setting: RoofForce | None
    yielding: RoofForce | None
    rubbed: Mapping[float, RoofForce | None]
    pull: RoofForce | None
    push: RoofForce | None
    over: Sequence[RoofForce]
    largest: RoofForce


@dataclass(frozen=True)
class PinLoad:
    """The forces in a pin over the used height [N].

    Arguments:
        nominal: largest with all legs at yield, rams without force, a roof that does not rub; by the factor on
            the yield force.
        worst: largest under any roof force on the canopy that the cylinders hold, likewise by factor.
        rubbed: the same with a roof that rubs either way.
        stresses: of `worst` and `rubbed` at 1.2 times yield; None where too little is known of the pin.
        yields: yield stresses of pin and eyes [Pa] against which it is judged; None where too little is known.
        assumed: whether its eyes are.
    """

    nominal: Mapping[float, float]
    worst: Mapping[float, float]
    rubbed: Mapping[float, float]
    stresses: tuple[PinStresses, PinStresses] | None
    yields: tuple[float, float] | None
    assumed: bool


@dataclass(frozen=True)
class Buckling:
    """Buckling of one cylinder at its longest.

    Arguments:
        length: [m]. force: on one at its yield pressure [N].
        euler, johnson: loads [N]; the second None without a yield stress.
    """

    length: float
    force: float
    euler: float
    johnson: float | None

    @property
    def least(self) -> float:
        """The load at which it fails [N]."""
        return self.euler if self.johnson is None else min(self.euler, self.johnson)


@dataclass(frozen=True)
class StandReport:
    """What a support must stand.

    Arguments:
        name, kind: of the machine.
        cylinders: by actuator. legs: names of those on the ground.
        forces: by posture, from the lowest on.
        rated: support force [N]. rated_is_assumed: whether the file does not give it.
        pins: by name. unknown_pins: of which too little is known.
        buckling: by actuator.
        unbuckled: actuators whose buckling is not told, with the reason.
        tipping: by posture of `forces`; None without a base.
        assumed: what was assumed, in sentences. sources: of the numbers, in sentences.
    """

    name: str
    kind: str
    cylinders: Mapping[str, CylinderStrength]
    legs: Sequence[str]
    forces: Sequence[SupportForce]
    rated: float
    rated_is_assumed: bool
    pins: Mapping[str, PinLoad]
    unknown_pins: Sequence[str]
    buckling: Mapping[str, Buckling]
    unbuckled: Mapping[str, str]
    tipping: Sequence[Tipping] | None
    assumed: Sequence[str]
    sources: Sequence[str]

    def data(self) -> dict[str, Any]:
        """All results as plain data, with the unit in the key."""
        cylinders = {
            name: {
                "count": one.count,
                "yield_push_N": one.push,
                "yield_pull_N": one.pull,
                "setting_push_N": None if one.setting_pressure is None else one.setting_pressure * one.area,
            }
            for name, one in self.cylinders.items()
        }
        return {**_plain(self), "cylinders": cylinders}


def _plain(item: Any) -> Any:
    """A result as numbers, texts, lists and mappings; keys of fields end by the unit of their numbers."""
    if names := _fields(item):
        found = {}
        for name in names:
            inner = getattr(item, name)
            nested = isinstance(inner, Mapping) and any(map(_fields, inner.values()))
            found[name if nested or name not in UNIT_OF else f"{name}_{UNIT_OF[name]}"] = _plain(inner)
        return found
    if isinstance(item, Mapping):
        return {f"{key:g}" if isinstance(key, float) else key: _plain(one) for key, one in item.items()}
    return [_plain(one) for one in item] if isinstance(item, (list, tuple)) else item


def _fields(item: Any) -> Sequence[str]:
    """Names of the fields of a data class or of a tuple with names; none of what is no result."""
    names: Sequence[str] = getattr(item, "_fields", ())
    return [one.name for one in fields(item)] if is_dataclass(item) else names
