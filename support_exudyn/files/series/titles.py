"""Titles of columns: a name and a unit, written as `tip.x [mm]`, `tip.x (mm)` or `tip.x_mm`."""

from __future__ import annotations

import re

from support_exudyn.files.series.units import as_pint_writes, is_unit

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
    """The name of a column, its unit (None: it has none), and what has to be told of it, or nothing."""
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
