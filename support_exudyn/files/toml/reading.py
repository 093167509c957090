"""Tables of files are read as values: keys become fields in SI, which pydantic validates."""

import math
from collections.abc import Callable, Mapping
from decimal import Decimal
from difflib import get_close_matches
from typing import Any, TypeVar

from pydantic import ValidationError

from support_exudyn.files.toml.faults import Faults, Place, dotted_key, quoted
from support_exudyn.files.toml.shapes import (
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
    within,
)
from user_forces.values.names import nearest
from user_forces.values.sourced import SourcedNumber
from user_forces.values.units import Unit
from user_forces.values.value import LARGEST, LENGTHS, InputError, Value, validated

V = TypeVar("V", bound=Value)
SMALLEST_EXPONENT = -1000  # of a decimal; smaller numbers are 0
ShortForm = Callable[["Reader", Any, Place], Any]

FAILED: Any = object()  # stands for a value that could not be read; the reason is among the faults


class Reader:
    """Reads values from tables, and collects their faults.

    faults: collects them. short_forms: by class, another way to write its values: takes the reader, the item
    and its place, and returns the value, FAILED, or None if the item is in the long form. sourced: numbers with
    a range by their dotted keys, whose ends are to lie in the range of their field.
    """

    def __init__(
        self,
        faults: Faults,
        short_forms: Mapping[type[Value], ShortForm] | None = None,
        sourced: Mapping[str, SourcedNumber] | None = None,
    ) -> None:
        self.faults = faults
        self.short_forms = dict(short_forms or {})
        self.sourced = sourced or {}

    def value(
        self,
        cls: type[Value],
        table: Mapping[str, Any],
        place: Place,
        base: Value | None = None,
        also: tuple[str, ...] = (),
    ) -> Any:
        """A value of a class from its table, whose `type` is known to fit; FAILED if the table has faults.

        base: a value whose fields replace missing ones. also: keys of the table that are read elsewhere.
        """
        before, fields, found = len(self.faults.lines), field_shapes(cls), FAILED
        table = cls.of_earlier(table)
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
        known = {key: field for field in fields.values() for key in field.keys}
        given: dict[str, Any] = {}
        keys: dict[str, str] = {}
        for key, item in table.items():
            if key == "type":
                continue
            field, fault = known.get(key), ""
            if field is None:
                name, fault = _unknown(cls, key, also)
            elif (name := field.name) in keys:
                fault = f"is given twice, {keys[name]} says the same; allowed: one of them"
            elif field.unit is not None and not field.ending(key) and _holds_number(item):
                fault = f"a number needs its unit in the key; allowed: {', '.join(field.keys[:-1])}"
            if fault:
                self.faults.add((*place, key), fault)
            if field is None or fault:
                given |= {name: FAILED} if name in fields else {}
            else:
                keys[name] = key
                given[name] = self._in_si(field.shape, item, (*place, key), field.unit, field.ending(key))
        return given, keys

    def _note(
        self,
        found: ValidationError,
        fields: Mapping[str, FieldShape],
        given: Mapping[str, tuple[str, Any]],
        place: Place,
    ) -> None:
        """Note pydantic's errors of a table; given: by the names of fields, their keys and items."""
        notes: dict[tuple[Any, ...], tuple[Any, ...] | None] = {}  # by their locations; None: is noted already
        for error in found.errors(include_url=False):
            name, *rest = error["loc"] or ("",)
            if not name:
                for line in str(error.get("ctx", {}).get("error", error["msg"])).splitlines():
                    self.faults.add(place, line)
            elif error["input"] is FAILED:
                notes[error["loc"]] = None
            elif name not in given:
                self.faults.add((*place, fields[str(name)].keys[0]), "missing; it has no default")
            else:
                field, (key, item) = fields[str(name)], given[str(name)]
                outer = shape = field.shape
                here, last = (*place, key), str(error["loc"][-1])
                at: tuple[Any, ...] = (name,)
                for part in rest:
                    if isinstance(part, str) and not isinstance(item, dict):  # pydantic's name of a choice
                        continue
                    if not _has(item, part):
                        break
                    outer, shape = shape, inner_shape(shape, part)
                    item, at = item[part], (*at, part)
                    here = (*here[:-1], f"{here[-1]}[{part}]") if isinstance(part, int) else (*here, str(part))
                if error["type"] == "extra_forbidden":
                    self.faults.add(here, f"unknown key; {nearest(last, outer['properties'])}")
                elif error["type"] == "missing" and isinstance(item, dict):
                    meaning = shape["properties"][last]["description"]
                    self.faults.add((*here, last), f"missing; it has no default: {meaning}")
                else:
                    notes.setdefault(at, (here, item, shape, field.unit, field.ending(key), error))
        for at, note in notes.items():
            if note and not any(len(other) > len(at) and other[: len(at)] == at for other in notes):
                self._refuse(*note)

    def _refuse(
        self,
        place: Place,
        item: Any,
        shape: Shape,
        unit: Unit | None = None,
        ending: str = "",
        error: Any = None,
    ) -> None:
        """Note an item that does not fit, and what does; error: pydantic's."""
        shape = either([each for each in options(shape) if _is_of_kind(each, item)] or options(shape))
        kind = "" if error is None else error["type"]
        if is_number(shape) and isinstance(item, dict) and item.keys() - SOURCED_KEYS.keys():
            for key in item.keys() - SOURCED_KEYS.keys():
                self.faults.add((*place, key), f"unknown key; {nearest(key, SOURCED_KEYS)}")
            return
        text = f"allowed: {allowed(shape, unit, ending)}"
        if "names" in shape and isinstance(item, str):
            names = shape["names"]
            text = "; ".join(filter(None, (nearest(item, names.options), names.instead)))
        elif kind in LENGTHS and "prefixItems" not in shape:
            least, most = (error["ctx"].get(f"{end}_length") for end in ("min", "max"))
            text = f"allowed: {f'at least {least}' if least else f'at most {most}'} items"
        elif is_number(shape) and not _is_number(item):
            text = text if text.startswith("allowed: a ") else f"allowed: a number {text[9:]}"
        elif is_number(shape) and not abs(_number_in_si(item, unit, ending)) <= LARGEST:
            text += f" up to {LARGEST:g}, in SI"
        elif kind == "value_error" and any(_is_of_kind(each, item) for each in options(shape)):
            is_whole = shape.get("type") != "integer" or item == math.floor(item)
            text = str(error["ctx"]["error"]) if is_whole else text
        self.faults.refuse(place, item, text)

    def _in_si(self, shape: Shape, item: Any, place: Place, unit: Unit | None, ending: str) -> Any:
        """An item as pydantic takes it: numbers in SI, values of classes; FAILED if it has faults inside."""
        several = options(shape)
        if item is FAILED:
            return item
        if _is_number(item) and shape.get("type") != "boolean":
            if self.sourced and (number := self.sourced.get(dotted_key(place))):
                self._check_ends(number, shape, place, unit, ending)
            return item if unit is None and isinstance(item, int) else _number_in_si(item, unit, ending)
        group = next((each["group"] for each in several if "group" in each), None)
        if group is not None and (len(several) == 1 or isinstance(item, dict)):
            return self.member(group, item, place)
        if shape.get("type") == "boolean" and not isinstance(item, bool):  # pydantic takes "yes", too
            self._refuse(place, item, shape)
            return FAILED
        if isinstance(item, list):
            *before, last = place or ("",)
            return tuple(
                self._in_si(inner_shape(shape, n), each, (*before, f"{last}[{n}]"), unit, ending)
                for n, each in enumerate(item)
            )
        if not isinstance(item, dict):
            return item
        return {
            name: self._in_si(inner_shape(shape, name), each, (*place, name), unit, ending)
            for name, each in item.items()
        }

    def _check_ends(
        self, number: SourcedNumber, shape: Shape, place: Place, unit: Unit | None, ending: str
    ) -> None:
        """Note the ends of a number's range that its field does not allow."""
        kinds = [one for one in options(shape) if is_number(one)]
        for key, end in (("from", number.low), ("to", number.high)):
            if end is not None and kinds:
                in_si = _number_in_si(end, unit, ending)
                if not any(within(one, in_si) for one in kinds):
                    self.faults.wrong((*place, key), end, allowed(either(kinds), unit, ending))

    def member(self, group: GroupShape, item: Any, place: Place) -> Any:
        """A value of a group of classes from an item of a file; FAILED, with the reason among the faults."""
        for base, short_form in self.short_forms.items():
            if any(issubclass(each, base) for each in group.bases):
                found = short_form(self, item, place)
                if found is not None:
                    return found
        if isinstance(item, group.bases):  # made by a program, see `simple_scenario`
            return item
        if not isinstance(item, dict):
            self._refuse(place, item, {"group": group})
            return FAILED
        name = item.get("type")
        cls = group.usual if name is None else group.kinds.get(name) if isinstance(name, str) else None
        if cls is not None:
            return self.value(cls, item, place)
        if name is None:
            self.faults.add((*place, "type"), f"missing; allowed: {', '.join(group.kinds) or 'none'}")
        else:
            advice = f"{nearest(str(name), group.kinds)}; classes of one's own: --import FILE"
            self.faults.refuse((*place, "type"), name, advice)
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
        where: the name of its file, for messages.
        short_forms: see `Reader`.
        sourced: collects numbers with range and source, see `plain_numbers`; None: the table has none.

    Raises InputError with a line for every fault: file, key, value, and what is allowed.
    """
    faults = Faults(where)
    item = table if sourced is None else plain_numbers(table, (), faults, sourced)
    found = Reader(faults, short_forms, sourced).member(GroupShape((cls,)), item, ())
    faults.check()
    return found  # type: ignore[no-any-return]


def plain_numbers(item: Any, place: Place, faults: Faults, sourced: dict[str, SourcedNumber]) -> Any:
    """An item of a file with plain numbers in place of tables `{ value, from, to, source }`.

    sourced: collects the contents of these tables by their dotted keys.
    """
    if isinstance(item, list):
        return [
            plain_numbers(each, (*place[:-1], f"{place[-1]}[{n}]"), faults, sourced)
            for n, each in enumerate(item)
        ]
    if not isinstance(item, dict):
        return item
    ends = {key: item[key] for key in ("value", "from", "to") if key in item}
    is_sourced = "type" not in item and 2 * len(item.keys() & SOURCED_KEYS.keys()) > len(item)
    if not (ends and is_sourced) or any(isinstance(each, (dict, list)) for each in ends.values()):
        return {key: plain_numbers(each, (*place, key), faults, sourced) for key, each in item.items()}
    before = len(faults.lines)
    for key in item.keys() - SOURCED_KEYS.keys():
        faults.add((*place, key), f"unknown key; {nearest(key, SOURCED_KEYS)}")
    for key, end in ends.items():
        if not _is_number(end):
            faults.wrong((*place, key), end, "a number")
    if "value" not in item:
        faults.add((*place, "value"), "missing; it has no default")
    for key, other in (("from", "to"), ("to", "from")):
        if key in item and other not in item:
            faults.add((*place, other), "missing; a range has from and to")
    source = item.get("source", "")
    if not isinstance(source, str) or ("source" in item and not source.strip()):
        faults.wrong((*place, "source"), source, "a text that is not empty")
    if len(faults.lines) == before and "from" in ends:
        low, high = ends["from"], ends["to"]
        if low > high:
            faults.wrong((*place, "from"), low, f"<= to = {quoted(high)}")
        elif not low <= ends["value"] <= high:
            faults.wrong((*place, "value"), ends["value"], f"from {quoted(low)} to {quoted(high)}")
    if len(faults.lines) > before:
        return FAILED
    written = {key: Decimal(str(end)) for key, end in ends.items()}
    sourced[dotted_key(place)] = SourcedNumber(written["value"], written.get("from"), written.get("to"), source)
    return item["value"]


def _unknown(cls: type[Value], key: str, also: tuple[str, ...]) -> tuple[str, str]:
    """The field that an unknown key may mean, which then is not called missing too; and the fault."""
    for name, instead in cls.removed.items():
        if key == name or key.startswith(f"{name}_"):
            return key, f"there is no such key any more; {instead}"
    fields = field_shapes(cls)
    for field in fields.values():
        if field.unit is not None and key.startswith(f"{field.name}_"):
            return field.name, f"has another unit; allowed: {', '.join(field.keys)}"
        if key == field.name:
            return field.name, f"is written with its unit; allowed: {', '.join(field.keys)}"
    of = {key: field.name for field in fields.values() for key in field.keys}
    guess = nearest(key, [*also, *of]).partition("allowed: ")[0]
    usual = ", ".join([*also, *(field.keys[0] for field in fields.values())])
    near = get_close_matches(key[:80], of, 1)
    return of[near[0]] if near else key, f"unknown key; {guess}allowed: {usual or 'none'}"


def _is_of_kind(shape: Shape, item: Any) -> bool:
    """Whether an item is a table, list, text or number, as a shape is."""
    if isinstance(item, dict):
        return "group" in shape or shape.get("type") == "object"
    if isinstance(item, list):
        return shape.get("type") == "array"
    return is_number(shape) if _is_number(item) else isinstance(item, str) and shape == {"type": "string"}


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
