"""How a table of text is written: what separates its items, what its decimals are, where its titles stand."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from support_exudyn.files.series.columns import first_names
from support_exudyn.files.series.table_titles import (
    COMMENTS,
    PYTHON,
    SEPARATORS,
    Titles,
    is_time_title,
    items,
    kind_of,
    stated_intervals,
)
from user_forces.values.value import InputError

GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}([.,])[0-9]{3}")  # 1,234: a thousand, or one and a bit
MANY_GROUPS = re.compile(
    r"[+-]?[0-9]{1,3}([., '])[0-9]{3}(\1[0-9]{3})+|[+-]?[0-9]{1,3}([.,][0-9]{3})+[.,][0-9]+"
)
BEGINS = re.compile(r"[\s\"]*[-+.,]?[0-9]")  # rows, but for those of words first
FEW = 2  # lines of numbers, such as sizes, that may stand above the titles
LINES, LETTERS = 400, 1_000_000  # by which a layout is determined
ALLOWED = "rows of numbers below a line of titles such as time_s,tip.x_mm"


@dataclass(frozen=True)
class TableLayout:
    """How a table is written.

    separator: between items. decimal: "." or ",". first: the index of the first line of numbers.
    titles: a name and a unit (None: it has none) for each item. kinds: "number", "stamp" or "word" for each.
    notes: on what was assumed. intervals: between rows [s], that the lines above give, by those lines.
    """

    separator: str
    decimal: str
    first: int
    titles: tuple[tuple[str, str | None], ...]
    kinds: tuple[str, ...]
    notes: tuple[str, ...] = ()
    intervals: Mapping[str, float] = field(default_factory=dict)

    @property
    def comment(self) -> str:
        """The pattern by which lines of comments begin."""
        return COMMENTS[self.separator]

    def items(self, line: str) -> list[str]:
        """The items of a line."""
        return items(line, self.separator)

    def is_row(self, line: str) -> bool:
        """Whether a line is a row: numbers and stamps where they belong, at least one of them."""
        return _is_row(self.items(line), self.kinds, self.decimal)


def _is_row(found: Sequence[str], kinds: Sequence[str], decimal: str) -> bool:
    if len(found) != len(kinds):
        return False
    own = [kind_of(item, decimal) for item in found]
    fit = all(wanted == "word" or one in (wanted, "missing") for one, wanted in zip(own, kinds, strict=True))
    return fit and any(one == wanted != "word" for one, wanted in zip(own, kinds, strict=True))


# --- separators, decimals and kinds ---


def _kinds(rows: Sequence[Sequence[str]], width: int, decimal: str) -> tuple[str, ...]:
    """What the columns are: of numbers or stamps where at least as many items are as words."""
    found = []
    for n in range(width):
        count = Counter(kind_of(row[n], decimal) for row in rows)
        most = max(("number", "stamp"), key=lambda kind: count[kind])
        found.append("word" if count["word"] > count[most] else most)
    return tuple(found)


def _tried(lines: Sequence[str], separator: str, decimal: str) -> tuple[int, int, tuple[str, ...]]:
    """How many rows there are if lines are separated so, how many columns are numbers, and what columns are."""
    comment = re.compile(COMMENTS[separator])
    split = [items(line, separator) for line in lines if line.strip() and not comment.match(line)]
    score: Counter[int] = Counter()
    for found in split:
        numbers = sum(kind_of(one, decimal) in ("number", "stamp") for one in found)
        score[len(found)] += numbers or (len(found) > 1 and LETTERS * any(map(is_time_title, found)))
    for width, _ in score.most_common(3):
        rows = [
            one
            for one in split
            if len(one) == width and any(kind_of(i, decimal) in ("number", "stamp") for i in one)
        ]
        kinds = _kinds(rows, width, decimal)
        fitting = [one for one in rows if _is_row(one, kinds, decimal)]
        if width < 2 or not fitting or any(_is_split(item, decimal) for one in fitting for item in one):
            continue
        return len(fitting), sum(one != "word" for one in kinds), kinds
    return 0, 0, ()


def _is_split(item: str, decimal: str) -> bool:
    """Whether an item is several numbers, so that something else separates items."""
    parts = re.split(r"[\t;| ]+", item)
    return (
        len(parts) > 1
        and kind_of(item, decimal) == "word"
        and all(PYTHON[","].fullmatch(one) for one in parts if one)
    )


def _written(lines: Sequence[str], separators: Sequence[str]) -> tuple[str, str, tuple[str, ...]] | None:
    """What separates items, what decimals are and what columns are; None of no table."""
    quoted = any('"' in line for line in lines)
    best, written = (0, 0.0), None
    for separator in separators:
        for decimal in ".," if separator != "," or quoted else ".":
            rows, numbers, kinds = _tried(lines, separator, decimal)
            score = (rows, numbers / max(len(kinds), 1))
            if score > best and rows:
                best, written = score, (separator, decimal, kinds)
    single = {one: sum(kind_of(line.strip(), one) == "number" for line in lines) for one in ".,"}
    decimal = max(single, key=lambda one: single[one])
    by_comma = written is not None and written[0] == ","
    above = [line for line in lines if not _is_pair(line) and not re.match(COMMENTS[","], line)]
    alone = single[decimal] > best[0] or (by_comma and single[decimal] == best[0])
    if alone and single[decimal] and not (by_comma and any("," in line for line in above)):
        return ";", decimal, ("number",)  # a column without times
    return written


def _is_pair(line: str) -> bool:
    """Whether a line is 1,5: a number, or two of them."""
    return kind_of(line.strip(), ",") == "number"


def layout(path: Path, lines: Sequence[str], separators: Sequence[str] = SEPARATORS) -> TableLayout:
    """How a table is written, from its first lines.

    Raises InputError if there are no rows of numbers, if they can be read in two ways, or if titles and rows
    do not fit each other.
    """
    intervals = stated_intervals([line for line in lines[:LINES] if not BEGINS.match(line)])
    lines = ["" if line.strip() in intervals else line for line in lines[:LINES]]
    if (written := _written(lines, separators)) is None:
        raise InputError(f"{path}: is no table of numbers; allowed: {ALLOWED}")
    separator, decimal, kinds = written
    comment = re.compile(COMMENTS[separator])
    text = [
        (n, items(line, separator)) for n, line in enumerate(lines) if line.strip() and not comment.match(line)
    ]
    start = _first_row(text, kinds, decimal)
    notes: list[str] = []
    if start + 1 < len(text) and _are_channels(text[start : start + 3], kinds):
        notes.append(f"Line {text[start][0] + 1} numbers the columns, and is passed over.")
        start += 1
    _check_groups(path, [found for _, found in text[start:]], kinds, decimal)
    first = text[start][0]
    rows = [found for _, found in text[start:]]
    whole = any(len(found) == len(kinds) and found[-1] for _, found in text[:start])
    ended = len(kinds) > 1 and not whole and all(len(one) == len(kinds) and not one[-1] for one in rows)
    names = Titles(path, separator, decimal, len(kinds) - ended)
    titles = names.read(text[:start], list(enumerate(lines[:first])))
    titles += (("", None),) * ended
    notes += names.notes
    named = tuple((name or f"column_{n}", unit) for n, (name, unit) in enumerate(titles, 1))
    lacking = [f"column_{n}" for n, (name, _) in enumerate(titles[: len(kinds) - ended], 1) if not name]
    if 0 < len(lacking) < len(kinds) - ended:
        notes.append(f"Columns without a title are called {first_names(lacking)}.")
    return TableLayout(separator, decimal, first, named, kinds, tuple(notes), intervals)


def _first_row(text: Sequence[tuple[int, list[str]]], kinds: Sequence[str], decimal: str) -> int:
    """The index of the first row; one or two above a line of words alone, as the titles are, are none."""
    fits = [_is_row(found, kinds, decimal) for _, found in text]
    start, titled = fits.index(True), False
    for n, (_, found) in enumerate(text[: len(fits) - fits[::-1].index(True)]):
        own = [kind_of(item, decimal) for item in found]
        if len(own) == len(kinds) and "word" in own and not {"number", "stamp"} & {*own}:
            start = fits.index(True, n) if sum(fits[:n]) <= FEW and not (titled and any(fits[:n])) else start
            titled = True
    while start and any(_is_row(text[start - 1][1], kinds, one) for one in ".,"):
        start -= 1  # of whatever decimals: a row of others is wrong, and no line of titles
    return start


def _are_channels(rows: Sequence[tuple[int, list[str]]], kinds: Sequence[str]) -> bool:
    """Whether the first of some rows has the numbers 1, 2, 3 of the columns, and is no step of the times."""
    if len(rows) < 2 or len(kinds) < 3 or len(rows[0][1]) != len(kinds):
        return False
    numbered = any(rows[0][1] == [str(n) for n in range(base, base + len(kinds))] for base in (0, 1))
    try:
        times = [float(found[0].replace(",", ".")) for _, found in rows]
    except ValueError:
        return numbered
    steps = [after - before for before, after in pairwise(times)]
    return numbered and (
        steps[0] <= 0.0 or (len(steps) > 1 and abs(steps[0] - steps[1]) > 0.01 * abs(steps[1]))
    )


def _check_groups(path: Path, rows: Sequence[Sequence[str]], kinds: Sequence[str], decimal: str) -> None:
    """Raise InputError if signs may stand between thousands or before decimals, and no number decides."""
    found = [
        row[n] for row in rows if len(row) == len(kinds) for n, kind in enumerate(kinds) if kind == "number"
    ]
    sign, point = (",", ".") if decimal == "." else (".", ",")
    in_doubt = [one for one in found if sign in one and GROUPED.fullmatch(one)]
    pointed = [one for one in found if point in one]
    if decimal == "," and not in_doubt:  # then 1,234 is decimal or a thousand
        in_doubt, pointed = pointed, [one for one in pointed if not GROUPED.fullmatch(one)]
    if in_doubt and not pointed and not any(MANY_GROUPS.fullmatch(one) for one in found):
        digits = in_doubt[0].replace(",", "").replace(".", "")
        part = in_doubt[0].replace(",", ".")
        raise InputError(
            f"{path}: {in_doubt[0]!r} may be {digits} or {part}; allowed: decimals with a point, or at least "
            "a number that decides what the sign is, such as 0,5"
        )
