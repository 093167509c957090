"""How a table of text is written: separator of its items, decimals, kinds of its columns, titles and units."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import numpy as np

from support_exudyn.files.series.columns import first_names
from support_exudyn.files.series.stamps import is_stamp
from support_exudyn.files.series.units import is_called_time, is_time, read_unit, scaled, split_title
from user_forces.values.value import InputError

BLANKS = " "  # any number of blanks and tabs
SEPARATORS = ("\t", ";", ",", "|", BLANKS)
COMMENTS = {one: re.compile(r"\s*(#|%|!|//)" if one == ";" else r"\s*(#|%|!|//|;)") for one in SEPARATORS}
MISSING = {  # items that are no numbers, in small letters
    *("", "nan", "-nan", "na", "n/a", "#n/a", "#nv", "nv", "null", "none", "nil", "nat", "-", "--", "---", "?"),
    *("*", "#value!", "#div/0!", "#ref!", "#num!", "#name?", "missing", "no data", "n.a.", "k.a.", "---.-"),
    *("--.--", "1.#qnan", "-1.#qnan", "1.#ind", "-1.#ind", "1.#inf", "-1.#inf", "nan(ind)", "-nan(ind)"),
}
ITEMS = re.compile(r'"[^"]*"|\S+')  # that blanks separate
SIGNS = " '\u00a0\u202f"  # between thousands, as a comma or a point may be
NUMBERS = {  # by what the decimals are behind
    point: re.compile(
        rf"[+-]?([0-9]+{dot}?[0-9]*|{dot}[0-9]+|[0-9]{{1,3}}([{other}{SIGNS}][0-9]{{3}})+({dot}[0-9]*)?)"
        r"([eEdD][+-]?[0-9]+)?|[+-]?(?i:inf|infinity)"
    )
    for point, dot, other in ((".", r"\.", ","), (",", ",", "."))
}
GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}([.,])[0-9]{3}")  # 1,234: a thousand, or one and a bit
MANY_GROUPS = re.compile(
    r"[+-]?[0-9]{1,3}([., '])[0-9]{3}(\1[0-9]{3})+|[+-]?[0-9]{1,3}([.,][0-9]{3})+[.,][0-9]+"
)
FEW = 2  # lines of numbers, such as sizes, that may stand above the titles
LINES = 400  # by which a layout is determined
ALLOWED = "rows of numbers below a line of titles such as time_s,tip.x_mm"
Title = tuple[str, str | None]  # a name, and a unit, None without one
Lines = Sequence[tuple[int, list[str]]]  # indices of lines, and their items


@dataclass(frozen=True)
class TableLayout:
    """How a table is written.

    separator: between items. decimal: "." or ",". first: the index of the first line of numbers.
    titles: a name and a unit for each item. kinds: "number", "stamp" or "word" for each.
    notes: on what was assumed. intervals: between rows [s] that the lines above give, by those lines.
    """

    separator: str
    decimal: str
    first: int
    titles: tuple[Title, ...]
    kinds: tuple[str, ...]
    notes: tuple[str, ...] = ()
    intervals: Mapping[str, float] = field(default_factory=dict)

    @property
    def comment(self) -> re.Pattern[str]:
        """The pattern by which lines of comments begin."""
        return COMMENTS[self.separator]


def items(line: str, separator: str) -> list[str]:
    """The items of a line, without blanks around them."""
    if separator == BLANKS:
        return [one.strip('"') for one in ITEMS.findall(line)]
    if '"' not in line:
        return [one.strip() for one in line.split(separator)]
    try:
        return [one.strip() for one in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]
    except csv.Error:  # an item that is too long
        return [line]


@lru_cache(maxsize=100_000)
def kind_of(item: str, decimal: str) -> str:
    """What an item is: "missing", "number", "stamp" or "word"."""
    if item.casefold() in MISSING:
        return "missing"
    if NUMBERS[decimal].fullmatch(item):
        return "number"
    return "stamp" if is_stamp(item) else "word"


def layout(path: Path, lines: Sequence[str], separators: Sequence[str] = SEPARATORS) -> TableLayout:
    """How a table is written, from its first lines.

    Raises InputError if there are no rows of numbers, if they can be read in two ways, or if titles and rows
    do not fit each other.
    """
    intervals = stated_intervals([line for line in lines[:LINES] if not re.match(r'[\s"]*[-+.,]?[0-9]', line)])
    lines = ["" if line.strip() in intervals else line for line in lines[:LINES]]
    if (written := _written(lines, separators)) is None:
        raise InputError(f"{path}: is no table of numbers; allowed: {ALLOWED}")
    separator, decimal, kinds = written
    comment = COMMENTS[separator]
    text = [
        (n, items(line, separator)) for n, line in enumerate(lines) if line.strip() and not comment.match(line)
    ]
    start = _first_row(text, kinds, decimal)
    notes: list[str] = []
    after = text[start + 1][1] if len(kinds) > 2 and start + 1 < len(text) else [""]
    if text[start][1] == [str(n + 1) for n in range(len(kinds))] and after[0].startswith("0"):  # no time of 1
        notes.append(f"Line {text[start][0] + 1} numbers the columns, and is passed over.")
        start += 1
    first, rows = text[start][0], [found for _, found in text[start:]]
    _check_groups(path, [row for row in rows if len(row) == len(kinds)], kinds, decimal)
    whole = any(len(found) == len(kinds) and found[-1] for _, found in text[:start])
    ended = len(kinds) > 1 and not whole and all(len(one) == len(kinds) and not one[-1] for one in rows)
    titles = _titles(path, lines[:first], separator, decimal, len(kinds) - ended, notes)
    lacking = [f"column_{n}" for n, (name, _) in enumerate(titles, 1) if not name]
    if 0 < len(lacking) < len(titles):
        notes.append(f"Columns without a title are called {first_names(lacking)}.")
    titles += [("", None)] * ended
    named = tuple((name or f"column_{n}", unit) for n, (name, unit) in enumerate(titles, 1))
    return TableLayout(separator, decimal, first, named, kinds, tuple(notes), intervals)


# --- separators, decimals, kinds and the first row ---


def _written(lines: Sequence[str], separators: Sequence[str]) -> tuple[str, str, tuple[str, ...]] | None:
    """What separates items, what decimals are and what columns are; None of no table.

    The most rows count, then the largest share of columns that are numbers.
    """
    quoted = any('"' in line for line in lines)
    best, written = (0, 0.0), None
    for separator in separators:
        for decimal in ".," if separator != "," or quoted else ".":
            rows, kinds = _tried(lines, separator, decimal)
            score = (rows, sum(one != "word" for one in kinds) / max(len(kinds), 1))
            if score > best and rows:
                best, written = score, (separator, decimal, kinds)
    single = {one: sum(kind_of(line.strip(), one) == "number" for line in lines) for one in ".,"}
    decimal = max(single, key=lambda one: single[one])
    by_comma = written is not None and written[0] == ","
    # 1,5 is a number, or two of them: titles with a comma tell
    words = [line for line in lines if kind_of(line.strip(), ",") != "number" and not COMMENTS[","].match(line)]
    titled = any("," in line for line in words)
    if single[decimal] and (single[decimal] > best[0] or (by_comma and single[decimal] == best[0])):
        return written if by_comma and titled else (";", decimal, ("number",))  # a column without times
    return written


def _tried(lines: Sequence[str], separator: str, decimal: str) -> tuple[int, tuple[str, ...]]:
    """How many rows there are if lines are separated so, and what their columns are."""
    text = [line for line in lines if line.strip() and not COMMENTS[separator].match(line)]
    split = [items(line, separator) for line in text]
    counts = [sum(kind_of(one, decimal) in ("number", "stamp") for one in found) for found in split]
    score: Counter[int] = Counter()  # of widths, by their numbers and by titles of times
    for found, count in zip(split, counts, strict=True):
        score[len(found)] += count or (len(found) > 1 and 10**6 * any(map(is_time_title, found)))
    for width, _ in score.most_common(3):
        rows = [found for found, count in zip(split, counts, strict=True) if len(found) == width and count]
        kinds = tuple(_kind([row[n] for row in rows], decimal) for n in range(width))
        fitting = sum(_is_row(one, kinds, decimal) for one in rows)
        if width > 1 and fitting:
            return fitting, kinds
    return 0, ()


def _kind(column: Sequence[str], decimal: str) -> str:
    """What a column is: of numbers or stamps where at least as many items are as words."""
    count = Counter(kind_of(item, decimal) for item in column)
    most = max(("number", "stamp"), key=lambda kind: count[kind])
    return "word" if count["word"] > count[most] else most


def _is_row(found: Sequence[str], kinds: Sequence[str], decimal: str) -> bool:
    """Whether items are numbers and stamps where they belong, at least one of them."""
    own = [kind_of(item, decimal) for item in found]
    pairs = list(zip(own, kinds, strict=False))
    fits = len(own) == len(kinds) and all(kind in ("word", one) or one == "missing" for one, kind in pairs)
    return fits and any(one == kind != "word" for one, kind in pairs)


def _first_row(text: Lines, kinds: Sequence[str], decimal: str) -> int:
    """The index of the first row; one or two above a line of words alone, as the titles are, are none."""
    fits = [_is_row(found, kinds, decimal) for _, found in text]
    start, titled = fits.index(True), False
    for n, (_, found) in enumerate(text[: len(fits) - fits[::-1].index(True)]):
        own = {kind_of(item, decimal) for item in found}
        if len(found) == len(kinds) and "word" in own and not {"number", "stamp"} & own:
            start = fits.index(True, n) if sum(fits[:n]) <= FEW and not (titled and any(fits[:n])) else start
            titled = True
    while start and any(_is_row(text[start - 1][1], kinds, one) for one in ".,"):
        start -= 1  # of whatever decimals: a row of others is wrong, and no line of titles
    return start


def _check_groups(path: Path, rows: Sequence[Sequence[str]], kinds: Sequence[str], decimal: str) -> None:
    """Raise InputError if signs may stand between thousands or before decimals, and no number decides."""
    found = [row[n] for row in rows for n, kind in enumerate(kinds) if kind == "number"]
    sign, point = (",", ".") if decimal == "." else (".", ",")
    in_doubt = [one for one in found if sign in one and GROUPED.fullmatch(one)]
    pointed = [one for one in found if point in one]
    if decimal == "," and not in_doubt:  # then 1,234 is decimal or a thousand
        in_doubt, pointed = pointed, [one for one in pointed if not GROUPED.fullmatch(one)]
    if in_doubt and not pointed and not any(MANY_GROUPS.fullmatch(one) for one in found):
        digits, part = re.sub("[.,]", "", in_doubt[0]), in_doubt[0].replace(",", ".")
        raise InputError(
            f"{path}: {in_doubt[0]!r} may be {digits} or {part}; allowed: decimals with a point, or at least "
            "a number that decides what the sign is, such as 0,5"
        )


# --- titles ---


def _titles(
    path: Path, lines: Sequence[str], separator: str, decimal: str, width: int, notes: list[str]
) -> list[Title]:
    """A name, empty if there is none, and a unit for each column, from the lines above the rows.

    notes: receives what was assumed. Raises InputError if the last line has titles, but not one for each item.
    """
    comment = COMMENTS[separator]
    plain = [(n, line) for n, line in enumerate(lines) if line.strip() and not comment.match(line)]
    bare = [(n, comment.sub("", line, count=1)) for n, line in enumerate(lines) if comment.match(line)]
    split = [
        [(n, found) for n, line in some if (found := _fitted(line, separator, width))] for some in (plain, bare)
    ]
    fitting = [one for one in split[0] or split[1] if _may_be_titles(one[1], decimal)]
    if not fitting:
        number, found = (plain[-1][0], items(plain[-1][1], separator)) if plain else (0, [])
        if len(found) > 1 and any(kind_of(one, decimal) == "word" for one in found):
            phrase = {"\t": "tabs", BLANKS: "blanks", ",": "commas"}.get(separator, repr(separator))
            raise InputError(
                f"{path}: line {number + 1}: has {len(found)} titles, separated by {phrase}, above rows of "
                f"{width} items; allowed: as many titles as items; where commas are decimal points items need "
                "another separator, ';'"
            )
        notes.append("There are no titles; columns are called by their numbers, column_1 and so on.")
        return [("", None)] * width
    end = next((n for n in range(1, len(fitting)) if _are_units(fitting[n][1])), len(fitting))
    timed = [one for one in fitting[:end] if any(map(is_time_title, one[1]))]
    used = [(timed or fitting[:end])[-1], *fitting[end : end + 1]]  # titles, units
    if passed := len({n for n, _ in plain} - {n for n, _ in used}):
        notes.append(f"{passed} {'line' if passed == 1 else 'lines'} above the rows passed over.")
    titles = []
    for word, below in zip(used[0][1], used[1][1] if used[1:] else [""] * width, strict=True):
        name, unit, note = split_title(word)
        if below := below.strip("[](){} "):
            unit, note = read_unit(below, is_called_time(word))
            if unit is None and not note:
                note = f"{below!r} is no unit that pint reads; it counts as none"
            note = note and f"column {name!r}: {note}"
        notes += [f"{note[0].upper()}{note[1:]}."] if note else []
        titles.append((name, unit))
    return titles


def _fitted(line: str, separator: str, width: int) -> list[str] | None:
    """The items of a line, None if they are not as many as those of a row."""
    found = items(line, separator)
    for gap in (r"\s+(?![\[(])", r"\s{2,}|\t"):  # a unit in brackets is no title
        if separator == BLANKS and len(found) != width:
            found = re.split(gap, line.strip())
    found = found if any(found[width:]) else found[:width]
    return found if len(found) == width and any(found) else None


def _may_be_titles(found: Sequence[str], decimal: str) -> bool:
    """Whether items are words rather than numbers, or stand behind a title of times."""
    count = Counter(kind_of(one, decimal) for one in found)
    named = 0 < count["word"] >= count["number"]
    return not count["stamp"] and (named or is_time_title(found[0]))


def _are_units(words: Sequence[str]) -> bool:
    """Whether a line has units for titles above it: most of its items."""
    bare = [one for word in words if (one := word.strip("[](){} ")) not in ("", "-")]
    known = [one for one in bare if any(read_unit(one))]
    return 2 * len(known) > len(bare) and not any(is_time_title(one) for one in words if one != "t")


@lru_cache(maxsize=10_000)
def is_time_title(title: str) -> bool:
    """Whether a title is one of times or dates, by its name or its unit."""
    name, unit, _ = split_title(title)
    is_date = re.search(r"\b(date|datum|fecha)\b|日期", name, re.IGNORECASE)
    return is_called_time(name) or (unit is not None and is_time(unit)) or is_date is not None


# --- rates that lines above the rows give ---

VALUE = (
    r"[\s:=,;\t\"]*(?:[\[(]\s*(?P<before>[^\])]{1,12})\s*[\])])?[\s:=,;\t\"]*"
    r"(?P<number>[0-9]*[.,]?[0-9]+(?:[eE][+-]?[0-9]+)?)(?![0-9]*[:/-][0-9])"
    r"\s*\"?[\s,;\t]*[\[(]?\s*(?P<unit>[^\s,;\"\])]{1,12}(?: per \w+)?)?"
)
SAMPLED = r"(?:sampl\w*|scan\w*|acqui\w*|data|log\w*|record\w*|mess|abtast|采样)[ _-]*"
RATE = re.compile(rf"(?:{SAMPLED}(?:rate|freq\w*|频率|率|速率)|\bfs\b|\bf_s\b|\brate\b){VALUE}", re.IGNORECASE)
INTERVAL = re.compile(
    rf"(?:{SAMPLED}(?:interval\w*|period|time|step|spacing|increment|zeit|periode|间隔|周期)|\bdt\b"
    rf"|\bdelta[ _]?[xt]\b|(?:time|x)[ _-]*(?:step|interval|increment)|\binterval\b|zeitschritt){VALUE}",
    re.IGNORECASE,
)
PER_SECOND = re.compile(r"([kM]?)(?:s|sa|samples?|scans|pts|次)(?:/| per )(?:s|sec|second|秒)|(k?)sps", re.I)


def stated_intervals(lines: Sequence[str]) -> dict[str, float]:
    """The times between rows [s] that some lines give as a rate or an interval, by the lines."""
    found: dict[str, float] = {}
    for line in lines:
        rate, interval = RATE.search(line), INTERVAL.search(line)
        match, usual = (rate, "Hz") if rate else (interval, "s")
        if match is None:
            continue
        number, phrase = match["number"], (match["before"] or match["unit"] or usual).strip(" .")
        is_thousands = rate and re.fullmatch(r"[1-9][0-9]{0,2},[0-9]{3}", number)
        unit = read_unit(phrase, of_time=not rate)[0] or usual
        if samples := PER_SECOND.fullmatch(phrase):
            unit = f"{samples[1] or samples[2] or ''}Hz"
        value = float(number.replace(",", "" if is_thousands else "."))
        try:
            known = float(scaled(np.array([value]), unit, usual, "")[0])
        except InputError:
            continue
        if known > 0.0:
            found[line.strip()] = 1.0 / known if rate else known
    return found
