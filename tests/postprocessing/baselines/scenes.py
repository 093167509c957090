"""Scenes that are kept as baselines: short, and with small errors."""

from __future__ import annotations

from support_exudyn import Scenario, simple_scenario


def rocker(duration: float = 0.02, **pin: object) -> Scenario:
    """A crank-rocker at 60 rad/s with clearance and friction between coupler and rocker; it hits four times."""
    return simple_scenario(
        "crank_rocker",
        duration_s=duration,
        record_period_s=duration / 40,
        accuracy="reference",
        drives={"crank": {"type": "Steady", "rate_rad_per_s": 60}},
        pins={
            "B": {
                "clearance_mm": 0.5,
                "friction": 0.1,
                "restitution": 0.8,
                "law": "LankaraniNikravesh",
                "stiffness_N_per_m_to_n": 1e10,
            }
            | pin
        },
    )
