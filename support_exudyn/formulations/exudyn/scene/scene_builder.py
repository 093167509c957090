"""From a scenario to a model in the engine: bodies, joints, contacts, loads, legs and weights."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import partial
from typing import Any

import numpy as np
from exudyn.itemInterface import ObjectConnectorSpringDamper

from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs, LegItem
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene, SceneContact
from support_exudyn.formulations.exudyn.scene.joint_builder import JointBuilder, placed
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.formulations.exudyn.scene.section_pin import SectionJournal, SectionPin
from support_exudyn.formulations.exudyn.scene.sections import SectionPlace, section_places
from support_exudyn.mechanics.constraints import frame_of
from support_exudyn.mechanics.contact_places import ContactPlace
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg, preloaded_legs
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.model.linkage import GROUND
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.connector.item import JointItem, Mount, frame


class SceneBuilder(JointBuilder):
    """Builds the engine's model of a scenario."""

    # --- contacts ---

    def contact_places(self) -> dict[str, list[Any]]:
        """Places of all contacts by name: each as a whole, then its sections."""
        scenario = self.scenario
        if not self.in_space:
            return {name: [place, place] for name, place in scenario.contact_places.items()}
        found: dict[str, list[Any]] = {}
        for name, bearing in self.linkage.bearings.items():
            if (pin := scenario.clearance_pins.get(bearing.pin)) is not None:
                found[name] = [*section_places(bearing, pin.contact, pin.bore, scenario.solver.sections)]
        for name, block in scenario.blocks.items():
            found[name] = 2 * [scenario.contact_places[name].in_space(block.lateral)]
        return found

    def add_contact(self, place: ContactPlace | SectionPlace) -> JointItem:
        """Add the connector of a contact."""
        bore, journal = self.frames(place)
        block = isinstance(place, ContactPlace) and place.on_block  # its face turns as little as the ground
        return JointItem(
            self.mbs,
            place.contact,
            self.mount(place.bore, place.bore_point, bore, still=block),
            self.mount(place.journal, place.journal_point, journal),
        )

    def frames(self, place: ContactPlace | SectionPlace) -> tuple[Matrix, Matrix]:
        """Axes of bore and journal in the start posture, in columns (3, 3)."""
        if isinstance(place, SectionPlace):
            return frame_of(place.bore_end.axis), frame_of(place.journal_end.axis)
        axes = np.array(frame((0.0, 0.0), place.axes(self.scenario.linkage)))[:3, :3]
        return axes, axes

    def mount(self, body: str, point: Any, axes: Matrix, still: bool = False) -> Mount:
        """Where a bore or a journal is."""
        return Mount(self.item(body), placed(axes, self.local(body, point)), still or body == GROUND)

    def contact(self, scene: EngineScene, name: str, places: list[Any], items: list[JointItem]) -> SceneContact:
        """The contact of connectors in the whole scene."""
        (middle, *parts), steps = places, self.scenario.solver.impact_steps
        mass, axes = partial(scene.inverse_mass, name), self.frames(middle)[0]
        if not isinstance(middle, SectionPlace):
            pins = [ContactConnector(item, mass, steps) for item in items]
            return SceneContact(middle, axes, 1.0, parts, pins)
        whole = SectionJournal(mass, slides=middle.slides)
        sections: list[ContactConnector] = [
            SectionPin(middle.contact, item, whole, part.section.share, steps)
            for part, item in zip(parts, items, strict=True)
        ]
        return SceneContact(middle, axes, middle.section.share, parts, sections)

    # --- hydraulics ---

    def add_leg(self, leg: PreloadedLeg) -> LegItem:
        """Put a hydraulic leg in place of an actuator; its force follows when all is there."""
        ends, model = self.ends(leg.actuator), leg.model
        spring = ObjectConnectorSpringDamper(markerNumbers=ends, referenceLength=leg.actuator.start_length)
        drive = self.scenario.drive_of(leg.name)
        source = model.inlet if isinstance(model, HydraulicCylinder) else drive
        return LegItem(self.mbs, leg, ends, self.mbs.AddObject(spring), source)

    def legs(self) -> list[PreloadedLeg]:
        """Hydraulic legs: those of the plane, in space each side with its share of them."""
        plane = preloaded_legs(self.scenario.linkage, self.scenario.legs, self.scenario.gravity)
        if not self.in_space:
            return [*plane.values()]
        return [
            PreloadedLeg(name, one, whole.model.share(one.share), one.share * whole.load)
            for name, one in self.linkage.actuators.items()
            if (whole := plane.get(one.actuator)) is not None
        ]

    def join_legs(self, items: Iterable[LegItem]) -> EngineLegs:
        """All legs, and the pump that they share."""
        scenario = self.scenario
        mass = sum(body.mass for body in scenario.linkage.bodies.values())
        weight = mass * math.hypot(*scenario.gravity)
        return EngineLegs(tuple(items), scenario.pump, weight)

    # --- the whole ---

    def build(self) -> EngineScene:
        """The whole scene."""
        scenario, linkage, mbs = self.scenario, self.linkage, self.mbs
        rows, held, size = self.constraints()
        self.add_joints(rows)
        frictions = {name: self.add_friction(joint) for name, joint in scenario.friction_joints.items()}
        legs = [self.add_leg(leg) for leg in self.legs()]
        places = self.contact_places()
        connectors = {name: [self.add_contact(part) for part in parts[1:]] for name, parts in places.items()}
        loads = {name: LoadItem(load, name, self) for name, load in scenario.elements.items()}
        for name, body in linkage.bodies.items() if any(scenario.gravity) else ():
            self.add_weight(name, body)
        mbs.Assemble()
        for friction in frictions.values():
            friction.assembled(self.multiplier(friction.joint.owner), self.bodies)
            friction.lagged = bool(connectors) or scenario.jumps
        scene = EngineScene(
            scenario=scenario,
            linkage=linkage,
            container=self.container,
            mbs=mbs,
            bodies=self.bodies,
            rows=rows,
            held=held,
            size=size,
            contacts={},
            frictions=frictions,
            loads=loads,
            driven=[*self.driven_parts()],
            legs=self.join_legs(legs),
        )
        for name, items in connectors.items():
            scene.contacts[name] = self.contact(scene, name, places[name], items)
        scene.drive_to(0.0)
        scene.start_moving()
        scene.legs.begin()
        scene.start_rubbing()
        scene.reset_memory()
        return scene


def build(scenario: Scenario) -> EngineScene:
    """The engine's model of a scenario at its start, before any settling, whatever its formulation is.

    Who asks for it releases it, see `EngineScene.release`.
    """
    return SceneBuilder(scenario).build()
