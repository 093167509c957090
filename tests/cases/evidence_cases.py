"""Evidence of machines that never were: on one the paper is right in everything, on the other in nothing."""

from __future__ import annotations

from collections.abc import Mapping

from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible_runs import CASES, CLEARANCES, IDEAL, MODE_1, OIL, OIL_IDEAL

MIDDLE = CLEARANCES[2]
CURVES = {"force": 10000.0, "speed": 5.0, "acceleration": 100.0}  # ranges of the ideal pin's
Values = dict[str, dict[str, float]]


def right() -> Evidence:
    """All that the paper claims is so."""
    found = _empty()
    for name in (*CURVES, "tip"):
        _loose(found, f"likeness_{name}", (0.999, 0.998, 0.997, 0.996))
    _loose(found, "rms_force", (900.0, 1000.0, 1100.0, 1200.0))
    for name in ("rms_speed", "rms_speed_early", "rms_speed_middle", "rms_speed_late"):
        _loose(found, name, (0.1, 0.11, 0.12, 0.13))
    _loose(found, "rms_acceleration", (20.0, 21.0, 40.0, 41.0))
    _loose(found, "speed_early", (1.0, 1.001, 1.002, 1.003))
    _loose(found, "speed_middle", (2.01, 2.02, 2.03, 2.04), ideal=2.0)
    _loose(found, "speed_late", (1.0, 1.001, 1.002, 1.003))
    _loose(found, "mean_acceleration", (0.003, -0.0515, -0.2733, -0.3219))
    _loose(found, "mean_force", (51376.0, 51492.0, 51649.0, 51795.0))
    _loose(found, "std_force", (6114.9, 5938.1, 6013.1, 6188.9))
    _loose(found, "mean_tip_shift", (-1.0, -2.0, -3.0, -4.0))
    _loose(found, "tip_range", (50.0, 50.5, 51.0, 51.5), ideal=49.5)
    for side in ("front", "rear"):
        _loose(found, f"{side}_angle", (79.9, 79.8, 79.7, 79.6), ideal=80.0)
    _loose(found, "front_lean", (9.9, 9.8, 9.7, 9.6), ideal=10.0)
    _loose(found, "rear_lean", (10.1, 10.2, 10.3, 10.4), ideal=10.0)
    found[MODE_1] |= {"impulse": 1000.0, "largest_force": 2e5}
    found[MIDDLE] |= {"largest_force": 1e5}
    for name in CURVES:
        found[MIDDLE][f"rms_from_start_{name}"] = 100.0
        found[MODE_1][f"rms_from_start_{name}"] = 200.0
    for name in ("largest_force", "rms_from_start_force"):
        found[OIL][name], found[OIL_IDEAL][name] = 2e5, 1e5
    return _evidence(found)


def wrong() -> Evidence:
    """Nothing of it is so."""
    found = _empty()
    for name in (*CURVES, "tip"):
        _loose(found, f"likeness_{name}", (0.9, 0.9, 0.9, 0.9))
    _loose(found, "rms_force", (10.0, 10.0, 10.0, 10.0))
    for name in ("rms_speed", "rms_speed_early", "rms_speed_middle", "rms_speed_late"):
        _loose(found, name, (0.004, 0.003, 0.002, 0.001))
    _loose(found, "rms_acceleration", (0.4, 0.3, 0.2, 0.1))
    _loose(found, "speed_early", (1.0, 0.9, 0.8, 0.7))
    _loose(found, "speed_middle", (2.0, 1.8, 1.6, 1.4), ideal=2.2)
    _loose(found, "speed_late", (1.0, 0.9, 0.8, 0.7))
    _loose(found, "mean_acceleration", (-3.0, -2.0, -1.0, 0.0))
    _loose(found, "mean_force", (51000.0, 49000.0, 47000.0, 45000.0))
    _loose(found, "std_force", (6000.0, 6500.0, 7000.0, 7500.0))
    _loose(found, "mean_tip_shift", (1.0, 2.0, 3.0, 4.0))
    _loose(found, "tip_range", (60.0, 70.0, 80.0, 90.0), ideal=50.0)
    for side in ("front", "rear"):
        _loose(found, f"{side}_angle", (80.1, 80.2, 80.3, 80.4), ideal=80.0)
    _loose(found, "front_lean", (10.1, 10.2, 10.3, 10.4), ideal=10.0)
    _loose(found, "rear_lean", (9.9, 9.8, 9.7, 9.6), ideal=10.0)
    found[MODE_1] |= {"impulse": 0.0, "largest_force": 1e5}
    found[MIDDLE] |= {"largest_force": 2e5}
    for name in CURVES:
        found[MIDDLE][f"rms_from_start_{name}"] = 105.0
        found[MODE_1][f"rms_from_start_{name}"] = 100.0
    for name in ("largest_force", "rms_from_start_force"):
        found[OIL][name], found[OIL_IDEAL][name] = 1e5, 2e5
    return _evidence(found)


def blurred(evidence: Evidence, error: float = 1e9) -> Evidence:
    """The same numbers, of which nothing is known."""
    return {case: {name: Measured(m.value, error) for name, m in row.items()} for case, row in evidence.items()}


def data(evidence: Evidence) -> dict[str, dict[str, list[float]]]:
    """As a row of the hypercube keeps it."""
    return {case: {name: [m.value, m.error] for name, m in row.items()} for case, row in evidence.items()}


def _empty() -> Values:
    found: Values = {case: {} for case in CASES}
    found[IDEAL] = {f"range_{name}": span for name, span in CURVES.items()}
    return found


def _loose(
    found: Values, name: str, values: tuple[float, float, float, float], ideal: float | None = None
) -> None:
    for case, value in zip(CLEARANCES, values, strict=True):
        found[case][name] = value
    if ideal is not None:
        found[IDEAL][name] = ideal


def _evidence(found: Mapping[str, Mapping[str, float]]) -> Evidence:
    return {case: {name: Measured(x) for name, x in row.items()} for case, row in found.items()}
