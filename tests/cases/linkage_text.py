"""Any linkage as a file of `kind = "linkage"`: all bodies as they are drawn."""

from typing import Any

from support_exudyn import Linkage
from support_exudyn.files.toml.text import toml_text
from support_exudyn.model.linkage import GROUND


def linkage_table(linkage: Linkage) -> dict[str, Any]:
    """The table of a linkage; every pin, guide and end of an actuator is a point of its own."""
    drawing: dict[str, list[float]] = {}

    def point(name: str, place: tuple[float, float]) -> str:
        drawing[name] = list(place)
        return name

    table: dict[str, Any] = {"kind": "linkage"}
    table["bodies"] = {
        name: {"mass_kg": body.mass, "centre_m": list(body.centre), "inertia_kg_m2": body.inertia}
        for name, body in linkage.bodies.items()
    }
    table["pins"] = {}
    for name, pin in linkage.pins.items():
        assert pin.first_point == pin.second_point
        point(name, pin.first_point)
        table["pins"][name] = [pin.first, pin.second]
    table["guides"] = {
        name: {
            "body": slide.body,
            "at": point(f"{name}_at", slide.point),
            "on": slide.against,
            "direction_rad": slide.direction,
            "turns": slide.turns,
        }
        for name, slide in linkage.slides.items()
    }
    table["actuators"] = {
        name: {
            "bodies": [one.foot, one.head],
            "at": [point(f"{name}_foot", one.foot_point), point(f"{name}_head", one.head_point)],
            "driven": one.driven,
        }
        for name, one in linkage.actuators.items()
    }
    table["cranks"] = {name: crank.body for name, crank in linkage.cranks.items()}
    table["gears"] = {
        name: {"bodies": [gear.first, gear.second], "ratio": gear.ratio} for name, gear in linkage.gears.items()
    }
    table["traced_points"] = {
        name: [one.body, point(f"{name}_point", one.point)]
        for name, one in linkage.points.items()
        if one.body != GROUND
    }
    table["drawing_m"] = drawing
    return table


def linkage_text(linkage: Linkage) -> str:
    """The file of a linkage."""
    return toml_text({key: item for key, item in linkage_table(linkage).items() if item})
