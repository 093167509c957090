"""Shapes say what a field of a value can hold in a file: messages, schemas and writing go by them.

A shape is the JSON Schema that pydantic makes of the field, with numbers in SI and two keywords of our own.
`group`: the item is a value of one of a `GroupShape` of classes. `names`: the item is a text out of `Names`
that are asked for when it is read.
"""

import inspect
import operator
import re
import typing
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass
from dataclasses import fields as dataclass_fields
from decimal import Decimal
from functools import cache
from typing import Any

from pydantic import GetCoreSchemaHandler
from pydantic.fields import FieldInfo
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema
from typing_extensions import Never

from support_exudyn.files.toml.faults import quoted
from user_forces.values.names import nearest
from user_forces.values.units import Unit
from user_forces.values.value import GROUP, InputError, Value, is_kind_of, kinds_of

Shape = Mapping[str, Any]
NAMES = "names"  # in the schemas of fields: the names of a text
BOUNDS = {  # keywords of JSON Schema, each with the name that pydantic and `operator` have, and its sign
    "exclusiveMinimum": ("gt", ">"),
    "minimum": ("ge", ">="),
    "exclusiveMaximum": ("lt", "<"),
    "maximum": ("le", "<="),
}
SOURCED_KEYS = {  # of a number that is a table, where numbers may be
    "value": "what is reckoned with",
    "from": "the least that it may be, in the same unit",
    "to": "the largest that it may be, in the same unit",
    "source": "where it comes from, and what the range rests on",
}


@dataclass(frozen=True, eq=False)
class Names:
    """Metadata of a field: the names that a text, or the keys of a table, can be.

    known: the names, each with what it means; of a table of tables, a mapping of names in place of the meaning;
    or a function that gives the names of a text, which later classes may add to. required: keys that a table
    must have. instead: advice on any other name.
    """

    known: Mapping[str, Any] | Callable[[], Sequence[str]]
    instead: str = ""
    required: tuple[str, ...] = ()

    @property
    def options(self) -> tuple[str, ...]:
        """All names, as they are now."""
        return tuple(self.known() if callable(self.known) else self.known)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> Any:
        """For pydantic: no value has another name."""
        if isinstance(self.known, Mapping) and source is not str:
            return _named(source, self.known, self.required, handler)
        return core_schema.no_info_after_validator_function(
            self._checked, handler(source), metadata={NAMES: self}
        )

    def _checked(self, name: str) -> str:
        if name not in self.options:
            raise ValueError(f"there is no {name!r}; {nearest(name, self.options)}")
        return name


def _named(
    source: Any, known: Mapping[str, Any], required: tuple[str, ...], handler: GetCoreSchemaHandler
) -> Any:
    """Pydantic's schema of a mapping with known keys, whose items may be such mappings."""
    item = typing.get_args(source)[1]
    inside = {
        name: core_schema.typed_dict_field(
            _named(item, one, (), handler) if isinstance(one, Mapping) else handler.generate_schema(item),
            required=name in required,
            metadata={} if isinstance(one, Mapping) else {"pydantic_js_updates": {"description": one}},
        )
        for name, one in known.items()
    }

    def in_order(given: Any, check: Callable[[Any], Mapping[str, Any]]) -> Mapping[str, Any]:
        found = check(given)
        return {name: found[name] for name in given}

    table = core_schema.typed_dict_schema(inside, extra_behavior="forbid")
    return core_schema.no_info_wrap_validator_function(in_order, table)


@dataclass(frozen=True)
class GroupShape:
    """A table that is a value of one of some classes, or of a class derived from them."""

    bases: tuple[type[Value], ...]

    @property
    def kinds(self) -> dict[str, type[Value]]:
        """The classes of which values can be made, by name."""
        kinds = {name: kind for base in self.bases for name, kind in kinds_of(base).items()}
        return dict(sorted(kinds.items()))

    @property
    def usual(self) -> type[Value] | None:
        """The class that is meant where a table says none; None if it has to."""
        if not self.says_type:
            return self.bases[0]
        kinds = list(self.kinds.values())
        return kinds[0] if len(kinds) == 1 else None

    @property
    def says_type(self) -> bool:
        """Whether tables that are written say their type: where there is a choice, or may be one some day."""
        return len(self.bases) > 1 or not is_kind_of(self.bases[0], Value)


