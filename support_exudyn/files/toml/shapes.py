"""Shapes say what a field of a value can hold in a file: reading, writing and schemas go by them.

A shape is found from the type of the field. It is a JSON Schema whose numbers are in SI, with two keywords of
our own. `group`: the item is a value of one of a `GroupShape` of classes. `names`: the item is a text out of
`Names` that are asked for when it is read.
"""

import inspect
import operator
import re
import types
import typing
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass
from dataclasses import fields as dataclass_fields
from decimal import Decimal
from functools import cache
from typing import Any, Literal

from pydantic import GetCoreSchemaHandler
from pydantic.fields import FieldInfo
from pydantic_core import core_schema
from typing_extensions import Never

from support_exudyn.files.toml.faults import said
from user_forces.values.units import Unit
from user_forces.values.value import InputError, Value, is_kind_of, known_classes

Shape = Mapping[str, Any]
# keywords of JSON Schema, each with its name in metadata, its sign and what fits it
BOUNDS: dict[str, tuple[str, str, Callable[[float, float], bool]]] = {
    "exclusiveMinimum": ("gt", ">", operator.gt),
    "minimum": ("ge", ">=", operator.ge),
    "exclusiveMaximum": ("lt", "<", operator.lt),
    "maximum": ("le", "<=", operator.le),
}
SOURCED_KEYS = {  # of a number that is a table, where numbers may be
    "value": "what is reckoned with",
    "from": "the least that it may be, in the same unit",
    "to": "the largest that it may be, in the same unit",
    "source": "where it comes from, and what the range rests on",
}
ENTRY = re.compile(r"^(?P<names>\w+(?:, \w+)*): (?P<text>.*)$")


@dataclass(frozen=True, eq=False)
class Names:
    """Metadata of a field: the names that a text, or the keys of a table, can be.

    known: the names, each with what it means; of a table of tables, a mapping of names in place of the meaning;
    or a function that gives the names of a text, which later classes may add to. required: keys that a table
    must have. instead: what to do with a name that is none of them, in words.
    """

    known: Mapping[str, Any] | Callable[[], Sequence[str]]
    required: tuple[str, ...] = ()
    instead: Callable[[str], str] | None = None

    @property
    def options(self) -> tuple[str, ...]:
        """All names, as they are now."""
        return tuple(self.known() if callable(self.known) else self.known)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> Any:
        """For pydantic: no value has another name."""
        return core_schema.no_info_after_validator_function(self._checked, handler(source))

    def _checked(self, item: Any) -> Any:
        missing = [name for name in self.required if name not in item]
        if missing:
            raise ValueError(f"{missing[0]}: missing; it has no default")
        _check_names(item, self.options if callable(self.known) else self.known)
        return item


def _check_names(item: Any, known: Any) -> None:
    for name in [item] if isinstance(item, str) else item:
        if name not in known:
            raise ValueError(f"there is no {name!r}; allowed: {', '.join(known)}")
        if isinstance(item, Mapping) and isinstance(known[name], Mapping):
            _check_names(item[name], known[name])


@dataclass(frozen=True)
class GroupShape:
    """A table that is a value of one of some classes, or of a class derived from them."""

    bases: tuple[type[Value], ...]

    @property
    def kinds(self) -> dict[str, type[Value]]:
        """The classes of which values can be made, by name."""
        known = known_classes().items()
        return {name: kind for name, kind in sorted(known) if issubclass(kind, self.bases) and _is_kind(kind)}

    @property
    def usual(self) -> type[Value] | None:
        """The class that is meant where a table says none; None if it has to."""
        if len(self.bases) == 1 and _is_kind(self.bases[0]):
            return self.bases[0]
        kinds = list(self.kinds.values())
        return kinds[0] if len(kinds) == 1 else None

    @property
    def says_type(self) -> bool:
        """Whether tables that are written say their type: where there is a choice, or may be one some day."""
        return len(self.bases) > 1 or not _is_kind(self.bases[0])


def _is_kind(cls: type) -> bool:
    return is_kind_of(cls, Value)


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


def field_shapes(cls: type[Value]) -> Mapping[str, FieldShape]:
    """The fields of a class, by name. Raises InputError for one of a type that files have no form for."""
    return _field_shapes(cls)  # type: ignore[arg-type]  # of values, which its hash is not of


@cache
def _field_shapes(cls: type[Value]) -> Mapping[str, FieldShape]:
    found: dict[str, FieldShape] = {}
    declared: Mapping[str, FieldInfo] = cls.__pydantic_fields__  # type: ignore[attr-defined]
    for one in dataclass_fields(cls):  # type: ignore[arg-type]
        info = declared[one.name]
        members = _members(info.annotation, tuple(info.metadata))
        shapes = [_shape(kind, metadata, f"{cls.__name__}.{one.name}") for kind, metadata in members if kind]
        allows_none = len(shapes) < len(members)
        needed = one.default is MISSING and one.default_factory is MISSING and info.is_required()
        found[one.name] = FieldShape(
            name=one.name,
            shape=either(shapes),
            unit=_unit(info.annotation, info.metadata),
            required=needed and not allows_none,
            allows_none=allows_none,
            default=None if info.is_required() else info.get_default(call_default_factory=True),
            help=help_texts(cls).get(one.name, ""),  # type: ignore[arg-type]
        )
    return found


