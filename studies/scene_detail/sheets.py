"""Tables of the study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from studies.common.chapter import Sheet
from studies.common.study import brief
from studies.scene_detail.measures import FROM_REFERENCE, MM, SMALLEST, Change, Measured, change
from studies.scene_detail.scenes import FULLEST, PLAINEST
from support_exudyn import Estimate, recommend
from support_exudyn.simulation.evidence.table import Table
from support_exudyn.simulation.recommend import QUESTIONS

BELOW = "below the error"
RELATIVE = {  # changes in per cent
    "mean_pin_force": "mean force [%]",
    "std_pin_force": "spread [%]",
    "largest_pin_force_in_stroke": "largest, stroke [%]",
    "largest_pin_force": "largest, whole run [%]",
    "std_angular_acceleration": "acceleration, spread [%]",
}
CANOPY = "canopy, largest [deg/s²]"
TIP, FARTHEST = "tip forward, mean [mm]", "tip, farthest [mm]"
TITLES = {
    "added": f"What each element changes when it is added to the {PLAINEST} scene",
    "taken": f"What is missing when an element is taken from the {FULLEST} scene",
    "combined": f"Cheap combinations, against the {FULLEST} scene",
    "space": "What space changes if all is driven alike",
}
SAID_UNEQUAL = {
    "largest_roll": ("roll of the canopy, largest [deg]", 1.0),
    "largest_yaw": ("yaw of the canopy, largest [deg]", 1.0),
    "largest_front_column_force": ("front column force, largest of both [kN]", 1e-3),
    "left_front_column_force_at_the_end": ("left front column, at the end [kN]", 1e-3),
    "right_front_column_force_at_the_end": ("right front column, at the end [kN]", 1e-3),
    "largest_moment": ("moment on the rear pin, largest [kN m]", 1e-3),
    "mean_pin_force": ("rear pin force, mean in the stroke [kN]", 1e-3),
    "largest_pin_force": ("rear pin force, largest [kN]", 1e-3),
    "largest_left_depth": ("depth at the left edge, largest [mm]", 1e3),
    "largest_right_depth": ("depth at the right edge, largest [mm]", 1e3),
}


def changes(one: Measured, reference: Measured) -> dict[str, Change]:
    """What a scene changes against its reference, by heading: per cent, and millimetres of the tip."""
    found = {
        heading: change(one.numbers[name], reference.numbers[name]).of(reference.numbers[name].value)
        for name, heading in RELATIVE.items()
    }
    canopy = "largest_canopy_acceleration"
    found[CANOPY] = change(one.numbers[canopy], reference.numbers[canopy])
    found[TIP] = change(one.numbers["mean_tip_x"], reference.numbers["mean_tip_x"]).scaled(MM)
    away = one.numbers[FROM_REFERENCE]
    found[FARTHEST] = Change(away.value, away.error).scaled(MM)
    return found


def shown(found: Change) -> str:
    """A change with its error, or that it is below it."""
    if found.below_error:
        return f"{BELOW}, {found.error:.1g}"
    # no more digits than the error leaves, and four at most
    return f"{'+' if found.value > 0.0 else ''}{_short(found)}"


def _short(found: Change) -> str:
    if found.error < 1e-3 * abs(found.value):
        return f"{found.value:.4g}"
    return brief(found.value, found.error)


def ratio(times: float) -> str:
    """A ratio of costs to two digits."""
    return f"{times:.0f}" if times >= 100.0 else f"{times:.2g}"


def change_sheet(measured: Mapping[str, Measured], group: str) -> Sheet:
    """What each element of a group changes, and how many times the reference's time the scene takes."""
    rows = []
    for one in measured.values():
        if one.scene.group == group and one.scene.reference:
            reference = measured[one.scene.reference]
            cells = (shown(item) for item in changes(one, reference).values())
            against = one.scene.reference
            times = ratio(one.cost.seconds / reference.cost.seconds)
            rows.append((one.scene.element, against, *cells, times))
    return Sheet(
        TITLES[group],
        ("element", "against", *RELATIVE.values(), CANOPY, TIP, FARTHEST, "times the time"),
        tuple(rows),
        f"Forces of the rear pin, acceleration: angular, of the rear link. {BELOW[0].upper()}{BELOW[1:]}: "
        "smaller than the numerical errors of both scenes together, which follow; where no error is given, it "
        "is less than a thousandth of the change.",
        left=2,
    )


