"""A planar scenario as an ADAMS/Solver dataset.

Parts have their frames in their centres of mass, parallel to the ground. A mechanism in space whose pins were
all revolute joints would be held several times in the direction across its plane. So revolute joints make a
tree from the ground to every body; a pin that closes a loop is the primitive INLINE, which holds the two
directions in the plane alone; and a body that no ideal pin ties to the ground is kept in the plane by a planar
joint. No constraint repeats another.

A column is two parts, which weigh 0.1 g: a cylinder on a revolute joint at its foot, in it the rod on a
translational joint whose motion is the drive, and the rod's INLINE at the head.
"""

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from studies.adams.clearance import write_clearance
from studies.adams.statements import Statements, number, numbers
from support_exudyn import CubicStep, Scenario
from support_exudyn.model.actuators import RigidActuator
from support_exudyn.model.drives.drive import Drive, Held
from support_exudyn.model.linkage import GROUND, Body, LinearActuator, PinPlace
from support_exudyn.model.pins import ClearancePin, IdealPin
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.normal.power_laws import LankaraniNikravesh
from user_forces.values.value import InputError, Vector2

LIGHT = 1e-4  # mass [kg] and inertia [kg m^2] of the parts of columns, which weigh nothing
ERROR, LONGEST_STEP = 1e-6, 1e-4  # of the integrator: relative tolerance, [s]
HEADER = """\
! Written by support-exudyn from a scenario, for comparison. It was NOT RUN in
! ADAMS by those who wrote it: syntax follows public manuals, and a test reads
! the file back, evaluates its expressions and solves its equations.
! Units are SI. The plane is x forward, y up; z is across.
"""


class AdamsDataset(NamedTuple):
    """A dataset, and what its results are called.

    text: of the `.adm` file. columns: the channels that its requests write, by name, each with what the result
    file calls it, `REQUEST.COMPONENT`.
    """

    text: str
    columns: Mapping[str, str]


def adams_dataset(scenario: Scenario, title: str) -> AdamsDataset:
    """The dataset of a scenario.

    Arguments:
        scenario: in the plane, of rigid bodies, ideal pins, clearance pins with the paper's laws, and rigid
            columns on a `CubicStep`, at rest at the start.
        title: a word, in the file's first line.

    Raises InputError with a line for everything that it has no statements for.
    """
    reasons = list(_reasons(scenario))
    if reasons:
        raise InputError("\n".join(reasons))
    return _Writing(scenario).whole(title)


