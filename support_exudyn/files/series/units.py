"""Units of series, by pint.

Three things differ from pint's own words. An angle is no pure number, so that deg is not made a number without
unit, nor Hz rad/s. `g` is the gram, but the standard gravity 9.80665 m/s^2 where an acceleration is asked for,
which grams cannot be. `Nm` is N m, where pint reads a count per length; `m/s2` is m/s^2.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import NamedSeries
from user_forces.values.value import InputError, short

NO_UNIT = ("-", "1", "no_units", "none", "unitless", "dimensionless")  # of pure numbers
LONGEST = 60  # letters of a unit
# letters, powers of at most two digits, and signs between them: pint computes what it is given, 9**9**9 too
WORDS = re.compile(r"[A-Za-z0-9µμ°%Ω_²³⁻¹·*/^() .+-]+")
COSTLY = re.compile(
    r"\d{3}|\d[eE]|[\d)]\s*(\*\*|\^)|(\*\*|\^)\s*-?\(|(\*\*|\^)[^*^]*(\*\*|\^)\s*[-\d.]*(\*\*|\^)"
)
TORQUE = re.compile(r"(?<![A-Za-z_])([kMm]?N)(m|mm|cm)(?![A-Za-z_])")
POWER = re.compile(r"(?<=[A-Za-zµμ])([2-4])(?![\d.])")
JOINED = re.compile(r"(?<=[A-Za-z])-(?=[A-Za-z])")  # newton-meter


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint  # 0.3 s, which a command that reads no units does not wait for

    return pint.UnitRegistry()


def as_pint_writes(text: str) -> str:
    """A unit in words that pint reads as they are meant; "" of pure numbers."""
    if text.strip() in NO_UNIT:
        return ""
    text = JOINED.sub("*", text.strip())
    return POWER.sub(r"**\1", TORQUE.sub(r"\1*\2", text))


@lru_cache(maxsize=1000)
def _unit(text: str) -> Any:
    """The unit of a text. Raises ValueError if pint reads none."""
    text = text.strip()
    if text in ("", *NO_UNIT):
        return _registry().Unit("")
    if len(text) > LONGEST or not WORDS.fullmatch(text) or COSTLY.search(text):
        raise ValueError("no unit")
    try:
        return _registry().Unit(as_pint_writes(text))
    except Exception:  # of pint's many kinds, and of the grammar below it
        raise ValueError("no unit") from None


def _base(text: str) -> Any:
    """The unit in base units, in which radians are one: units that can be converted have the same."""
    return _registry().get_root_units(_unit(text))[1]


def is_unit(text: str) -> bool:
    """Whether pint reads a text as a unit."""
    try:
        _unit(text)
    except ValueError:
        return False
    return True


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
    unit_checked(given, where)
    unit_checked(unit, where)
    if _same(given, unit):
        return values
    registry, known = _registry(), _unit(given)
    if given.strip() == "g" and _base(unit) == registry.Unit("m/s**2"):
        known = registry.Unit("standard_gravity")
    elif _base(given) != _base(unit):
        raise InputError(
            f"{where}: is in {given or 'pure numbers'}, which cannot be given in {unit or 'pure numbers'}; "
            f"allowed: units of one kind{_hint(given, unit)}"
        )
    converted: npt.NDArray[np.float64] = np.asarray(registry.Quantity(values, known).to(_unit(unit)).magnitude)
    return converted


def _same(one: str, other: str) -> bool:
    return bool(_unit(one) == _unit(other)) and one.strip() == other.strip()


def _hint(given: str, unit: str) -> str:
    if _base(given) / _base(unit) in (_registry().Unit("rad"), _registry().Unit("1/rad")):
        return "; an angle is no pure number: rpm and deg/s are rates of angles, Hz and 1/s are not"
    return ""


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


# --- titles of columns: a name and a unit, `tip.x [mm]`, `tip.x (mm)` or `tip.x_mm` ---

# by which a title may end after a low line; no letters that also name things, as A, B, C, l, t do
SMALL = {
    *("m", "mm", "cm", "um", "km", "mm2", "m2", "mm3", "m3", "s", "ms", "us", "min"),
    *("deg", "rad", "mrad", "rpm", "N", "kN", "MN", "mN", "Pa", "kPa", "MPa", "GPa", "bar", "mbar"),
    *("kg", "J", "kJ", "W", "kW", "Hz", "kHz", "degC", "percent", "inch", "ft", "lbf", "sec"),
}
PRODUCTS = {  # the only products: of v_m_s nobody knows whether it is a speed
    "N_m": "N*m", "kN_m": "kN*m", "MN_m": "MN*m", "N_mm": "N*mm", "N_s": "N*s", "kN_s": "kN*s",
    "kg_m2": "kg*m**2", "kg_m": "kg*m",
}  # fmt: skip
ENDINGS = {**{one: as_pint_writes(one) for one in SMALL}, **PRODUCTS}
ABOVE = {**ENDINGS, "l": "l", "t": "t"}  # a "per"
BELOW = {**ENDINGS, "s2": "s**2", "h": "h"}
BRACKETS = re.compile(r"(.*\S)\s*(?:\[([^\[\]]*)\]|\(([^()]*)\))", re.DOTALL)


def split_title(title: str) -> tuple[str, str | None, str]:
    """The name of a column, its unit (None: it has none), and a note on it, or nothing."""
    title = title.strip()
    if found := BRACKETS.fullmatch(title):
        name, square, round_ = found.groups()
        unit = (round_ if square is None else square).strip()
        if not unit:
            return name, None, ""
        if is_unit(unit):
            return name, as_pint_writes(unit), ""
        return title, None, f"column {title!r}: {unit!r} is no unit that pint reads; it counts as none"
    words = title.split("_")
    for start in range(1, len(words)):
        unit = _ending("_".join(words[start:]))
        if unit is None:
            continue
        if words[start - 1] in SMALL and start > 1:
            return title, None, f"column {title!r}: its unit can be read in two ways; it counts as none"
        return "_".join(words[:start]), unit, ""
    return title, None, ""


def _ending(text: str) -> str | None:
    """The unit that an ending stands for, None: for none."""
    above, per, below = text.partition("_per_")
    if not per and text.startswith("per_"):
        above, per, below = "1", "per_", text[len("per_") :]
    if not per:
        return ENDINGS.get(text)
    over = "1" if above == "1" else ABOVE.get(above)
    units = [BELOW.get(one) for one in below.split("_")]
    if over is None or None in units:
        return None
    words = "*".join(map(str, units))
    return f"{over}/({words})" if len(units) > 1 else f"{over}/{words}"
