"""Units as ADAMS writes them, in words that pint reads."""

from __future__ import annotations

import re

from support_exudyn.files.series.units import as_pint_writes, is_unit

WORD = re.compile(r"[A-Za-z_]+")
NAMES = {  # those that pint does not know, or reads otherwise
    "pound_mass": "pound", "kpound_mass": "kilopound", "ounce_mass": "ounce", "kpound_force": "kilopound_force",
    "knewton": "kilonewton", "kgf": "kilogram_force", "hz": "hertz", "angular_minutes": "arcminute",
    "angular_seconds": "arcsecond", "kw": "kilowatt", "kwh": "kilowatt_hour", "volt": "volt",
}  # fmt: skip


def adams_unit(text: str) -> str | None:
    """The unit of `newton-meter`, `inch/sec**2` or `no_units`; None if there is none, or pint reads none."""
    text = text.strip()
    if not text:
        return None
    found = WORD.sub(lambda word: _word(word.group()), text)
    return as_pint_writes(found) if is_unit(found) else None


def _word(word: str) -> str:
    if word in NAMES:
        return NAMES[word]
    if word.lower() in NAMES:
        return NAMES[word.lower()]
    return word.lower() if word.lower() != word and not is_unit(word) else word
