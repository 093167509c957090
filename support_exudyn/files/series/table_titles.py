"""Items of tables of text, numbers, stamps and words; titles, units and rates in the lines above the rows."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np

from support_exudyn.files.series.stamps import is_stamp
from support_exudyn.files.series.units import is_called_time, is_time, read_unit, scaled, split_title
from user_forces.values.value import InputError

BLANKS = " "  # any number of blanks and tabs
SEPARATORS = ("\t", ";", ",", "|", BLANKS)
COMMENTS = {one: r"[ \t]*(#|%|!|//)" if one == ";" else r"[ \t]*(#|%|!|//|;)" for one in SEPARATORS}
MISSING = {  # items that are no numbers, in small letters
    *("", "nan", "-nan", "na", "n/a", "#n/a", "#nv", "nv", "null", "none", "nil", "nat", "-", "--", "---", "?"),
    *("*", "#value!", "#div/0!", "#ref!", "#num!", "#name?", "missing", "no data", "n.a.", "k.a.", "---.-"),
    "--.--",
}
NOTHING = r"[+-]?(1[.,]#(QNAN|SNAN|IND|INF)0*|nan\(ind\)|nan\(snan\))"  # as Microsoft's compilers write them
ITEMS = re.compile(r'"[^"]*"|\S+')  # that blanks separate
SIGNS = " '\u00a0\u202f"  # between thousands, as a comma or a point may be
NUMBERS = {  # by what the decimals are behind
    point: rf"[+-]?([0-9]+{dot}?[0-9]*|{dot}[0-9]+|[0-9]{{1,3}}([{other}{SIGNS}][0-9]{{3}})+({dot}[0-9]*)?)"
    r"([eEdD][+-]?[0-9]+)?"
    for point, dot, other in ((".", r"\.", ","), (",", ",", "."))
}
INFINITE = r"[+-]?(?i:inf|infinity|∞)"
PYTHON = {point: re.compile(rf"{pattern}|{INFINITE}") for point, pattern in NUMBERS.items()}


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
    small = item.casefold()
    if small in MISSING or re.fullmatch(NOTHING, item, re.IGNORECASE):
        return "missing"
    if PYTHON[decimal].fullmatch(item):
        return "number"
    return "stamp" if is_stamp(item) else "word"


# --- titles ---


class Titles:
    """The titles of a table's columns, from the lines above its rows; notes report what was assumed."""

    def __init__(self, path: Path, separator: str, decimal: str, width: int) -> None:
        self._path, self._separator, self._decimal, self._width = path, separator, decimal, width
        self.notes: list[str] = []

    def read(
        self, text: Sequence[tuple[int, list[str]]], lines: Sequence[tuple[int, str]]
    ) -> tuple[tuple[str, str | None], ...]:
        """A name, empty if there is none, and a unit for each column.

        text: lines above the rows, with their items; lines: all of them, also comments.
        """
        comment = re.compile(COMMENTS[self._separator])
        fitting = [(n, found) for n, line in lines if not comment.match(line) and (found := self._fitted(line))]
        if not fitting:
            bare = [(n, comment.sub("", line, count=1)) for n, line in lines if comment.match(line)]
            fitting = [(n, found) for n, line in bare if (found := self._fitted(line))]
        fitting = [one for one in fitting if self._may_be_titles(one[1])]
        if not fitting and (found := self._a_line_each(lines)):
            return self._named(found, None)
        if not fitting:
            self._check(text)
            self.notes.append("There are no titles; columns are called by their numbers, column_1 and so on.")
            return (("", None),) * self._width
        units = next((n for n in range(1, len(fitting)) if self._are_units(fitting[n][1])), None)
        above = fitting if units is None else fitting[:units]
        timed = [one for one in above if any(is_time_title(title) for title in one[1])]
        place, titles = (timed or above)[-1]
        below = fitting[units][1] if units is not None and fitting[units][0] > place else None
        used = (place, fitting[units][0] if below is not None and units is not None else place)
        passed = sum(bool(line.strip()) and not comment.match(line) and n not in used for n, line in lines)
        if passed:
            self.notes.append(f"{passed} {'line' if passed == 1 else 'lines'} above the rows passed over.")
        return self._named(titles, below)

    def _fitted(self, line: str) -> list[str] | None:
        """The items of a line, None if they are not as many as those of a row."""
        found = items(line, self._separator)
        if self._separator == BLANKS and len(found) != self._width:  # a unit in brackets is no title
            for gap in (r"\s+(?![\[(])", r"\s{2,}|\t"):
                found = re.split(gap, line.strip()) if len(found) != self._width else found
        if len(found) > self._width and not any(found[self._width :]):
            found = found[: self._width]
        return found if len(found) == self._width and any(found) else None

    def _may_be_titles(self, found: Sequence[str]) -> bool:
        """Whether items are words rather than numbers, or stand behind a title of times."""
        kinds = [kind_of(one, self._decimal) for one in found]
        words = sum(one == "word" for one in kinds)
        if "stamp" in kinds:
            return False
        return is_time_title(found[0]) or (bool(words) and 2 * words >= sum(one != "missing" for one in kinds))

    def _check(self, text: Sequence[tuple[int, list[str]]]) -> None:
        """Raise InputError if the line above the rows has titles, and not as many as the rows have items."""
        number, found = text[-1] if text else (0, [])
        if len(found) < 2 or not any(kind_of(one, self._decimal) == "word" for one in found):
            return
        more = (
            "; where commas are decimal points items need another separator, ';'"
            if self._separator == ","
            else ""
        )
        phrase = {"\t": "tabs", BLANKS: "blanks", ",": "commas"}.get(self._separator, repr(self._separator))
        raise InputError(
            f"{self._path}: line {number + 1}: has {len(found)} titles, separated by {phrase}, above rows of "
            f"{self._width} items; allowed: as many titles as items{more}"
        )

    def _a_line_each(self, lines: Sequence[tuple[int, str]]) -> list[str] | None:
        """Titles that stand a line each; None if the lines above the rows are other ones."""
        words = [line.strip().strip('"') for _, line in lines if line.strip()][-self._width :]
        single = all(len(items(one, self._separator)) == 1 or self._separator == BLANKS for one in words)
        return words if len(words) == self._width and single and is_time_title(words[0]) else None

    def _are_units(self, words: Sequence[str]) -> bool:
        """Whether a line has units for titles above it: most of its items."""
        bare = [one for word in words if (one := word.strip("[](){} ")) not in ("", "-")]
        known = [one for one in bare if read_unit(one)[0] is not None or read_unit(one)[1]]
        return (
            bool(known)
            and 2 * len(known) > len(bare)
            and not any(is_time_title(one) for one in words if one != "t")
        )

    def _named(self, words: Sequence[str], below: Sequence[str] | None) -> tuple[tuple[str, str | None], ...]:
        found = []
        for n, word in enumerate(words):
            name, unit, note = split_title(word)
            if below is not None and (bare := below[n].strip("[](){} ")):
                unit, note = read_unit(bare, is_called_time(word)) if bare not in ("-", "--") else ("", "")
                note = f"column {name!r}: {note}" if note else ""
                if unit is None and not note:
                    note = f"column {word!r}: {bare!r} is no unit that pint reads; it counts as none"
            if note:
                self.notes.append(f"{note[0].upper()}{note[1:]}.")
            found.append((name, unit))
        return tuple(found)


