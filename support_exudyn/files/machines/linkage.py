"""Files of planar linkages of any kind: a drawing, bodies, joints and drives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field, replace
from typing import Annotated, Literal

from support_exudyn.files.machines.linkage_bodies import DrawnBody, LinkageBodyData, drawn_body
from support_exudyn.files.machines.linkage_joints import (
    DrawnPoints,
    LinkageActuatorData,
    LinkageGearData,
    LinkageGuideData,
    LinkagePinData,
)
from support_exudyn.files.machines.linkage_loads import (
    LinkageForceData,
    LinkageSpringData,
    LinkageTorqueData,
    LinkageTorsionData,
)
from support_exudyn.files.machines.parts import check_known
from support_exudyn.files.toml.shapes import Names
from support_exudyn.machines.check.statics import mobility
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.planar_linkage import PlanarLinkage
from support_exudyn.machines.strength.strength_data import StrengthData
from support_exudyn.mechanics.closure import assembled
from support_exudyn.mechanics.postures import set_moving
from support_exudyn.model.linkage import GROUND, Crank, Linkage, TracePoint
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.plane_geometry import distance
from user_forces.values.units import Metres, Radians, RadiansPerSecond
from user_forces.values.value import InputError, Positive, Real, Value, Vector2, check_names, value

MISDRAWN = 1e-3  # [m] by which a point may be drawn beside its place on the body without a warning
NAMED = (  # whose channels begin with the names of their parts
    "bodies", "traced_points", "actuators", "guides", "gears", "springs", "torsion_springs", "torques",
    "forces",
)  # fmt: skip
PIN_WIDTH = {"pins": "length of the contact in pins, along their axes"}


@value
class LinkageStart(Value):
    """Where a linkage starts, if not as it is drawn, and how fast.

    Arguments:
        angle: of bodies [rad], from +x: of the line of their bar, or of x of their frame; if no angle and no
            length is given, cranks stand as they are drawn.
        length: of actuators [m], > 0.
        angular_velocity: of bodies that move by themselves at the start [rad/s]; a driven crank has that of its
            drive.
    """

    angle: Radians[Mapping[str, Real]] = field(default_factory=dict)
    length: Metres[Mapping[str, Positive]] = field(default_factory=dict)
    angular_velocity: RadiansPerSecond[Mapping[str, Real]] = field(default_factory=dict)


@value
class LinkageFile(Value):
    """Any planar linkage: bodies on pins, in guides, on actuators, cranks and gears.

    Arguments:
        kind: what the machine is.
        name: what it is called.
        sources: where the data come from: texts, by what they are of.
        drawing: places of points at the start [m], [x, y], x to the right, y up. Those of the ground are exact;
            those of bodies with lengths of their own say roughly where they lie, and so which way they are put
            together where there are two.
        bodies: that move, by name.
        pins: by name: two bodies that are pinned together at the point of that name, or a table.
        guides: along which something slides, by name.
        gears: pairs of bodies that turn in proportion, by name.
        actuators: that hold two points apart, by name.
        cranks: driven bodies that turn, by the name of the crank.
        springs: springs and dampers between points of two bodies, by name.
        torsion_springs: springs and dampers against turning, by name.
        torques, forces: of given course, by name.
        traced_points: points whose paths are recorded, by name: body and point.
        start: where it starts, if not as it is drawn.
        stroke: by how much its actuators extend from the start on, in use [m], > 0.
        bore_radius: radii of the bores of pins, for pins with clearance [m], > 0.
        width: across the plane [m]: the lengths of pins.
        strength: bores, pressures, stages, eyes and base, for `stand`.
    """

    kind: Literal["linkage"]
    name: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)
    drawing: Metres[Mapping[str, Vector2]]
    bodies: Mapping[str, LinkageBodyData]
    pins: Mapping[str, tuple[str, str] | LinkagePinData] = field(default_factory=dict)
    guides: Mapping[str, LinkageGuideData] = field(default_factory=dict)
    gears: Mapping[str, LinkageGearData] = field(default_factory=dict)
    actuators: Mapping[str, LinkageActuatorData] = field(default_factory=dict)
    cranks: Mapping[str, str] = field(default_factory=dict)
    springs: Mapping[str, LinkageSpringData] = field(default_factory=dict)
    torsion_springs: Mapping[str, LinkageTorsionData] = field(default_factory=dict)
    torques: Mapping[str, LinkageTorqueData] = field(default_factory=dict)
    forces: Mapping[str, LinkageForceData] = field(default_factory=dict)
    traced_points: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    start: LinkageStart = field(default_factory=LinkageStart)
    stroke: Metres[Positive] | None = None
    bore_radius: Metres[Mapping[str, Positive]] = field(default_factory=dict)
    width: Metres[Annotated[Mapping[str, Mapping[str, Positive]], Names(PIN_WIDTH)]] = field(
        default_factory=dict
    )
    strength: StrengthData | None = None

    def data(self) -> MachineData:
        """The machine. Raises InputError if it cannot be built."""
        if not self.bodies:
            raise InputError("bodies: there are none; allowed: one or more, [bodies.NAME]")
        bodies = {name: drawn_body(name, body, self.drawing) for name, body in self.bodies.items()}
        places = DrawnPoints(bodies, self.drawing)
        guides = {name: places.guide(name, guide) for name, guide in self.guides.items()}
        drawing = Linkage(
            bodies={name: body.body() for name, body in bodies.items()},
            pins={name: places.pin(name, pin) for name, pin in self.pins.items()},
            actuators={name: places.actuator(name, one) for name, one in self.actuators.items()},
            points={name: self._traced(name, places) for name in self.traced_points}
            | dict(self._loaded(places)),
            cranks={
                name: Crank(body=places.moving(body, f"cranks.{name}")) for name, body in self.cranks.items()
            },
            slides={name: guide for name, (guide, _) in guides.items()},
            gears={name: places.gear(name, gear) for name, gear in self.gears.items()},
        )
        self._check_names(drawing, places)
        origins = {name: origin for name, (_, origin) in guides.items()}
        held = {body for name, body in self._on_springs()}
        angles = self.start.angle
        if not angles and not self.start.length:  # what drives turn stands as it is drawn
            angles = {crank.body: drawing.bodies[crank.body].angle for crank in drawing.cranks.values()}
        closed = assembled(drawing, angles, self.start.length, origins=origins, held=held)
        _check_driven(closed)
        acting = self._acting(closed)
        columns = {name: one.column(f"actuators.{name}") for name, one in self.actuators.items()}
        closed = replace(closed, points={name: closed.points[name] for name in self.traced_points})
        lengths = self.width.get("pins", {})
        return MachineData(
            PlanarLinkage(
                drawing=set_moving(closed, self.start.angular_velocity), acting=acting, pin_lengths=lengths
            ),
            self.name,
            bore_radii=self.bore_radius,
            blocks={name: one.block for name, one in self.guides.items() if one.block is not None},
            actuators={name: one for name, one in columns.items() if one is not None},
            stroke=self.stroke,
            sources=self.sources,
            kind=self.kind,
            assumed=tuple(body.assumed for body in bodies.values() if body.assumed),
            warnings=tuple(self._moved_points(bodies)),
            strength=self.strength,
        )

    def _moved_points(self, bodies: Mapping[str, DrawnBody]) -> Iterator[str]:
        """Warnings on points that the drawing has elsewhere than `points_mm` of their body."""
        for name, body in bodies.items():
            for point in self.bodies[name].points:
                place = body.place(point, self.drawing, point)
                apart = distance(place, self.drawing[point]) if point in self.drawing else 0.0
                if apart > MISDRAWN:
                    yield (
                        f"bodies.{name}.points_mm.{point}: lies {1e3 * apart:.4g} mm beside the point of the "
                        "drawing, which is moved there"
                    )

    def _traced(self, name: str, places: DrawnPoints) -> TracePoint:
        body, point = self.traced_points[name]
        where = f"traced_points.{name}"
        return TracePoint(body=places.moving(body, where), point=places.place(body, point, where))

    def _on_springs(self) -> Iterator[tuple[str, str]]:
        """Names of what acts by springs, each with its bodies, which need no other joint."""
        for kind in ("springs", "torsion_springs"):
            for name, one in getattr(self, kind).items():
                yield from ((f"{kind}.{name}", body) for body in one.bodies if body != GROUND)

    def _loaded(self, places: DrawnPoints) -> Iterator[tuple[str, TracePoint]]:
        """The points at which springs and forces act, by the key that says them."""
        ends = [
            (f"springs.{name}.at[{n}]", one.bodies[n], one.at[n])
            for name, one in self.springs.items()
            for n in range(2)
        ]
        ends += [(f"forces.{name}.at", one.body, one.at) for name, one in self.forces.items()]
        for where, body, point in ends:
            yield where, TracePoint(body=body, point=places.place(body, point, where))

    def _acting(self, linkage: Linkage) -> dict[str, ActingLoad]:
        """What acts on the linkage, closed, by name."""
        at = {name: one.point for name, one in linkage.points.items()}
        acting: dict[str, ActingLoad] = {
            name: one.load(at[f"springs.{name}.at[0]"], at[f"springs.{name}.at[1]"])
            for name, one in self.springs.items()
        }
        acting |= {name: one.load() for name, one in self.torsion_springs.items()}
        acting |= {name: one.load() for name, one in self.torques.items()}
        return acting | {name: one.load(at[f"forces.{name}.at"]) for name, one in self.forces.items()}

    def _check_names(self, linkage: Linkage, places: DrawnPoints) -> None:
        """Raise InputError where something is said of what is not there, or two things share a name."""
        for what in ("drawing", "pins", "cranks", *NAMED):
            check_names(what, getattr(self, what))
        for where, named, known, what in (
            ("bore_radius_mm", self.bore_radius, linkage.pins, "pin"),
            ("width_mm.pins", self.width.get("pins", {}), linkage.pins, "pin"),
            ("start.angle_deg", self.start.angle, linkage.bodies, "body"),
            ("start.angular_velocity", self.start.angular_velocity, linkage.bodies, "body"),
            ("start.length_mm", self.start.length, linkage.actuators, "actuator"),
        ):
            for name in named:
                check_known(where, name, known, f"there is no such {what}")
        for name, torque in self.torques.items():
            places.body(torque.body, f"torques.{name}.body")
            places.body(torque.against, f"torques.{name}.against")
        for where, body in self._on_springs():
            places.body(body, f"{where}.bodies")
        taken: dict[str, str] = {}
        for what in NAMED:
            for name in getattr(self, what):
                if name in taken:
                    raise InputError(f"{what}.{name}: {taken[name]}.{name} has this name; allowed: another")
                taken[name] = what


def _check_driven(linkage: Linkage) -> None:
    """Raise InputError if there are more driven parts than ways to move: they fight."""
    free = mobility(linkage)
    if free.driven > free.free:
        driven = [f"actuators.{name}" for name, one in linkage.actuators.items() if one.driven]
        driven += [f"cranks.{name}" for name in linkage.cranks]
        raise InputError(
            f"{', '.join(driven)}: too many drives, {free.driven} driven parts fight over "
            f"{free.free} degrees of freedom; allowed: at most {free.free}"
        )
