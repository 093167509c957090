"""Tables of files are read as values, by what the values' classes declare."""

import math
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from difflib import get_close_matches
from typing import Any, TypeVar

from support_exudyn.files.toml.faults import Faults, Place, dotted_key, nearest, said, said_place
from support_exudyn.files.toml.shapes import (
    BOUNDS,
    SOURCED_KEYS,
    FieldShape,
    GroupShape,
    Shape,
    allowed,
    either,
    field_shapes,
    options,
)
from user_forces.values.sourced import SourcedNumber
from user_forces.values.units import Unit
from user_forces.values.value import DEEPEST, LARGEST, InputError, Value, of_earlier_version, removed_fields

V = TypeVar("V", bound=Value)
SMALLEST_EXPONENT = -1000  # of a decimal; what is smaller is 0
ShortForm = Callable[["Reader", Any, Place], Any]
UNKNOWN = "unknown key"


class Failed:
    """The stand-in for a value that could not be read; the reason is among the faults."""


FAILED = Failed()


class Reader:
    """Reads values from tables, and collects what is wrong with them.

    faults: what was wrong so far. short_forms: for a class, another way to write its values: is given the item
    and its place, and gives the value, FAILED, or None if the item is in the long form. sourced: where numbers
    may be tables `{ value, from, to, source }`, these are put there by their dotted keys; None: they may not.
    """

    def __init__(
        self,
        faults: Faults,
        short_forms: Mapping[type[Value], ShortForm] | None = None,
        sourced: dict[str, SourcedNumber] | None = None,
    ) -> None:
        self.faults = faults
        self.short_forms = dict(short_forms or {})
        self.sourced = sourced

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
        for key, item in of_earlier_version(cls, table).items():
            here = (*place, key)
            if key == "type":
                continue
            if key not in keys and self.faults.is_full:
                self.faults.lines.append(UNKNOWN)
                given[key] = FAILED
                continue
            if key not in keys:
                meant, reason = _removed(cls, key) or _unknown(key, shapes, also)
                self.faults.add(here, reason)
                given[meant] = FAILED
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
            elif field.allows_none and field.default is None:
                given[field.name] = None
        return FAILED if FAILED in given.values() else given

    def made(self, cls: type[Value], given: Mapping[str, Any], place: Place) -> Any:
        """A value of its fields; FAILED, with the file and the place before what the class says of them."""
        try:
            return cls(**given)
        except InputError as error:
            for line in str(error).splitlines():
                if line.startswith(f"{cls.__name__}."):
                    self.faults.add(
                        (), ".".join(filter(None, (said_place(place), line[len(cls.__name__) + 1 :])))
                    )
                else:
                    self.faults.add(place, line.removeprefix(f"{cls.__name__}: "))
            return FAILED

    def _item_of(self, field: FieldShape, item: Any, place: Place, ending: str) -> Any:
        if field.unit is not None and not ending and _holds_number(item):
            self.faults.add(place, f"a number needs its unit in the key; allowed: {', '.join(field.keys[:-1])}")
            return FAILED
        return self.item(field.shape, item, place, field.unit, ending)

    def item(self, shape: Shape, item: Any, place: Place, unit: Unit | None = None, ending: str = "") -> Any:
        """The meaning of an item of a file where something of a shape is wanted.

        unit, ending: of its numbers. FAILED if it does not fit.
        """
        if isinstance(item, (dict, list)) and len(place) > 2 * DEEPEST:
            self.faults.add(place[:4], f"is nested too deep; allowed: {DEEPEST} levels")
            return FAILED
        if "group" in shape:
            return self._group(shape, item, place)
        if self.sourced is not None and _says_more(shape, item):
            return self._sourced(self.sourced, _numeric(shape), item, place, unit, ending)
        if not is_for(shape, item):
            return self._refused(shape, item, place, unit, ending)
        match shape:
            case {"anyOf": several}:
                fitting = next(one for one in several if is_for(one, item))
                return self.item(fitting, item, place, unit, ending)
            case {"type": "number" | "integer" as kind}:
                number = _in_si(item, unit, ending)
                if number is None or not _is_within(number, shape):
                    return self._refused(shape, item, place, unit, ending)
                return int(number) if kind == "integer" else number
            case {"type": "array"}:
                shapes = shape.get("prefixItems", [shape.get("items")] * len(item))
                *before, last = place or ("",)
                pairs = ((one, (*before, f"{last}[{n}]")) for n, one in enumerate(shapes))
                found = [self.item(one, item[n], at, unit, ending) for n, (one, at) in enumerate(pairs)]
                return FAILED if FAILED in found else tuple(found)
            case {"type": "object"}:
                return self._table(shape, item, place, unit, ending)
        return item

    def _refused(self, shape: Shape, item: Any, place: Place, unit: Unit | None, ending: str) -> Failed:
        if "names" in shape and isinstance(item, str):
            names = shape["names"]
            more = f"; {names.instead(item)}" if names.instead else ""
            self.faults.add((), f"{said_place(place)} = {said(item)}: {nearest(item, names.options)}{more}")
            return FAILED
        range_ = allowed(shape, unit, ending)
        if shape.get("type") in ("number", "integer"):
            if not is_for(shape, item):
                range_ = range_ if range_.startswith("a ") else f"a number {range_}"
            elif _in_si(item, unit, ending) is None:
                range_ += f" up to {LARGEST:g}, in SI"
        self.faults.wrong(place, item, range_)
        return FAILED

    def _sourced(
        self,
        found: dict[str, SourcedNumber],
        shape: Shape,
        table: Mapping[str, Any],
        place: Place,
        unit: Unit | None,
        ending: str,
    ) -> Any:
        """The value of a number that is a table with its range and source; the whole is put into `found`."""
        before = len(self.faults.lines)
        for key in [one for one in table if one not in SOURCED_KEYS]:
            guess = "" if self.faults.is_full else nearest(key, SOURCED_KEYS)
            self.faults.add((*place, key), f"{UNKNOWN}; {guess}")
        numbers = {key: table[key] for key in ("value", "from", "to") if key in table}
        for key, item in numbers.items():
            if is_for(shape, item):
                numbers[key] = self.item(shape, item, (*place, key), unit, ending)
            else:
                self._refused(shape, item, (*place, key), unit, ending)
        if "value" not in table and table.keys() <= SOURCED_KEYS.keys():  # it may be misspelt
            self.faults.add((*place, "value"), "missing; it has no default")
        for one, other in (("from", "to"), ("to", "from")):
            if one in table and other not in table:
                self.faults.add((*place, other), "missing; a range has from and to")
        source = table.get("source", "")
        if not isinstance(source, str) or ("source" in table and not source.strip()):
            self.faults.wrong((*place, "source"), source, "a text that is not empty")
        if len(self.faults.lines) == before and "from" in table:
            low, high = table["from"], table["to"]
            if low > high:
                self.faults.wrong((*place, "from"), low, f"<= to = {said(high)}")
            elif not low <= table["value"] <= high:
                self.faults.wrong((*place, "value"), table["value"], f"from {said(low)} to {said(high)}")
        if len(self.faults.lines) > before:
            return FAILED
        written = {key: Decimal(str(table[key])) for key in numbers}
        found[dotted_key(place)] = SourcedNumber(
            written["value"], written.get("from"), written.get("to"), source
        )
        return numbers["value"]

    def _table(self, shape: Shape, table: Any, place: Place, unit: Unit | None, ending: str) -> Any:
        """A table of items by name: of any, or of those that the shape has."""
        known: Mapping[str, Shape] = shape.get("properties", {})
        found: dict[str, Any] = {}
        for name, item in table.items():
            here = (*place, name)
            if self.faults.is_full:
                self.faults.lines.append(UNKNOWN)
                found[name] = FAILED
            elif inner := known.get(name, shape.get("additionalProperties")):
                found[name] = self.item(inner, item, here, unit, ending)
            else:
                self.faults.add(here, f"unknown key; {nearest(name, known)}")
                meant = get_close_matches(name[:80], known, 1)  # which is not called missing too
                found[meant[0] if meant else name] = FAILED
        for name in shape.get("required", ()):
            if name not in found:
                self.faults.add((*place, name), f"missing; it has no default: {known[name]['description']}")
                found[name] = FAILED
        return FAILED if FAILED in found.values() else found

    def _group(self, shape: Shape, item: Any, place: Place) -> Any:
        group: GroupShape = shape["group"]
        for base, short_form in self.short_forms.items():
            if any(issubclass(one, base) for one in group.bases):
                found = short_form(self, item, place)
                if found is not None:
                    return found
        if isinstance(item, group.bases):  # made by a program, see `simple_scenario`
            return item
        if not isinstance(item, dict):
            return self._refused(shape, item, place, None, "")
        cls = self._kind(group, item, place)
        return FAILED if cls is None else self.value(cls, item, place)

    def _kind(self, group: GroupShape, table: Mapping[str, Any], place: Place) -> type[Value] | None:
        """The class that a table says it is of; None if that is not known."""
        name = table.get("type")
        if name is None:
            if group.usual is None:
                self.faults.add((*place, "type"), f"missing; allowed: {', '.join(group.kinds) or 'none'}")
            return group.usual
        if not isinstance(name, str) or name not in group.kinds:
            known = nearest(name if isinstance(name, str) else "", group.kinds)
            said_kinds = f"{known}; classes of one's own: --import FILE"
            self.faults.add((), f"{said_place((*place, 'type'))} = {said(name)}: {said_kinds}")
            return None
        return group.kinds[name]