@lru_cache(maxsize=10_000)
def is_time_title(title: str) -> bool:
    """Whether a title is one of times, by its name or its unit."""
    name, unit, _ = split_title(title)
    return is_called_time(name) or (unit is not None and is_time(unit)) or is_called_date(name)


def is_called_date(name: str) -> bool:
    """Whether a title is one of dates."""
    return re.search(r"\b(date|datum|fecha)\b|日期", name, re.IGNORECASE) is not None


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
PER_SECOND = re.compile(r"[kM]?(s|sa|samples?|scans|pts|次)(/| per )(s|sec|second|秒)|k?sps", re.IGNORECASE)


def stated_intervals(lines: Sequence[str]) -> dict[str, float]:
    """The times between rows [s] that some lines give as a rate or an interval, by the lines."""
    found: dict[str, float] = {}
    for line in lines:
        for pattern, usual in ((RATE, "Hz"), (INTERVAL, "s")):
            if (match := pattern.search(line)) is None:
                continue
            number = match["number"]
            is_thousands = usual == "Hz" and re.fullmatch(r"[1-9][0-9]{0,2},[0-9]{3}", number)
            value = float(number.replace(",", "" if is_thousands else "."))
            phrase = (match["before"] or match["unit"] or usual).strip(" .")
            unit = read_unit(phrase, of_time=usual == "s")[0] or usual
            if PER_SECOND.fullmatch(phrase):
                unit, value = "Hz", value * {"k": 1e3, "M": 1e6}.get(phrase[0], 1.0)
            try:
                known = float(scaled(np.array([value]), unit, usual, "")[0])
            except InputError:
                continue
            if known > 0.0:
                found[line.strip()] = 1.0 / known if usual == "Hz" else known
                break
    return found