def _members(annotation: Any, metadata: Sequence[Any] = ()) -> list[tuple[Any, tuple[Any, ...]]]:
    """The members of a union, with the metadata of each; None for NoneType."""
    if typing.get_origin(annotation) is typing.Annotated:
        inner, *more = typing.get_args(annotation)
        return _members(inner, (*more, *metadata))
    if typing.get_origin(annotation) in (typing.Union, types.UnionType):
        return [one for member in typing.get_args(annotation) for one in _members(member, metadata)]
    return [(None if annotation is type(None) else annotation, tuple(_flat(metadata)))]


def _shape(annotation: Any, metadata: Sequence[Any], where: str) -> Shape:
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    names = next((one for one in metadata if isinstance(one, Names)), None)

    def inner(item: Any) -> Shape:
        shapes = [_shape(kind, more, where) for kind, more in _members(item) if kind]
        return either(shapes) if shapes else _no_form(where, item)

    if origin is Literal:
        return {"enum": arguments}
    if annotation in (float, int):
        limits = [(word, getattr(one, name, None)) for one in metadata for word, (name, *_) in BOUNDS.items()]
        bounds = {word: float(limit) for word, limit in limits if limit is not None}
        return {"type": "number" if annotation is float else "integer", **bounds}
    if annotation in (bool, str):
        return {"names": names} if names else {"type": "boolean" if annotation is bool else "string"}
    if origin is tuple and arguments and arguments[-1] is not Ellipsis:
        return {"type": "array", "prefixItems": tuple(map(inner, arguments))}
    if origin in (tuple, frozenset, list):
        return {"type": "array", "items": inner(arguments[0])}
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        item = inner(arguments[1])
        if names is None:
            return {"type": "object", "additionalProperties": item}
        return {**_named(item, names.known), "required": names.required}
    if inspect.isclass(annotation) and issubclass(annotation, Value):
        return {"group": GroupShape((annotation,))}
    return _no_form(where, annotation)


def _named(item: Shape, known: Any) -> dict[str, Any]:
    """The shape of a table whose keys are known, and so of the tables in it where names hold names."""
    inside = {
        name: _named(item["additionalProperties"], one)
        if isinstance(one, Mapping)
        else {**item, "description": one}
        for name, one in known.items()
    }
    return {"type": "object", "properties": inside}


def _no_form(where: str, annotation: Any) -> Never:
    raise InputError(
        f"{where}: is of type {annotation}, which files have no form for; allowed: numbers, texts, bool, "
        "Literal, values, and tuples and mappings of them"
    )


def _flat(metadata: Sequence[Any]) -> Iterator[Any]:
    """Metadata, with those that stand in a `Field(...)`."""
    for item in metadata:
        yield from _flat(item.metadata) if isinstance(item, FieldInfo) else (item,)


def _unit(annotation: Any, metadata: Sequence[Any] = ()) -> Unit | None:
    """The unit in a type, or in what it holds; not in the classes that it may be."""
    for item in _flat(metadata):
        if isinstance(item, Unit):
            return item
    if typing.get_origin(annotation) is typing.Annotated:
        inner, *more = typing.get_args(annotation)
        return _unit(inner, more)
    return next(filter(None, map(_unit, typing.get_args(annotation))), None)


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
            return ", ".join(map(said, choices))
        case {"names": names}:
            return ", ".join(map(said, names.options))
        case {"type": "number" | "integer" as kind}:
            limits = [(sign, shape[name]) for name, (_, sign, _) in BOUNDS.items() if name in shape]
            bounds = " and ".join(f"{sign} {scaled(limit, unit, ending)}" for sign, limit in limits)
            return bounds if bounds and kind == "number" else f"a {WHOLE[kind]} {bounds}".strip()
        case {"prefixItems": items}:
            return f"a list of {len(items)}, each {' or '.join(dict.fromkeys(map(inner, items)))}"
        case {"items": item}:
            return f"a list, each {inner(item)}"
        case {"additionalProperties": item}:
            return f"a table of names, each {inner(item)}"
        case {"properties": names}:
            return f"a table of {', '.join(names)}"
    return "a text" if shape["type"] == "string" else "true, false"


WHOLE = {"number": "number", "integer": "whole number"}


# --- help from docstrings ---


@cache
def help_texts(cls: type) -> Mapping[str, str]:
    """The help on the fields of a class, from its docstring and those of its bases."""
    found: dict[str, str] = {}
    for one in reversed(cls.__mro__):
        if one.__doc__ and "Arguments:" in one.__doc__:
            found |= dict(_entries(inspect.cleandoc(one.__doc__).partition("Arguments:")[2]))
    names = "|".join(one.name for one in dataclass_fields(cls))
    for text in list(found.values()):  # several in a line: `radius: [m], > 0. mass: [kg], > 0.`
        first, *more = re.split(rf"(?<=\.) (?=(?:{names}): )", text)
        found = {name: first if one == text else one for name, one in found.items()}
        found |= {name: one for name, _, one in (item.partition(": ") for item in more)}
    return found


def _entries(text: str) -> Iterator[tuple[str, str]]:
    """Names and texts of an indented list `name: text`, one text over several lines."""
    names: list[str] = []
    words: list[str] = []
    for line in [*text.splitlines()[1:], "end"]:
        if line.strip() and not line.startswith("    "):  # a new section
            break
        if line.startswith("     ") or not line.strip():
            words.append(line.strip())
            continue
        yield from ((name, " ".join(words).strip()) for name in names)
        entry = ENTRY.match(line.strip())
        names, words = (entry["names"].split(", "), [entry["text"]]) if entry else ([], [])
    yield from ((name, " ".join(words).strip()) for name in names)
