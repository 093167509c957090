"""The scenes: elements added to the plainest, taken from the fullest, both in space, and combined."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal

from studies.common import paper_machine
from support_exudyn import (
    ClearancePin,
    CubicStep,
    IdealPin,
    OwnBody,
    Pin,
    Scenario,
    SolverSettings,
    cylinders_and_rods,
    reference_support,
)
from support_exudyn.simulation.recommend import STROKE, UNEQUAL
from user_forces import Ambrosio, Frictionless, JournalContact, LankaraniNikravesh

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


def stroke() -> Scenario:
    """The plainest scene: a dwell, then a stroke as steep as the paper's."""
    return Scenario(
        machine=reference_support(),
        drive=IN_STEP,
        duration=DURATION,
        step=STEP,
        record_period=STEP,
        solver=SolverSettings(impact_steps=IMPACT_STEPS, sections=SECTIONS_OF_STRAIGHT),
        channels=CHANNELS,
    )


def clearance_joint(sliding_coefficient: float) -> ClearancePin:
    """The paper's pin."""
    normal = LankaraniNikravesh(
        stiffness=paper_machine.stiffness(CLEARANCE_MM), restitution=paper_machine.RESTITUTION
    )
    friction = Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless()
    bearing = paper_machine.bearing(CLEARANCE_MM)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=normal, friction=friction))


def friction_pin() -> IdealPin:
    """An ideal pin with friction, as thick as the paper's."""
    return IdealPin(
        friction=Ambrosio(sliding_coefficient=FRICTION), radius=paper_machine.bearing(CLEARANCE_MM).bore_radius
    )


def in_plane() -> list[DetailScene]:
    """What is added to the plainest and taken from the fullest scene, and cheap combinations."""
    plain = stroke()
    full = fullest(plain)
    return [*_added(plain), *_taken(full), *_combined(plain)]


def fullest(plain: Scenario) -> Scenario:
    """Clearance and friction in all pins, columns of two bodies on oil, the tail beam on an oil jack."""
    oil = paper_machine.oil_columns()["front_column"]
    return replace(
        plain,
        pins=_all(plain, clearance_joint(FRICTION)),
        actuators=cylinders_and_rods(oil),
        parts={"tail_beam": OwnBody(jack=paper_machine.JACK)},
    )


def _all(plain: Scenario, pin: Pin) -> dict[str, Pin]:
    return dict.fromkeys(plain.machine.linkage().pins, pin)


def _added(plain: Scenario) -> Iterable[DetailScene]:
    oil = paper_machine.oil_columns()
    slippery, rubbing = clearance_joint(0.0), friction_pin()
    rear: dict[str, Pin] = {REAR: slippery}
    changes: dict[str, dict[str, Any]] = {
        "clearance, rear pin": {"pins": rear},
        "clearance, 2 pins": {"pins": dict.fromkeys(TWO, slippery)},
        "clearance, 5 pins": {"pins": _all(plain, slippery)},
        "friction, rear pin": {"pins": {REAR: rubbing}},
        "friction, 5 pins": {"pins": _all(plain, rubbing)},
        "clearance and friction, rear pin": {"pins": {REAR: clearance_joint(FRICTION)}},
        "mass of columns": {"actuators": cylinders_and_rods()},
        "oil in columns": {"actuators": oil},
        "mass and oil of columns": {"actuators": cylinders_and_rods(oil["front_column"])},
        "tail beam, rigid jack": {"parts": {"tail_beam": OwnBody()}},
        "tail beam, oil jack": {"parts": {"tail_beam": OwnBody(jack=paper_machine.JACK)}},
        "space": {"dimensions": 3},
    }
    yield DetailScene(PLAINEST, "added", "", STROKE, plain)
    for name, fields in changes.items():
        yield DetailScene(f"{PLAINEST} + {name}", "added", PLAINEST, STROKE, replace(plain, **fields))
    settled = replace(plain, pins=rear, start="settled")
    yield DetailScene(f"{WITH_CLEARANCE} + settled start", "added", WITH_CLEARANCE, STROKE, settled)


