"""Strategies for drawn values of every class there is.

Classes are found in the register and their fields in what they declare, so that a new law is tried without a
line here.
"""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import math
import pkgutil
import types
import typing
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import annotated_types
import rich.console  # noqa: F401 - as it is imported it draws at random, which hypothesis would tell of
from hypothesis import HealthCheck, assume, settings
from hypothesis import strategies as st
from pydantic.fields import FieldInfo

import support_exudyn
import user_forces
from support_exudyn import (
    ClearancePin,
    CubicStep,
    IdealPin,
    ImpactStand,
    OilColumn,
    OwnBody,
    Scenario,
    SolverSettings,
    Steady,
    TableDrive,
    UniformSpeed,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
)
from tests.cases.machine_cases import contact
from tests.often import often
from user_forces import CubicCoulomb, InputError, LuGre, Value

# How often each property is tried in a run of the tests; see `tried`.
EXAMPLES = {
    "normal laws": 120,
    "contacts": 60,
    "drives": 60,
    "machines": 100,
    "scenarios": 120,
    "runs": 60,
    "files of values": 250,
    "files of scenarios": 60,
}


def tried(name: str) -> Callable[[Any], Any]:
    """Hypothesis's settings of a property, tried as often as `EXAMPLES` says, or more in a longer profile."""
    return settings(
        max_examples=often(EXAMPLES[name]),
        deadline=None,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large],
    )


def one_of(items: typing.Sequence[Any]) -> st.SearchStrategy[Any]:
    """One of some items; `sampled_from` for those that are long in a report."""
    return st.integers(0, len(items) - 1).map(lambda n: items[n])


# --- values of every class ---


def _all_modules() -> None:
    for package in (user_forces, support_exudyn):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if "peers" not in module.name:
                importlib.import_module(module.name)


@cache
def kinds(base: type = Value) -> tuple[type[Value], ...]:
    """All classes of the program of which values can be made; those with an underscore other values make."""
    _all_modules()
    public = [kind for name, kind in Value._register.items() if not name.startswith("_")]
    known = [kind for kind in public if issubclass(kind, base)]
    own = [kind for kind in known if kind.__module__.split(".")[0] in ("user_forces", "support_exudyn")]
    return tuple(kind for kind in own if dataclasses.is_dataclass(kind) and not inspect.isabstract(kind))


def fields_of(kind: type) -> dict[str, FieldInfo]:
    """What a class declares."""
    return kind.__pydantic_fields__  # type: ignore[attr-defined, no-any-return]


@cache
def seeds() -> tuple[Value, ...]:
    """Values whose parts fit each other, of which drawn ones are made by changing something."""
    with_clearance = ClearancePin(contact=contact())
    lugre = LuGre(static_coefficient=0.3, sliding_coefficient=0.2)
    rubbing = IdealPin(friction=CubicCoulomb(sliding_coefficient=0.1), radius=0.06)
    support, crank = reference_support(), ravn_slider_crank()
    stand = ImpactStand(bore_mass=3.0, journal_mass=1.0, speed=0.5)
    oil = OilColumn(bore_area=0.05, oil_length=0.8, bulk_modulus=1.5e9)
    rise = Scenario(
        machine=support, pins={"rear_base": with_clearance}, drive=CubicStep(), duration=5.0, record_period=0.01
    )
    heavy = dataclasses.replace(
        rise, actuators=cylinders_and_rods(), pins={"front_base": rubbing}, solver=SolverSettings(sections=7)
    )
    space = dataclasses.replace(rise, dimensions=3, actuators={"front_column": oil}, channels=("tip.*",))
    apart = dataclasses.replace(
        rise,
        actuators={"front_column": oil, "rear_column": oil},
        drive=CubicStep(stroke=0.2),
        drives={"rear_column": UniformSpeed(stroke=0.1)},
        accuracy="draft",
    )
    turning = Scenario(
        machine=crank,
        pins={"slider_pin": ClearancePin(contact=dataclasses.replace(contact(), friction=lugre))},
        drive=Steady(rate=500.0),
        duration=0.01,
        step=1e-5,
        record_period=1e-4,
    )
    impact = Scenario(machine=stand, pins={"pin": with_clearance}, duration=0.01, gravity=(0.0, 0.0))
    linkages = [crank.linkage(), support.detailed(("front_column",), ()), support.in_space(support.linkage())]
    table = TableDrive(times=(0.0, 1.0, 2.5), extensions=(0.0, 0.1, 0.05))
    return (rise, heavy, space, apart, turning, impact, *linkages, OwnBody(jack=oil), table)


@cache
def examples_of(kind: type) -> tuple[Value, ...]:
    """All values of a class in `seeds`."""
    found: list[Value] = []

    def visit(item: Any) -> None:
        if isinstance(item, kind) and item not in found:
            found.append(item)
        if isinstance(item, Value):
            for name in fields_of(type(item)):
                visit(getattr(item, name))
        elif isinstance(item, Mapping):
            for one in item.values():
                visit(one)
        elif isinstance(item, tuple):
            for one in item:
                visit(one)

    for seed in seeds():
        visit(seed)
    return tuple(found)


