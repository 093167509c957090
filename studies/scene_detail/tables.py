"""Tables of the study."""

import math
from collections.abc import Callable, Mapping

from studies.common.numbers import rounded
from studies.common.words import TextTable
from studies.scene_detail.measures import (
    FROM_REFERENCE,
    MM,
    SMALLEST,
    Change,
    Cost,
    MeasuredScene,
    change,
    times_as_long,
)
from studies.scene_detail.scenes import FULLEST, PLAINEST
from support_exudyn import Estimate, recommend
from support_exudyn.simulation.evidence.table import EvidenceTable as Tried
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
UNEQUAL_ROWS = {  # heading and scale
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


def changes(one: MeasuredScene, reference: MeasuredScene) -> dict[str, Change]:
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
        digits = max(0, 3 - math.floor(math.log10(abs(found.value))))
        return f"{found.value:.{digits}f}"
    return rounded(found.value, found.error)


def ratio(times: float) -> str:
    """A ratio of costs to two digits."""
    return f"{times:.0f}" if times >= 100.0 else f"{times:.2g}"


def change_table(measured: Mapping[str, MeasuredScene], group: str) -> TextTable:
    """What each element of a group changes, and how many times the reference's time the scene takes."""
    rows = []
    for one in measured.values():
        if one.scene.group == group and one.scene.reference:
            reference = measured[one.scene.reference]
            cells = (shown(item) for item in changes(one, reference).values())
            times = ratio(times_as_long(one, reference))
            rows.append((one.scene.element, one.scene.reference, *cells, times))
    header = ("element", "against", *RELATIVE.values(), CANOPY, TIP, FARTHEST, "times the time")
    return TextTable(header, tuple(rows), left=2, width=220)


STROKE_COLUMNS = {  # heading and scale
    "mean_pin_force": ("mean force [N]", 1.0),
    "std_pin_force": ("spread [N]", 1.0),
    "largest_pin_force_in_stroke": ("largest, stroke [N]", 1.0),
    "largest_pin_force": ("largest, whole run [N]", 1.0),
    "mean_tip_x": ("tip forward, mean [mm]", MM),
    "mean_tip_y": ("tip up, mean [mm]", MM),
    "std_angular_acceleration": ("acceleration, spread [deg/s²]", 1.0),
    "largest_canopy_acceleration": ("canopy, largest [deg/s²]", 1.0),
    "onset_speed_1": ("1st impact [m/s]", 1.0),
    "onset_speed_2": ("2nd [m/s]", 1.0),
    "onset_speed_3": ("3rd [m/s]", 1.0),
}


def value_table(measured: Mapping[str, MeasuredScene]) -> TextTable:
    """The numbers of all scenes of the stroke."""
    rows = tuple(
        (name, *(_cell(one.numbers.get(key), scale) for key, (_, scale) in STROKE_COLUMNS.items()))
        for name, one in measured.items()
        if one.scene.group != "unequal"
    )
    return TextTable(("scene", *(heading for heading, _ in STROKE_COLUMNS.values())), rows, width=260)


def _cell(number: Estimate | None, scale: float) -> str:
    if number is None:
        return ""
    if abs(number.value) <= SMALLEST[number.unit]:
        return "0"  # but for rounding
    return rounded(scale * number.value, scale * number.error)


def cost_table(measured: Mapping[str, MeasuredScene]) -> TextTable:
    """What all scenes cost."""
    plain = measured[PLAINEST]
    columns: dict[str, Callable[[Cost], str]] = {
        "time [s]": lambda c: rounded(c.seconds, c.scatter) if c.scatter < c.seconds else f"{c.seconds:.2g}",
        f"of {PLAINEST}": lambda c: f"{c.seconds / plain.cost.seconds:.3g}",
        "steps": lambda c: str(c.steps),
        "a step [us]": lambda c: f"{c.per_step:.0f}",
        "calls of user functions a step": lambda c: f"{c.calls:.3g}",
    }
    rows = tuple((name, *(get(one.cost) for get in columns.values())) for name, one in measured.items())
    return TextTable(("scene", *columns), rows, width=220)


def unequal_table(measured: Mapping[str, MeasuredScene]) -> TextTable:
    """What the plane cannot show."""
    scenes = {name: one for name, one in measured.items() if one.scene.group == "unequal"}
    rows = tuple(
        (heading, *(_cell(one.numbers.get(key), scale) for one in scenes.values()))
        for key, (heading, scale) in UNEQUAL_ROWS.items()
    )
    return TextTable(("quantity", *scenes), rows, width=200)


def advice_table(tried: Tried) -> TextTable:
    """Which scene for which question."""
    rows = []
    for question in QUESTIONS:
        advice = recommend(question, tried)
        used = max((item.difference + item.error) / item.allowed for item in advice.evidence)
        fullest = tried.fullest_of(QUESTIONS[question].family).name
        share = "0 %" if advice.scene == fullest else f"{100.0 * used:.2g} %"
        rows.append((question, advice.scene, f"{advice.seconds:.2g}", f"{advice.fullest_seconds:.2g}", share))
    header = ("question", "cheapest scene", "time [s]", "fullest [s]", "off, of what is allowed")
    return TextTable(header, tuple(rows), left=2, width=130)


def evidence_table(tried: Tried) -> TextTable:
    """The answers of the advised scenes beside those of the fullest."""
    rows = []
    for question in QUESTIONS:
        for n, item in enumerate(recommend(question, tried).evidence):
            both = (f"{rounded(one.value, one.error)} {one.unit}" for one in (item.here, item.fullest))
            compared = (item.number.replace("_", " "), *both, f"{item.difference:.3g}", f"{item.allowed:.3g}")
            rows.append(("" if n else question, *compared))
    header = ("question", "answer", "here", "fullest", "difference", "allowed")
    return TextTable(header, tuple(rows), left=2, width=160)


# --- for sentences ---


def strongest(measured: Mapping[str, MeasuredScene], group: str, heading: str, most: int = 3) -> list[str]:
    """The elements of a group that surely change a number most, each with its change, the strongest first."""
    found = []
    for one in measured.values():
        if one.scene.group == group and one.scene.reference in (PLAINEST, FULLEST):
            changed = changes(one, measured[one.scene.reference])[heading]
            if not changed.below_error:
                found.append((abs(changed.value) - changed.error, one.scene.element[2:], changed))
    found.sort(key=lambda item: item[0], reverse=True)
    return [f"{element} ({shown(changed)})" for _, element, changed in found[:most]]


def without_effect(measured: Mapping[str, MeasuredScene], group: str, heading: str, least: float) -> list[str]:
    """The elements of a group that surely change a number by less than this."""
    return [
        one.scene.element[2:]
        for one in measured.values()
        if one.scene.group == group
        and one.scene.reference in (PLAINEST, FULLEST)
        and (changed := changes(one, measured[one.scene.reference])[heading])
        and abs(changed.value) + changed.error < least
    ]
