"""What a field of a value can hold in a file, found from its type: what reading, writing and schemas go by."""

from __future__ import annotations

import inspect
import types
import typing
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass
from dataclasses import fields as dataclass_fields
from functools import cache
from typing import Any, Literal

import annotated_types
from pydantic.fields import FieldInfo
from typing_extensions import Never

from support_exudyn.files.toml.help_texts import help_texts
from user_forces.values.units import Unit
from user_forces.values.value import InputError, Value

Bound = tuple[str, float]  # one of > >= < <=, and the limit in SI


@dataclass(frozen=True)
class Names:
    """Metadata of a field of texts: the names that are allowed, which are asked for when it is read."""

    known: Callable[[], Sequence[str]]


@dataclass(frozen=True)
class Number:
    """A number within bounds. whole: none between them."""

    bounds: tuple[Bound, ...] = ()
    whole: bool = False


@dataclass(frozen=True)
class Text:
    """Any text."""


@dataclass(frozen=True)
class Truth:
    """true or false."""


@dataclass(frozen=True)
class Choice:
    """One of some words or numbers: those given, or those that are known when they are asked for."""

    given: tuple[Any, ...] = ()
    known: Callable[[], Sequence[str]] | None = None

    @property
    def options(self) -> tuple[Any, ...]:
        """All that are allowed."""
        return self.given if self.known is None else tuple(self.known())


@dataclass(frozen=True)
class Fixed:
    """A list of so many items."""

    items: tuple[Shape, ...]


@dataclass(frozen=True)
class Several:
    """A list of any length. made: what becomes of it."""

    item: Shape
    made: type = tuple


@dataclass(frozen=True)
class Named:
    """A table of items by name."""

    item: Shape


@dataclass(frozen=True)
class Group:
    """A table that is a value of one of some classes, or of a class derived from them."""

    bases: tuple[type[Value], ...]

    @property
    def kinds(self) -> dict[str, type[Value]]:
        """The classes of which values can be made, by name."""
        known = Value._register.items()
        return {name: kind for name, kind in sorted(known) if issubclass(kind, self.bases) and _is_kind(kind)}

    @property
    def usual(self) -> type[Value] | None:
        """The class that is meant where a table says none; None if it has to."""
        kinds = list(self.kinds.values())
        if len(kinds) == 1:
            return kinds[0]
        return self.bases[0] if len(self.bases) == 1 and self.bases[0] in kinds else None

    @property
    def says_type(self) -> bool:
        """Whether tables that are written say their type: where there is a choice, or may be one some day."""
        return len(self.bases) > 1 or not _is_kind(self.bases[0])


@dataclass(frozen=True)
class Either:
    """What fits one of some shapes, of which no two take the same."""

    options: tuple[Shape, ...]


Shape = Number | Text | Truth | Choice | Fixed | Several | Named | Group | Either


