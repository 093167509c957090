"""What a support must stand as plain data: SI and radians, the unit in the key."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from support_exudyn.machines.strength.pins import PinStresses
from support_exudyn.machines.strength.results import PinLoad, StandReport, SupportForce
from support_exudyn.machines.strength.roof_forces import RoofForce


def numbers(report: StandReport) -> dict[str, Any]:
    """All numbers of the page, and those of the postures between."""
    rated, said = report.rated
    aside = report.off_middle
    return {
        "name": report.name,
        "kind": report.kind,
        "cylinders": {
            name: {
                "count": one.count,
                "yield_push_N": one.push,
                "yield_pull_N": one.pull,
                "setting_push_N": None if one.setting_pressure is None else one.setting_pressure * one.area,
            }
            for name, one in report.cylinders.items()
        },
        "rated_force_N": rated,
        "rated_force_is_assumed": not said,
        "postures": [_support(one) for one in report.forces],
        "pins": {name: _pin(one) for name, one in report.pins.items()},
        "pins_without_data": list(report.unknown_pins),
        "buckling": {
            name: {
                "length_m": one.length,
                "yield_push_N": one.force,
                "euler_N": one.euler,
                "johnson_N": one.johnson,
            }
            for name, one in report.buckling.items()
        },
        "buckling_not_told": dict(report.unbuckled),
        "beside_the_middle": aside
        if isinstance(aside, str)
        else [
            {
                "height_m": one.height,
                "aside_m": one.aside,
                "middle_N": one.nominal,
                "legs_alone_N": one.legs_alone,
                "torsion_N_m": one.moment,
                "pins_with_least_moments_N": dict(one.pins),
                "pins_in_the_middle_N": dict(one.centred),
                "moments_with_least_forces_N_m": dict(one.tilts),
            }
            for one in aside
        ],
        "tipping": None
        if report.tipping is None
        else [
            {"mass_kg": one.mass, "centre_m": list(one.centre), "angles_rad": dict(one.angles)}
            for one in report.tipping
        ],
        "tip_wander_m": report.wander,
        "assumed": list(report.assumed),
        "sources": list(report.sources),
    }


def _roof(roof: RoofForce | None) -> dict[str, float] | None:
    return None if roof is None else {"force_N": roof.force, "x_m": roof.x}


def _support(one: SupportForce) -> dict[str, Any]:
    return {
        "stroke_m": one.stroke,
        "roof_height_m": one.contact.height,
        "canopy_x_m": [one.contact.rear, one.contact.front],
        "setting": _roof(one.setting),
        "yield": _roof(one.yielding),
        "yield_where_a_single_leg_holds_least": _roof(one.least),
        "yield_with_friction": {f"{mu:g}": _roof(roof) for mu, roof in one.rubbed.items()},
        "yield_rams_pull": _roof(one.pull),
        "yield_rams_push": _roof(one.push),
        "largest": _roof(one.largest),
        "over_canopy": [{"x_m": x, "force_N": force} for x, force in one.over],
    }


def _pin(one: PinLoad) -> dict[str, Any]:
    def by_factor(loads: Mapping[float, float]) -> dict[str, float]:
        return {f"{factor:g}": force for factor, force in loads.items()}

    return {
        "legs_alike_N": by_factor(one.nominal),
        "any_roof_force_N": by_factor(one.worst),
        "any_roof_force_with_friction_N": by_factor(one.rubbed),
        "stresses": None if one.stresses is None else _stresses(one.stresses[0]),
        "stresses_with_friction": None if one.stresses is None else _stresses(one.stresses[1]),
        "yield_stress_of_pin_Pa": None if one.yields is None else one.yields[0],
        "yield_stress_of_eyes_Pa": None if one.yields is None else one.yields[1],
        "eyes_are_assumed": one.assumed,
    }


def _stresses(one: PinStresses) -> dict[str, Any]:
    return {
        "force_N": one.force,
        "bearing_Pa": one.bearing,
        "shear_Pa": one.shear,
        "bending_Pa": one.bending,
        "safeties": dict(one.safeties),
    }
