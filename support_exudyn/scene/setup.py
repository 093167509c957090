"""From a scenario to the records of a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.mechanics.contact_places import ContactPlace
from support_exudyn.mechanics.hydraulic_legs import preloaded_legs
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.load import Load, StretchLoad, TimeFunction
from support_exudyn.model.pins import IdealPin
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene import arrays
from support_exudyn.scene.arrays import LOSSES, Matrix, Records, SceneArrays, Vector, Whole
from support_exudyn.scene.compilation import (
    NUMBERS,
    address_of,
    contact_law,
    joint_friction,
    load_law,
)
from support_exudyn.scene.courses import (
    Courses,
    courses,
    extension_of,
    segment_edges,
)
from support_exudyn.scene.hydraulics.fill import Legs, fill_legs
from support_exudyn.scene.motion import rounds_of
from support_exudyn.scene.time_grid import record_times
from user_forces.friction.law import FrictionLaw
from user_forces.values.value import Vector2

OUT = 5  # numbers that a law writes at most
# a body that a row is of, and the first of the numbers that the row takes of it
SIDES = (("body", "x"), ("other", "ox"), ("carrier", "carrier_x"))


@dataclass(frozen=True)
class Model:
    """A scenario as arrays, before it is run.

    scene: for the first segment. edges: times between which all courses are smooth [s]. times: of the records
    [s]. drives, valves: names of the courses, in order. order: of the rows as the linkage has them, by their
    place in the scene. states: how many the state has.
    """

    scenario: Scenario
    scene: SceneArrays
    courses: Courses
    edges: list[float]
    times: Vector
    drives: tuple[str, ...]
    valves: tuple[str, ...]
    order: Whole
    contacts: tuple[str, ...]
    legs: Legs
    driven_rows: Mapping[str, int]
    states: int


class _Builder:
    """Collects points, rows and constants."""

    def __init__(self, scenario: Scenario) -> None:
        self.linkage = scenario.linkage
        self.numbers = {name: n for n, name in enumerate(self.linkage.bodies)} | {GROUND: -1}
        self.points: list[tuple[int, Vector2]] = []
        self.known: dict[tuple[str, Vector2], int] = {}
        self.constants: list[float] = []

    def point(self, body: str, point: Vector2) -> int:
        """The number of a point of a body, start posture."""
        key = (body, (float(point[0]), float(point[1])))
        if key not in self.known:
            self.known[key] = len(self.points)
            x, y = (0.0, 0.0) if body == GROUND else self.linkage.bodies[body].centre
            self.points.append((self.numbers[body], (point[0] - x, point[1] - y)))
        return self.known[key]

    def law(self, law: Callable[..., float], constants: Sequence[float]) -> tuple[float, int]:
        """Address of the machine code of a function for `call_law`, and where its constants begin."""
        place = len(self.constants)
        self.constants += constants
        return float(address_of(law)), place


def model_of(scenario: Scenario) -> Model:
    """The arrays of a scenario that the formulation covers."""
    build = _Builder(scenario)
    linkage = scenario.linkage
    rigid = [name for name in linkage.actuators if name not in scenario.compliant_actuators]
    driven = [name for name in (*linkage.actuators, *linkage.cranks) if name not in scenario.valved]
    moving = [name for name in driven if scenario.drive_of(name).span(scenario.duration) != (0.0, 0.0)]
    valves = [name for name, one in scenario.valved.items() if one.inlet.breaks or one.inlet.opening(0.0)]
    edges = segment_edges(scenario.breaks, scenario.duration)
    functions: list[TimeFunction] = [extension_of(scenario.drive_of(name)) for name in moving]
    functions += [scenario.valved[name].inlet.opening for name in valves]
    of_loads = len(functions)
    functions += [function for load in scenario.elements.values() for function in load.courses]
    found = courses(functions, edges)
    course = {name: n for n, name in enumerate((*moving, *valves))}
    joints, order, held = _joints(scenario, build, rigid, course)
    count = len(linkage.bodies)
    states = 6 * count
    contacts = np.zeros(len(scenario.contact_places), arrays.CONTACT)
    for record, place in zip(contacts, scenario.contact_places.values(), strict=True):
        states = _contact(record, place, build, linkage, states)
    legs = _legs(scenario, build, course, states)
    states += legs.states
    loads = _loads(scenario, build, of_loads)
    rows, pairs, square = _rows(joints, held)
    rubbing = _rubbing(scenario, build, joints, states)
    states += int((rubbing["state"] >= 0).sum())
    counts = np.ones(len(rows))
    counts[order] = scenario.held.counts
    scene = SceneArrays(
        bodies=_bodies(scenario),
        points=_points(build, linkage),
        courses=found.segments[0].copy(),
        pieces=found.pieces,
        coefficients=found.coefficients,
        joints=joints,
        rows=rows,
        row_numbers=rows.view(np.float64).reshape(-1),
        pairs=pairs,
        square=square,
        repeats=np.zeros((repeated_count(scenario.held)[0], len(rows))),
        counts=counts,
        spare=np.zeros(len(rows)),
        rounds=rounds_of(scenario.held),
        contacts=contacts,
        legs=arrays.leg_arrays(legs.arrays),
        loads=loads,
        rubbing=rubbing,
        constants=np.array([*build.constants, 0.0]),
        out=np.zeros(OUT + int(loads["courses"].max(initial=0))),
    )
    return Model(
        scenario=scenario,
        scene=scene,
        courses=found,
        edges=edges,
        times=record_times(scenario.duration, scenario.recorded_every),
        drives=tuple(moving),
        valves=tuple(valves),
        order=order,
        contacts=tuple(scenario.contact_places),
        legs=legs,
        driven_rows={
            name: int(order[n]) for n, name in enumerate((*rigid, *linkage.cranks), 2 * len(scenario.held_pins))
        },
        states=states + LOSSES,
    )


def _bodies(scenario: Scenario) -> Records:
    """Bodies with their weight."""
    found = np.zeros(len(scenario.linkage.bodies), arrays.BODY)
    gx, gy = scenario.gravity
    stand_in = scenario.held.kinetics.stand_in[2::3].tolist()
    for record, body, inertia in zip(found, scenario.linkage.bodies.values(), stand_in, strict=True):
        record["light"], record["light_turn"] = 1.0 / body.mass, 1.0 / (body.inertia + inertia)
        record["stand_in"] = inertia
        record["weight_x"], record["weight_y"] = body.mass * gx, body.mass * gy
        record["x0"], record["y0"] = body.centre
    return found


def _points(build: _Builder, linkage: Linkage) -> Records:
    """All points that were asked for; those of the ground stand still."""
    found = np.zeros(len(build.points), arrays.POINT)
    for record, (body, arm) in zip(found, build.points, strict=True):
        record["body"] = body
        record["arm_x"], record["arm_y"] = arm
        if body < 0:
            record["x"], record["y"] = arm
    return found


class _Joint(NamedTuple):
    """A joint before its rows are numbered: its record's numbers, and the two bodies that its rows are of."""

    kind: int
    first: int
    second: int
    bodies: tuple[int, int]
    rows: int
    course: int = -1
    length: float = 0.0
    angle: float = 0.0
    ratio: float = 0.0
    carrier: int = -1  # a third body, of a gear