@dataclass(frozen=True)
class FieldShape:
    """A field of a class.

    name: of it. shape: what it holds; without None, which a file says by leaving it out. unit: of its numbers,
    if they have one. required: whether it has to be there. allows_none: whether it may be None. default: what
    it is if it is left out. help: what the docstring says of it.
    """

    name: str
    shape: Shape
    unit: Unit | None
    required: bool
    allows_none: bool
    default: Any
    help: str

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys by which a file may give it, the usual one first; without unit, for words, the last."""
        if self.unit is None:
            return (self.name,)
        ended = tuple(f"{self.name}_{ending}" for ending in self.unit.endings)
        return ended if all(map(is_numeric, options(self.shape))) else (*ended, self.name)

    def ending(self, key: str) -> str:
        """The unit that one of the keys ends by; empty: without."""
        return "" if key == self.name else key[len(self.name) + 1 :]


def options(shape: Shape) -> Sequence[Shape]:
    """The shapes of which an item fits one."""
    return shape.get("anyOf", (shape,))  # type: ignore[no-any-return]


def either(shapes: Sequence[Shape]) -> Shape:
    """One shape; classes of values among several become one group."""
    bases = tuple(base for one in shapes if "group" in one for base in one["group"].bases)
    rest = [one for one in shapes if "group" not in one] + ([{"group": GroupShape(bases)}] if bases else [])
    return rest[0] if len(rest) == 1 else {"anyOf": rest}


def is_numeric(shape: Shape) -> bool:
    """Whether this is a number, or numbers in a list or table."""
    return shape.get("type") in ("number", "integer", "array", "object")


def is_number(shape: Shape) -> bool:
    """Whether what fits a shape is a number of any size in its bounds."""
    return shape.get("type") in ("number", "integer") and "enum" not in shape


def within(shape: Shape, number: float) -> bool:
    """Whether a number in SI lies in the bounds of a shape."""
    return all(
        getattr(operator, name)(number, shape[word]) for word, (name, _) in BOUNDS.items() if word in shape
    )


def field_shapes(cls: type[Value]) -> Mapping[str, FieldShape]:
    """The fields of a class, by name. Raises InputError for one of a type that files have no form for."""
    return _field_shapes(cls)  # type: ignore[arg-type]  # of values, which its hash is not of


@cache
def _field_shapes(cls: type[Value]) -> Mapping[str, FieldShape]:
    found: dict[str, FieldShape] = {}
    declared: Mapping[str, FieldInfo] = cls.__pydantic_fields__  # type: ignore[attr-defined]
    shapes = _Shapes(cls).of_fields()
    for one in dataclass_fields(cls):  # type: ignore[arg-type]
        info = declared[one.name]
        allows_none = type(None) in typing.get_args(info.annotation)
        needed = one.default is MISSING and one.default_factory is MISSING and info.is_required()
        found[one.name] = FieldShape(
            name=one.name,
            shape=shapes[one.name],
            unit=_unit(info.annotation, info.metadata),
            required=needed and not allows_none,
            allows_none=allows_none,
            default=None if info.is_required() else info.get_default(call_default_factory=True),
            help=help_texts(cls).get(one.name, ""),  # type: ignore[arg-type]
        )
    return found


class _Shapes(GenerateJsonSchema):
    """Pydantic's generator of JSON Schemas, for the shapes of the fields of a class."""

    def __init__(self, cls: type[Value]) -> None:
        super().__init__()
        self.cls = cls

    def of_fields(self) -> Mapping[str, Shape]:
        """The shapes, by the names of the fields."""
        schema: Any = self.cls.__pydantic_core_schema__  # type: ignore[attr-defined]
        if schema["type"] == "definitions":  # of a class with fields of its own kind
            own = schema["schema"]["schema_ref"]
            schema = next(one for one in schema["definitions"] if one.get("ref") == own)
        return self.generate(schema)["properties"]  # type: ignore[no-any-return]

    def definition_ref_schema(self, schema: Any) -> Any:
        """The class itself."""
        return {"group": GroupShape((self.cls,))}

    def generate_inner(self, schema: Any) -> dict[str, Any]:
        """The shape of what a schema of pydantic takes, its bounds by the words of JSON Schema."""
        shape = super().generate_inner(schema)
        for word, (name, _) in BOUNDS.items():
            if name in shape:
                shape[word] = float(shape.pop(name))
        return shape

    def field_title_should_be_set(self, schema: Any) -> bool:
        """Give no field a title: its key names it."""
        return False

    def function_plain_schema(self, schema: Any) -> Any:
        """The group of a class of values."""
        cls = schema.get("metadata", {}).get(GROUP)
        return super().function_plain_schema(schema) if cls is None else {"group": GroupShape((cls,))}

    def function_after_schema(self, schema: Any) -> Any:
        """The names of a text."""
        names = schema.get("metadata", {}).get(NAMES)
        return super().function_after_schema(schema) if names is None else {"names": names}

    def nullable_schema(self, schema: Any) -> Any:
        """The shape without None, which a file says by leaving a key out."""
        return self.generate_inner(schema["schema"])

    def default_schema(self, schema: Any) -> Any:
        """The shape without the default, which `FieldShape` has."""
        return self.generate_inner(schema["schema"])

    def union_schema(self, schema: Any) -> Any:
        """One shape of several."""
        choices = [one[0] if isinstance(one, tuple) else one for one in schema["choices"]]
        return either(list(map(self.generate_inner, choices)))

    def handle_invalid_for_json_schema(self, schema: Any, error_info: str) -> Never:
        """Raise InputError: a field is of a type that files have no form for."""
        raise InputError(
            f"{self.cls.__name__}: has a field of a type that files have no form for, {error_info}; allowed: "
            "numbers, texts, bool, Literal, values, and tuples and mappings of them"
        )


