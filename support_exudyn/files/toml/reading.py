"""Tables of files are read as values: keys become fields in SI, which pydantic checks."""

import math
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from difflib import get_close_matches
from functools import partial
from typing import Any, TypeVar

from pydantic import ValidationError

from support_exudyn.files.toml.faults import Faults, Place, dotted_key, nearest, place_text, quoted
from support_exudyn.files.toml.shapes import (
    BOUNDS,
    SOURCED_KEYS,
    FieldShape,
    GroupShape,
    Shape,
    allowed,
    either,
    field_shapes,
    inner_shape,
    is_number,
    options,
)
from user_forces.values.sourced import SourcedNumber
from user_forces.values.units import Unit
from user_forces.values.value import (
    LARGEST,
    LENGTHS,
    InputError,
    Value,
    of_earlier_version,
    removed_fields,
    validated,
)

V = TypeVar("V", bound=Value)
SMALLEST_EXPONENT = -1000  # of a decimal; what is smaller is 0
ShortForm = Callable[["Reader", Any, Place], Any]


FAILED: Any = object()  # stands for a value that could not be read; the reason is among the faults


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

    def value(
        self,
        cls: type[Value],
        table: Mapping[str, Any],
        place: Place,
        base: Value | None = None,
        also: tuple[str, ...] = (),
    ) -> Any:
        """A value of a class from its table, whose `type` is known to fit; FAILED if something is wrong.

        base: a value whose fields stand for those that are not given. also: keys that the table may have
        besides, which somebody else reads.
        """
        before, fields, found = len(self.faults.lines), field_shapes(cls), FAILED
        table = of_earlier_version(cls, table)
        given, keys = self._given(cls, table, place, also)
        for field in fields.values():
            if field.name not in given and base is not None:
                given[field.name] = getattr(base, field.name)
            elif field.name not in given and field.allows_none and field.default is None:
                given[field.name] = None
        try:
            found = validated(cls, given)
        except ValidationError as error:
            self._note(error, fields, {name: (key, table[key]) for name, key in keys.items()}, place)
        except InputError as error:
            self.faults.add(place, str(error).removeprefix(f"{cls.__name__}: "))
        return FAILED if len(self.faults.lines) > before else found

    def _given(
        self, cls: type[Value], table: Mapping[str, Any], place: Place, also: tuple[str, ...]
    ) -> tuple[dict[str, Any], dict[str, str]]:
        """The fields that a table gives, in SI, FAILED for those of wrong keys; and their keys."""
        fields = field_shapes(cls)
        known = {key: one for one in fields.values() for key in one.keys}
        given: dict[str, Any] = {}
        by: dict[str, str] = {}
        for key, item in table.items():
            if key == "type":
                continue
            field, here = known.get(key), (*place, key)
            if field is None:
                meant, reason = "", "unknown key"
                if not self.faults.is_full:
                    meant, reason = _removed(cls, key) or _unknown(key, fields, also)
                self.faults.add(here, reason)
                if meant in fields:
                    given[meant] = FAILED
            elif field.name in by:
                self.faults.add(here, f"is given twice, {by[field.name]} says the same; allowed: one of them")
                given[field.name] = FAILED
            elif field.unit is not None and not field.ending(key) and _holds_number(item):
                allowed_keys = ", ".join(field.keys[:-1])
                self.faults.add(here, f"a number needs its unit in the key; allowed: {allowed_keys}")
                given[field.name] = FAILED
            else:
                by[field.name] = key
                given[field.name] = self._in_si(field.shape, item, here, field.unit, field.ending(key))
        return given, by

    def _note(
        self,
        found: ValidationError,
        fields: Mapping[str, FieldShape],
        given: Mapping[str, tuple[str, Any]],
        place: Place,
    ) -> None:
        """Note pydantic's errors of a table; given: by the names of fields, their keys and items."""
        notes: dict[tuple[Any, ...], Callable[[], None] | None] = {}  # by their places; None: is noted already
        errors: list[Any] = list(found.errors(include_url=False))
        extra = [error["loc"] for error in errors if error["type"] == "extra_forbidden"]
        for error in errors:
            name, *rest = error["loc"] or ("",)
            if not name:
                for line in str(error.get("ctx", {}).get("error", error["msg"])).splitlines():
                    self.faults.add(place, line)
            elif error["input"] is FAILED:
                notes[error["loc"]] = None
            elif name not in given:
                self.faults.add((*place, fields[name].keys[0]), "missing; it has no default")
            else:
                field, (key, item) = fields[name], given[name]
                shape, here, at = field.shape, (*place, key), error["loc"][:1]
                for part in rest:
                    if isinstance(part, str) and not isinstance(item, dict):  # how pydantic names a choice
                        continue
                    if not _has(item, part) or (*at, part) in extra:
                        break
                    shape, item, at = inner_shape(shape, part), item[part], (*at, part)
                    here = (*here[:-1], f"{here[-1]}[{part}]") if isinstance(part, int) else (*here, part)
                last = str(error["loc"][-1])
                if error["loc"] in extra:
                    hint = "" if self.faults.is_full else f"; {nearest(last, shape['properties'])}"
                    self.faults.add((*here, last), f"unknown key{hint}")
                elif error["type"] == "missing" and isinstance(item, dict):
                    near = (get_close_matches(str(one[-1])[:80], [last], 1) for one in extra if one[:-1] == at)
                    if not any(near):  # else it is misspelt
                        said_of_it = shape["properties"][last]["description"]
                        self.faults.add((*here, last), f"missing; it has no default: {said_of_it}")
                else:
                    note = partial(self._refuse, shape, item, here, field.unit, field.ending(key), error)
                    notes.setdefault(at, note)
        for at, one in notes.items():
            if one is not None and not any(len(other) > len(at) and other[: len(at)] == at for other in notes):
                one()

    def _refuse(
        self, shape: Shape, item: Any, place: Place, unit: Unit | None, ending: str, error: Any = None
    ) -> None:
        """Note an item that does not fit, and what does; error: pydantic's, whose own words may be better."""
        said_of_item = f"{place_text(place)} = {quoted(item)}"
        shape = either([one for one in options(shape) if _is_of_kind(one, item)] or options(shape))
        if "names" in shape and isinstance(item, str):
            names = shape["names"]
            more = f"; {names.instead(item)}" if names.instead else ""
            self.faults.add((), f"{said_of_item}: {nearest(item, names.options)}{more}")
            return
        if error is not None and error["type"] == "value_error" and _is_for(shape, item, unit, ending):
            self.faults.add((), f"{said_of_item}: {error['ctx']['error']}")
            return
        if error is not None and error["type"] in LENGTHS and "prefixItems" not in shape:
            least, most = (error["ctx"].get(f"{end}_length") for end in ("min", "max"))
            self.faults.wrong(place, item, f"at least {least} items" if least else f"at most {most} items")
            return
        range_ = allowed(shape, unit, ending)
        if is_number(shape) and not _is_number(item):
            range_ = range_ if range_.startswith("a ") else f"a number {range_}"
        elif is_number(shape) and not abs(_number_in_si(item, unit, ending)) <= LARGEST:
            range_ += f" up to {LARGEST:g}, in SI"
        self.faults.wrong(place, item, range_)

    def _in_si(self, shape: Shape, item: Any, place: Place, unit: Unit | None, ending: str) -> Any:
        """An item as pydantic takes it: numbers in SI, values of classes; FAILED if it is wrong inside."""
        several = options(shape)
        if item is FAILED:
            return item
        if _is_number(item) and shape.get("type") != "boolean":
            return item if unit is None and isinstance(item, int) else _number_in_si(item, unit, ending)
        if isinstance(item, dict) and self.sourced is not None and _says_more(shape, item):
            return self._sourced(self.sourced, shape, item, place, unit, ending)
        group = next((one["group"] for one in several if "group" in one), None)
        if group is not None and (len(several) == 1 or isinstance(item, dict)):
            return self.member(group, item, place)
        if shape.get("type") == "boolean" and not isinstance(item, bool):  # where pydantic takes "yes", too
            self._refuse(shape, item, place, unit, ending)
            return FAILED
        if isinstance(item, list):
            *before, last = place or ("",)
            return tuple(
                self._in_si(inner_shape(shape, n), one, (*before, f"{last}[{n}]"), unit, ending)
                for n, one in enumerate(item)
            )
        if not isinstance(item, dict):
            return item
        return {
            name: self._in_si(inner_shape(shape, name), one, (*place, name), unit, ending)
            for name, one in item.items()
        }

    def _sourced(
        self,
        found: dict[str, SourcedNumber],
        shape: Shape,
        table: Mapping[str, Any],
        place: Place,
        unit: Unit | None,
        ending: str,
    ) -> Any:
        """The value in SI of a number that is a table with its range and source, which is put into `found`."""
        before = len(self.faults.lines)
        shape = next(one for one in options(shape) if is_number(one))
        for key in [one for one in table if one not in SOURCED_KEYS]:
            self.faults.add((*place, key), f"unknown key; {nearest(key, SOURCED_KEYS)}")
        numbers = {key: table[key] for key in ("value", "from", "to") if key in table}
        for key, item in numbers.items():
            if not (_is_number(item) and _is_within(_number_in_si(item, unit, ending), shape)):
                self._refuse(shape, item, (*place, key), unit, ending)
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
                self.faults.wrong((*place, "from"), low, f"<= to = {quoted(high)}")
            elif not low <= table["value"] <= high:
                self.faults.wrong((*place, "value"), table["value"], f"from {quoted(low)} to {quoted(high)}")
        if len(self.faults.lines) > before:
            return FAILED
        written = {key: Decimal(str(item)) for key, item in numbers.items()}
        found[dotted_key(place)] = SourcedNumber(
            written["value"], written.get("from"), written.get("to"), source
        )
        return _number_in_si(table["value"], unit, ending)

    def member(self, group: GroupShape, item: Any, place: Place) -> Any:
        """A value of a group of classes from an item of a file; FAILED, with the reason among the faults."""
        for base, short_form in self.short_forms.items():
            if any(issubclass(one, base) for one in group.bases):
                found = short_form(self, item, place)
                if found is not None:
                    return found
        if isinstance(item, group.bases):  # made by a program, see `simple_scenario`
            return item
        if not isinstance(item, dict):
            self._refuse({"group": group}, item, place, None, "")
            return FAILED
        name = item.get("type")
        cls = group.usual if name is None else group.kinds.get(name) if isinstance(name, str) else None
        if cls is not None:
            return self.value(cls, item, place)
        if name is None:
            self.faults.add((*place, "type"), f"missing; allowed: {', '.join(group.kinds) or 'none'}")
        else:
            known = f"{nearest(str(name), group.kinds)}; classes of one's own: --import FILE"
            self.faults.add((), f"{place_text((*place, 'type'))} = {quoted(name)}: {known}")
        return FAILED


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
    found = Reader(faults, short_forms, sourced).member(GroupShape((cls,)), table, ())
    faults.check()
    return found  # type: ignore[no-any-return]