def _held(scenario: Scenario, build: _Builder, rigid: Sequence[str], course: Mapping[str, int]) -> list[_Joint]:
    """All that is held, in the order of `reactions.HeldJoints`."""
    linkage, number = scenario.linkage, build.numbers
    found = []
    for name in scenario.held_pins:
        pin = linkage.pins[name]
        first, second = build.point(pin.first, pin.first_point), build.point(pin.second, pin.second_point)
        found.append(_Joint(arrays.PIN, first, second, (number[pin.second], number[pin.first]), 2))
    for name in rigid:
        one = linkage.actuators[name]
        foot, head = build.point(one.foot, one.foot_point), build.point(one.head, one.head_point)
        bodies, length = (number[one.head], number[one.foot]), one.start_length
        found.append(_Joint(arrays.ACTUATOR, foot, head, bodies, 1, course.get(name, -1), length))
    for name, crank in linkage.cranks.items():
        body = number[crank.body]
        found.append(_Joint(arrays.CRANK, body, -1, (body, -1), 1, course.get(name, -1)))
    for slide in scenario.guided_linkage.slides.values():
        carrier = build.point(slide.against, slide.point)
        guided = build.point(slide.body, slide.point)
        bodies = number[slide.body], number[slide.against]
        found.append(_Joint(arrays.SLIDE, carrier, guided, bodies, slide.conditions, angle=slide.direction))
    for gear in linkage.gears.values():
        bodies = number[gear.second], number[gear.first]
        carrier = number[gear.carrier or GROUND]
        found.append(_Joint(arrays.GEAR, bodies[1], bodies[0], bodies, 1, ratio=gear.ratio, carrier=carrier))
    return found


