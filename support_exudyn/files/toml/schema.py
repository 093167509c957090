"""JSON Schemas of files, made from what the classes declare, by which editors complete and check TOML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from decimal import Decimal
from itertools import combinations
from typing import Any

from support_exudyn.files.toml.help_texts import summary
from support_exudyn.files.toml.shapes import (
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
from support_exudyn.files.toml.words import scaled
from user_forces.values.units import Unit
from user_forces.values.value import Value

DRAFT = "https://json-schema.org/draft/2020-12/schema"
KEYWORDS = {">": "exclusiveMinimum", ">=": "minimum", "<": "exclusiveMaximum", "<=": "maximum"}
Table = dict[str, Any]


class Schemas:
    """Schemas of values; those of classes are kept once, in `defs`, and referred to.

    besides: for a class, schemas of further ways to write its values.
    """

    def __init__(self) -> None:
        self.defs: Table = {}
        self.besides: dict[type[Value], list[Table]] = {}

    def value(self, cls: type[Value]) -> Table:
        """That of a class: a reference to it."""
        name = cls.__name__
        if name not in self.defs:
            self.defs[name] = {}  # so that a class which holds its like comes to an end
            self.defs[name] = self.table(cls)
        return {"$ref": f"#/$defs/{name}"}

    def table(self, cls: type[Value], all_optional: bool = False) -> Table:
        """That of a table that is a value of a class; all_optional: what is missing comes from elsewhere."""
        properties: Table = {"type": {"const": cls.__name__}}
        rules: list[Table] = []
        required: list[str] = []
        for field in field_shapes(cls).values():
            for key in field.keys:
                properties[key] = self.field(cls, field, key)
            rules += [{"not": {"required": list(two)}} for two in combinations(field.keys, 2)]
            if field.required and not all_optional:
                if len(field.keys) == 1:
                    required.append(field.keys[0])
                else:
                    rules.append({"anyOf": [{"required": [key]} for key in field.keys]})
        found: Table = {"type": "object", "description": summary(cls), "properties": properties}
        found |= {"required": required} if required else {}
        found |= {"allOf": rules} if rules else {}
        return found | {"additionalProperties": False}

    def field(self, cls: type[Value], field: FieldShape, key: str) -> Table:
        """That of a key by which a field may be given."""
        ending = field.ending(key)
        if field.unit is not None and field.wordy:
            shape = _of_kind(field.shape, numbers=bool(ending))
        else:
            shape = field.shape
        default = _default(cls, field, ending)
        said = {"description": field.help} if field.help else {}
        return said | self.item(shape, field.unit, ending) | ({} if default is None else {"default": default})

    def item(self, shape: Shape, unit: Unit | None = None, ending: str = "") -> Table:
        """That of what fits a shape; numbers in the unit of an ending."""
        match shape:
            case Number():
                bounds = {KEYWORDS[sign]: _plain(scaled(limit, unit, ending)) for sign, limit in shape.bounds}
                return {"type": "integer" if shape.whole else "number", **bounds}
            case Text():
                return {"type": "string"}
            case Truth():
                return {"type": "boolean"}
            case Choice():
                return {"enum": list(shape.options)}
            case Fixed():
                items = [self.item(one, unit, ending) for one in shape.items]
                inside = (
                    {"prefixItems": items} if any(one != items[0] for one in items) else {"items": items[0]}
                )
                return {"type": "array", **inside, "minItems": len(items), "maxItems": len(items)}
            case Several():
                return {"type": "array", "items": self.item(shape.item, unit, ending)}
            case Named():
                return {"type": "object", "additionalProperties": self.item(shape.item, unit, ending)}
            case Group():
                return self.group(shape)
            case Either():
                return {"anyOf": [self.item(one, unit, ending) for one in shape.options]}

    def group(self, group: Group) -> Table:
        """That of a table whose type says its class, and of the other ways to write its values."""
        kinds: Iterable[type[Value]] = group.kinds.values()
        # not beside the reference, where older drafts, which some editors know only, do not look
        tables = [
            self.value(kind) if kind is group.usual else {"allOf": [self.value(kind)], "required": ["type"]}
            for kind in kinds
        ]
        short = [one for base, them in self.besides.items() if base in group.bases for one in them]
        every = [*short, *tables]
        return every[0] if len(every) == 1 else {"oneOf": every}

    def whole(self, title: str, table: Table) -> Table:
        """A schema of a file, with all that it refers to."""
        return {"$schema": DRAFT, "title": title, **table, "$defs": dict(sorted(self.defs.items()))}


def _of_kind(shape: Shape, numbers: bool) -> Shape:
    """Of what may be numbers or words, what is one of them."""
    options = shape.options if isinstance(shape, Either) else (shape,)
    fitting = tuple(one for one in options if isinstance(one, (Number, Fixed, Several, Named)) is numbers)
    return fitting[0] if len(fitting) == 1 else Either(fitting)


def _default(cls: type[Value], field: FieldShape, ending: str) -> Any:
    """What a field is if it is left out, as a key says it; None if it is none, or long."""
    info = cls.__pydantic_fields__[field.name]  # type: ignore[attr-defined]
    found = None if info.is_required() else info.get_default(call_default_factory=True)
    if isinstance(found, (str, bool)):
        return None if ending else found
    if isinstance(found, (int, float)) and (field.unit is None or ending):
        return _plain(scaled(found, field.unit, ending)) if isinstance(found, float) else found
    return None


def _plain(number: Decimal) -> int | float:
    """A number as JSON has it."""
    return int(number) if number == number.to_integral_value() and abs(number) < 10**15 else float(number)


def without(table: Mapping[str, Any], *names: str) -> Table:
    """A schema of a table that lacks some of its keys."""
    properties = {key: one for key, one in table["properties"].items() if key not in names}
    required = [key for key in table.get("required", []) if key not in names]
    return {**table, "properties": properties, **({"required": required} if "required" in table else {})}
