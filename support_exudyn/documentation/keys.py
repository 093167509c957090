"""The keys of files, from their JSON Schemas: as pages, and as tables for terminals."""

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

Schema = Mapping[str, Any]
LIMITS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
LINKED = re.compile(r"(?<!\\)\[([^]]*)\]\(#[^)]*\)")  # a link of Markdown to a place of the page
LONGEST = 30  # letters of a default in a column of a terminal
TOP = "Where a key has several forms, each with a unit of its own, range and unit are those of the first."


class KeyRow(NamedTuple):
    """Keys of a quantity, each with its unit, what they take, their default and their meaning, as Markdown."""

    keys: list[str]
    takes: str
    default: str
    meaning: str


def keys_page(title: str, schema: Schema) -> str:
    """A page of Markdown with a table for the file, and one for every class that its tables can be.

    Arguments:
        title: of the page.
        schema: a JSON Schema, as `scenario_schema` and `machine_schema` give it.
    """
    found = _Keys(schema.get("$defs", {}))
    parts = [f"# {title}", schema.get("description", ""), TOP]
    for name, (description, rows) in found.tables(schema).items():
        parts += [f"## {name}", description] if name else [description]
        if rows:
            lines = ["| key | takes | default | meaning |", "|---|---|---|---|"]
            for row in rows:
                cells = (", ".join(f"`{key}`" for key in row.keys), *row[1:])
                escaped = (cell.replace("|", "\\|").replace("\n", " ") for cell in cells)
                lines.append(f"| {' | '.join(escaped)} |")
            parts.append("\n".join(lines))
    return "\n\n".join(part for part in parts if part) + "\n"


def key_tables(schema: Schema) -> dict[str, list[tuple[str, str, str]]]:
    """The same tables for terminals: by the name of their class, of the file itself empty.

    A row is a key (the others of one quantity behind what it means), its default, and what it takes and means.

    Arguments:
        schema: as of `keys_page`.
    """
    tables: dict[str, list[tuple[str, str, str]]] = {}
    for name, (_, rows) in _Keys(schema.get("$defs", {})).tables(schema).items():
        for row in rows:
            takes, default, meaning = (
                LINKED.sub(r"\1", cell).replace("`", "").replace("\\", "") for cell in row[1:]
            )
            if len(default) > LONGEST:
                default, meaning = "", f"{meaning} By default {default}."
            also = f" Also {', '.join(row.keys[1:])}." if row.keys[1:] else ""
            text = ": ".join(filter(None, (takes, meaning))) + also
            tables.setdefault(name, []).append((row.keys[0], default, text))
    return tables


class _Keys:
    """Tables that are being made: the classes they refer to, and tables in few words that have no class.

    definitions: schemas of classes, by name.
    """

    def __init__(self, definitions: Schema) -> None:
        self.definitions = definitions
        self.short: dict[str, Schema] = {}
        self.owner = ""

    def tables(self, schema: Schema) -> dict[str, tuple[str, list[KeyRow]]]:
        """Description and rows of the file (its name is empty), of tables in few words, and of classes."""
        first = ""
        if "properties" not in schema and (kinds := schema.get("oneOf", schema.get("anyOf"))):
            first = "A file is " + ", or ".join(self._takes(kind) for kind in kinds) + "."
        found = {"": (first, list(self._rows(schema)))}
        classes = {}
        for name in sorted(self.definitions):
            self.owner = name
            classes[name] = (
                _plain(self.definitions[name].get("description", "")),
                list(self._rows(self.definitions[name])),
            )
        while missing := [name for name in self.short if name not in found]:
            for name in missing:
                self.owner = name
                found[name] = "", list(self._rows(self.short[name]))
        return found | classes

    def _rows(self, schema: Schema) -> Iterator[KeyRow]:
        """The rows of a table; keys that differ in their unit alone share one."""
        grouped: list[tuple[list[str], Schema]] = []
        for key, kind in schema.get("properties", {}).items():
            stem = grouped[-1][0][0].rpartition("_")[0] if grouped else ""
            same = grouped and stem and key.startswith(stem) and _unitless(kind) == _unitless(grouped[-1][1])
            if same and "const" not in kind:
                grouped[-1][0].append(key)
            else:
                grouped.append(([key], kind))
        needed = set(schema.get("required", ()))
        for rule in schema.get("allOf", ()):  # one of several units is needed
            needed |= {key for one in rule.get("anyOf", ()) for key in one.get("required", ())}
        for keys, kind in grouped:
            default = "needed" if needed & set(keys) else _code(kind.get("default", ""))
            yield KeyRow(keys, self._takes(kind), default, _plain(kind.get("description", "")))

    def _takes(self, one: Schema) -> str:
        """In words what fits a schema; classes with a link to their table on the same page."""
        for word in ("anyOf", "oneOf"):
            if word in one:
                return ", or ".join(dict.fromkeys(self._takes(item) for item in one[word]))
        match one:
            case {"$ref": place}:
                name = place.rpartition("/")[2]
                return f"[{name}](#{_anchor(name)})"
            case {"allOf": [first, *_]} if "properties" not in one:
                return self._takes(first)
            case {"const": item}:
                return _code(item)
            case {"enum": items}:
                return ", ".join(map(_code, items))
            case {"type": "number" | "integer" as kind}:
                bounds = " and ".join(f"{sign} {one[word]:g}" for word, sign in LIMITS.items() if word in one)
                return f"{'a number' if kind == 'number' else 'a whole number'} {bounds}".strip()
            case {"type": "array", "prefixItems": [item, *_] as items}:
                return f"a list of {len(items)}, each {self._takes(item)}"
            case {"type": "array", "items": item}:
                many = f" of {one['minItems']}" if one.get("minItems", 0) == one.get("maxItems", -1) else ""
                return f"a list{many}, each {self._takes(item)}"
            case {"type": "object", "additionalProperties": Mapping() as inner}:
                return f"a table of names, each {self._takes(inner)}"
            case {"type": "object", "properties": properties, "description": text}:
                kind = properties.get("type", {}).get("const")
                name = f"{kind} in few words" if kind else re.split(r"[:,]| \[", text.rstrip("."))[0]
                if self.short.get(name, one) != one:  # another kind of machine has one of this name
                    name += f" of {self.owner}"
                self.short[name] = one
                return f"[{name}](#{_anchor(name)})"
            case {"type": "object"}:
                return "a table of " + ", ".join(f"`{name}`" for name in one.get("properties", {}))
            case {"type": "string"}:
                return "a text"
            case {"type": "boolean"}:
                return "`true` or `false`"
        return "anything"


def _unitless(one: Schema) -> str:
    """The description of a key, without units."""
    return re.sub(r"\[[^]]*\]", "", one.get("description", ""))


def _plain(text: str) -> str:
    """A text whose units in brackets are no links."""
    return text.replace("[", "\\[").replace("]", "\\]")


def _anchor(name: str) -> str:
    """The place of a heading, as Markdown names it."""
    return re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", name).strip().lower())


def _code(item: Any) -> str:
    if item == "":
        return ""
    return f"`{str(item).lower() if isinstance(item, bool) else item}`"
