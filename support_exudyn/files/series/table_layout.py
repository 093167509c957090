"""How a table of text is written: what separates its items, what its decimals are, where its titles stand."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from support_exudyn.files.series.units import as_pint_writes, is_unit, split_title
from user_forces.values.value import InputError, short

BLANKS = " "  # any number of blanks and tabs
SEPARATORS = ("\t", ";", ",", BLANKS)
SAID = {"\t": "tabs", ";": "';'", ",": "commas", BLANKS: "blanks"}
COMMENT = re.compile(r"\s*(#|%|!|//)")
MISSING = ("", "nan", "NaN", "NAN", "NA", "N/A", "n/a", "null", "NULL", "-nan", "#N/A")  # no number
NUMBERS = {
    ".": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?|[+-]?(inf|Inf|INF|infinity)", re.ASCII),
    ",": re.compile(r"[+-]?(\d+(,\d+)?|,\d+)([eEdD][+-]?\d+)?", re.ASCII),
}
GROUPED = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+", re.ASCII)  # 1,234: a thousand, or one and a bit
WORDS = re.compile(r'"[^"]*"|\S+')  # that blanks separate
FEW = 6  # names that are told
LINES, LETTERS = 400, 1_000_000  # that are looked at
ALLOWED = "rows of two or more numbers below a line of titles such as time_s,tip.x_mm"
Rows = tuple[int, str, bool]  # items of each, what separates them, whether all end with that


@dataclass(frozen=True)
class TableLayout:
    """How a table is written.

    separator: between items. decimal: "." or ",". first: the index of the first line of numbers.
    width: items of a row. titles: a name and a unit (None: it has none) for each item. notes: what is told.
    words: which items are no numbers, as of dates and remarks.
    """

    separator: str
    decimal: str
    first: int
    width: int
    titles: tuple[tuple[str, str | None], ...]
    notes: tuple[str, ...]
    words: frozenset[int] = frozenset()

    def items(self, line: str) -> list[str]:
        """The items of a line."""
        return items(line, self.separator)

    def number(self, item: str) -> float | None:
        """The number that an item is, NaN where it says that there is none; None if it is no number."""
        if item in MISSING:
            return float("nan")
        if not NUMBERS[self.decimal].fullmatch(item):
            return None
        return float(item.replace(",", ".").replace("d", "e").replace("D", "e"))


def items(line: str, separator: str) -> list[str]:
    """The items of a line, without blanks around them."""
    if separator == BLANKS:
        return [one.strip('"') for one in WORDS.findall(line)]
    if '"' not in line:
        return [one.strip() for one in line.split(separator)]
    try:
        return [one.strip() for one in next(csv.reader([line], delimiter=separator), [])]
    except csv.Error:  # an item that is too long
        return [line]


def is_row(line: str, separator: str, decimal: str, words: Collection[int] = ()) -> int:
    """How many items a row of numbers has, but for those that are words; 0 if it is none."""
    found = items(line, separator)
    number = NUMBERS[decimal]
    wanted = [one for n, one in enumerate(found) if n not in words] if words else found
    if len(found) < 2 or not all(one in MISSING or number.fullmatch(one) for one in wanted):
        return 0
    return len(found) if any(wanted) else 0


def _words(text: Sequence[str], separator: str, decimal: str, width: int) -> frozenset[int]:
    """Which items of rows of a width are words: never a number, and not always missing."""
    split = (items(line, separator) for line in text)
    rows = [one for one in split if len(one) == width and any(NUMBERS[decimal].fullmatch(item) for item in one)]
    kinds = ({_kind(one[n], decimal) for one in rows} for n in range(width))
    return frozenset(n for n, found in enumerate(kinds) if "word" in found and "number" not in found)


def _kind(item: str, decimal: str) -> str:
    if item in MISSING:
        return "missing"
    return "number" if NUMBERS[decimal].fullmatch(item) else "word"


def _written(text: Sequence[str]) -> tuple[int, str, str, frozenset[int]] | None:
    """Items of a row, what separates them, what their decimals are, and which are words; None of no table.

    Only if no row is of numbers alone, separators are looked for by which rows have words, too.
    """
    tried = [(one, decimal) for one in SEPARATORS for decimal in ".,"[: 1 if one == "," else 2]]
    best: tuple[int, int, str, str] | None = None  # rows, items in each, separator, decimals
    for separator, decimal in tried:
        widths = Counter(filter(None, (is_row(line, separator, decimal) for line in text)))
        if widths:
            width, rows = widths.most_common(1)[0]
            if best is None or rows > best[0]:
                best = rows, width, separator, decimal
    if best is not None:
        _, width, separator, decimal = best
        words = frozenset[int]() if separator == BLANKS else _words(text, separator, decimal, width)
        return width, separator, decimal, words
    found = [_with_words(text, *one) for one in tried if one[0] != BLANKS]
    rows, _, (width, separator, decimal, words) = max(found, key=lambda one: one[:2])
    return (width, separator, decimal, words) if rows else None


def _with_words(
    text: Sequence[str], separator: str, decimal: str
) -> tuple[int, int, tuple[int, str, str, frozenset[int]]]:
    """How many rows of numbers and words there are, how many of their items are numbers, and how it is written.

    An item that another separator could part is no word.
    """
    split = [items(line, separator) for line in text]
    widths = Counter(len(one) for one in split if len(one) > 1)
    others = "\t;".replace(separator, "")
    width = widths.most_common(1)[0][0] if widths else 0
    words = _words(text, separator, decimal, width)
    rows = sum(is_row(line, separator, decimal, words) == width for line in text) if width else 0
    if any(set(others) & set(item) for one in split if len(one) == width for item in one):
        rows = 0
    return rows, width - len(words), (width, separator, decimal, words)


def layout(path: Path, lines: Sequence[str]) -> TableLayout:
    """How a table is written, from its first lines.

    Raises InputError if there are no rows of numbers, if they can be read in two ways, or if titles and rows
    do not fit each other.
    """
    text = [(n, line) for n, line in enumerate(lines[:LINES]) if line.strip() and not COMMENT.match(line)]
    if (written := _written([line for _, line in text])) is None:
        raise InputError(f"{path}: is no table of numbers; allowed: {ALLOWED}")
    width, separator, decimal, words = written
    place = next(  # of whatever decimals: a row of others is wrong, and no line of titles
        n for n, (_, line) in enumerate(text) if width in (is_row(line, separator, one, words) for one in ".,")
    )
    if decimal == ",":
        _check_commas(path, [line for _, line in text[place:]], separator, words)
    first = text[place][0]
    # rows may end with a separator where the line of titles does not
    ended = all(not items(line, separator)[-1] for _, line in text[place:])
    titles, notes = _titles(path, lines[:first], text[:place], (width, separator, ended))
    if words:
        others = ", ".join(short(titles[n][0]) for n in sorted(words)[:FEW])
        notes = (*notes, f"Columns that are no numbers are left out: {others}.")
    return TableLayout(separator, decimal, first, width, titles, notes, words)


def _check_commas(path: Path, lines: Sequence[str], separator: str, words: Collection[int]) -> None:
    """Raise InputError if all commas may stand between thousands."""
    rows = (items(line, separator) for line in lines)
    with_comma = [one for row in rows for n, one in enumerate(row) if "," in one and n not in words]
    if with_comma and all(GROUPED.fullmatch(one) for one in with_comma):
        whole, part = with_comma[0].replace(",", ""), with_comma[0].replace(",", ".", 1)
        raise InputError(
            f"{path}: {with_comma[0]!r} may be {whole} or {part}; allowed: decimals with a point, or at least "
            "one number that tells what the comma is, such as 0,5"
        )


def _titles(
    path: Path, above: Sequence[str], text: Sequence[tuple[int, str]], rows: Rows
) -> tuple[tuple[tuple[str, str | None], ...], tuple[str, ...]]:
    """A name and a unit for each column, and what is told."""
    width, separator, _ = rows
    notes: list[str] = []
    words_above = [one for _, line in text for one in line.split()]
    if text and all(NUMBERS["."].fullmatch(one) for one in words_above):  # sizes, as of rows: no titles
        notes.append(f"Lines of other numbers above the rows are passed over: {len(text)}.")
        text = ()
    if not text:
        words = _of_comment(above, rows)
        if words is None:
            notes.append("There are no titles; columns are called by their numbers, column_1 and so on.")
            return tuple((f"column_{n}", None) for n in range(1, width + 1)), tuple(notes)
        return _named(words, None, width, notes), tuple(notes)
    number, line = text[-1]
    words = _fitted(line, rows)
    if words is None and (words := _a_line_each(text, rows)) is not None:
        text = text[: 1 - width]  # of which the last is the first title
    if words is None:
        found = len(items(line, separator))
        more = "; where commas are decimal points items need another separator, ';'" if separator == "," else ""
        raise InputError(
            f"{path}: line {number + 1}: has {found} titles, separated by {SAID[separator]}, above rows of "
            f"{width} items; allowed: as many titles as items{more}"
        )
    below, rest = None, text[:-1]
    if rest and _are_units(words) and (upper := _fitted(rest[-1][1], rows)) is not None:
        below, words, rest = words, upper, rest[:-1]
    if rest:
        notes.append(
            f"{len(rest)} {'line' if len(rest) == 1 else 'lines'} above the titles "
            f"{'is' if len(rest) == 1 else 'are'} passed over."
        )
    return _named(words, below, width, notes), tuple(notes)


def _a_line_each(text: Sequence[tuple[int, str]], rows: Rows) -> list[str] | None:
    """Titles that stand a line each; None if the lines above the rows are other ones."""
    width, separator, _ = rows
    words = [line.strip().strip('"') for _, line in text[-width:]]
    single = all(len(items(one, separator)) == 1 or separator == BLANKS for one in words)
    return words if len(words) == width and single and is_time_title(words[0]) else None


def is_time_title(title: str) -> bool:
    """Whether a title is one of times."""
    return split_title(title)[0].casefold() in ("time", "t")


def _of_comment(above: Sequence[str], rows: Rows) -> list[str] | None:
    """Titles in the last comment before the rows, as numpy writes them."""
    comments = [line for line in above if COMMENT.match(line)]
    if not comments:
        return None
    line = COMMENT.sub("", comments[-1], count=1)
    return _fitted(line, rows)


def _fitted(line: str, rows: Rows) -> list[str] | None:
    """The items of a line of titles, None if they are not as many as those of a row."""
    width, separator, ended = rows
    found = items(line, separator)
    if separator == BLANKS and len(found) != width:  # a unit in brackets is no title
        found = re.split(r"\s+(?![\[(])", line.strip())
    if ended and len(found) == width - 1:
        found.append("")
    return found if len(found) == width else None


def _are_units(words: Sequence[str]) -> bool:
    """Whether a line has units for titles above it."""
    bare = [one.strip("[]() ") for one in words]
    return any(one not in ("", "-") for one in bare) and all(is_unit(one) for one in bare)


def _named(
    words: Sequence[str], below: Sequence[str] | None, width: int, notes: list[str]
) -> tuple[tuple[str, str | None], ...]:
    found = []
    for n in range(width):
        if below is not None:
            bare = below[n].strip("[]() ")
            found.append((words[n] or f"column_{n + 1}", as_pint_writes(bare) if bare else None))
            continue
        name, unit, told = split_title(words[n])
        if told:
            notes.append(f"{told[0].upper()}{told[1:]}.")
        found.append((name or f"column_{n + 1}", unit))
    return tuple(found)
