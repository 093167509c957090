"""What of a scenario has to fit its machine."""

import dataclasses
import math
from collections.abc import Collection, Mapping

import numpy as np

from support_exudyn.mechanics.channels import ALL_CHANNELS, check_patterns
from support_exudyn.mechanics.following import follow
from support_exudyn.model.drives.drive import Held
from support_exudyn.model.guides import Guide
from support_exudyn.model.hydraulics.elements import PumpStation
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.loads.load import ActingLoad, AnyLoad
from support_exudyn.model.pins import Pin
from support_exudyn.scenario.scenario_data import ScenarioData
from user_forces.values.names import nearest, unknown
from user_forces.values.value import InputError, check_names

TURNED = 1e-9  # least share by which a condition holds how a body turns


def check(scenario: ScenarioData) -> None:
    """Raise ValueError that says what of a scenario does not fit its machine, or the rest of it."""
    _check_known("parts", scenario.parts, scenario.machine.jacks, "part on a jack")
    try:
        scenario.unloaded  # noqa: B018 - can it be laid out?
    except InputError as error:
        raise ValueError(str(error)) from None
    _check_loads(scenario)
    linkage = scenario.linkage
    if scenario.dimensions == 3:
        _check_space(scenario)
        _check_loads_in_space(scenario)
    places = linkage.pins
    _check_known("pins", scenario.pins, places, "pin")
    for name, place in places.items():
        apart = math.dist(place.first_point, place.second_point)
        if apart > 1e-9 and scenario.pin(name).holds:
            raise ValueError(
                f"pins.{name}: its points on both bodies are {apart:.3g} m apart at the start; "
                "allowed for an ideal pin: 0, for a clearance pin: any"
            )
    _check_known("guides", scenario.guides, linkage.slides, "guide")
    for name, guide in scenario.guides.items():
        if misfit := guide.misfit(linkage.slides[name].turns):
            raise ValueError(f"guides.{name}: {misfit}")
    if scenario.record_period is not None and scenario.record_period > scenario.duration:
        raise ValueError(
            f"record_period = {scenario.record_period} s: allowed: at most the duration, {scenario.duration} s"
        )
    _check_point_masses(scenario)
    _check_actuators(scenario, linkage)
    _check_drives(scenario, linkage)
    if scenario.channels != ALL_CHANNELS:
        check_patterns(scenario.channel_definitions, scenario.channels)


def _check_known(field: str, names: Collection[str], known: Collection[str], what: str) -> None:
    """Raise ValueError unless the machine has everything that a field of the scenario names."""
    for name in names:
        if name not in known:
            raise ValueError(f"{field}.{name}: {unknown(what, name, known)}")


def _check_point_masses(scenario: ScenarioData) -> None:
    """Raise ValueError if joints do not determine how point masses turn, whose own inertia does not either."""
    held, names = scenario.held, list(scenario.linkage.bodies)
    points = [name for name in names if scenario.linkage.bodies[name].inertia == 0.0]
    turns = [3 * names.index(name) + 2 for name in points]
    rows = held.rows(np.zeros(3 * len(names)))[:, turns]
    if points and np.linalg.matrix_rank(rows, tol=TURNED) < len(points):
        alone = [
            name for name, row in zip(points, rows.T, strict=True) if np.abs(row).max(initial=0.0) < TURNED
        ]
        raise ValueError(
            f"bodies.{(alone or points)[0]}: its inertia is 0, and no joint without clearance that lies away "
            "from its centre of mass holds how it turns; allowed: an inertia > 0, or such a joint"
        )


def _check_space(scenario: ScenarioData) -> None:
    try:
        space = scenario.space
    except InputError as error:
        raise ValueError(f"dimensions = 3: {error}") from None
    if scenario.chooses_steps:
        raise ValueError(
            f"formulation = {scenario.formulation!r}: is planar; allowed in space: 'auto', 'exudyn'"
        )
    joints: dict[str, Pin | Guide] = {f"pins.{name}": pin for name, pin in scenario.pins.items()}
    joints |= {f"guides.{name}": guide for name, guide in scenario.guides.items()}
    for where, joint in joints.items():
        if refused := joint.refused_in_space():
            what, allowed = refused
            raise ValueError(f"{where} = {what}: is planar; allowed in space: {allowed}")
    for name, bearing in space.bearings.items():
        if scenario.pin(bearing.pin).holds and bearing.misfit:
            raise ValueError(
                f"bearings.{name}: {bearing.misfit} at the start; allowed for an ideal pin: none, for a "
                "clearance pin: any"
            )
    # rigid actuators of a pair cannot be driven apart: what they stand under is rigid, too
    for name, actuator in space.actuators.items():
        if actuator.actuator in scenario.compliant_actuators:
            continue
        for other in space.parts_of_actuator(actuator.actuator):
            if scenario.drive_of(other) != scenario.drive_of(name):
                raise ValueError(
                    f"drives.{name}: is not the drive of {other}, and both are rigid; "
                    "allowed for a pair of rigid actuators: one drive, or columns of oil"
                )


