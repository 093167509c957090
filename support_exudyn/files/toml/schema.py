"""JSON Schemas of files, made from what the classes declare, by which editors complete and check TOML."""

import inspect
from decimal import Decimal
from itertools import combinations
from typing import Any

from support_exudyn.files.toml.shapes import (
    BOUNDS,
    SOURCED_KEYS,
    FieldShape,
    GroupShape,
    Shape,
    either,
    field_shapes,
    is_number,
    is_numeric,
    options,
    scaled,
)
from user_forces.values.sourced import SourcedNumber
from user_forces.values.units import ANGLES, Unit
from user_forces.values.value import Value

DRAFT = "https://json-schema.org/draft/2020-12/schema"
Table = dict[str, Any]


class Schemas:
    """Schemas of values; those of classes are kept once, in `defs`, and referred to.

    Every number may be a table with its range and source. besides: for a class, schemas of further ways to
    write its values.
    """

    def __init__(self) -> None:
        self.defs: Table = {SourcedNumber.__name__: _sourced()}
        self.besides: dict[type[Value], list[Table]] = {}

    def value(self, cls: type[Value]) -> Table:
        """The schema of a class: a reference to it."""
        name = cls.__name__
        if name not in self.defs:
            self.defs[name] = {}  # so that a class which holds its like comes to an end
            self.defs[name] = self.table(cls)
        return {"$ref": f"#/$defs/{name}"}

    def table(self, cls: type[Value], typed: bool = True, all_optional: bool = False) -> Table:
        """The schema of a value's table; typed: with its `type`; all_optional: no key is needed."""
        properties: Table = {"type": {"const": cls.__name__}} if typed else {}
        rules: list[Table] = []
        required: list[str] = []
        for field in field_shapes(cls).values():
            for key in field.keys:
                properties[key] = self._field(field, key)
            rules += [{"not": {"required": list(two)}} for two in combinations(field.keys, 2)]
            if field.required and not all_optional:
                if len(field.keys) == 1:
                    required.append(field.keys[0])
                else:
                    rules.append({"anyOf": [{"required": [key]} for key in field.keys]})
        said = " ".join(inspect.cleandoc(cls.__doc__ or "").partition("\n\n")[0].split())
        found: Table = {"type": "object", "description": said, "properties": properties}
        found |= {"required": required} if required else {}
        found |= {"allOf": rules} if rules else {}
        return found | {"additionalProperties": False}

    def _field(self, field: FieldShape, key: str) -> Table:
        """The schema of a key by which a field may be given."""
        ending = field.ending(key)
        shape = field.shape
        if field.unit is not None and len(field.keys) > len(field.unit.endings):  # numbers or words
            shape = either([one for one in options(shape) if is_numeric(one) is bool(ending)])
        default = _default(field, ending)
        said = {"description": _help(field, ending)} if field.help else {}
        return said | self.item(shape, field.unit, ending) | ({} if default is None else {"default": default})

    def item(self, shape: Shape, unit: Unit | None = None, ending: str = "") -> Table:
        """The schema of what fits a shape; numbers in the unit of an ending."""

        def inner(one: Shape) -> Table:
            return self.item(one, unit, ending)

        if "group" in shape:
            return self._group(shape["group"])
        if "names" in shape:
            known = {"enum": list(shape["names"].options)}
            own = {"type": "string", "pattern": ":"}  # classes of one's own are named by their place
            return {"anyOf": [known, own]} if callable(shape["names"].known) else known
        if "properties" in shape:
            of_unit = f" [{ending}]" if ending else ""
            inside = {name: inner(one) for name, one in shape["properties"].items()}
            inside = {
                name: {**one, "description": one.get("description", name) + of_unit}
                for name, one in inside.items()
            }
            return {**shape, "properties": inside}
        found = dict(shape)
        for word in {"items", "additionalProperties"} & shape.keys():
            found[word] = inner(shape[word])
        for word in {"anyOf", "prefixItems"} & shape.keys():
            found[word] = list(map(inner, shape[word]))
        if "prefixItems" in found and all(one == found["prefixItems"][0] for one in found["prefixItems"]):
            found["items"] = found.pop("prefixItems")[0]  # as older drafts have it, too
        if not is_number(shape):
            return found
        bounds = {name: _plain(scaled(shape[name], unit, ending)) for name in BOUNDS if name in shape}
        plain = {**found, **bounds}
        table: Table = {"$ref": f"#/$defs/{SourcedNumber.__name__}"}
        if bounds:
            table = {"allOf": [table, {"properties": dict.fromkeys(("value", "from", "to"), bounds)}]}
        return {"anyOf": [plain, table]}

    def _group(self, group: GroupShape) -> Table:
        """The schema of a table whose type says its class, and of the other ways to write its values."""
        # not beside the reference, where older drafts, which some editors know only, do not look
        tables = [
            self.value(kind) if kind is group.usual else {"allOf": [self.value(kind)], "required": ["type"]}
            for kind in group.kinds.values()
        ]
        short = [one for base, them in self.besides.items() if base in group.bases for one in them]
        every = [*short, *tables]
        return every[0] if len(every) == 1 else {"oneOf": every}

    def whole(self, title: str, table: Table) -> Table:
        """A schema of a file, with all that it refers to."""
        return {"$schema": DRAFT, "title": title, **table, "$defs": dict(sorted(self.defs.items()))}


def _sourced() -> Table:
    """The schema of a number that is a table with its range and source."""
    texts = {"source": {"type": "string", "pattern": r"\S"}}
    return {
        "type": "object",
        "description": (inspect.getdoc(SourcedNumber) or "").partition("\n")[0],
        "properties": {
            key: {"description": said, **texts.get(key, {"type": "number"})}
            for key, said in SOURCED_KEYS.items()
        },
        "required": ["value"],
        "oneOf": [
            {"required": ["from", "to"]},
            {"not": {"anyOf": [{"required": ["from"]}, {"required": ["to"]}]}},
        ],
        "additionalProperties": False,
    }


def _help(field: FieldShape, ending: str) -> str:
    """The help on a field; where a key has another unit than the program, that unit is added."""
    if field.unit is None or not ending or field.unit.endings[ending] == 1:
        return field.help
    return f"{field.help.rstrip('.')}; this key is in {ending.replace('_per_', '/').replace('_', ' ')}."


def _default(field: FieldShape, ending: str) -> Any:
    """The default of a field, in the unit of a key; None if there is none, or it is long."""
    found = field.default
    if (
        ending in ANGLES and field.unit is not None and "m" in field.unit.endings
    ):  # of a drive, whose default is a length
        return None
    if isinstance(found, (str, bool)):
        return None if ending else found
    if isinstance(found, (int, float)) and (field.unit is None or ending):
        return _plain(scaled(found, field.unit, ending)) if isinstance(found, float) else found
    return None


def _plain(number: Decimal) -> int | float:
    """A number as JSON has it."""
    return int(number) if number == number.to_integral_value() and abs(number) < 10**15 else float(number)