def _joints(
    scenario: Scenario, build: _Builder, rigid: Sequence[str], course: Mapping[str, int]
) -> tuple[Records, Whole, list[_Joint]]:
    """Joints with their rows, those of neighbours close to each other; and the rows as the linkage has them.

    The order is that of Cuthill and McKee, reversed: factors then have next to nothing outside of a band.
    """
    held = _held(scenario, build, rigid, course)
    moved = [{*one.bodies, one.carrier} - {-1} for one in held]
    touch = np.array([[bool(one & other) for other in moved] for one in moved])
    order = reverse_cuthill_mckee(csr_array(touch), symmetric_mode=True).tolist() if held else []
    first, row = dict[int, int](), 0
    for n in order:
        first[n] = row
        row += held[n].rows
    found = np.zeros(len(held), arrays.JOINT)
    for n, (record, one) in enumerate(zip(found, held, strict=True)):
        record["kind"], record["row"], record["first"], record["second"] = (
            one.kind,
            first[n],
            one.first,
            one.second,
        )
        record["course"], record["conditions"] = one.course, one.rows
        record["length"], record["angle"], record["ratio"] = one.length, one.angle, one.ratio
    rows = [first[n] + k for n, one in enumerate(held) for k in range(one.rows)]
    return found, np.array(rows, np.int64), held


def _rows(joints: Records, held: Sequence[_Joint]) -> tuple[Records, Records, Matrix]:
    """Rows with their bodies and envelope, pairs of rows that share a body, and room for the square matrix."""
    rows = np.zeros(sum(one.rows for one in held), arrays.ROW)
    for joint, one in zip(joints, held, strict=True):
        for k in range(one.rows):
            row = rows[joint["row"] + k]
            row["body"], row["other"], row["carrier"] = *one.bodies, one.carrier
    width, names = rows.itemsize // 8, list(rows.dtype.names or ())
    sides = [
        [(int(row[body]), width * i + names.index(numbers)) for body, numbers in SIDES]
        for i, row in enumerate(rows)
    ]
    pairs = [
        (i, j, body, one, two)
        for i, mine in enumerate(sides)
        for j, theirs in enumerate(sides[: i + 1])
        for body, one in mine
        for other, two in theirs
        if body == other >= 0
    ]
    for i in range(len(rows)):
        rows[i]["first"] = min([i, *(pair[1] for pair in pairs if pair[0] == i)])
    return rows, np.array(pairs, arrays.PAIR), np.zeros((len(rows), len(rows)))


