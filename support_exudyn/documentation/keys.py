"""The keys of files as pages, from their JSON Schemas."""

import re
from collections.abc import Mapping
from typing import Any

Schema = Mapping[str, Any]
LIMITS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
LONGEST = 30  # letters of a default in a column of a terminal
TOP = "Where a key has several forms, each with a unit of its own, range and unit are those of the first."


def keys_page(title: str, schema: Schema) -> str:
    """A page of Markdown with a table for the file, and one for every class that its tables can be.

    Arguments:
        title: of the page.
        schema: a JSON Schema, as `scenario_schema` and `machine_schema` give it.
    """
    return _KeysPage(schema.get("$defs", {})).text(title, schema)


def key_tables(schema: Schema) -> dict[str, list[tuple[str, str, str]]]:
    """The tables of that page for terminals: by the name of their class, of the file itself empty.

    A row is a key (the others of one quantity behind what it means), its default, and what it takes and means.

    Arguments:
        schema: as of `keys_page`.
    """
    tables: dict[str, list[tuple[str, str, str]]] = {"": []}
    name = ""
    for line in keys_page("", schema).splitlines():
        if line.startswith("## "):
            name = line[3:]
        elif line.startswith("| `"):
            keys, takes, default, meaning = map(_bare, re.split(r" (?<!\\)\| ?", line[2:])[:4])
            first, *others = keys.split(", ")
            if len(default) > LONGEST:
                default, meaning = "", f"{meaning} By default {default}."
            also = f" Also {', '.join(others)}." if others else ""
            said = ": ".join(filter(None, (takes, meaning)))
            tables.setdefault(name, []).append((first, default, said + also))
    return tables


def _bare(cell: str) -> str:
    """A cell without the signs of Markdown."""
    return re.sub(r"(?<!\\)\[([^]]*)\]\(#[^)]*\)", r"\1", cell).replace("\\", "").replace("`", "").strip()


class _KeysPage:
    """A page that is being written: the classes it refers to, and tables in few words that have no class.

    definitions: schemas of classes, by name.
    """

    def __init__(self, definitions: Schema) -> None:
        self.definitions = definitions
        self.short: dict[str, Schema] = {}
        self.owner = ""

    def text(self, title: str, schema: Schema) -> str:
        """The whole page."""
        parts = [f"# {title}", schema.get("description", ""), TOP]
        if "properties" in schema:
            parts.append(self._table(schema))
        elif kinds := schema.get("oneOf", schema.get("anyOf")):
            parts.append("A file is " + ", or ".join(self._takes(one) for one in kinds) + ".")
        classes = [
            part for name in sorted(self.definitions) for part in self._section(name, self.definitions[name])
        ]
        done: set[str] = set()
        while len(done) < len(self.short):  # a table in few words may hold one
            for name in [one for one in self.short if one not in done]:
                parts += self._section(name, self.short[name])
                done.add(name)
        return "\n\n".join(part for part in [*parts, *classes] if part) + "\n"

    def _section(self, name: str, schema: Schema) -> list[str]:
        self.owner = name
        table = self._table(schema) if schema.get("properties") else ""
        return [f"## {name}", "" if name in self.short else _plain(schema.get("description", "")), table]

    def _table(self, schema: Schema) -> str:
        rows: list[tuple[list[str], Schema]] = []
        for key, one in schema["properties"].items():
            stem = rows[-1][0][0].rpartition("_")[0] if rows else ""
            same = rows and stem and key.startswith(stem) and _unitless(one) == _unitless(rows[-1][1])
            if same and "const" not in one:
                rows[-1][0].append(key)
            else:
                rows.append(([key], one))
        needed = set(schema.get("required", ()))
        for rule in schema.get("allOf", ()):  # one of several units is needed
            needed |= {key for one in rule.get("anyOf", ()) for key in one.get("required", ())}
        lines = ["| key | takes | if nothing is said | meaning |", "|---|---|---|---|"]
        for keys, one in rows:
            usual = "needed" if needed & set(keys) else _said(one.get("default", ""))
            cells = (
                ", ".join(f"`{key}`" for key in keys),
                self._takes(one),
                usual,
                _plain(one.get("description", "")),
            )
            lines.append(
                "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"
            )
        return "\n".join(lines)

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
                return _said(item)
            case {"enum": items}:
                return ", ".join(map(_said, items))
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
    """What is said of a key, without units."""
    return re.sub(r"\[[^]]*\]", "", one.get("description", ""))


def _plain(text: str) -> str:
    """A text whose units in brackets are no links."""
    return text.replace("[", "\\[").replace("]", "\\]")


def _anchor(name: str) -> str:
    """The place of a heading, as Markdown names it."""
    return re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", name).strip().lower())


def _said(item: Any) -> str:
    if item == "":
        return ""
    return f"`{str(item).lower() if isinstance(item, bool) else item}`"