def _removed(cls: type[Value], key: str) -> tuple[str, str] | None:
    """The field that there once was of which a key is, with or without its unit, and what is said of it."""
    for name, instead in removed_fields(cls).items():
        if key == name or key.startswith(f"{name}_"):
            return key, f"there is no such key any more; {instead}"
    return None


def _unknown(key: str, fields: Mapping[str, FieldShape], also: Iterable[str]) -> tuple[str, str]:
    """The field that a wrong key may mean, so that it is not called missing too; and what is said of it."""
    for field in fields.values():
        if field.unit is not None and key.startswith(f"{field.name}_"):
            return field.name, f"has another unit; allowed: {', '.join(field.keys)}"
        if key == field.name:
            return field.name, f"is written with its unit; allowed: {', '.join(field.keys)}"
    of = {key: one.name for one in fields.values() for key in one.keys}
    guess = nearest(key, [*also, *of]).partition("allowed: ")[0]
    usual = ", ".join([*also, *(one.keys[0] for one in fields.values())])
    near = get_close_matches(key[:80], of, 1)
    return of[near[0]] if near else key, f"unknown key; {guess}allowed: {usual or 'none'}"


def _says_more(shape: Shape, item: Mapping[str, Any]) -> bool:
    """Whether a table is that of a number; one of another kind, which may be there, says its type."""
    several = options(shape)
    tables = any("group" in one or one.get("type") == "object" for one in several)
    return any(map(is_number, several)) and (not tables or ("value" in item and "type" not in item))


