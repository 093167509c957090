"""Whether loaded pins that slide shake, as a table: what `show` and `check` tell before and after a run."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from support_exudyn.postprocessing.figures.units import said
from support_exudyn.scenario.pin_stability import PinOutlook

HEADER = (
    "pin",
    "sliding",
    ">growth rate",
    ">frequency",
    ">worst at",
    ">friction",
    ">shakes from",
)
DIGITS = 3
TITLE = "do loaded pins shake as they slide? at the worst posture of the stroke"


def rows(outlooks: Sequence[PinOutlook]) -> list[tuple[str, ...]]:
    """Pin, verdict, growth rate, frequency, travel of the drive there, friction there and the critical one."""
    found: list[tuple[str, ...]] = []
    for one in outlooks:
        told = _data(one)
        pin = f"{one.pin}, if it had such play" if one.assumed else one.pin
        if told["growth_rate_per_s"] is None:
            found.append((pin, "nowhere at rest", "", "", "", "", ""))
            continue
        at = f"{math.degrees(told['travel']):.0f} deg" if one.turns else f"{1e3 * told['travel']:.0f} mm"
        critical = told["critical_friction"]
        found.append(
            (
                pin,
                _verdict(one),
                f"{_growth(told):.{DIGITS}g} /s",
                said(told["frequency_Hz"], "Hz", DIGITS) if told["frequency_Hz"] else "none",
                at,
                f"{told['friction']:.{DIGITS}g}",
                "none up to 1" if critical is None else f"{critical:.{DIGITS}g}",
            )
        )
    return found


def _verdict(outlook: PinOutlook) -> str:
    """What small motions do at the postures at which they are about an equilibrium."""
    if any(pin is not None and not pin.stable for pin in outlook.found):
        return "shakes"
    return "stable" if outlook.stable else "in part nowhere at rest"


def _growth(told: Mapping[str, Any]) -> float:
    """The growth rate [1/s], without what is rounding where nothing grows."""
    growth: float = told["growth_rate_per_s"]
    return min(growth, 0.0) if told["stable"] else growth


def data(outlooks: Sequence[PinOutlook]) -> list[dict[str, Any]]:
    """Whether each pin shakes, as plain data in SI; what there is not is None."""
    return [_data(one) for one in outlooks]


def _data(one: PinOutlook) -> dict[str, Any]:
    worst = one.worst
    pin = None if worst is None else one.found[worst]
    critical = one.critical_friction
    told: dict[str, Any] = {
        "pin": one.pin,
        "assumed": one.assumed,
        "stable": one.stable,
        "growth_rate_per_s": None,
        "critical_friction": critical if math.isfinite(critical) else None,
    }
    if worst is None or pin is None:
        return told
    return told | {
        "growth_rate_per_s": pin.growth,
        "frequency_Hz": pin.frequency,
        "time_s": float(one.times[worst]),
        "travel": float(one.travels[worst]),
        "friction": pin.friction,
        "beyond_painleve": pin.normal_mobility < 0.0,
    }
