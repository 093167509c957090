"""Evidence of machines that never were: on one the paper is right in everything, on the other in nothing."""

from __future__ import annotations

from studies.claims.evidence import Evidence, Measured
from studies.claims.plausible_runs import CASES, CLEARANCES, IDEAL, MODE_1, OIL, OIL_IDEAL

MIDDLE = CLEARANCES[2]
RANGES = {"range_force": 10000.0, "range_speed": 5.0, "range_acceleration": 100.0}  # of the ideal pin
ALIKE = (0.999, 0.998, 0.997, 0.996)
GROWING, FALLING = (0.1, 0.11, 0.12, 0.13), (0.004, 0.003, 0.002, 0.001)
SPEEDS = (1.0, 1.001, 1.002, 1.003), (1.0, 0.9, 0.8, 0.7)
ANGLES = (79.9, 79.8, 79.7, 79.6, 80.0), (80.1, 80.2, 80.3, 80.4, 80.0)
LEANS = (9.9, 9.8, 9.7, 9.6, 10.0), (10.1, 10.2, 10.3, 10.4, 10.0)
ROWS: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {  # of four clearances and the ideal pin
    **{f"likeness_{n}": (ALIKE, (0.9,) * 4) for n in ("force", "speed", "acceleration", "tip")},
    "rms_force": ((900.0, 1000.0, 1100.0, 1200.0), (10.0,) * 4),
    **{f"rms_speed{stage}": (GROWING, FALLING) for stage in ("", "_early", "_middle", "_late")},
    "rms_acceleration": ((20.0, 21.0, 40.0, 41.0), (0.4, 0.3, 0.2, 0.1)),
    "speed_early": SPEEDS,
    "speed_middle": ((2.01, 2.02, 2.03, 2.04, 2.0), (2.0, 1.8, 1.6, 1.4, 2.2)),
    "speed_late": SPEEDS,
    "mean_acceleration": ((0.003, -0.0515, -0.2733, -0.3219), (-3.0, -2.0, -1.0, 0.0)),
    "mean_force": ((51376.0, 51492.0, 51649.0, 51795.0), (51000.0, 49000.0, 47000.0, 45000.0)),
    "std_force": ((6114.9, 5938.1, 6013.1, 6188.9), (6000.0, 6500.0, 7000.0, 7500.0)),
    "mean_tip_shift": ((-1.0, -2.0, -3.0, -4.0), (1.0, 2.0, 3.0, 4.0)),
    "tip_range": ((50.0, 50.5, 51.0, 51.5, 49.5), (60.0, 70.0, 80.0, 90.0, 50.0)),
    "front_angle": ANGLES,
    "rear_angle": ANGLES,
    "front_lean": LEANS,
    "rear_lean": LEANS[::-1],
}  # fmt: skip
MODES = {  # by case and name, right and wrong
    (MODE_1, "impulse"): (1000.0, 0.0),
    (MODE_1, "largest_force"): (2e5, 1e5),
    (MIDDLE, "largest_force"): (1e5, 2e5),
    **{(MIDDLE, f"rms_from_start_{n}"): (100.0, 105.0) for n in ("force", "speed", "acceleration")},
    **{(MODE_1, f"rms_from_start_{n}"): (200.0, 100.0) for n in ("force", "speed", "acceleration")},
    **{(OIL, name): (2e5, 1e5) for name in ("largest_force", "rms_from_start_force")},
    **{(OIL_IDEAL, name): (1e5, 2e5) for name in ("largest_force", "rms_from_start_force")},
}


def right(place: int = 0) -> Evidence:
    """All that the paper claims is so; place 1: nothing of it."""
    found: dict[str, dict[str, Measured]] = {case: {} for case in CASES}
    found[IDEAL] = {name: Measured(value) for name, value in RANGES.items()}
    for name, values in ROWS.items():
        for case, value in zip((*CLEARANCES, IDEAL), values[place], strict=False):
            found[case][name] = Measured(value)
    for (case, name), pair in MODES.items():
        found[case][name] = Measured(pair[place])
    return found


def wrong() -> Evidence:
    """Nothing of it is so."""
    return right(1)


def blurred(evidence: Evidence, error: float = 1e9) -> Evidence:
    """The same numbers, of which nothing is known."""
    return {case: {name: Measured(m.value, error) for name, m in row.items()} for case, row in evidence.items()}


def data(evidence: Evidence) -> dict[str, dict[str, list[float]]]:
    """As a row of the hypercube keeps it."""
    return {case: {name: [m.value, m.error] for name, m in row.items()} for case, row in evidence.items()}
