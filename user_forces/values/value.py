"""Values: frozen, validated data classes that can be written to and read from plain data.

A law, a machine or a scenario is its parameters. Each is declared as

    @value
    class Ambrosio(FrictionLaw):
        sliding_coefficient: NonNegative

and is then immutable, compared by its fields, checked when it is made, and turned into plain
dictionaries (for JSON, TOML or HDF5) by `Value.to_data` and back by `Value.from_data`.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import numbers
from abc import ABC
from collections.abc import Mapping, Sequence
from decimal import Decimal
from importlib import import_module
from typing import Annotated, Any, ClassVar, TypeVar

import numpy as np
from pydantic import (
    AfterValidator,
    BeforeValidator,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    ValidationError,
)
from pydantic.dataclasses import dataclass as pydantic_dataclass
from pydantic_core import ArgsKwargs, core_schema
from typing_extensions import Self, dataclass_transform

from user_forces.values import places
from user_forces.values.names import InputError as InputError
from user_forces.values.names import Named, meant, nearest
from user_forces.values.names import check_names as check_names
from user_forces.values.names import cleaned as cleaned
from user_forces.values.names import short as short

LARGEST = 1e30  # of any number: products of several neither overflow nor vanish
GROUP = "value_class"  # in the schemas of fields: the class of their values
DEEPEST = 32  # of plain data, in containers within containers; a scenario has 7


def carries_unit(item: Any) -> bool:
    """Whether this is a quantity with a unit, as pint makes them."""
    return all(hasattr(item, name) for name in ("magnitude", "units", "to_base_units"))


def _number(item: Any) -> float:
    """A plain float from a number of any kind, also a decimal or one of numpy; text and truths are none."""
    if type(item) not in (float, int):  # tables have a million that are
        if carries_unit(item):  # where a field has a unit that has been taken off
            if not item.dimensionless:
                raise ValueError("Input should be a number without a unit")
            item = item.to_base_units().magnitude
        if isinstance(item, np.ndarray) and item.ndim == 0:
            item = item.item()
        if isinstance(item, bool) or not isinstance(item, (numbers.Real, Decimal)):
            raise ValueError("Input should be a number")
    try:
        number = float(item)
    except (ValueError, OverflowError):  # a signalling decimal; a whole number of 400 digits
        number = math.nan
    if not abs(number) <= LARGEST:
        raise ValueError(f"Input should be a finite number from {-LARGEST:g} to {LARGEST:g}")
    return number


def _not_next_to_zero(number: float) -> float:
    """So that one over it is a number, and its square not zero."""
    if 0.0 < number < 1.0 / LARGEST:
        raise ValueError(
            f"Input should be a number not so near to zero: at least {1.0 / LARGEST:g} if it is not 0"
        )
    return number


def _whole(item: Any) -> int:
    number = _number(item)
    if number != math.floor(number):
        raise ValueError("Input should be a whole number")
    return int(number)


Real = Annotated[float, BeforeValidator(_number)]
Whole = Annotated[int, BeforeValidator(_whole)]
Positive = Annotated[Real, Field(gt=0), AfterValidator(_not_next_to_zero)]
NonNegative = Annotated[Real, Field(ge=0), AfterValidator(_not_next_to_zero)]
Coefficient = Annotated[Real, Field(ge=0, le=5), AfterValidator(_not_next_to_zero)]  # of friction
Fraction = Annotated[Real, Field(ge=0, le=1)]
Share = Annotated[Real, Field(gt=0, le=1), AfterValidator(_not_next_to_zero)]
Restitution = Share
Vector2 = tuple[Real, Real]
Vector3 = tuple[Real, Real, Real]


_being_made: set[type] = set()  # classes whose own schemas are built


class Value:
    """Base of all data classes made with `value`; keeps a register of them by class name.

    Classes that our packages offer are imported into it when they are asked for.
    """

    removed: ClassVar[Mapping[str, str]] = {}  # fields of earlier versions, with what to do instead
    _register: ClassVar[dict[str, type[Value]]] = {}

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        name, known = cls.__name__, Value._register.get(cls.__name__)
        if known is None or known.__module__ == cls.__module__ or places.place(name) != cls.__module__:
            Value._register[name] = cls  # one's own takes the place of ours, whichever is imported first

    def __new__(cls, *args: Any, **kwargs: Any) -> Self:
        """The new value.

        Raises InputError of a class that only groups others, and of one that `value` has not made: nothing
        could be read back.
        """
        if only_groups(cls):
            if _is_made(cls) or ABC in cls.__bases__:
                raise InputError(
                    f"{cls.__name__}: is a kind of values; allowed: {', '.join(sorted(kinds_of(cls)))}"
                )
            _check_whole(cls)
        if not _is_made(cls):
            raise InputError(
                f"{cls.__name__}: is no class of values, which are checked, saved and read; allowed: the line "
                f"@value before `class {cls.__name__}`, with `from support_exudyn import value`"
            )
        return super().__new__(cls)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> Any:
        """Schema for pydantic: a field of this class takes values of it, of later subclasses too."""
        is_late = not _being_made and vars(cls).get("__pydantic_complete__") is False  # it named a later class
        if cls in _being_made or is_late:  # its own schema
            return handler(source)

        def member(item: Any) -> Any:
            if isinstance(item, cls):
                return item
            raise ValueError(f"Input should be a value of class {cls.__name__}")

        return core_schema.no_info_plain_validator_function(member, metadata={GROUP: cls})

    def __getstate__(self) -> dict[str, Any]:
        """What a copy and another process are given: the fields, and classes that are kept.

        What else was computed and kept may be functions, which no other process can be given.
        """
        fields = {field.name for field in dataclasses.fields(self)}  # type: ignore[arg-type]
        return {name: item for name, item in vars(self).items() if name in fields or isinstance(item, type)}

    def to_data(self) -> dict[str, Any]:
        """Plain data (dict, list, str, float, int, bool, None) from which `from_data` rebuilds."""
        fields = dataclasses.fields(self)  # type: ignore[arg-type]
        return {"type": type(self).__name__} | {f.name: _plain(getattr(self, f.name)) for f in fields}

    @classmethod
    def of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        """The present fields, or keys of a file, for those that an earlier version wrote."""
        return given

    @staticmethod
    def of_name(name: str) -> type[Value]:
        """The class of this name. Raises KeyError that says which names are near if there is none."""
        known = known_class(name)
        return Named(Value._register, "class of values")[name] if known is None else known

    @staticmethod
    def from_data(data: Mapping[str, Any]) -> Any:
        """Rebuild the value that `to_data` wrote.

        Raises InputError if the type is not known or a field does not fit.
        """
        return _rebuilt(data, _class_of(data))


def known_class(name: str) -> type[Value] | None:
    """The class of this name, imported if it is one of ours; None if there is none."""
    if name not in Value._register:
        module = places.place(name)
        import_module(module) if module else places.import_all()
    return Value._register.get(name)


def known_classes() -> dict[str, type[Value]]:
    """All classes of values by name, those that only group others among them."""
    places.import_all()
    return Value._register


def kinds_of(cls: type[Value]) -> dict[str, type[Value]]:
    """The classes under a class of which values can be made, by name."""
    return {name: kind for name, kind in known_classes().items() if is_kind_of(kind, cls)}


def is_kind_of(kind: type[Value], cls: type[Value]) -> bool:
    """Whether a class is under another, and users can make values of it: its name does not begin with _."""
    is_public = not kind.__name__.startswith("_")
    return (
        issubclass(kind, cls) and hasattr(kind, "__dataclass_fields__") and not only_groups(kind) and is_public
    )


def only_groups(cls: type) -> bool:
    """Whether a class only groups others: it lacks methods of theirs, or derives from ABC itself."""
    return ABC in cls.__bases__ or inspect.isabstract(cls)


def _is_made(cls: type[Value]) -> bool:
    """Whether `value` has made a class; or one that it derives from, and it has no fields of its own."""
    if "__pydantic_fields__" in vars(cls):
        return True
    fields = [one for one in inspect.get_annotations(cls).values() if "ClassVar" not in str(one)]
    return hasattr(cls, "__dataclass_fields__") and not fields


def _check_whole(cls: Any) -> None:
    """Raise InputError if a class lacks methods of its kind, and is none that others are derived from."""
    missing = sorted(getattr(cls, "__abstractmethods__", ()))
    own = [name for name in missing if name in vars(cls)]
    if not missing or own or ABC in cls.__bases__:
        return
    told = []
    for name in missing:
        method = getattr(cls, name)
        meaning = (inspect.getdoc(method) or "see its kind").partition("\n")[0].rstrip(".")
        told.append(f"{name}, a {'property' if isinstance(method, property) else 'method'} ({meaning})")
    raise InputError(
        f"class {cls.__name__}: lacks {'; '.join(told)}; allowed: a class that defines "
        f"{'it' if len(missing) == 1 else 'them'}, or ABC among its bases if only others are derived from it"
    )


def _plain(item: Any) -> Any:
    if isinstance(item, Value):
        return item.to_data()
    if isinstance(item, Mapping):
        return {k: _plain(v) for k, v in item.items()}
    if isinstance(item, (tuple, list)):
        return [_plain(v) for v in item]
    if isinstance(item, frozenset):
        return sorted(item)
    return item


def _class_of(data: Any) -> type[Value]:
    """The class that plain data name. Raises InputError if there is none."""
    kind = data.get("type") if isinstance(data, Mapping) else None
    found = known_class(kind) if isinstance(kind, str) else None
    if found is not None and is_kind_of(found, Value):
        return found
    raise InputError(
        f"type = {short(kind)}: not a known type; one's own have to be imported first, on a command line by "
        f"--import FILE; {meant(kind, sorted(kinds_of(Value)))}"
    )


def _rebuilt(item: Any, cls: type[Value] | None = None, depth: int = 0) -> Any:
    """Plain data with values in place of the tables that name a class; cls: of this table."""
    if depth > DEEPEST:
        raise InputError(f"data = {short(item)}: are nested too deep; allowed: {DEEPEST} levels")
    if isinstance(item, list):
        return tuple(_rebuilt(one, None, depth + 1) for one in item)
    if not isinstance(item, Mapping):
        return item
    cls = _class_of(item) if cls is None and "type" in item else cls
    given = item if cls is None else cls.of_earlier(item)
    inside = {name: _rebuilt(each, None, depth + 1) for name, each in given.items()}
    if cls is None:
        return inside
    inside.pop("type", None)
    return cls(**inside)


T = TypeVar("T")


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(dataclasses.field,))
def value(cls: type[T]) -> type[T]:
    """Class decorator: a frozen, keyword-only data class whose fields are checked when it is made.

    Unknown, missing and out-of-range fields raise InputError, which names the field, its value and
    what is allowed. So does the class itself where it is defined, if it lacks a method of its kind; classes
    that only others derive from have ABC among their bases.
    """
    _check_whole(cls)
    config = ConfigDict(extra="forbid", allow_inf_nan=False, arbitrary_types_allowed=True)
    _being_made.add(cls)
    try:
        made: Any = pydantic_dataclass(frozen=True, kw_only=True, config=config)(cls)
    finally:
        _being_made.remove(cls)

    def __init__(self: Any, /, *args: Any, **kwargs: Any) -> None:
        try:
            self.__pydantic_validator__.validate_python(ArgsKwargs(args, kwargs), self_instance=self)
        except ValidationError as error:
            raise InputError(
                "\n".join(_sentence(made, e) for e in _first(error.errors(include_url=False)))
            ) from None
        _name_entries(self)

    __init__.__doc__ = made.__init__.__doc__
    made.__init__ = __init__
    return made  # type: ignore[no-any-return]


def validated(cls: type[Value], given: Mapping[str, Any]) -> Any:
    """A value of a class from its fields. Raises pydantic's ValidationError, InputError of names."""
    made = cls.__new__(cls)
    validator: Any = cls.__pydantic_validator__  # type: ignore[attr-defined]
    validator.validate_python(ArgsKwargs((), dict(given)), self_instance=made)
    _name_entries(made)
    return made


