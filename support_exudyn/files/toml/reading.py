"""From a table of a file to a value, by what the value's class declares."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from decimal import Decimal
from typing import Any, TypeVar

from support_exudyn.files.toml.millimetres import in_millimetres
from support_exudyn.files.toml.place import Faults, Place, nearest, said, said_place
from support_exudyn.files.toml.shapes import (
    Bound,
    Choice,
    Either,
    FieldShape,
    Fixed,
    Group,
    Named,
    Number,
    Several,
    Shape,
    Text,
    Truth,
    field_shapes,
)
from support_exudyn.files.toml.words import allowed
from user_forces.values.units import Unit
from user_forces.values.value import DEEPEST, LARGEST, InputError, Value

V = TypeVar("V", bound=Value)
SMALLEST_EXPONENT = -1000  # of a decimal; what is smaller is 0
ShortForm = Callable[["Reader", Any, Place], Any]


class Failed:
    """What stands for a value that could not be read; why is among the faults."""


FAILED = Failed()


class Reader:
    """Reads values from tables, and collects what is wrong with them.

    faults: what was wrong so far. short_forms: for a class, another way to write its values: is given the item
    and its place, and gives the value, FAILED, or None if the item is in the long form.
    """

    def __init__(self, faults: Faults, short_forms: Mapping[type[Value], ShortForm] | None = None) -> None:
        self.faults = faults
        self.short_forms = dict(short_forms or {})

    def value(self, cls: type[Value], table: Mapping[str, Any], place: Place, base: Value | None = None) -> Any:
        """A value of a class from its table, whose `type` has been looked at; FAILED if something is wrong.

        base: a value whose fields stand for those that are not given.
        """
        given = self.fields(cls, table, place, base)
        return FAILED if isinstance(given, Failed) else self.made(cls, given, place)

    def fields(
        self,
        cls: type[Value],
        table: Mapping[str, Any],
        place: Place,
        base: Value | None = None,
        also: tuple[str, ...] = (),
    ) -> dict[str, Any] | Failed:
        """The fields of a class that a table gives, read; those of `base` for the others.

        also: keys that the table may have besides, which somebody else reads.
        """
        shapes = field_shapes(cls)
        keys = {key: one for one in shapes.values() for key in one.keys}
        given: dict[str, Any] = {}
        by: dict[str, str] = {}
        for key, item in table.items():
            here = (*place, key)
            if key == "type":
                continue
            if key not in keys:
                self.faults.add(here, _unknown(key, shapes, also))
                given[_meant(key, shapes)] = FAILED
                continue
            field = keys[key]
            if field.name in by:
                self.faults.add(here, f"is given twice, {by[field.name]} says the same; allowed: one of them")
                given[field.name] = FAILED
                continue
            by[field.name] = key
            given[field.name] = self._item_of(field, item, here, field.ending(key))
        for field in shapes.values():
            if field.name in given:
                continue
            if base is not None:
                given[field.name] = getattr(base, field.name)
            elif field.required:
                self.faults.add((*place, field.keys[0]), "missing; it has no default")
                given[field.name] = FAILED
            elif field.allows_none and _has_no_default(cls, field.name):
                given[field.name] = None
        return FAILED if FAILED in given.values() else given

    def made(self, cls: type[Value], given: Mapping[str, Any], place: Place) -> Any:
        """A value of its fields; FAILED, with the file and the place before what the class says of them."""
        try:
            return cls(**given)
        except InputError as error:
            for line in str(error).splitlines():
                self._of_class(cls, line, place)
            return FAILED

    def _of_class(self, cls: type[Value], line: str, place: Place) -> None:
        """What a class says of its fields, in the words of the file."""
        name = cls.__name__
        if line.startswith(f"{name}."):
            whole = ".".join(filter(None, (said_place(place), line[len(name) + 1 :])))
            self.faults.add((), _in_file_units(whole))
        else:
            self.faults.add(place, _in_file_units(line.removeprefix(f"{name}: ")))

    def _item_of(self, field: FieldShape, item: Any, place: Place, ending: str) -> Any:
        if field.unit is not None and not ending and _holds_number(item):
            self.faults.add(place, f"a number needs its unit in the key; allowed: {', '.join(field.keys[:-1])}")
            return FAILED
        return self.item(field.shape, item, place, field.unit, ending)

    def item(self, shape: Shape, item: Any, place: Place, unit: Unit | None = None, ending: str = "") -> Any:
        """What an item of a file means, where something of a shape is wanted.

        unit, ending: of its numbers. FAILED if it does not fit.
        """
        if isinstance(item, (dict, list)) and len(place) > 2 * DEEPEST:
            self.faults.add(place[:4], f"is nested too deep; allowed: {DEEPEST} levels")
            return FAILED
        if isinstance(shape, Either):
            fitting = [one for one in shape.options if _is_for(one, item)]
            if not fitting:
                self.faults.wrong(place, item, allowed(shape, unit, ending))
                return FAILED
            return self.item(fitting[0], item, place, unit, ending)
        if isinstance(shape, Group):
            return self._group(shape, item, place)
        if not _is_for(shape, item):
            range_ = allowed(shape, unit, ending)
            kind = "a number " if isinstance(shape, Number) and not range_.startswith("a ") else ""
            self.faults.wrong(place, item, kind + range_)
            return FAILED
        match shape:
            case Number():
                return self._number(shape, item, place, unit, ending)
            case Choice():
                return next(one for one in shape.options if one == item)
            case Fixed():
                return self._all(zip(shape.items, item, strict=True), place, unit, ending)
            case Several():
                found = self._all(((shape.item, one) for one in item), place, unit, ending)
                return found if found is FAILED else shape.made(found)
            case Named():
                named = {
                    name: self.item(shape.item, one, (*place, name), unit, ending) for name, one in item.items()
                }
                return FAILED if FAILED in named.values() else named
        return item

    def _all(self, pairs: Any, place: Place, unit: Unit | None, ending: str) -> Any:
        """A tuple of items, each of its shape."""
        *before, last = place or ("",)
        found = tuple(
            self.item(shape, one, (*before, f"{last}[{n}]"), unit, ending)
            for n, (shape, one) in enumerate(pairs)
        )
        return FAILED if FAILED in found else found

    def _group(self, shape: Group, item: Any, place: Place) -> Any:
        for base, short_form in self.short_forms.items():
            if any(issubclass(one, base) for one in shape.bases):
                found = short_form(self, item, place)
                if found is not None:
                    return found
        if not isinstance(item, dict):
            self.faults.wrong(place, item, allowed(shape))
            return FAILED
        cls = self.kind(shape, item, place)
        return FAILED if cls is None else self.value(cls, item, place)

    def kind(self, shape: Group, table: Mapping[str, Any], place: Place) -> type[Value] | None:
        """The class that a table says it is of; None if that is not known."""
        name = table.get("type")
        if name is None:
            if shape.usual is None:
                self.faults.add((*place, "type"), f"missing; allowed: {', '.join(shape.kinds) or 'none'}")
            return shape.usual
        if not isinstance(name, str) or name not in shape.kinds:
            known = nearest(name if isinstance(name, str) else "", shape.kinds)
            said_kinds = f"{known}; classes of one's own: --import MODULE"
            self.faults.add((), f"{said_place((*place, 'type'))} = {said(name)}: {said_kinds}")
            return None
        return shape.kinds[name]

    def _number(self, shape: Number, item: Any, place: Place, unit: Unit | None, ending: str) -> Any:
        """A number in SI."""
        number = _in_si(item, unit, ending)
        if number is None or (shape.whole and number != math.floor(number)):
            self.faults.wrong(place, item, allowed(shape, unit, ending))
            return FAILED
        if not all(_within(number, bound) for bound in shape.bounds):
            self.faults.wrong(place, item, allowed(shape, unit, ending))
            return FAILED
        return int(number) if shape.whole else number


def read_value(
    cls: type[V],
    table: Mapping[str, Any],
    where: str = "",
    short_forms: Mapping[type[Value], ShortForm] | None = None,
) -> V:
    """A value from its table, as `load_toml` or a part of it gives it.

    Arguments:
        cls: a class of values, or a kind of them; then `type` in the table says which.
        table: of the value.
        where: what errors call it: the name of its file.
        short_forms: see `Reader`.

    Raises InputError with a line for everything that is wrong: file, key, value, and what is allowed.
    """
    faults = Faults(where)
    found = Reader(faults, short_forms).item(Group((cls,)), table, ())
    faults.check()
    return found  # type: ignore[no-any-return]


def _in_file_units(line: str) -> str:
    """What a class says in metres, in mm; without the question whether that is what was given."""
    return in_millimetres(line).replace(" (is it given in mm?)", "")


def _has_no_default(cls: type[Value], name: str) -> bool:
    info = cls.__pydantic_fields__[name]  # type: ignore[attr-defined]
    return bool(info.is_required())


def _unknown(key: str, shapes: Mapping[str, FieldShape], also: tuple[str, ...]) -> str:
    """What is said of a key that no field has: what it may have been meant to be."""
    for field in shapes.values():
        if field.unit is not None and key.startswith(f"{field.name}_"):
            return f"has another unit; allowed: {', '.join(field.keys)}"
        if key == field.name:
            return f"is written with its unit; allowed: {', '.join(field.keys)}"
    usual = [*also, *(one.keys[0] for one in shapes.values())]
    every = [*also, *(key for one in shapes.values() for key in one.keys)]
    known = nearest(key, every)
    guess = known.partition("allowed: ")[0]
    return f"unknown key; {guess}allowed: {', '.join(usual) or 'none'}"


def _meant(key: str, shapes: Mapping[str, FieldShape]) -> str:
    """The field that a wrong key is of, as far as that can be told, so that it is not called missing too."""
    for field in shapes.values():
        if key == field.name or key.startswith(f"{field.name}_"):
            return field.name
    known = {key: one.name for one in shapes.values() for key in one.keys}
    from difflib import get_close_matches

    near = get_close_matches(key[:80], known, 1)
    return known[near[0]] if near else key


def _holds_number(item: Any) -> bool:
    if isinstance(item, list):
        return any(map(_holds_number, item[:100]))
    return isinstance(item, (int, Decimal)) and not isinstance(item, bool)


def _is_for(shape: Shape, item: Any) -> bool:
    """Whether an item is of the kind that a shape takes, whatever its range."""
    match shape:
        case Number():
            return isinstance(item, (int, float, Decimal)) and not isinstance(item, bool)
        case Text():
            return isinstance(item, str)
        case Truth():
            return isinstance(item, bool)
        case Choice():
            same = isinstance(item, (str, bool, int, Decimal))
            return same and any(type(one) is type(item) and one == item for one in shape.options)
        case Fixed():
            return isinstance(item, list) and len(item) == len(shape.items)
        case Several():
            return isinstance(item, list)
        case Named() | Group():
            return isinstance(item, dict)
        case Either():
            return any(_is_for(one, item) for one in shape.options)


def _in_si(item: int | float | Decimal, unit: Unit | None, ending: str) -> float | None:
    """A number in SI, rounded once; None if it is not finite or too large."""
    if isinstance(item, int) and abs(item) > LARGEST * 1e9:
        return None
    written = Decimal(repr(item)) if isinstance(item, float) else Decimal(item)
    if not written.is_finite() or written.adjusted() > math.log10(LARGEST) + 10:
        return None
    if written.adjusted() < SMALLEST_EXPONENT:
        return 0.0
    number = float(written) if unit is None else unit.read(written, ending)
    return number if abs(number) <= LARGEST else None


def _within(number: float, bound: Bound) -> bool:
    sign, limit = bound
    match sign:
        case ">":
            return number > limit
        case ">=":
            return number >= limit
        case "<":
            return number < limit
    return number <= limit