def _is_of_kind(shape: Shape, item: Any) -> bool:
    """Whether an item is a table, list, text or number, as a shape is."""
    if isinstance(item, dict):
        return "group" in shape or shape.get("type") == "object"
    if isinstance(item, list):
        return shape.get("type") == "array"
    return is_number(shape) if _is_number(item) else isinstance(item, str) and shape == {"type": "string"}


def _is_for(shape: Shape, item: Any, unit: Unit | None, ending: str) -> bool:
    """Whether an item is of a kind of a shape, so that a check of a class has refused it."""
    fitting = [one for one in options(shape) if _is_of_kind(one, item)]
    if _is_number(item):
        return any(_is_within(_number_in_si(item, unit, ending), one) for one in fitting)
    return bool(fitting)


def _is_number(item: Any) -> bool:
    return isinstance(item, (int, float, Decimal)) and not isinstance(item, bool)


def _holds_number(item: Any) -> bool:
    if isinstance(item, list):
        return any(map(_holds_number, item[:100]))
    if isinstance(item, dict):
        return "type" not in item and _holds_number(item.get("value"))
    return _is_number(item)


def _has(item: Any, part: Any) -> bool:
    """Whether a table or a list has an entry."""
    if isinstance(item, list):
        return isinstance(part, int) and part < len(item)
    return isinstance(item, dict) and part in item


def _number_in_si(item: int | float | Decimal, unit: Unit | None, ending: str) -> float:
    """A number in SI, rounded once; infinite if it is too large, or none."""
    if isinstance(item, int) and abs(item) > LARGEST * 1e9:
        return math.inf
    written = Decimal(repr(item)) if isinstance(item, float) else Decimal(item)
    if not written.is_finite() or written.adjusted() > math.log10(LARGEST) + 10:
        return math.inf
    if written.adjusted() < SMALLEST_EXPONENT:
        return 0.0
    return float(written) if unit is None else unit.read(written, ending)


def _is_within(number: float, shape: Shape) -> bool:
    """Whether a number is one of a shape."""
    if not abs(number) <= LARGEST or (shape["type"] == "integer" and number != math.floor(number)):
        return False
    return all(fits(number, shape[name]) for name, (*_, fits) in BOUNDS.items() if name in shape)