def _taken(full: Scenario) -> Iterable[DetailScene]:
    with_clearance, rubbing = clearance_joint(FRICTION), friction_pin()
    changes: dict[str, dict[str, Any]] = {
        "friction": {"pins": _all(full, clearance_joint(0.0))},
        "clearance": {"pins": _all(full, rubbing)},
        "clearance, but in rear pin": {"pins": _all(full, rubbing) | {REAR: with_clearance}},
        "clearance, but in 2 pins": {"pins": _all(full, rubbing) | dict.fromkeys(TWO, with_clearance)},
        "clearance and friction": {"pins": {}},
        "mass of columns": {"actuators": paper_machine.oil_columns()},
        "oil in columns": {"actuators": cylinders_and_rods()},
        "mass and oil of columns": {"actuators": {}},
        "oil of tail beam's jack": {"parts": {"tail_beam": OwnBody()}},
        "tail beam": {"parts": {}},
        "concentric start": {"start": "settled"},
    }
    yield DetailScene(FULLEST, "taken", "", STROKE, full)
    for name, fields in changes.items():
        yield DetailScene(f"{FULLEST} - {name}", "taken", FULLEST, STROKE, replace(full, **fields))


def _combined(plain: Scenario) -> Iterable[DetailScene]:
    with_clearance = clearance_joint(FRICTION)
    five = replace(plain, pins=_all(plain, with_clearance))
    rear = replace(plain, pins={REAR: with_clearance}, start="settled")
    settled = replace(five, start="settled")
    both = "clearance and friction"
    yield DetailScene(f"{PLAINEST} + {both}, 5 pins", "combined", FULLEST, STROKE, five)
    yield DetailScene(f"{PLAINEST} + {both}, 5 pins, settled", "combined", FULLEST, STROKE, settled)
    yield DetailScene(f"{PLAINEST} + {both}, rear pin, settled", "combined", FULLEST, STROKE, rear)


def in_space() -> list[DetailScene]:
    """The paper's pin in space, driven as in the plane."""
    plain = replace(stroke(), dimensions=3)
    pins = {CLEARANCE_IN_SPACE: (WITH_CLEARANCE, 0.0), PAPERS_IN_SPACE: (PAPERS, FRICTION)}
    return [
        DetailScene(name, "space", planar, STROKE, replace(plain, pins={REAR: clearance_joint(friction)}))
        for name, (planar, friction) in pins.items()
    ]


def unequal() -> list[DetailScene]:
    """The front columns driven apart, on oil, from a settled start; one of equal columns beside them."""

    def drive(share: float) -> CubicStep:
        return replace(BESIDE, stroke=share * BESIDE.stroke)

    base = Scenario(
        machine=reference_support(),
        drive=drive(1.0),
        drives={"front_column_left": drive(1.0 - APART), "front_column_right": drive(1.0 + APART)},
        duration=BESIDE.end,
        dimensions=3,
        actuators=paper_machine.oil_columns(),
        start="settled",
        step=STEP_BESIDE,
        record_period=STEP_BESIDE,
        solver=SolverSettings(impact_steps=IMPACT_STEPS, sections=SECTIONS, newton_tolerance=NEWTON_TOLERANCE),
        channels=CHANNELS_UNEQUAL,
    )
    rubbing = replace(base, pins={REAR: clearance_joint(FRICTION)})
    return [
        DetailScene(UNEQUAL_FULLEST, "unequal", "", UNEQUAL, rubbing),
        DetailScene(
            UNEQUAL_WITH_CLEARANCE,
            "unequal",
            UNEQUAL_FULLEST,
            UNEQUAL,
            replace(base, pins={REAR: clearance_joint(0.0)}),
        ),
        DetailScene(UNEQUAL_IDEAL, "unequal", UNEQUAL_FULLEST, UNEQUAL, base),
        DetailScene(EQUAL, "unequal", UNEQUAL_FULLEST, "", replace(rubbing, drives={})),
    ]


def scenes() -> dict[str, DetailScene]:
    """All, by name."""
    return {scene.name: scene for scene in (*in_plane(), *in_space(), *unequal())}