def read_value(
    cls: type[V],
    table: Mapping[str, Any],
    where: str = "",
    short_forms: Mapping[type[Value], ShortForm] | None = None,
    sourced: dict[str, SourcedNumber] | None = None,
) -> V:
    """A value from its table, as `load_toml` or a part of it gives it.

    Arguments:
        cls: a class of values, or a kind of them; then `type` in the table says which.
        table: of the value.
        where: what errors call it: the name of its file.
        short_forms, sourced: see `Reader`.

    Raises InputError with a line for everything that is wrong: file, key, value, and what is allowed.
    """
    faults = Faults(where)
    found = Reader(faults, short_forms, sourced).item({"group": GroupShape((cls,))}, table, ())
    faults.check()
    return found  # type: ignore[no-any-return]


def _removed(cls: type[Value], key: str) -> tuple[str, str] | None:
    """The field that there once was of which a key is, with or without its unit, and what is said of it."""
    for name, instead in removed_fields(cls).items():
        if key == name or key.startswith(f"{name}_"):
            return key, f"there is no such key any more; {instead}"
    return None


def _unknown(key: str, shapes: Mapping[str, FieldShape], also: Iterable[str]) -> tuple[str, str]:
    """The field that a wrong key may mean, so that it is not called missing too; and what is said of it."""
    for field in shapes.values():
        if field.unit is not None and key.startswith(f"{field.name}_"):
            return field.name, f"has another unit; allowed: {', '.join(field.keys)}"
        if key == field.name:
            return field.name, f"is written with its unit; allowed: {', '.join(field.keys)}"
    of = {key: one.name for one in shapes.values() for key in one.keys}
    guess = nearest(key, [*also, *of]).partition("allowed: ")[0]
    usual = ", ".join([*also, *(one.keys[0] for one in shapes.values())])
    near = get_close_matches(key[:80], of, 1)
    return of[near[0]] if near else key, f"unknown key; {guess}allowed: {usual or 'none'}"