NAMES = ("ground", "rear_base", "pin", "slider_pin", "front_column", "canopy", "crank", "a", "type", "")
names = st.sampled_from(NAMES) | st.text(max_size=4)


def fitting(annotation: Any, metadata: typing.Sequence[Any] = ()) -> st.SearchStrategy[Any]:
    """What fits a field of its own, though perhaps not the others."""
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is typing.Annotated:
        return fitting(arguments[0], arguments[1:])
    if origin is typing.Literal:
        return st.sampled_from(arguments)
    if origin in (typing.Union, types.UnionType):
        return st.one_of([fitting(argument) for argument in arguments])
    if origin is tuple:
        if arguments[-1] is Ellipsis:
            return st.lists(fitting(arguments[0]), max_size=3).map(tuple)
        return st.tuples(*map(fitting, arguments))
    if origin is frozenset:
        return st.frozensets(fitting(arguments[0]))
    if origin is not None and issubclass(origin, Mapping):
        return st.dictionaries(names, fitting(arguments[1]), max_size=3)
    if annotation is type(None):
        return st.none()
    if annotation is bool:
        return st.booleans()
    if annotation is str:
        return names
    if annotation in (float, int):
        return _within(annotation, _flat(metadata))
    if inspect.isclass(annotation) and issubclass(annotation, Value):
        return values(annotation)
    raise NotImplementedError(f"{annotation}: a field of a kind that the strategies do not know yet")


def _flat(metadata: typing.Sequence[Any]) -> list[Any]:
    """Metadata of a field, with those that stand in a `Field(...)`."""
    return [one for item in metadata for one in (item.metadata if isinstance(item, FieldInfo) else [item])]


def _within(kind: type, metadata: typing.Sequence[Any]) -> st.SearchStrategy[Any]:
    low, high, open_end = -1e30, 1e30, False
    for item in metadata:
        match item:
            case annotated_types.Gt(gt=limit):
                low, open_end = float(limit), True
            case annotated_types.Ge(ge=limit):
                low = float(limit)
            case annotated_types.Lt(lt=limit) | annotated_types.Le(le=limit):
                high = float(limit)
    if kind is int:
        return st.integers(math.ceil(max(low, -1000)), math.floor(min(high, 1000)))
    least = max(low, 1e-30) if open_end and low == 0.0 else low
    usual = [
        x for x in (0.0, 1e-6, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.5, 3.0, 100.0, 1e6, 1e11) if least <= x <= high
    ]
    return st.sampled_from([*usual, least, high]) | st.floats(least, high)


@cache
def values(kind: type) -> st.SearchStrategy[Any]:
    """Values of a class, or of all that are of its kind."""
    return st.deferred(lambda: st.one_of([_of(one) for one in kinds(kind)]))


def _of(kind: type[Value]) -> st.SearchStrategy[Any]:
    """Values of one class: some that stand in `seeds`, the same changed, and others made from its fields."""
    known = _known(kind)
    made = _made(kind)
    if not known:
        return made
    return one_of(known) | _changed(kind, known) | made


def _made(kind: type[Value]) -> st.SearchStrategy[Any]:
    wanted = {name: fitting(field.annotation, field.metadata) for name, field in fields_of(kind).items()}
    needed = {name: one for name, one in wanted.items() if fields_of(kind)[name].is_required()}
    rest = {name: one for name, one in wanted.items() if name not in needed}
    fields = st.fixed_dictionaries(needed, optional=rest)

    @st.composite
    def made(draw: st.DrawFn) -> Any:
        found = attempt(kind, draw(fields))
        if found is None and (known := _known(kind)):
            return known[0]
        assume(found is not None)
        return found

    return made()


def _known(kind: type[Value]) -> tuple[Value, ...]:
    return tuple(one for one in examples_of(kind) if type(one) is kind)


def _changed(kind: type[Value], known: tuple[Value, ...]) -> st.SearchStrategy[Any]:
    wanted = {name: fitting(field.annotation, field.metadata) for name, field in fields_of(kind).items()}

    @st.composite
    def changed(draw: st.DrawFn) -> Any:
        one = draw(one_of(known))
        for name in draw(st.lists(st.sampled_from(sorted(wanted)), min_size=1, max_size=2)) if wanted else ():
            new = attempt(kind, {**_given(one), name: draw(wanted[name])})
            one = one if new is None else new
        return one

    return changed()


def _given(one: Value) -> dict[str, Any]:
    return {name: getattr(one, name) for name in fields_of(type(one))}


def attempt(kind: type, given: Mapping[str, Any]) -> Any:
    """A value, or None if its fields do not fit each other."""
    try:
        return kind(**given)
    except InputError:
        return None