class _Writing:
    """A dataset while it is written."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario, self.linkage = scenario, scenario.linkage
        self.out = Statements()
        self.parts: dict[str, int] = {}  # by body
        self.centres: dict[str, Vector2] = {GROUND: (0.0, 0.0)}
        self.axes = 0  # the marker of the ground's axes

    def whole(self, title: str) -> AdamsDataset:
        out = self.out
        out.plain("UNITS", "FORCE = NEWTON, MASS = KILOGRAM, LENGTH = METER, TIME = SECOND")
        out.heading("PARTS")
        self.parts[GROUND] = out.add("PART", GROUND, "GROUND")
        self.axes = self.marker(GROUND, (0.0, 0.0), "axes")
        for name, body in self.linkage.bodies.items():
            self.body(name, body)
        self.pins()
        out.heading("COLUMNS")
        for name, actuator in self.linkage.actuators.items():
            self.column(name, actuator, self.scenario.drive_of(name))
        out.heading("CLEARANCE PINS")
        for name, pin in self.scenario.clearance_pins.items():
            self.clearance(name, pin, self.linkage.pins[name])
        for name, point in self.linkage.points.items():
            at = self.marker(point.body, point.point, name)
            self.out.ask(name, x=f"DX({at},{self.axes},{self.axes})", y=f"DY({at},{self.axes},{self.axes})")
        out.heading("RESULTS")
        columns = out.requests()
        self.analysis()
        head = f"ADAMS/View model name: {title}\n{HEADER}"
        return AdamsDataset(head + "\n".join(out.lines) + "\nEND\n", columns)

    def part(self, name: str, centre: Vector2, mass: float, inertia: float) -> int:
        """A part, and the marker of its centre of mass. Only the last moment of inertia counts in the plane."""
        out, marker = self.out, self.out.following("MARKER")
        self.centres[name] = centre
        self.parts[name] = out.add(
            "PART",
            name,
            f"QG = {numbers(*centre, 0.0)}",
            f"MASS = {number(mass)}",
            f"CM = {marker}",
            f"IP = {numbers(0.5 * inertia, 0.5 * inertia, inertia)}",
        )
        return self.marker(name, centre, f"{name}_centre")

    def marker(self, body: str, point: Vector2, name: str, along: float | None = None) -> int:
        """A marker at a point of the start posture; along: direction of its z axis [rad], else it is across."""
        x, y = self.centres[body]
        where = [f"PART = {self.parts[body]}", f"QP = {numbers(point[0] - x, point[1] - y, 0.0)}"]
        if along is not None:  # body 3-1-3: z = (sin psi, -cos psi, 0) for theta = 90 degrees
            where.append(f"REULER = {number(along + 0.5 * math.pi)}, {number(0.5 * math.pi)}, 0.0")
        return self.out.add("MARKER", name, *where)

    def body(self, name: str, body: Body) -> None:
        at = self.part(name, body.centre, body.mass, body.inertia)
        pair = f"{at},{self.axes}"
        self.out.ask(
            name,
            x=f"DX({pair},{self.axes})",
            y=f"DY({pair},{self.axes})",
            angle=f"AZ({pair})+{number(body.angle)}",
        )

    def pins(self) -> None:
        """All ideal pins, from the ground outwards; and planar joints for what they do not reach."""
        self.out.heading("PINS")
        left = {name: self.linkage.pins[name] for name in self.scenario.held_pins}
        reached = {GROUND}
        while True:
            for name, pin in list(left.items()):
                if {pin.first, pin.second} & reached:
                    closes = {pin.first, pin.second} <= reached
                    self.pin(name, left.pop(name), closes)
                    reached |= {pin.first, pin.second}
            if any({pin.first, pin.second} & reached for pin in left.values()):
                continue
            loose = next((name for name in self.linkage.bodies if name not in reached), None)
            if loose is None:
                return
            at, on = self.marker(loose, self.centres[loose], f"{loose}_plane"), self.axes
            self.out.add("JOINT", f"{loose}_plane", "PLANAR", f"I = {at}", f"J = {on}")
            reached.add(loose)

    def pair(self, name: str, first: tuple[str, Vector2], second: tuple[str, Vector2]) -> tuple[int, int]:
        """Markers of two bodies at their points, called NAME_i and NAME_j; written in this order."""
        return self.marker(*first, f"{name}_i"), self.marker(*second, f"{name}_j")

    def pin(self, name: str, pin: PinPlace, closes: bool) -> None:
        kind, form = ("JPRIM", "INLINE") if closes else ("JOINT", "REVOLUTE")
        first = self.marker(pin.first, pin.first_point, f"{name}_j")
        second = self.marker(pin.second, pin.second_point, f"{name}_i")
        joint = self.out.add(kind, name, form, f"I = {second}", f"J = {first}")
        force = {f"force_{axis}": f"{kind}({joint},0,{n},0)" for n, axis in ((2, "x"), (3, "y"))}
        self.out.ask(f"pin.{name}", **force)

    def column(self, name: str, actuator: LinearActuator, drive: Drive) -> None:
        foot, head = actuator.foot_point, actuator.head_point
        along = math.atan2(head[1] - foot[1], head[0] - foot[0])
        cylinder, rod = f"{name}_cylinder", f"{name}_rod"
        self.part(cylinder, foot, LIGHT, LIGHT)
        self.part(rod, head, LIGHT, LIGHT)
        feet = self.pair(f"{name}_foot", (cylinder, foot), (actuator.foot, foot))
        self.out.add("JOINT", f"{name}_foot", "REVOLUTE", f"I = {feet[0]}", f"J = {feet[1]}")
        slides = [
            self.marker(body, head, f"{name}_slide_{end}", along) for end, body in (("i", rod), ("j", cylinder))
        ]
        joint = self.out.add("JOINT", name, "TRANSLATIONAL", f"I = {slides[0]}", f"J = {slides[1]}")
        extension = "0"  # over time [m]
        if isinstance(drive, CubicStep):
            start, end, stroke = map(number, (drive.start, drive.end, drive.stroke))
            extension = f"STEP(TIME,{start},0,{end},{stroke})"
        motion = self.out.add("MOTION", name, f"JOINT = {joint}", f"FUNCTION = {extension}")
        heads = self.pair(f"{name}_head", (actuator.head, head), (rod, head))
        self.out.add("JPRIM", f"{name}_head", "INLINE", f"I = {heads[0]}", f"J = {heads[1]}")
        self.out.ask(name, length=f"DM({heads[0]},{feet[1]})", force=f"MOTION({motion},0,4,{slides[0]})")

    def clearance(self, name: str, pin: ClearancePin, place: PinPlace) -> None:
        ends = [(place.first, place.first_point), (place.second, place.second_point)]
        bore, journal = ends if pin.bore == "first" else ends[::-1]
        write_clearance(
            self.out,
            name,
            pin,
            journal=self.marker(*journal, f"{name}_journal"),
            bore=self.marker(*bore, f"{name}_bore"),
            floating=self.out.add("MARKER", f"{name}_floating", f"PART = {self.parts[bore[0]]}", "FLOATING"),
            axes=self.axes,
        )

    def analysis(self) -> None:
        """Weight, integrator and output."""
        x, y = map(number, self.scenario.gravity)
        self.out.plain("ACCGRAV", f"IGRAV = {x}", f"JGRAV = {y}", f"KGRAV = {number(0.0)}")
        self.out.plain("INTEGRATOR", "GSTIFF", f"ERROR = {number(ERROR)}", f"HMAX = {number(LONGEST_STEP)}")
        self.out.plain("OUTPUT", "REQSAVE")
        self.out.plain("RESULTS", "FORMATTED, XRF")


def solver_commands(scenario: Scenario, model: str) -> str:
    """The commands (`.acf`) by which ADAMS/Solver runs a dataset: to the scenario's end, with its records."""
    end, period = number(scenario.duration), number(scenario.recorded_every)
    return f"\nfile/model={model}\nsimulate/dynamics, end={end}, dtout={period}\nstop\n"


