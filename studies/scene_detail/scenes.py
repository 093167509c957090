"""The scenes: elements added to the plainest, taken from the fullest, both in space, and combined."""

from __future__ import annotations

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
    reference_support,
    two_body_columns,
)
from support_exudyn.simulation.recommend import STROKE, UNEQUAL
from user_forces import Ambrosio, Frictionless, JournalContact, LankaraniNikravesh

CLEARANCE_MM = 1.5
FRICTION = paper_machine.SLIDING_COEFFICIENT
REAR = paper_machine.LOOSE_PIN
TWO = (REAR, "front_base")
APART = 0.01  # of the stroke: so much less on the left, so much more on the right
SECTIONS = 9
# The tolerance is a share of the forces at hand: under columns that push and pull each other with 370 kN
# the default of 1e-8 hides 200 N of the pin's force; this takes a quarter to two fifths more iterations.
NEWTON_TOLERANCE = 1e-10
Group = Literal["added", "taken", "combined", "space", "unequal"]

PLAINEST, FULLEST = "plainest", "fullest"
LOOSE, PAPERS = f"{PLAINEST} + clearance, rear pin", f"{PLAINEST} + clearance and friction, rear pin"
LOOSE_IN_SPACE, PAPERS_IN_SPACE = "clearance in space", "clearance and friction in space"
UNEQUAL_IDEAL, UNEQUAL_LOOSE = "unequal, ideal pins", "unequal, clearance"
UNEQUAL_FULLEST, EQUAL = "unequal, clearance and friction", "equal, clearance and friction"
CHANNELS = (f"pin.{REAR}.force", "tip.*", "rear_link.angular_acceleration", "canopy.angular_acceleration")
CHANNELS_UNEQUAL = (*CHANNELS, f"pin.{REAR}.*", "canopy.roll", "canopy.yaw", "front_column_*.force")


@dataclass(frozen=True)
class Scene:
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
        """Of the stroke [s]."""
        return self.scenario.drive.breaks[0]

    @property
    def end(self) -> float:
        """Of the stroke [s]."""
        return self.scenario.drive.breaks[-1]

    @property
    def drive(self) -> str:
        """The stroke and the run in words."""
        stroke = self.scenario.drive.span(self.scenario.duration)[1]
        return f"{1e3 * stroke:g} mm from {self.begin:g} to {self.end:g} s, run of {self.scenario.duration:g} s"


def stroke(quick: bool) -> Scenario:
    """The plainest scene: a dwell, then a stroke as steep as the paper's; quick: shorter and coarser."""
    drive, duration, step, steps = CubicStep(stroke=0.05, start=0.5, end=1.13), 1.2, 1e-3, 64
    if quick:
        drive, duration, step, steps = CubicStep(stroke=0.0003, start=0.01, end=0.058), 0.06, 2e-3, 16
    return Scenario(
        machine=reference_support(),
        drive=drive,
        duration=duration,
        step=step,
        record_period=step,
        solver=SolverSettings(impact_steps=steps),
        channels=CHANNELS,
    )


def loose_pin(sliding_coefficient: float) -> ClearancePin:
    """The paper's pin, damped by the depth that it is pressed to (`DepthSpeed`)."""
    normal = LankaraniNikravesh(
        stiffness=paper_machine.stiffness(CLEARANCE_MM), restitution=paper_machine.RESTITUTION
    )
    friction = Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless()
    bearing = paper_machine.bearing(CLEARANCE_MM)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=normal, friction=friction))


def rubbing_pin() -> IdealPin:
    """An ideal pin with friction, as thick as the paper's."""
    return IdealPin(
        friction=Ambrosio(sliding_coefficient=FRICTION), radius=paper_machine.bearing(CLEARANCE_MM).bore_radius
    )


def in_plane(quick: bool) -> list[Scene]:
    """What is added to the plainest and taken from the fullest scene, and cheap combinations."""
    plain = stroke(quick)
    full = fullest(plain)
    return [*_added(plain), *_taken(full), *_combined(plain)]


def fullest(plain: Scenario) -> Scenario:
    """Clearance and friction in all pins, columns of two bodies on oil, the tail beam on an oil jack."""
    oil = paper_machine.oil_columns()["front_column"]
    return replace(
        plain,
        pins=_all(plain, loose_pin(FRICTION)),
        columns=two_body_columns(oil),
        parts={"tail_beam": OwnBody(jack=paper_machine.JACK)},
    )


def _all(plain: Scenario, pin: Pin) -> dict[str, Pin]:
    return dict.fromkeys(plain.machine.linkage().pins, pin)


