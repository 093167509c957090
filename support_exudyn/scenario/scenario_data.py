"""What a scenario contains, and what follows from it: mechanism, drive of every part, kinds of pins."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from dataclasses import field, replace
from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import Field

from support_exudyn.mechanics.channel_table import Parts, channel_definitions
from support_exudyn.mechanics.channels import ALL_CHANNELS, ChannelDefinition
from support_exudyn.mechanics.closing import Conditions
from support_exudyn.mechanics.contact_places import (
    ContactPlace,
    block_places,
    contact_places,
    lacks_mass,
    with_mass,
)
from support_exudyn.mechanics.joint_friction import FrictionJoint, friction_joints
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.mechanics.postures import eccentric
from support_exudyn.model.actuators import (
    ActuatorModel,
    CylinderAndRod,
    OwnBody,
    PartModel,
    with_cylinder_and_rod,
)
from support_exudyn.model.drives.drive import Drive, Held
from support_exudyn.model.guides import ClearanceGuide, Guide, IdealGuide
from support_exudyn.model.hydraulics.elements import PumpStation
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.loads.load import ActingLoad, AnyLoad
from support_exudyn.model.machine import Machine
from support_exudyn.model.pins import ClearancePin, CompliantPin, IdealPin, Pin
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED, SolverSettings
from user_forces.friction.law import FrictionLaw
from user_forces.values.units import MetresPerSecondSquared, Seconds
from user_forces.values.value import InputError, Positive, Real, Value, Vector2, value

ACCURACIES = {"draft": 1e-2, "standard": 1e-3, "reference": 1e-5}
Accuracy = Literal["draft", "standard", "reference"] | Real
SMALLEST_GOAL, LARGEST_GOAL = 1e-8, 0.1
LARGEST_STEP = 0.1  # [s]


@value
class ScenarioData(Value, ABC):
    """The fields of a `Scenario` before anything is checked, and what follows from them.

    Arguments:
        machine: what is simulated.
        pins: for each pin that is not ideal (or to say so), what it is, by name.
        guides: for each guide of the machine that is not ideal (or to say so), what it is, by name; those with
            clearance in the plane.
        actuators: for each actuator that is not rigid and massless (or to say so), what it is, by name.
        pump: that all `HydraulicCylinder`s share; None: each has its own, which gives what is asked for at its
            `system_pressure`.
        parts: for each part that is not fixed to its body (or to say so), what it is, by name.
        drive: how all driven parts move: actuators extend [m], cranks turn [rad]. Into an oil column it lets
            oil. A `HydraulicCylinder` follows none, it has an inlet of its own.
        drives: for each driven part, an actuator or crank, that moves otherwise, how it does, by name. A part
            that follows another by the machine's making, such as the ram of a two-leg shield, does so unless it
            is named here.
        loads: what acts on the machine besides its weight and what it has of its own making (`Machine.loads`),
            by name; in the plane and in space.
        duration: end time [s], > 0; the run starts at 0.
        dimensions: 2: in the plane, both sides of a machine lumped; 3: in space, for machines that know their
            lateral dimensions. Parts that there are two of are then driven by names such as `front_column_left`
            if not both alike.
        start: "concentric": every journal in the middle of its bore, velocities as the machine says and as
            the drive has them with ideal pins; "settled": at rest in static equilibrium under gravity.
        gravity: acceleration [m/s^2].
        accuracy: what is asked for instead of settings: the relative error of mean, spread and largest value
            of the pin forces and of the paths of traced points, from 1e-8 to 0.1, or "draft" (1e-2), "standard"
            (1e-3), "reference" (1e-5). `step` and `solver` are then chosen by the program, as is the
            formulation if it is "auto"; it estimates its errors and refines until they are as asked.
            None: the settings stand as they are.
        formulation: "exudyn": the engine's rigid bodies with constraints, generalised alpha; runs every
            scene. "compiled": the same without the engine, by an explicit method with error control; in the
            plane, for laws and loads that are written as formulas. "auto": exudyn; with an accuracy the
            cheapest that covers the scene.
        step: largest time step [s], > 0, of the Exudyn formulation. Steps are equal parts of the time
            between two records; they are cut at impacts.
        record_period: time between records [s], > 0. Records are for curves; means, deviations and extremes are
            taken from every step. None: as the machine moves, see `timescales.default_period`.
        channels: what is recorded: names of channels, or patterns of them as in a shell, case-sensitive,
            such as "tip.*"; all by default. `time` always is. The result checks looks at all of them; without
            it (`SolverSettings.result_checks`) what nothing asks for is neither kept nor computed. A run to an
            accuracy also records what its errors are estimated by: all forces, angular accelerations and traced
            points.
        solver: settings of the time integration.
    """

    machine: Machine
    pins: Mapping[str, Pin] = field(default_factory=dict)
    guides: Mapping[str, Guide] = field(default_factory=dict)
    actuators: Mapping[str, ActuatorModel] = field(default_factory=dict)
    pump: PumpStation | None = None
    parts: Mapping[str, PartModel] = field(default_factory=dict)
    drive: Drive = field(default_factory=Held)
    drives: Mapping[str, Drive] = field(default_factory=dict)
    loads: Mapping[str, AnyLoad] = field(default_factory=dict)
    duration: Seconds[Positive]
    dimensions: Literal[2, 3] = 2
    start: Literal["concentric", "settled"] = "concentric"
    gravity: MetresPerSecondSquared[Vector2] = (0.0, -9.81)
    accuracy: Accuracy | None = None
    formulation: Literal["auto", "exudyn", "compiled"] = "auto"
    step: Seconds[Annotated[Real, Field(gt=0, le=LARGEST_STEP)]] = 5e-4
    record_period: Seconds[Positive] | None = None
    channels: tuple[str, ...] = ALL_CHANNELS
    solver: SolverSettings = field(default_factory=SolverSettings)

    def __getstate__(self) -> dict[str, Any]:
        """What is sent to another process: all but functions within functions, and what takes much room."""
        return {name: item for name, item in vars(self).items() if name not in ("channel_definitions", "plain")}

    @cached_property
    def plain(self) -> Mapping[str, Any]:
        """What `to_data` gives, once for all that only read it."""
        return self.to_data()

    @abstractmethod
    def refined(self, factor: float = 2) -> ScenarioData:
        """A scenario with steps so many times shorter, see `Scenario.refined`."""

    @property
    def chooses_steps(self) -> bool:
        """Whether the formulation chooses its steps by a tolerance."""
        return self.formulation in ERROR_CONTROLLED

    @property
    def jumps(self) -> bool:
        """Whether the speed of any drive jumps anywhere."""
        return any(drive.speed_jump(t) != 0.0 for drive in self.drives_in_use for t in drive.breaks)

    @cached_property
    def acting_loads(self) -> dict[str, ActingLoad]:
        """Loads that act by time and motion: those that the machine has of its own making, then the others."""
        given = {name: load for name, load in self.loads.items() if isinstance(load, ActingLoad)}
        return {**self.machine.loads, **given}

    @cached_property
    def elements(self) -> dict[str, ActingLoad]:
        """All that acts by time and motion: loads, and those of compliant pins as "pin.NAME.LOAD"."""
        found = dict(self.acting_loads)
        for name, pin in self.pins.items():
            if isinstance(pin, CompliantPin):
                found |= pin.named_loads(name, self.linkage.pins[name])
        return found

    @cached_property
    def blocks(self) -> dict[str, FallingBlock]:
        """Blocks that fall on the machine, by name."""
        return {name: load for name, load in self.loads.items() if isinstance(load, FallingBlock)}

    @cached_property
    def linkage(self) -> Linkage:
        """The mechanism in its start posture, as far as it is modelled, with blocks that fall on it."""
        linkage = self.unloaded
        for name, block in self.blocks.items():
            linkage = block.joined(linkage, name)
        return linkage

    @cached_property
    def unloaded(self) -> Linkage:
        """The machine's mechanism, as far as it is modelled.

        Raises InputError if its clearance pins cannot start with the eccentricities that are asked for.
        """
        modelled = self._modelled()
        offsets = {name: pin.offset for name, pin in self.pins.items() if name in modelled.pins}
        return eccentric(modelled, offsets)

    def _modelled(self) -> Linkage:
        """The machine's mechanism as far as it is modelled, with all journals where the machine has them."""
        heavy = {
            name: actuator for name, actuator in self.actuators.items() if isinstance(actuator, CylinderAndRod)
        }
        if not heavy and not self.own_bodies:
            return self.machine.linkage()
        linkage = self.machine.detailed(tuple(heavy), tuple(self.own_bodies))
        for name, model in heavy.items():
            if name in linkage.actuators and linkage.actuators[name].driven:
                linkage = with_cylinder_and_rod(linkage, name, model)
        return linkage

    @cached_property
    def guided_linkage(self) -> Linkage:
        """The mechanism with those guides alone that constraints hold."""
        loose = {name for name, guide in self.guides.items() if not guide.holds}
        if not loose:
            return self.linkage
        slides = {name: slide for name, slide in self.linkage.slides.items() if name not in loose}
        return replace(self.linkage, slides=slides)

    @cached_property
    def held(self) -> Conditions:
        """What constraints hold: ideal pins, rigid actuators, cranks, guides and gears."""
        linkage, oil = self.guided_linkage, self.compliant_actuators
        pins = {name: linkage.pins[name] for name in self.held_pins}
        rigid = {name: one for name, one in linkage.actuators.items() if name not in oil}
        return Conditions(replace(linkage, pins=pins, actuators=rigid))

    @cached_property
    def contact_places(self) -> dict[str, ContactPlace]:
        """Where bodies may make contact and part: clearance pins, corners in guides, faces of blocks."""
        joints = contact_places(self.linkage, self.clearance_pins, self._guides_with_masses)
        return {**joints, **block_places(self.blocks, self.gravity)}

    def contact_stem(self, name: str) -> str:
        """What channels and numbers of a contact begin with; name: of `contact_places`, or of an edge."""
        place = self.contact_places.get(name)
        return f"pin.{name}" if place is None else place.stem

    @cached_property
    def space(self) -> SpatialLinkage:
        """The machine's mechanism in space, with blocks that fall on it.

        Raises InputError if the machine is known in its plane only.
        """
        space = self.machine.in_space(self.unloaded)
        for name, block in self.blocks.items():
            space = block.joined_in_space(space, name)
        return space

    def drive_of(self, name: str) -> Drive:
        """The drive that an actuator or crank follows; `Held` for one that is not driven, or is a cylinder."""
        whole = name
        if self.dimensions == 3 and name in self.space.actuators:  # one of a pair
            whole = self.space.actuators[name].actuator
        actuators = self.linkage.actuators
        if whole in self.valved or (whole in actuators and not actuators[whole].driven):
            return Held()
        said = self.drives.get(name, self.drives.get(whole))
        if said is not None:
            return said
        return self._coupled_drives.get(whole, self.drive)

    @cached_property
    def _coupled_drives(self) -> dict[str, Drive]:
        """Drives of the parts that follow others because nothing is said of them, by name."""
        found = {}
        for name, leader in self.machine.leaders.items():
            if name not in self.drives:
                lead = self.drives.get(leader, self.drive)
                try:
                    found[name] = self.machine.coupled_drive(name, lead, self.duration)
                except InputError as error:
                    raise InputError(self.of_drives((leader,), error)) from None
        return found

    def of_drives(self, names: Collection[str], error: InputError) -> str:
        """What is said of the drives of these parts, with the fields that say them."""
        said = str(error)
        fields = [f"drives.{name}" for name in names if name in self.drives] or ["drive"]
        return said if said.startswith(("drive", "drives.")) else f"{' and '.join(fields)}: {said}"

    @property
    def drives_in_plane(self) -> tuple[dict[str, Drive], ...]:
        """The drives of all driven parts of the plane, by name; in space once for either side."""
        if self.dimensions == 2:
            return ({name: self.drive_of(name) for name in self.driven},)
        parts = {name: self.space.parts_of_actuator(name) for name in self.linkage.driven}
        sides = ({name: self.drive_of(part[n % len(part)]) for name, part in parts.items()} for n in (0, 1))
        return tuple(sides)

    @property
    def driven(self) -> tuple[str, ...]:
        """Names of all parts that follow a drive: actuators, then cranks."""
        if self.dimensions == 2:
            return tuple(name for name in self.linkage.driven if name not in self.valved)
        driven = [name for name in self.linkage.driven if name not in self.valved]
        return tuple(name for name, one in self.space.actuators.items() if one.actuator in driven)

    @cached_property
    def drives_in_use(self) -> tuple[Drive, ...]:
        """All different drives of driven parts; `drive` if the machine has none."""
        found: list[Drive] = []
        for name in self.driven:
            if (drive := self.drive_of(name)) not in found:
                found.append(drive)
        return tuple(found) or (self.drive,)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Breaks of all drives in use, of loads and of valves [s], sorted."""
        of_drives = {t for drive in self.drives_in_use for t in drive.breaks}
        of_valves = (cylinder.inlet.breaks for cylinder in self.valved.values())
        return tuple(sorted(of_drives.union(*(load.breaks for load in self.elements.values()), *of_valves)))

    @cached_property
    def channel_definitions(self) -> dict[str, ChannelDefinition]:
        """All channels that could be asked for, by name."""
        linkage, legs = self.linkage if self.dimensions == 2 else self.space, self.legs
        if self.dimensions == 3:
            sides = self.space.actuators.items()
            legs = {name: legs[one.actuator] for name, one in sides if one.actuator in legs}
        return channel_definitions(
            linkage,
            Parts(
                pins=self.pins,
                guides=self.guides,
                oil=self.compliant_actuators,
                legs=legs,
                pump=self.pump is not None,
                loads=self.acting_loads,
                blocks=tuple(self.blocks),
            ),
        )

    @property
    def goal(self) -> float | None:
        """The accuracy that is asked for, as a number; None if none is."""
        return ACCURACIES[self.accuracy] if isinstance(self.accuracy, str) else self.accuracy

    def pin(self, name: str) -> Pin:
        """The pin of this name, ideal if nothing is said of it."""
        return self.pins.get(name, IdealPin())

    @property
    def held_pins(self) -> tuple[str, ...]:
        """Names of the pins that two constraints hold, in the order of the linkage."""
        return tuple(name for name in self.linkage.pins if self.pin(name).holds)

    @cached_property
    def clearance_pins(self) -> dict[str, ClearancePin]:
        """The pins that have clearance, by name, with the masses that their laws need, see `contact_places`."""
        found = {name: pin for name, pin in self.pins.items() if isinstance(pin, ClearancePin)}
        for name, pin in found.items():
            if lacks_mass(pin.contact.normal) and name in self.linkage.pins:
                found[name] = with_mass(pin, name, self.linkage, self.open_kinetics)
        return found

    @cached_property
    def _guides_with_masses(self) -> dict[str, Guide]:
        """The guides with the masses that their laws need."""
        found = dict(self.guides)
        for name, guide in found.items():
            if isinstance(guide, ClearanceGuide) and lacks_mass(guide.normal):
                found[name] = with_mass(guide, name, self.linkage, self.open_kinetics)
        return found

    @property
    def open_kinetics(self) -> Kinetics:
        """Masses and constraints with all clearance joints open and all actuators rigid."""
        return kinetics_of(self.guided_linkage, self.held_pins)

    @property
    def friction_pins(self) -> dict[str, IdealPin]:
        """The ideal pins that have friction, by name."""
        pins = self.pins.items()
        return {name: pin for name, pin in pins if isinstance(pin, IdealPin) and pin.friction is not None}

    @property
    def friction_guides(self) -> dict[str, IdealGuide]:
        """The ideal guides that have friction, by name."""
        found = {name: guide for name, guide in self.guides.items() if isinstance(guide, IdealGuide)}
        return {name: guide for name, guide in found.items() if guide.friction is not None}

    @property
    def friction_joints(self) -> dict[str, FrictionJoint]:
        """Ideal pins with friction, then ideal guides, as "pins.NAME" and "guides.NAME"."""
        return friction_joints(self.linkage, self.friction_pins, self.friction_guides)

    @property
    def friction_laws(self) -> dict[str, FrictionLaw]:
        """The laws of `friction_joints`."""
        return {name: joint.law for name, joint in self.friction_joints.items()}

    @cached_property
    def legs(self) -> dict[str, HydraulicLeg]:
        """All actuators, and jacks, that oil holds, by name."""
        jacks = {self.machine.jacks[name]: part.jack for name, part in self.own_bodies.items()}
        found = {name: one.hydraulic for name, one in {**self.actuators, **jacks}.items()}
        return {name: one for name, one in found.items() if isinstance(one, HydraulicLeg)}

    @property
    def valved(self) -> dict[str, HydraulicCylinder]:
        """All actuators that are hydraulic cylinders, by name; they follow no drive."""
        return {name: one for name, one in self.actuators.items() if isinstance(one, HydraulicCylinder)}

    @property
    def compliant_actuators(self) -> tuple[str, ...]:
        """Names of the actuators whose length no constraint holds: those on oil."""
        return tuple(self.legs)

    @property
    def own_bodies(self) -> dict[str, OwnBody]:
        """The parts that are bodies of their own, by name."""
        return {name: part for name, part in self.parts.items() if isinstance(part, OwnBody)}