def value_sheet(measured: Mapping[str, Measured]) -> Sheet:
    """The numbers of all scenes of the stroke."""
    names = {
        "mean_pin_force": ("mean force [N]", 1.0),
        "std_pin_force": ("spread [N]", 1.0),
        "largest_pin_force_in_stroke": ("largest, stroke [N]", 1.0),
        "largest_pin_force": ("largest, whole run [N]", 1.0),
        "mean_tip_x": ("tip forward, mean [mm]", MM),
        "mean_tip_y": ("tip up, mean [mm]", MM),
        "std_angular_acceleration": ("acceleration, spread [deg/s²]", 1.0),
        "largest_canopy_acceleration": ("canopy, largest [deg/s²]", 1.0),
        "onset_speed_1": ("1st touch [m/s]", 1.0),
        "onset_speed_2": ("2nd [m/s]", 1.0),
        "onset_speed_3": ("3rd [m/s]", 1.0),
    }
    rows = [
        (name, *(_cell(one.numbers.get(key), scale) for key, (_, scale) in names.items()))
        for name, one in measured.items()
        if one.scene.group != "unequal"
    ]
    return Sheet(
        "All scenes of the stroke",
        ("scene", *(heading for heading, _ in names.values())),
        tuple(rows),
        "± is the estimated error, of steps and in space also of sections. Touches of the rear pin, none if "
        "it is ideal or settled.",
    )


def _cell(number: Estimate | None, scale: float) -> str:
    if number is None:
        return ""
    if abs(number.value) <= SMALLEST[number.unit]:
        return "0"  # but for rounding
    return brief(scale * number.value, scale * number.error)


def cost_sheet(measured: Mapping[str, Measured]) -> Sheet:
    """What all scenes cost."""
    plain = measured[PLAINEST]
    rows = []
    for name, one in measured.items():
        cost, held = one.cost, one.cost.held
        rows.append(
            (
                name,
                brief(cost.seconds, cost.scatter) if cost.scatter < cost.seconds else f"{cost.seconds:.2g}",
                f"{cost.seconds / plain.cost.seconds:.3g}",
                str(cost.steps),
                f"{cost.per_step:.0f}",
                *(str(n) for n in (held.coordinates, held.constraints, held.markers, held.connectors)),
                str(held.user_functions),
                f"{cost.calls:.3g}",
                str(held.callbacks),
            )
        )
    return Sheet(
        "What each scene costs",
        (
            "scene",
            "time [s]",
            f"of {PLAINEST}",
            "steps",
            "a step [us]",
            "coordinates",
            "constraints",
            "markers",
            "connectors",
            "user functions",
            "their calls a step",
            "callbacks a step",
        ),
        tuple(rows),
        "Processor time of the coarser run, ± what a step of the finer run takes more or less; short ones were "
        "run four times, alone, ± scatter. A callback sees every step, a user function computes a force as "
        "often as the solver asks.",
    )


def unequal_sheet(measured: Mapping[str, Measured]) -> Sheet:
    """What the plane cannot show."""
    scenes = {name: one for name, one in measured.items() if one.scene.group == "unequal"}
    rows = [
        (said, *(_cell(one.numbers.get(key), scale) for one in scenes.values()))
        for key, (said, scale) in SAID_UNEQUAL.items()
    ]
    return Sheet(
        "Front columns driven 2 % apart, and alike",
        ("quantity", *scenes),
        tuple(rows),
        "In space, columns on oil. The moment is about the axes across the pin, through its middle. Ideal pins "
        "have no depth, and rigid bodies do not determine how rear pin and front links share their moments.",
    )


def advice_sheet(tried: Table) -> Sheet:
    """Which scene for which question."""
    rows: list[Sequence[str]] = []
    for question in QUESTIONS:
        advice = recommend(question, tried)
        for n, item in enumerate(advice.evidence):
            first = (question, advice.scene, f"{advice.seconds:.2g}", f"{advice.fullest_seconds:.2g}")
            rows.append(
                (
                    *(first if n == 0 else ("", "", "", "")),
                    item.number.replace("_", " "),
                    f"{brief(item.here.value, item.here.error)} {item.here.unit}",
                    f"{brief(item.fullest.value, item.fullest.error)} {item.fullest.unit}",
                    f"{item.allowed:.3g}",
                    f"{item.difference:.3g}",
                )
            )
    return Sheet(
        "The cheapest scene for each question",
        (
            "question",
            "scene",
            "time [s]",
            "fullest [s]",
            "answer",
            "here",
            "fullest",
            "allowed",
            "difference",
        ),
        tuple(tuple(row) for row in rows),
        "; ".join(f"{question}: {asked.said}" for question, asked in QUESTIONS.items())
        + ". Differences count with the numerical errors of both scenes added.",
        left=2,
    )