@dataclass(frozen=True)
class FieldShape:
    """A field of a class.

    name: of it. shape: what it holds; without None, which a file says by leaving it out. unit: of its numbers,
    if they have one. required: whether it has to be there. allows_none: whether it may be None.
    help: what the docstring says of it.
    """

    name: str
    shape: Shape
    unit: Unit | None
    required: bool
    allows_none: bool
    help: str

    @property
    def wordy(self) -> bool:
        """Whether something that is no number fits, which needs no unit."""
        options = self.shape.options if isinstance(self.shape, Either) else (self.shape,)
        return any(isinstance(one, (Text, Truth, Choice, Group)) for one in options)

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys by which a file may give it; the usual one first."""
        if self.unit is None:
            return (self.name,)
        ended = tuple(f"{self.name}_{ending}" for ending in self.unit.endings)
        return (*ended, self.name) if self.wordy else ended

    def ending(self, key: str) -> str:
        """The unit that one of the keys ends by; empty: without."""
        return "" if key == self.name else key[len(self.name) + 1 :]


def _is_kind(cls: type) -> bool:
    return hasattr(cls, "__pydantic_fields__") and not inspect.isabstract(cls)


def field_shapes(cls: type[Value]) -> dict[str, FieldShape]:
    """What a class declares, by the names of its fields.

    Raises InputError if a field is of a type that files have no form for.
    """
    return dict(_field_shapes(cls))  # type: ignore[arg-type]  # of values, which its hash is not of


@cache
def _field_shapes(cls: type[Value]) -> Mapping[str, FieldShape]:
    found: dict[str, FieldShape] = {}
    declared: Mapping[str, FieldInfo] = cls.__pydantic_fields__  # type: ignore[attr-defined]
    for one in dataclass_fields(cls):  # type: ignore[arg-type]
        info = declared[one.name]
        options = _options(info.annotation, tuple(info.metadata))
        shapes = [_shape(kind, metadata, f"{cls.__name__}.{one.name}") for kind, metadata in options if kind]
        required = one.default is MISSING and one.default_factory is MISSING and info.is_required()
        found[one.name] = FieldShape(
            name=one.name,
            shape=_either(shapes),
            unit=_unit(info.annotation, info.metadata),
            required=required and len(shapes) == len(options),
            allows_none=len(shapes) < len(options),
            help=help_texts(cls).get(one.name, ""),  # type: ignore[arg-type]
        )
    return found


def _options(annotation: Any, metadata: Sequence[Any] = ()) -> list[tuple[Any, tuple[Any, ...]]]:
    """The members of a union, with the metadata of each; None for NoneType."""
    if typing.get_origin(annotation) is typing.Annotated:
        inner, *more = typing.get_args(annotation)
        return _options(inner, (*more, *metadata))
    if typing.get_origin(annotation) in (typing.Union, types.UnionType):
        return [one for member in typing.get_args(annotation) for one in _options(member, metadata)]
    return [(None if annotation is type(None) else annotation, tuple(metadata))]


def _either(shapes: Sequence[Shape]) -> Shape:
    """One shape; classes of values among several become one group."""
    groups = [one for one in shapes if isinstance(one, Group)]
    rest: list[Shape] = [one for one in shapes if not isinstance(one, Group)]
    if groups:
        rest.append(Group(tuple(base for one in groups for base in one.bases)))
    return rest[0] if len(rest) == 1 else Either(tuple(rest))


def _shape(annotation: Any, metadata: Sequence[Any], where: str) -> Shape:
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)

    def inner(item: Any) -> Shape:
        options = [_shape(kind, more, where) for kind, more in _options(item) if kind]
        return _either(options) if options else _no_form(where, item)

    if origin is Literal:
        return Choice(arguments)
    if annotation is bool:
        return Truth()
    if annotation in (float, int):
        return Number(tuple(_bounds(metadata)), whole=annotation is int)
    if annotation is str:
        names = [one for one in metadata if isinstance(one, Names)]
        return Choice(known=names[0].known) if names else Text()
    if origin is tuple and arguments and arguments[-1] is Ellipsis:
        return Several(inner(arguments[0]))
    if origin is tuple:
        return Fixed(tuple(map(inner, arguments)))
    if origin in (frozenset, list):
        return Several(inner(arguments[0]), origin)
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        return Named(inner(arguments[1]))
    if inspect.isclass(annotation) and issubclass(annotation, Value):
        return Group((annotation,))
    return _no_form(where, annotation)


def _no_form(where: str, annotation: Any) -> Never:
    raise InputError(
        f"{where}: is of type {annotation}, which files have no form for; allowed: numbers, texts, bool, "
        "Literal, values, and tuples and mappings of them"
    )


def _flat(metadata: Sequence[Any]) -> Iterator[Any]:
    """Metadata, with those that stand in a `Field(...)`."""
    for item in metadata:
        if isinstance(item, FieldInfo):
            yield from _flat(item.metadata)
        else:
            yield item


def _bounds(metadata: Sequence[Any]) -> Iterator[Bound]:
    for item in _flat(metadata):
        if isinstance(item, annotated_types.Gt):
            yield ">", item.gt  # type: ignore[misc]
        if isinstance(item, annotated_types.Ge):
            yield ">=", item.ge  # type: ignore[misc]
        if isinstance(item, annotated_types.Lt):
            yield "<", item.lt  # type: ignore[misc]
        if isinstance(item, annotated_types.Le):
            yield "<=", item.le  # type: ignore[misc]


def _unit(annotation: Any, metadata: Sequence[Any] = ()) -> Unit | None:
    """The unit in a type, or in what it holds; not in the classes that it may be."""
    for item in _flat(metadata):
        if isinstance(item, Unit):
            return item
    if typing.get_origin(annotation) is typing.Annotated:
        inner, *more = typing.get_args(annotation)
        return _unit(inner, more)
    return next(filter(None, map(_unit, typing.get_args(annotation))), None)
