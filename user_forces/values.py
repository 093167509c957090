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
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, TypeVar

import annotated_types
from pydantic import BeforeValidator, ConfigDict, Field, ValidationError
from pydantic.dataclasses import dataclass as pydantic_dataclass
from typing_extensions import dataclass_transform


def _no_text(item: Any) -> Any:
    if isinstance(item, (str, bytes, bool)):
        raise ValueError("Input should be a number")
    return item


Real = Annotated[float, BeforeValidator(_no_text)]
Positive = Annotated[Real, Field(gt=0)]
NonNegative = Annotated[Real, Field(ge=0)]
Fraction = Annotated[Real, Field(ge=0, le=1)]
Restitution = Annotated[Real, Field(gt=0, le=1)]
Vector2 = tuple[Real, Real]
Vector3 = tuple[Real, Real, Real]


class InputError(ValueError):
    """A value that cannot be used: says which field, what it was, and what is allowed."""


class Value:
    """Base of all data classes made with `value`; keeps a register of them by class name."""

    _register: ClassVar[dict[str, type[Value]]] = {}

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Value._register[cls.__name__] = cls

    def to_data(self) -> dict[str, Any]:
        """Plain data (dict, list, str, float, int, bool, None) from which `from_data` rebuilds."""
        fields = dataclasses.fields(self)  # type: ignore[arg-type]
        return {"type": type(self).__name__} | {f.name: _plain(getattr(self, f.name)) for f in fields}

    @staticmethod
    def from_data(data: Mapping[str, Any]) -> Any:
        """Rebuild the value that `to_data` wrote.

        Raises InputError if the type is not known or a field does not fit.
        """
        kind = data.get("type") if isinstance(data, Mapping) else None
        known = {name: cls for name, cls in Value._register.items() if dataclasses.is_dataclass(cls)}
        known = {name: cls for name, cls in known.items() if not inspect.isabstract(cls)}
        if not isinstance(kind, str) or kind not in known:
            raise InputError(
                f"type = {kind!r}: not a known type; known are {', '.join(sorted(known))}. "
                "Import the module that defines it first."
            )
        return known[kind](**{k: _rebuilt(v) for k, v in data.items() if k != "type"})


def _plain(item: Any) -> Any:
    if isinstance(item, Value):
        return item.to_data()
    if isinstance(item, Mapping):
        if "type" in item:
            raise InputError("'type': cannot be used as a name, it marks what kind of value data are of")
        return {k: _plain(v) for k, v in item.items()}
    if isinstance(item, (tuple, list)):
        return [_plain(v) for v in item]
    return item


def _rebuilt(item: Any) -> Any:
    if isinstance(item, Mapping):
        return Value.from_data(item) if "type" in item else {k: _rebuilt(v) for k, v in item.items()}
    if isinstance(item, list):
        return tuple(_rebuilt(v) for v in item)
    return item


T = TypeVar("T")


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(dataclasses.field,))
def value(cls: type[T]) -> type[T]:
    """Class decorator: a frozen, keyword-only data class whose fields are checked when it is made.

    Unknown, missing and out-of-range fields raise InputError, which names the field, its value and
    what is allowed.
    """
    config = ConfigDict(extra="forbid", allow_inf_nan=False, arbitrary_types_allowed=True)
    made: Any = pydantic_dataclass(frozen=True, kw_only=True, config=config)(cls)
    checked_init = made.__init__

    def __init__(self: Any, *args: Any, **kwargs: Any) -> None:
        try:
            checked_init(self, *args, **kwargs)
        except ValidationError as error:
            raise InputError("\n".join(_sentence(made, e) for e in error.errors())) from None

    __init__.__doc__ = checked_init.__doc__
    made.__init__ = __init__
    return made  # type: ignore[no-any-return]


OUT_OF_BOUNDS = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")  # pydantic's names


def _sentence(cls: Any, error: Mapping[str, Any]) -> str:
    """One line for one pydantic error: where, the value, what is wrong, what is allowed."""
    path = ".".join(str(part) for part in error["loc"])
    where = f"{cls.__name__}.{path}" if path else cls.__name__
    fields = [f.name for f in dataclasses.fields(cls)]
    if error["type"] in ("unexpected_keyword_argument", "unexpected_positional_argument"):
        return f"{where} = {_short(error['input'])}: unknown field; the fields are {', '.join(fields)}"
    if error["type"] in ("missing", "missing_keyword_only_argument"):
        return f"{where}: missing; it has no default"
    if error["type"] == "value_error" and not path:  # a check of ours over several fields
        return f"{where}: {error['ctx']['error']}"
    allowed = _allowed(cls, error["loc"])
    if allowed and error["type"] in OUT_OF_BOUNDS:
        return f"{where} = {_short(error['input'])}: allowed: {allowed}"
    # of a check of ours, without pydantic's words before it
    said = error["ctx"]["error"] if error["type"] == "value_error" else error["msg"]
    return f"{where} = {_short(error['input'])}: {said}" + (f"; allowed: {allowed}" if allowed else "")


def _allowed(cls: Any, loc: tuple[Any, ...]) -> str:
    """The bounds declared on a field, as text such as '> 0' or '>= 0 and <= 1'."""
    if len(loc) != 1 or loc[0] not in cls.__pydantic_fields__:
        return ""
    bounds = []
    for item in cls.__pydantic_fields__[loc[0]].metadata:
        match item:
            case annotated_types.Gt(gt=limit):
                bounds.append(f"> {limit}")
            case annotated_types.Ge(ge=limit):
                bounds.append(f">= {limit}")
            case annotated_types.Lt(lt=limit):
                bounds.append(f"< {limit}")
            case annotated_types.Le(le=limit):
                bounds.append(f"<= {limit}")
    return " and ".join(bounds)


def _short(item: Any) -> str:
    """An input as text that fits into a line."""
    text = " ".join(repr(item).split())
    return text if len(text) <= 80 else text[:77] + "..."