def _says_more(shape: Shape, item: Any) -> bool:
    """Whether an item is the table of a number; one of another kind, which may be there, says its type."""
    if not isinstance(item, dict) or not is_for(shape, 0):
        return False
    return not is_for(shape, item) or ("value" in item and "type" not in item)


def _numeric(shape: Shape) -> Shape:
    """The shape of a number, where that is among what may be."""
    return either([one for one in options(shape) if one.get("type") in ("number", "integer")])


def _holds_number(item: Any) -> bool:
    if isinstance(item, list):
        return any(map(_holds_number, item[:100]))
    if isinstance(item, dict):
        return "type" not in item and _holds_number(item.get("value"))
    return isinstance(item, (int, Decimal)) and not isinstance(item, bool)


def is_for(shape: Shape, item: Any) -> bool:
    """Whether an item is of the kind that a shape takes, whatever its range."""
    match shape:
        case {"anyOf": several}:
            return any(is_for(one, item) for one in several)
        case {"group": group}:
            return isinstance(item, (dict, *group.bases))
        case {"type": "object"}:
            return isinstance(item, dict)
        case {"enum": choices}:
            return any(type(one) is type(item) and one == item for one in choices)
        case {"names": names}:
            return isinstance(item, str) and item in names.options
        case {"type": "array"}:
            return isinstance(item, list) and len(item) == len(shape.get("prefixItems", item))
        case {"type": "number" | "integer"}:
            return isinstance(item, (int, float, Decimal)) and not isinstance(item, bool)
    return isinstance(item, str if shape["type"] == "string" else bool)


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


def _is_within(number: float, shape: Shape) -> bool:
    """Whether a number is one of a shape."""
    bounds = (fits(number, shape[name]) for name, (*_, fits) in BOUNDS.items() if name in shape)
    return all(bounds) and (shape["type"] == "number" or number == math.floor(number))
