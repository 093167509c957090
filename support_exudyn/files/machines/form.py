"""What data files have in common: tables of numbers in mm, kg and degrees, and what is said of errors."""

from __future__ import annotations

import difflib
from abc import ABC, abstractmethod
from collections.abc import Mapping
from decimal import Decimal
from typing import Annotated, Any, ClassVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from support_exudyn.machines.machine_data import MachineData
from user_forces.values.units import Metres, Radians, Unit
from user_forces.values.value import LARGEST, InputError, Vector2, short, step

UNIT_OF: dict[str, Unit] = {"mm": Metres.__metadata__[0], "deg": Radians.__metadata__[0]}
UNKNOWN = "unknown_key"


def _number(item: Any, unit: str, positive: bool = False) -> Decimal:
    """A decimal as it stands in the file, finite and of a sensible size."""
    allowed = f"allowed: a number{' > 0' if positive else ''} up to {LARGEST:g}, in {unit}"
    if isinstance(item, bool) or not isinstance(item, (int, Decimal)):
        raise ValueError(allowed)
    number = Decimal(item)
    if not number.is_finite() or abs(number) > Decimal(LARGEST):
        raise ValueError(allowed)
    if positive and not number > 0:
        raise ValueError(allowed)
    return number


def _point(item: Any) -> tuple[Decimal, Decimal]:
    try:
        first, second = item if isinstance(item, list) else (None, None)
        return _number(first, "mm"), _number(second, "mm")
    except ValueError:
        raise ValueError("allowed: two numbers [x, y] in mm") from None


def _schema(description: str, positive: bool = False) -> WithJsonSchema:
    bound = {"exclusiveMinimum": 0} if positive else {}
    return WithJsonSchema({"type": "number", "description": description, **bound})


Millimetres = Annotated[Decimal, BeforeValidator(lambda item: _number(item, "mm")), _schema("[mm]")]
Size = Annotated[Decimal, BeforeValidator(lambda item: _number(item, "mm", True)), _schema("[mm]", True)]
Degrees = Annotated[Decimal, BeforeValidator(lambda item: _number(item, "degrees")), _schema("[degrees]")]
Mass = Annotated[Decimal, BeforeValidator(lambda item: _number(item, "kg", True)), _schema("[kg]", True)]
Inertia = Annotated[
    Decimal, BeforeValidator(lambda item: _number(item, "kg m^2", True)), _schema("[kg m^2]", True)
]
Place = Annotated[
    tuple[Decimal, Decimal],
    BeforeValidator(_point),
    WithJsonSchema(
        {
            "type": "array",
            "items": {"type": "number"},
            "minItems": 2,
            "maxItems": 2,
            "description": "[x, y] [mm]",
        }
    ),
]


def metres(number: Decimal) -> float:
    """From mm, rounded once."""
    return UNIT_OF["mm"].read(number, "mm")


def radians(number: Decimal) -> float:
    """From degrees, rounded once."""
    return UNIT_OF["deg"].read(number, "deg")


def point(place: tuple[Decimal, Decimal]) -> Vector2:
    """From mm."""
    return metres(place[0]), metres(place[1])


class Table(BaseModel):
    """A table of a data file. Its keys are its fields.

    NAMES: for fields that are tables of their own, which keys these may have, each with what it means.
    REQUIRED: of these, which they must have.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)

    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = {}
    REQUIRED: ClassVar[Mapping[str, tuple[str, ...]]] = {}

    @model_validator(mode="before")
    @classmethod
    def _keys_are_known(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            raise ValueError("allowed: a table")
        _check_keys(data, tuple(cls.model_fields), "")
        for name, names in cls.NAMES.items():
            if name not in data:
                continue
            inner = data[name]
            if not isinstance(inner, dict):
                raise _wrong(f"{name} = {told(inner)}: allowed: a table, begun with [{name}]")
            _check_keys(inner, tuple(names), f"{name}.")
            for key in cls.REQUIRED.get(name, ()):
                if key not in inner:
                    raise _wrong(f"{name}.{key}: missing; it has no default: {names[key]}")
        return data

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema: Any, handler: Any) -> dict[str, Any]:
        """Tables with known keys are told to editors as such."""
        schema: dict[str, Any] = handler.resolve_ref_schema(handler(core_schema))
        for name, names in cls.NAMES.items():
            inner = schema["properties"][name]
            item = inner.pop("additionalProperties")
            inner["properties"] = {
                key: {**item, "description": f"{said} {_unit(item)}".strip()} for key, said in names.items()
            }
            inner["additionalProperties"] = False
            if cls.REQUIRED.get(name):
                inner["required"] = list(cls.REQUIRED[name])
            inner.pop("default", None)
        return schema


class MachineForm(Table, ABC):
    """The whole file of a machine; a kind of machine says what else it holds and what it is."""

    kind: str = Field(description="What the machine is.")
    name: str = Field("", description="What it is called.", strict=True)
    sources: dict[str, str] = Field(
        default_factory=dict, description="Where the data come from: texts, by what they are of."
    )

    @abstractmethod
    def data(self) -> MachineData:
        """The machine, in SI. Raises InputError if it cannot be built."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> MachineData:
        """The machine from the file's tables, numbers as int or Decimal.

        Raises InputError that names key, value and what is allowed.
        """
        try:
            made = cls.model_validate(data)
        except ValidationError as error:
            found = [_sentence(one) for one in error.errors(include_url=False)]
            raise InputError("\n".join(dict.fromkeys(found))) from None
        return made.data()


def _unit(item: Mapping[str, Any]) -> str:
    return str(item.get("description", ""))


def _wrong(text: str) -> PydanticCustomError:
    """An error that says where it is by itself, from the table on."""
    return PydanticCustomError(UNKNOWN, "{text}", {"text": text})


def _check_keys(data: Mapping[str, Any], allowed: tuple[str, ...], where: str) -> None:
    for key in data:
        if key in allowed:
            continue
        near = difflib.get_close_matches(key, allowed, n=1, cutoff=0.5) if len(key) < 200 else []
        meant = f" (did you mean {near[0]!r}?)" if near else ""
        raise _wrong(f"{where}{step(key)}: unknown key{meant}; allowed: {', '.join(sorted(allowed))}")


def told(item: Any) -> str:
    """A value as it stands in the file."""
    return short(_plain(item, 0))


class _Written(str):
    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def _plain(item: Any, depth: int) -> Any:
    if isinstance(item, Decimal):
        return _Written(str(item)[:60])
    if depth < 4 and isinstance(item, list):
        return [_plain(one, depth + 1) for one in item[:20]]
    if depth < 4 and isinstance(item, dict):
        return {key: _plain(one, depth + 1) for key, one in list(item.items())[:20]}
    return item


def path(steps: tuple[Any, ...]) -> str:
    """Where something stands in a file: `parts.shield[0].mass_kg`."""
    text = ""
    for one in steps:
        text += f"[{one}]" if isinstance(one, int) else f".{step(one)}"
    return text.removeprefix(".")


def _sentence(error: Mapping[str, Any]) -> str:
    """One line for one pydantic error: where, the value, what is allowed."""
    where = path(error["loc"])
    if error["type"] == UNKNOWN:
        return f"{where}.{error['msg']}".removeprefix(".")
    if error["type"] == "missing":
        return f"{where}: missing; it has no default"
    said = {
        "string_type": "allowed: a text",
        "list_type": "allowed: a list",
        "dict_type": "allowed: a table",
    }.get(error["type"])
    said = said or (str(error["ctx"]["error"]) if error["type"] == "value_error" else error["msg"])
    return f"{where} = {told(error['input'])}: {said}"
