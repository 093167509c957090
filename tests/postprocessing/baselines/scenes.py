"""Scenes that are kept as baselines: short, and with small errors."""

from __future__ import annotations

from support_exudyn import Scenario, simple_scenario


def rocker(duration: float = 0.02, **pin: object) -> Scenario:
    """A crank-rocker at 60 rad/s with clearance and friction between coupler and rocker; it hits four times."""
    return simple_scenario(
        "crank_rocker",
        duration_s=duration,
        record_period_s=duration / 20,
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


def rise() -> Scenario:
    """The reference support rises by 20 mm on columns of oil, with clearance in a pin of the rear link."""
    oil = {"type": "OilColumn", "bore_area_mm2": 50000, "oil_length_mm": 1000, "bulk_modulus_MPa": 1500}
    return simple_scenario(
        "reference",
        duration_s=0.2,
        record_period_s=0.01,
        accuracy="reference",
        drive={"mode": 2, "stroke_mm": 20, "start_s": 0.05, "end_s": 0.15},
        pins={"rear_base": {"clearance_mm": 1.5, "friction": 0.25}},
        actuators=dict.fromkeys(("front_column", "rear_column"), oil),
    )