def _reasons(scenario: Scenario) -> Iterator[str]:
    """A line for everything that the writer has no statements for."""
    linkage = scenario.linkage
    if scenario.dimensions != 2:
        yield f"dimensions = {scenario.dimensions}: allowed: 2"
    if scenario.start != "concentric":
        yield f"start = {scenario.start!r}: allowed: 'concentric'"
    for name, pin in scenario.pins.items():
        if isinstance(pin, ClearancePin):
            law, friction = pin.contact.normal, pin.contact.friction
            if type(law) is not LankaraniNikravesh:
                yield f"pins.{name}.contact.normal = {type(law).__name__}: allowed: LankaraniNikravesh"
            if type(friction) not in (Ambrosio, Frictionless):
                kind = type(friction).__name__
                yield f"pins.{name}.contact.friction = {kind}: allowed: Ambrosio, or none"
        elif not isinstance(pin, IdealPin):
            yield f"pins.{name} = {type(pin).__name__}: allowed: ideal pins, and ClearancePin"
        elif pin.friction is not None:
            yield f"pins.{name}.friction = {type(pin.friction).__name__}: allowed: an ideal pin without"
    for name, model in scenario.actuators.items():
        if not isinstance(model, RigidActuator):
            yield f"actuators.{name} = {type(model).__name__}: allowed: RigidActuator"
    for name in scenario.own_bodies:
        yield f"parts.{name}: a body of its own; allowed: parts that are fixed to their bodies"
    for name in (*scenario.acting_loads, *scenario.blocks):
        yield f"loads.{name}: allowed: none but the weight"
    others = {"cranks": linkage.cranks, "slides": linkage.slides, "gears": linkage.gears}
    for kind, items in others.items():
        for name in items:
            yield f"{kind}.{name}: allowed: machines of bodies, pins and columns"
    for name in linkage.actuators:
        drive = scenario.drive_of(name)
        if not isinstance(drive, (CubicStep, Held)):
            yield f"drives.{name} = {type(drive).__name__}: allowed: CubicStep, the STEP function, or Held"
    for name, body in linkage.bodies.items():
        if any(body.velocity) or body.spin:
            yield f"bodies.{name}: moves at the start; allowed: machines that start at rest"