def _name_entries(made: Any) -> None:
    """Let a table of a value answer a name that it does not have with the names that are near."""
    cls = type(made).__name__
    for name, item in list(vars(made).items()):
        if not isinstance(item, Mapping):
            continue
        if "type" in item:
            raise InputError(
                f"{cls}.{name}: 'type': cannot be used as a name, it marks what kind of value "
                "data are of; allowed: any other"
            )
        object.__setattr__(made, name, Named(item, f"name in {cls}.{name}"))


MARKS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}
OUT_OF_BOUNDS = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")  # pydantic's names


LENGTHS = ("too_short", "too_long")


def _first(errors: Sequence[Any]) -> list[Any]:
    """Errors but those that only follow from others: items that are wrong are not counted."""
    within = {error["loc"][:-1] for error in errors}
    return [error for error in errors if error["type"] not in LENGTHS or error["loc"] not in within]


def _sentence(cls: Any, error: Mapping[str, Any]) -> str:
    """One line for one pydantic error: where, the value, what is wrong, what is allowed."""
    path = ".".join(map(step, error["loc"]))
    where = f"{cls.__name__}.{path}" if path else cls.__name__
    item, kind, context = f"{where} = {short(error['input'])}", error["type"], error.get("ctx", {})
    if kind.startswith("unexpected_"):
        if instead := cls.removed.get(path):
            return f"{item}: there is no such field any more; {instead}"
        return f"{item}: unknown field; {nearest(path, [each.name for each in dataclasses.fields(cls)])}"
    if kind.startswith("missing"):
        return f"{where}: missing; it has no default"
    if kind == "value_error" and not path:  # a check of ours over several fields
        return f"{where}: {context['error']}"
    if kind in LENGTHS:
        least, most = (context.get(f"{end}_length") for end in ("min", "max"))
        return f"{item}: allowed: {f'at least {least}' if least is not None else f'at most {most}'} items"
    allowed = _allowed(cls, error["loc"])
    if kind in OUT_OF_BOUNDS:
        bound = allowed or " and ".join(f"{MARKS[end]} {limit:g}" for end, limit in context.items())
        return f"{item}: allowed: {bound}"
    said = context.get("error", error["msg"])  # of a check of ours, without pydantic's words before it
    return f"{item}: {said}" + (f"; allowed: {allowed}" if allowed else "")


def _allowed(cls: Any, loc: tuple[Any, ...]) -> str:
    """The bounds declared on a field, as text such as '> 0' or '>= 0 and <= 1'."""
    if len(loc) != 1 or loc[0] not in cls.__pydantic_fields__:
        return ""
    bounds = []
    for item in cls.__pydantic_fields__[loc[0]].metadata:
        bounds += [f"{mark} {getattr(item, end)}" for end, mark in MARKS.items() if hasattr(item, end)]
    return " and ".join(bounds)


def step(part: Any) -> str:
    """A field, a name or a number on the way to what is wrong."""
    text = str(part)
    return text if len(text) <= 80 and text.isprintable() else short(part)