def _unit(annotation: Any, metadata: Sequence[Any] = ()) -> Unit | None:
    """The unit in a type, or in what it holds; not in the classes that it may be."""
    for item in metadata:
        if isinstance(item, Unit):
            return item
    if typing.get_origin(annotation) is typing.Annotated:
        inner, *more = typing.get_args(annotation)
        return _unit(inner, more)
    return next(filter(None, map(_unit, typing.get_args(annotation))), None)


def inner_shape(shape: Shape, at: str | int) -> Shape:
    """The shape of what is at a name of a table or a place of a list."""
    for one in options(shape):
        if one.get("type") == "array" and isinstance(at, int):
            each: Sequence[Shape] = one.get("prefixItems", ())
            return each[at] if at < len(each) else one.get("items", {})
        if one.get("type") == "object" and isinstance(at, str):
            return one.get("properties", {}).get(at) or one.get("additionalProperties") or {}
    return {}


# --- in words ---


def scaled(limit: float, unit: Unit | None, ending: str) -> Decimal:
    """A limit in the unit of a key."""
    exact = Decimal(repr(float(limit))) if unit is None else unit.write(float(limit), ending)
    return exact.to_integral_value() if exact == exact.to_integral_value() and abs(exact) < 10**15 else exact


def allowed(shape: Shape, unit: Unit | None = None, ending: str = "") -> str:
    """The words for what fits a shape; numbers in the unit of a key."""

    def inner(one: Shape) -> str:
        return allowed(one, unit, ending)

    match shape:
        case {"anyOf": several}:
            return ", or ".join(map(inner, several))
        case {"group": group}:
            return f"a table of type {', '.join(group.kinds)}" if group.kinds else "none"
        case {"enum": choices}:
            return ", ".join(map(quoted, choices))
        case {"const": choice}:
            return quoted(choice)
        case {"names": names}:
            return ", ".join(map(quoted, names.options))
        case {"type": "number" | "integer" as kind}:
            limits = [(sign, shape[name]) for name, (_, sign) in BOUNDS.items() if name in shape]
            bounds = " and ".join(f"{sign} {scaled(limit, unit, ending)}" for sign, limit in limits)
            return bounds if bounds and kind == "number" else f"a {WHOLE[kind]} {bounds}".strip()
        case {"prefixItems": items}:
            return f"a list of {len(items)}, each {' or '.join(dict.fromkeys(map(inner, items)))}"
        case {"items": item}:
            return f"a list, each {inner(item)}"
        case {"properties": names}:
            return f"a table of {', '.join(names)}"
        case {"additionalProperties": item}:
            return f"a table of names, each {inner(item)}"
    return "a text" if shape["type"] == "string" else "true, false"


WHOLE = {"number": "number", "integer": "whole number"}


# --- help from docstrings ---


@cache
def help_texts(cls: type) -> Mapping[str, str]:
    """The help on the fields of a class, from the `Arguments:` of its docstring and of its bases'."""
    names = "|".join(each.name for each in dataclass_fields(cls))
    entry = re.compile(rf"(?:^|\n|(?<=\.) ) *((?:{names})(?:, (?:{names}))*): ")
    found: dict[str, str] = {}
    for each in reversed(cls.__mro__):
        section = inspect.cleandoc(each.__doc__ or "").partition("Arguments:")[2]
        section = re.split(r"\n(?=\S)", section)[0]  # up to the next section
        section = re.sub(r"(\n\s*)?\n {5,}", " ", section).strip()
        texts = iter(entry.split(section)[1:])
        for named, text in zip(texts, texts, strict=True):
            found |= dict.fromkeys(named.split(", "), text.partition("\n")[0].strip())
    return found