def _added(plain: Scenario) -> Iterable[Scene]:
    oil = paper_machine.oil_columns()
    slippery, rubbing = loose_pin(0.0), rubbing_pin()
    rear: dict[str, Pin] = {REAR: slippery}
    changes: dict[str, dict[str, Any]] = {
        "clearance, rear pin": {"pins": rear},
        "clearance, 2 pins": {"pins": dict.fromkeys(TWO, slippery)},
        "clearance, 5 pins": {"pins": _all(plain, slippery)},
        "friction, rear pin": {"pins": {REAR: rubbing}},
        "friction, 5 pins": {"pins": _all(plain, rubbing)},
        "clearance and friction, rear pin": {"pins": {REAR: loose_pin(FRICTION)}},
        "mass of columns": {"columns": two_body_columns()},
        "oil in columns": {"columns": oil},
        "mass and oil of columns": {"columns": two_body_columns(oil["front_column"])},
        "tail beam, rigid jack": {"parts": {"tail_beam": OwnBody()}},
        "tail beam, oil jack": {"parts": {"tail_beam": OwnBody(jack=paper_machine.JACK)}},
        "space": {"dimensions": 3},
    }
    yield Scene(PLAINEST, "added", "", STROKE, plain)
    for name, fields in changes.items():
        yield Scene(f"{PLAINEST} + {name}", "added", PLAINEST, STROKE, replace(plain, **fields))
    settled = replace(plain, pins=rear, start="settled")
    yield Scene(f"{LOOSE} + settled start", "added", LOOSE, STROKE, settled)


def _taken(full: Scenario) -> Iterable[Scene]:
    loose, rubbing = loose_pin(FRICTION), rubbing_pin()
    changes: dict[str, dict[str, Any]] = {
        "friction": {"pins": _all(full, loose_pin(0.0))},
        "clearance": {"pins": _all(full, rubbing)},
        "clearance, but in rear pin": {"pins": _all(full, rubbing) | {REAR: loose}},
        "clearance, but in 2 pins": {"pins": _all(full, rubbing) | dict.fromkeys(TWO, loose)},
        "clearance and friction": {"pins": {}},
        "mass of columns": {"columns": paper_machine.oil_columns()},
        "oil in columns": {"columns": two_body_columns()},
        "mass and oil of columns": {"columns": {}},
        "oil of tail beam's jack": {"parts": {"tail_beam": OwnBody()}},
        "tail beam": {"parts": {}},
        "concentric start": {"start": "settled"},
    }
    yield Scene(FULLEST, "taken", "", STROKE, full)
    for name, fields in changes.items():
        yield Scene(f"{FULLEST} - {name}", "taken", FULLEST, STROKE, replace(full, **fields))


def _combined(plain: Scenario) -> Iterable[Scene]:
    loose = loose_pin(FRICTION)
    five = replace(plain, pins=_all(plain, loose))
    rear = replace(plain, pins={REAR: loose}, start="settled")
    settled = replace(five, start="settled")
    both = "clearance and friction"
    yield Scene(f"{PLAINEST} + {both}, 5 pins", "combined", FULLEST, STROKE, five)
    yield Scene(f"{PLAINEST} + {both}, 5 pins, settled", "combined", FULLEST, STROKE, settled)
    yield Scene(f"{PLAINEST} + {both}, rear pin, settled", "combined", FULLEST, STROKE, rear)


def in_space(quick: bool) -> list[Scene]:
    """The paper's pin in space, driven as in the plane."""
    plain = replace(stroke(quick), dimensions=3)
    pins = {LOOSE_IN_SPACE: (LOOSE, 0.0), PAPERS_IN_SPACE: (PAPERS, FRICTION)}
    return [
        Scene(name, "space", planar, STROKE, replace(plain, pins={REAR: loose_pin(friction)}))
        for name, (planar, friction) in pins.items()
    ]


def unequal(quick: bool) -> list[Scene]:
    """The front columns driven apart, on oil, from a settled start; one of equal columns beside them."""
    begin, end, size, step, steps = (0.01, 0.16, 0.0028, 1e-2, 16) if quick else (0.2, 2.2, 0.5, 1e-3, 64)

    def drive(share: float) -> CubicStep:
        return CubicStep(stroke=share * size, start=begin, end=end)

    base = Scenario(
        machine=reference_support(),
        drive=drive(1.0),
        drives={"front_column_left": drive(1.0 - APART), "front_column_right": drive(1.0 + APART)},
        duration=end,
        dimensions=3,
        columns=paper_machine.oil_columns(),
        start="settled",
        step=step,
        record_period=step,
        solver=SolverSettings(impact_steps=steps, sections=SECTIONS, newton_tolerance=NEWTON_TOLERANCE),
        channels=CHANNELS_UNEQUAL,
    )
    rubbing = replace(base, pins={REAR: loose_pin(FRICTION)})
    return [
        Scene(UNEQUAL_FULLEST, "unequal", "", UNEQUAL, rubbing),
        Scene(UNEQUAL_LOOSE, "unequal", UNEQUAL_FULLEST, UNEQUAL, replace(base, pins={REAR: loose_pin(0.0)})),
        Scene(UNEQUAL_IDEAL, "unequal", UNEQUAL_FULLEST, UNEQUAL, base),
        Scene(EQUAL, "unequal", UNEQUAL_FULLEST, "", replace(rubbing, drives={})),
    ]


def scenes(quick: bool) -> dict[str, Scene]:
    """All, by name."""
    return {scene.name: scene for scene in (*in_plane(quick), *in_space(quick), *unequal(quick))}
