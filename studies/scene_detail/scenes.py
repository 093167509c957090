"""The scenes: elements added to the plainest, taken from the fullest, both in space, and combined."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

from studies.common import paper_machine
from support_exudyn import (
    CubicStep,
    IdealPin,
    OwnBody,
    Scenario,
    SolverSettings,
    cylinders_and_rods,
    reference_support,
)
from support_exudyn.simulation.recommend import STROKE, UNEQUAL
from user_forces import Ambrosio

CLEARANCE_MM = 1.5
FRICTION = paper_machine.SLIDING_COEFFICIENT
REAR = paper_machine.CLEARANCE_PIN
TWO = (REAR, "front_base")
APART = 0.01  # of the stroke: so much less on the left, so much more on the right
# of all columns alike, and of the front ones that are driven apart
IN_STEP, DURATION = CubicStep(stroke=0.05, start=0.5, end=1.13), 1.2
BESIDE = CubicStep(stroke=0.5, start=0.2, end=2.2)
# The longest of three runs' steps, and their records [s]. A fourth of them, and of the impacts' steps, moves
# the numbers of the stroke by no more than their errors. A stroke begins and ends at whole multiples of four
# records, so that every fourth of them can be looked at, too.
STEP, STEP_BESIDE = 1.25e-3, 5e-3
IMPACT_STEPS = 20
SECTIONS, SECTIONS_OF_STRAIGHT = 4, 2  # of the longest; a pin that is not tilted is right with any number
# The tolerance is a share of the forces at hand: under columns that push and pull each other with 370 kN
# the default of 1e-8 hides 200 N of the pin's force; this takes a quarter to two fifths more iterations.
NEWTON_TOLERANCE = 1e-10
Group = Literal["added", "taken", "combined", "space", "unequal"]

PLAINEST, FULLEST = "plainest", "fullest"
WITH_CLEARANCE, PAPERS = f"{PLAINEST} + clearance, rear pin", f"{PLAINEST} + clearance and friction, rear pin"
CLEARANCE_IN_SPACE, PAPERS_IN_SPACE = "clearance in space", "clearance and friction in space"
UNEQUAL_IDEAL, UNEQUAL_WITH_CLEARANCE = "unequal, ideal pins", "unequal, clearance"
UNEQUAL_FULLEST, EQUAL = "unequal, clearance and friction", "equal, clearance and friction"
CHANNELS = (f"pin.{REAR}.force", "tip.*", "rear_link.angular_acceleration", "canopy.angular_acceleration")
CHANNELS_UNEQUAL = (*CHANNELS, f"pin.{REAR}.*", "canopy.roll", "canopy.yaw", "front_column_*.force")


@dataclass(frozen=True)
class DetailScene:
    """A scene that is run.

    name. group: where it stands in tables. reference: name of the scene that it differs from by one element,
    empty for those that have none. family: of those that may be recommended. scenario.
    """

    name: str
    group: Group
    reference: str
    family: str
    scenario: Scenario

    @property
    def element(self) -> str:
        """What is added or taken, with its sign; the name if nothing is."""
        added = self.group in ("added", "taken") and self.name.startswith(f"{self.reference} ")
        return self.name.removeprefix(self.reference).strip() if added else self.name

    @property
    def begin(self) -> float:
        """The start of the stroke [s]."""
        return self.scenario.drive.breaks[0]

    @property
    def end(self) -> float:
        """The end of the stroke [s]."""
        return self.scenario.drive.breaks[-1]

    @property
    def drive(self) -> str:
        """The stroke and the run in words."""
        stroke = self.scenario.drive.span(self.scenario.duration)[1]
        return f"{1e3 * stroke:g} mm from {self.begin:g} to {self.end:g} s, run of {self.scenario.duration:g} s"


# --- elements of the model ---

SMOOTH, ROUGH = (
    paper_machine.clearance_joint(CLEARANCE_MM, friction, law=paper_machine.PAPERS_LAW)
    for friction in (0.0, FRICTION)
)
RUBBING = IdealPin(  # with friction, as thick as the paper's
    friction=Ambrosio(sliding_coefficient=FRICTION), radius=paper_machine.bearing(CLEARANCE_MM).bore_radius
)
OIL = paper_machine.oil_columns()
HEAVY, HEAVY_ON_OIL = cylinders_and_rods(), cylinders_and_rods(OIL["front_column"])
ON_JACK = {"tail_beam": OwnBody(jack=paper_machine.JACK)}
PINS = tuple(reference_support().linkage().pins)
ALL_SMOOTH, ALL_ROUGH, ALL_RUBBING = (dict.fromkeys(PINS, pin) for pin in (SMOOTH, ROUGH, RUBBING))
FULL: dict[str, Any] = {
    "pins": ALL_ROUGH,
    "actuators": HEAVY_ON_OIL,
    "parts": ON_JACK,
}  # fields of the fullest scene
Elements = dict[str, dict[str, Any]]  # fields that differ from those of the reference, by name
ADDED: Elements = {  # to the plainest scene
    "clearance, rear pin": {"pins": {REAR: SMOOTH}},
    "clearance, 2 pins": {"pins": dict.fromkeys(TWO, SMOOTH)},
    "clearance, 5 pins": {"pins": ALL_SMOOTH},
    "friction, rear pin": {"pins": {REAR: RUBBING}},
    "friction, 5 pins": {"pins": ALL_RUBBING},
    "clearance and friction, rear pin": {"pins": {REAR: ROUGH}},
    "mass of columns": {"actuators": HEAVY},
    "oil in columns": {"actuators": OIL},
    "mass and oil of columns": {"actuators": HEAVY_ON_OIL},
    "tail beam, rigid jack": {"parts": {"tail_beam": OwnBody()}},
    "tail beam, oil jack": {"parts": ON_JACK},
    "space": {"dimensions": 3},
}
TAKEN: Elements = {  # from the fullest scene
    "friction": {"pins": ALL_SMOOTH},
    "clearance": {"pins": ALL_RUBBING},
    "clearance, but in rear pin": {"pins": ALL_RUBBING | {REAR: ROUGH}},
    "clearance, but in 2 pins": {"pins": ALL_RUBBING | dict.fromkeys(TWO, ROUGH)},
    "clearance and friction": {"pins": {}},
    "mass of columns": {"actuators": OIL},
    "oil in columns": {"actuators": HEAVY},
    "mass and oil of columns": {"actuators": {}},
    "oil of tail beam's jack": {"parts": {"tail_beam": OwnBody()}},
    "tail beam": {"parts": {}},
    "concentric start": {"start": "settled"},
}
COMBINED: Elements = {  # cheap combinations, added to the plainest scene
    "5 pins": {"pins": ALL_ROUGH},
    "5 pins, settled": {"pins": ALL_ROUGH, "start": "settled"},
    "rear pin, settled": {"pins": {REAR: ROUGH}, "start": "settled"},
}


# --- scenes ---


def of_strokes() -> Iterator[DetailScene]:
    """Elements added to the plainest scene and taken from the fullest, cheap combinations, and space."""

    def scene(name: str, group: Group, reference: str, base: Scenario, **fields: Any) -> DetailScene:
        return DetailScene(name, group, reference, STROKE, replace(base, **fields))

    plain = Scenario(  # a dwell, then a stroke as steep as the paper's
        machine=reference_support(),
        drive=IN_STEP,
        duration=DURATION,
        step=STEP,
        record_period=STEP,
        solver=SolverSettings(impact_steps=IMPACT_STEPS, sections=SECTIONS_OF_STRAIGHT),
        channels=CHANNELS,
    )
    full = replace(plain, **FULL)
    yield scene(PLAINEST, "added", "", plain)
    for name, fields in ADDED.items():
        yield scene(f"{PLAINEST} + {name}", "added", PLAINEST, plain, **fields)
    settled = f"{WITH_CLEARANCE} + settled start"
    yield scene(settled, "added", WITH_CLEARANCE, plain, pins={REAR: SMOOTH}, start="settled")
    yield scene(FULLEST, "taken", "", full)
    for name, fields in TAKEN.items():
        yield scene(f"{FULLEST} - {name}", "taken", FULLEST, full, **fields)
    for name, fields in COMBINED.items():
        yield scene(f"{PAPERS.removesuffix('rear pin')}{name}", "combined", FULLEST, plain, **fields)
    for name, planar, pin in (
        (CLEARANCE_IN_SPACE, WITH_CLEARANCE, SMOOTH), (PAPERS_IN_SPACE, PAPERS, ROUGH),
    ):  # fmt: skip
        yield scene(name, "space", planar, plain, dimensions=3, pins={REAR: pin})


def unequal() -> Iterator[DetailScene]:
    """The front columns driven apart, on oil, from a settled start; and equal columns for comparison."""
    left, right = (replace(BESIDE, stroke=share * BESIDE.stroke) for share in (1.0 - APART, 1.0 + APART))
    ideal = Scenario(
        machine=reference_support(),
        drive=BESIDE,
        drives={"front_column_left": left, "front_column_right": right},
        duration=BESIDE.end,
        dimensions=3,
        actuators=OIL,
        start="settled",
        step=STEP_BESIDE,
        record_period=STEP_BESIDE,
        solver=SolverSettings(impact_steps=IMPACT_STEPS, sections=SECTIONS, newton_tolerance=NEWTON_TOLERANCE),
        channels=CHANNELS_UNEQUAL,
    )
    rough, smooth = (replace(ideal, pins={REAR: pin}) for pin in (ROUGH, SMOOTH))
    yield DetailScene(UNEQUAL_FULLEST, "unequal", "", UNEQUAL, rough)
    yield DetailScene(UNEQUAL_WITH_CLEARANCE, "unequal", UNEQUAL_FULLEST, UNEQUAL, smooth)
    yield DetailScene(UNEQUAL_IDEAL, "unequal", UNEQUAL_FULLEST, UNEQUAL, ideal)
    yield DetailScene(EQUAL, "unequal", UNEQUAL_FULLEST, "", replace(rough, drives={}))


def scenes() -> dict[str, DetailScene]:
    """All, by name."""
    return {scene.name: scene for scene in (*of_strokes(), *unequal())}