def _contact(record: Any, place: ContactPlace, build: _Builder, linkage: Linkage, states: int) -> int:
    """Fill in a contact; how many states there are with that of its friction law."""
    bearing, contact = place.contact.bearing, place.contact
    record["first"] = build.point(place.bore, place.bore_point)
    record["second"] = build.point(place.journal, place.journal_point)
    record["slot"] = arrays.ONE_SIDED if bearing.is_one_sided else bearing.is_slot
    record["law"], record["constants"] = build.law(
        contact_law(contact.law_kernel, len(contact.law_constants)), contact.law_constants
    )
    record["radius"], record["clearance"] = bearing.constants
    record["angle"] = place.axes(linkage)
    record["state"] = states if contact.friction.has_state else -1
    return states + contact.friction.has_state


def friction_law(law: FrictionLaw) -> tuple[Callable[..., float], tuple[float, ...]]:
    """The friction law of an ideal joint for `call_law`, and its constants."""
    force, own = law.force_formula
    if not law.has_state:
        return joint_friction(force, len(own), None, 0), own
    rate, others = law.rate_formula
    return joint_friction(force, len(own), rate, len(others)), (*own, *others)


def _legs(scenario: Scenario, build: _Builder, course: Mapping[str, int], states: int) -> Legs:
    """Hydraulic legs, whose states begin at a place."""
    preloaded = preloaded_legs(scenario.linkage, scenario.legs, scenario.gravity)
    found = fill_legs(tuple(preloaded.values()), scenario.pump, states)
    for record, name in zip(found.records, preloaded, strict=True):
        actuator = scenario.linkage.actuators[name]
        record["foot"] = build.point(actuator.foot, actuator.foot_point)
        record["head"] = build.point(actuator.head, actuator.head_point)
        record["course"] = course.get(name, -1)
    return found


def _loads(scenario: Scenario, build: _Builder, course: int) -> Records:
    """Loads with their compiled functions; course: the first of theirs."""
    found = np.zeros(len(scenario.elements), arrays.LOAD)
    for record, (name, load) in zip(found, scenario.elements.items(), strict=True):
        against, kind = load.against(name), arrays.MOMENT
        point, origin = (0.0, 0.0), (0.0, 0.0)
        if isinstance(load, Load):
            kind, point, origin = arrays.FORCE, load.point, load.origin
        elif isinstance(load, StretchLoad):
            kind, against, (point, origin) = arrays.STRETCH, load.body, load.points
        record["kind"], record["powers"] = kind, load.FORCES
        record["point_y"], record["origin_y"] = point[1], origin[1]
        record["first"] = max(0, len(load.MOTION._fields) - NUMBERS)
        record["point"], record["origin"] = build.point(load.body, point), build.point(against, origin)
        record["law"], record["constants"] = build.law(*load_law(load))
        record["course"], record["courses"] = course, len(load.courses)
        course += len(load.courses)
    return found


def _rubbing(scenario: Scenario, build: _Builder, joints: Records, states: int) -> Records:
    """Friction of ideal pins, then of ideal guides; states: how many the state has without theirs."""
    rubbing = scenario.friction_joints
    pins = dict(zip(scenario.held_pins, joints[joints["kind"] == arrays.PIN], strict=True))
    slides = dict(zip(scenario.guided_linkage.slides, joints[joints["kind"] == arrays.SLIDE], strict=True))
    found = np.zeros(len(rubbing), arrays.RUBBING)
    for record, joint in zip(found, rubbing.values(), strict=True):
        record["law"], record["constants"] = build.law(*friction_law(joint.law))
        record["state"] = states if joint.law.has_state else -1
        states += joint.law.has_state
        record["body"], record["other"] = build.numbers[joint.second], build.numbers[joint.first]
        name, part = joint.owner[1], joint.part
        if isinstance(part, IdealPin):
            record["kind"], record["row"], record["radius"] = (
                arrays.BOLT,
                pins[name]["row"],
                joint.lever((0.0, 0.0)),
            )
            continue
        record["kind"] = arrays.BLOCK if part.block else arrays.GUIDED
        for what in ("row", "first", "second", "angle"):
            record[what] = slides[name][what]
        record["radius"] = part.pin_radius or 0.0
        record["half_length"], record["half_height"] = (0.5 * side for side in part.block or (0.0, 0.0))
    return found