def _check_actuators(scenario: ScenarioData, linkage: Linkage) -> None:
    driven = [name for name, actuator in linkage.actuators.items() if actuator.driven]
    _check_known("actuators", scenario.actuators, driven, "actuator")
    for name, actuator in scenario.actuators.items():
        for one in scenario.space.parts_of_actuator(name) if scenario.dimensions == 3 else (name,):
            actuator.check_extension(scenario.drive_of(one).span(scenario.duration)[0], one)
        actuator.check_elements(f"actuators.{name}")
        if isinstance(actuator, HydraulicCylinder):
            actuator.check_length(linkage.actuators[name].start_length, name)
            if name in scenario.drives:
                raise ValueError(
                    f"drives.{name}: is a HydraulicCylinder, which follows no drive; allowed: none, but "
                    f"actuators.{name}.inlet"
                )
    for name, part in scenario.own_bodies.items():
        part.jack.check_elements(f"parts.{name}.jack")
    if scenario.pump is not None:
        _check_pump(scenario, scenario.pump)
    if scenario.valved and not scenario.driven and scenario.drive != Held():
        raise ValueError(
            f"drive = {type(scenario.drive).__name__}: nothing follows it, for all actuators are "
            "HydraulicCylinder, which move by their inlet; allowed: Held()"
        )


def _check_pump(scenario: ScenarioData, pump: PumpStation) -> None:
    if not scenario.valved:
        raise ValueError(
            "pump = PumpStation: no actuator is a HydraulicCylinder, which alone draws from it; allowed: None"
        )
    for name, cylinder in scenario.valved.items():
        if pump.pressure <= cylinder.tank_pressure:
            raise ValueError(
                f"pump.pressure = {pump.pressure} Pa: allowed: > actuators.{name}.tank_pressure = "
                f"{cylinder.tank_pressure} Pa"
            )


def _check_drives(scenario: ScenarioData, linkage: Linkage) -> None:
    allowed = tuple(dict.fromkeys((*linkage.driven, *scenario.driven)))
    _check_known("drives", scenario.drives, allowed, "driven part")
    for drive in scenario.drives_in_use:
        if scenario.start == "settled" and drive.initial_speed != 0.0:
            raise ValueError(
                "start = 'settled': is at rest, but the drive moves from the start on "
                f"({drive.initial_speed} per s); allowed with this drive: 'concentric'"
            )
    try:
        for drives in scenario.drives_in_plane:
            follow(scenario.machine.linkage(), drives, scenario.duration)
    except InputError as error:
        raise ValueError(scenario.of_drives(drives, error)) from None


def _check_loads(scenario: ScenarioData) -> None:
    linkage = scenario.unloaded
    taken = {"pin", "energy", "time", *linkage.bodies, *linkage.points, *linkage.driven, *linkage.actuators}
    taken |= {*linkage.pins, *linkage.slides, *linkage.gears}
    own: Mapping[str, AnyLoad] = scenario.machine.loads
    tables = {field.name: getattr(linkage, field.name) for field in dataclasses.fields(linkage)}
    for what, names in {**tables, "machine.loads": own, "loads": scenario.loads}.items():
        check_names(what, names)
    for name, load in own.items():
        _check_load(scenario, f"machine.loads.{name}", name, load, taken)
    for name, load in scenario.loads.items():
        _check_load(scenario, f"loads.{name}", name, load, {*taken, *own})


def _check_loads_in_space(scenario: ScenarioData) -> None:
    """Raise ValueError if a load acts on a body that there are two of."""
    single = scenario.space.bodies
    own = scenario.machine.loads
    everything: dict[str, AnyLoad] = {**scenario.acting_loads, **scenario.blocks}
    for name, load in everything.items():
        where = f"machine.loads.{name}" if name in own and name not in scenario.loads else f"loads.{name}"
        for what, body in (("body", load.body), ("other", load.against(name))):
            if body != GROUND and body not in single:
                allowed = [one for one in scenario.unloaded.bodies if one in single]
                raise ValueError(
                    f"{where}.{what} = {body!r}: there are two of it in space, which is not covered; "
                    f"allowed with dimensions = 3: {', '.join(allowed)}"
                )


def _check_load(scenario: ScenarioData, where: str, name: str, load: AnyLoad, taken: Collection[str]) -> None:
    """Raise ValueError unless a load goes with the machine; taken: names that it cannot have."""
    linkage, against = scenario.unloaded, load.against(name)
    if name in taken:
        raise ValueError(
            f"{where}: the machine has something of this name; allowed: all but {', '.join(sorted(taken))}"
        )
    if load.body not in linkage.bodies:
        raise ValueError(f"{where}.body = {load.body!r}: no such body; {nearest(load.body, linkage.bodies)}")
    if against not in (GROUND, name, *linkage.bodies):  # a body that it brings along has its own name
        bodies = (GROUND, *linkage.bodies)
        raise ValueError(f"{where}.other = {against!r}: no such body; {nearest(against, bodies)}")
    if not isinstance(load, (ActingLoad, FallingBlock)):
        raise ValueError(f"{where} = {type(load).__name__}: allowed: one of the kinds in model.loads")
