"""Units of series: how files write them, and their conversion by pint.

Three things differ from pint's own words. An angle is no pure number, so that deg is not made a number without
unit, nor Hz rad/s. `g` is the gram, but the standard gravity 9.80665 m/s^2 where an acceleration is asked for,
which grams cannot be; likewise `t` is the tonne, but its weight where a force is asked for. `Nm` is N m, where
pint reads a count per length; `m/s2` is m/s^2.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import NamedSeries
from user_forces.values.value import InputError, short

NO_UNIT = ("", "-", "--", "1", "no_units", "none", "unitless", "dimensionless", "[-]")  # of pure numbers
LONGEST = 60  # letters of a unit
WORDS = re.compile(r"[A-Za-z0-9µμε°%Ω_²³⁻¹·⋅*/^() .+-]+")
COSTLY = re.compile(
    r"[0-9]{3}|[0-9][eE]|[0-9.)]\s*(\*\*|\^)"
)  # powers of numbers, which pint computes: 9**9**9
TORQUE = re.compile(r"(?<![A-Za-z_])([kMm]?N)(m|mm|cm)(?![A-Za-z_])")
POWER = re.compile(r"(?<=[A-Za-zµμ])([2-4])(?![\d.])")
JOINED = re.compile(r"(?<=[A-Za-z])-(?=[A-Za-z])")  # newton-meter
LETTERS = re.compile(r"[A-Za-zµμε°_]+")
# by which a title may end after a low line; no letters that also name things, as A, B, C, l, t do
SMALL = {
    *("m", "mm", "cm", "um", "km", "mm2", "m2", "mm3", "m3", "s", "ms", "us", "min"),
    *("deg", "rad", "mrad", "rpm", "N", "kN", "MN", "mN", "Pa", "kPa", "MPa", "GPa", "bar", "mbar"),
    *("kg", "J", "kJ", "W", "kW", "Hz", "kHz", "degC", "percent", "inch", "ft", "lbf", "sec"),
}
USUAL = {*SMALL, "h", "l", "g", "t", "°", "°C", "psi", "kgf", "tf", "lb", "μm", "μs", "K", "V", "mV", "A", "mA"}
# units in any case of letters that can be read in no other way; mPa and MPa, mN and MN can
CASED = {
    one.casefold(): one
    for one in {*USUAL, "ksi", "kips", "degF", "inches", "hPa", "N*m", "kN*m"} - {"MN", "mN", "mV"}
    if len(one) > 1
} | {"knm": "kN*m"}
WHOLE = {  # units as a whole, in any case of letters, that pint does not know or reads otherwise
    **dict.fromkeys(("r/min", "rev/min", "revs/min", "u/min", "upm", "rpm", "revolutions/min"), "rpm"),
    **dict.fromkeys(("r/s", "rev/s", "rps"), "turn/s"),
    **dict.fromkeys(("tonf", "ton-force", "tonne-force", "metric ton-force"), "tf"),
    **dict.fromkeys(("°c", "deg c", "deg. c", "degc", "celsius", "°celsius", "grad c"), "degC"),
    **dict.fromkeys(("tonne", "tonnes", "metric ton", "metric tons"), "t"),
    **dict.fromkeys(("ue", "ustrain", "µstrain", "µε", "με", "um/m", "µm/m"), "microstrain"),
    "lpm": "l/min", "gpm": "gallon/min", "m/s/s": "m/s**2", "pct": "%",
}  # fmt: skip
NAMES = {  # words that pint does not know, or reads otherwise
    "pound_mass": "pound", "kpound_mass": "kilopound", "ounce_mass": "ounce", "kpound_force": "kilopound_force",
    "knewton": "kilonewton", "kgf": "kilogram_force", "angular_minutes": "arcminute",
    "angular_seconds": "arcsecond", "kwh": "kilowatt_hour", "rev": "turn", "msec": "ms", "usec": "us",
    "secs": "s", "hrs": "h", "mins": "min",
}  # fmt: skip
OF_TIME = {"s": "s", "ms": "ms", "us": "us", "min": "min", "h": "h", "d": "day"}  # in any case, of times


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint  # 0.3 s, which a command that reads no units does not wait for

    return pint.UnitRegistry()


def _as_pint_writes(text: str) -> str:
    return POWER.sub(r"**\1", TORQUE.sub(r"\1*\2", JOINED.sub("*", text)))


@lru_cache(maxsize=1000)
def _unit(text: str) -> Any:
    """The unit of a text; None if pint reads none."""
    text = text.strip()
    if len(text) > LONGEST or (text and not WORDS.fullmatch(text)) or COSTLY.search(text):
        return None
    try:
        return _registry().Unit("" if text in NO_UNIT else _as_pint_writes(text))
    except Exception:  # of pint's many kinds, and of the grammar below it
        return None


def _base(text: str) -> Any:
    """The unit in base units, in which radians are one: units that can be converted have the same."""
    return _registry().get_root_units(_unit(text))[1]


def is_unit(text: str) -> bool:
    """Whether pint reads a text as a unit."""
    return _unit(text) is not None


@lru_cache(maxsize=1000)
def is_time(text: str) -> bool:
    """Whether a text is a unit of time."""
    return is_unit(text) and bool(_base(text) == _registry().Unit("s"))


def unit_checked(text: str, where: str) -> str:
    """The text. Raises InputError if it is no unit."""
    if not is_unit(text):
        raise InputError(f"{where}: {short(text)}: is no unit; allowed: such as mm, kN, deg/s, m/s^2, N*m, 1")
    return text


def scaled(values: npt.NDArray[np.float64], given: str, unit: str, where: str) -> npt.NDArray[np.float64]:
    """Values in `unit` from those in `given`, shape kept.

    where: what they are of, for messages. Raises InputError if one is no unit, or if they are of two kinds.
    """
    registry, known = _registry(), _unit(unit_checked(given, where))
    if given.strip() == unit_checked(unit, where).strip():
        return values
    if given.strip() == "g" and _base(unit) == registry.Unit("m/s**2"):
        known = registry.Unit("standard_gravity")
    elif given.strip() == "t" and _base(unit) == _base("N"):
        known = registry.Unit("force_metric_ton")
    elif _base(given) != _base(unit):
        of_angle = _base(given) / _base(unit) in (registry.Unit("rad"), registry.Unit("1/rad"))
        hint = "; an angle is no pure number: rpm and deg/s are rates of angles, Hz and 1/s are not"
        raise InputError(
            f"{where}: is in {given or 'pure numbers'}, which cannot be given in {unit or 'pure numbers'}; "
            f"allowed: units of one kind{hint if of_angle else ''}"
        )
    converted: npt.NDArray[np.float64] = np.asarray(registry.Quantity(values, known).to(_unit(unit)).magnitude)
    return converted


def converted(series: NamedSeries, unit: str) -> npt.NDArray[np.float64]:
    """The values of a series (n,) in `unit`, which pint reads.

    Raises InputError if the series has no unit, which nobody guesses, or one of another kind.
    """
    if series.unit is None:
        wanted = unit or "1"
        raise InputError(
            f"{series.name}: its file gives no unit, and {unit or 'a pure number'} is asked for; allowed: a "
            f"unit in the column's title, '{series.name} [{wanted}]', or in compare.toml, "
            f'[files.FILE.units] "{series.name}" = "{wanted}"'
        )
    return scaled(series.values, series.unit, unit, series.name)


# --- units as files write them ---


@lru_cache(maxsize=10_000)
def read_unit(text: str, of_time: bool = False) -> tuple[str | None, str]:
    """The unit that a file's text is, in words that pint reads, and a note on what was assumed, or nothing.

    None if it is none, or can be read in two ways. of_time: whether it stands behind a name of times, where S
    is the second and MIN the minute.
    """
    text = " ".join(unicodedata.normalize("NFKC", text).split())
    small = text.casefold()
    if text in NO_UNIT:
        return "", ""
    if of_time and small in OF_TIME:
        return OF_TIME[small], ""
    if small in WHOLE:
        return WHOLE[small], ""
    if small in ("ton", "tons"):
        return "t", f"unit {text!r} is read as the tonne of 1000 kg, and its weight where it is a force"
    if text in ("mpa", "mn", "Mn"):
        return None, f"unit {text!r} may be {'mPa or MPa' if text == 'mpa' else 'mN or MN'}; it counts as none"
    if text == "G":
        return "g", "unit 'G' is read as g"
    if text in ("mPa", "mN"):
        return text, f"unit {text!r} is a thousandth of {text[1:]}; {text.replace('m', 'M')} has a capital M"
    cased = CASED | {"s": "s", "m": "m"} if text.isupper() and "/" in text else CASED  # MM/S
    found = LETTERS.sub(lambda word: _word(word[0], cased), text)
    if not is_unit(found):
        return None, ""
    assumed = any(cased.get(word.casefold(), word) != word for word in LETTERS.findall(text))
    return _as_pint_writes(found), f"unit {text!r} is read as {found}" if assumed else ""


def _word(word: str, cased: Mapping[str, str]) -> str:
    """A word of a unit as pint knows it. cased: units by their small letters."""
    small = word.casefold()
    known = NAMES.get(small) or cased.get(small)
    return known or (small if len(word) > 2 and not is_unit(word) else word)


# --- titles of columns: a name and a unit ---

PRODUCTS = {  # the only products: of v_m_s nobody knows whether it is a speed
    "N_m": "N*m", "kN_m": "kN*m", "MN_m": "MN*m", "N_mm": "N*mm", "N_s": "N*s", "kN_s": "kN*s",
    "kg_m2": "kg*m**2", "kg_m": "kg*m",
}  # fmt: skip
ENDINGS = {**{one: _as_pint_writes(one) for one in SMALL}, **PRODUCTS}
PER = {**ENDINGS, "l": "l", "t": "t", "h": "h", "s2": "s**2", "1": "1"}  # before and behind a "per"
BRACKETS = re.compile(r"(.*\S)\s*(?:\[([^\[\]]*)\]|\(([^()]*)\)|\{([^{}]*)\})", re.DOTALL)
# "time, s", "Pressure/MPa", "Force in kN", "Force kN"; before a stroke stands no unit, as in mm/s
BARE = re.compile(r"(.*?[^\s,:/])(?:\s*(,|/)\s*|\s+(in)\s+|(\s+|:\s*))(\S+)", re.DOTALL)
TIMES = re.compile(r"(^|[^a-z])(time|zeit|temps|tiempo|tempo|timestamp)([^a-z]|$)|时间|时刻", re.IGNORECASE)


def is_called_time(name: str) -> bool:
    """Whether a name has a word for times, as Elapsed Time, Zeit or 时间."""
    return name.casefold() == "t" or TIMES.search(name.replace("_", " ")) is not None


@lru_cache(maxsize=10_000)
def split_title(title: str) -> tuple[str, str | None, str]:
    """The name of a column, its unit (None: it has none), and a note on it, or nothing.

    The unit stands in brackets, `tip.x [mm]`, `tip.x (mm)`; behind a low line, `tip.x_mm`; or if it is a usual
    one, as in `time, s`, `Pressure/MPa`, `Force in kN`, `Force kN`.
    """
    title = unicodedata.normalize("NFKC", title).strip() if not title.isascii() else title.strip()
    unit: str | None
    if found := BRACKETS.fullmatch(title):
        text = (found[2] or found[3] or found[4] or "").strip()
        name = found[1].rstrip(" /") or found[1]
        unit, note = read_unit(text, is_called_time(name)) if text else (None, "")
        if text and unit is None and not note:
            return title, None, f"column {title!r}: {text!r} is no unit that pint reads; it counts as none"
        return name, unit, f"column {name!r}: {note}" if note else ""
    words = title.split("_")
    for start in range(1, len(words)):
        name = "_".join(words[:start])
        unit, note = _ending(name, "_".join(words[start:]))
        if unit is not None and start > 1 and words[start - 1] in SMALL:
            return title, None, f"column {title!r}: its unit can be read in two ways; it counts as none"
        if unit is not None:
            return name, unit, f"column {name!r}: {note}" if note else ""
    if bare := BARE.fullmatch(title):
        unit, note = _usual(bare[1], bare[5], bare[2] or bare[3] or "")
        if unit is not None:
            return bare[1], unit, f"column {bare[1]!r}: {note}" if note else ""
    return title, None, ""


def _usual(name: str, text: str, sign: str) -> tuple[str | None, str]:
    """The unit, with a note, that stands in a title behind a sign or a blank; None if it is no usual one."""
    of_time = is_called_time(name)
    unit, note = read_unit(text, of_time)
    words = LETTERS.findall(text)
    usual = text.casefold() in WHOLE or all(_word(word, CASED).rstrip("2345") in USUAL for word in words)
    if unit is None or not words or not (usual or (of_time and is_time(unit))):
        return None, ""
    of_rate = sign == "/" and name in USUAL - {"t", "h", "l", "g"}  # "mm/s" is a unit and no name
    is_name = not sign and (text in ("min", "ms", "um") or len(text) < 2)  # the least force, sensor N
    return (None, "") if not of_time and text != "°" and (of_rate or is_name) else (unit, note)


def _ending(name: str, text: str) -> tuple[str | None, str]:
    """The unit that an ending of a title stands for, None: for none; and a note."""
    above, per, below = f"_{text}".partition("_per_")
    if per:
        units = [PER.get(one) for one in (above[1:] or "1", *below.split("_"))]
        return None if None in units else "/".join(map(str, units)), ""
    if text in ENDINGS:
        return ENDINGS[text], ""
    small = text.casefold()
    if is_called_time(name) and small in OF_TIME:
        return OF_TIME[small], ""
    if small in ("ton", "tonf") or (small in CASED and small not in ("min", "lb", "μs", "ms")):
        return read_unit(text)
    return ("g", "") if small == "g" and name.casefold().startswith("acc") else (None, "")
