"""From a scenario to a model in the engine: bodies, joints, contacts, loads, legs and weights."""

from __future__ import annotations

import math
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
        mounts = []
        # the face of a block turns as little as the ground
        still = isinstance(place, ContactPlace) and place.on_block
        ends = (place.bore, place.bore_point, still), (place.journal, place.journal_point, False)
        for (body, point, is_still), axes in zip(ends, self.frames(place), strict=True):
            frame = placed(axes, self.local(body, point))
            mounts.append(Mount(self.item(body), frame, is_still or body == GROUND))
        bore, journal = mounts
        return JointItem(self.mbs, place.contact, bore, journal)

    def frames(self, place: ContactPlace | SectionPlace) -> tuple[Matrix, Matrix]:
        """Axes of bore and journal in the start posture, in columns (3, 3)."""
        if isinstance(place, SectionPlace):
            return frame_of(place.bore_end.axis), frame_of(place.journal_end.axis)
        axes = np.array(frame((0.0, 0.0), place.axes(self.scenario.linkage)))[:3, :3]
        return axes, axes

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

    def add_legs(self) -> list[LegItem]:
        """Put hydraulic legs in place of actuators, in space on each side; their forces follow later."""
        scenario = self.scenario
        legs = preloaded_legs(scenario.linkage, scenario.legs, scenario.gravity)
        if self.in_space:
            legs = {
                name: PreloadedLeg(name, one, whole.model.share(one.share), one.share * whole.load)
                for name, one in self.linkage.actuators.items()
                if (whole := legs.get(one.actuator)) is not None
            }
        found = []
        for name, leg in legs.items():
            ends, model = self.ends(leg.actuator), leg.model
            spring = ObjectConnectorSpringDamper(markerNumbers=ends, referenceLength=leg.actuator.start_length)
            source = model.inlet if isinstance(model, HydraulicCylinder) else scenario.drive_of(name)
            found.append(LegItem(self.mbs, leg, ends, self.mbs.AddObject(spring), source))
        return found

    # --- the whole ---

    def build(self) -> EngineScene:
        """The whole scene."""
        scenario, linkage, mbs = self.scenario, self.linkage, self.mbs
        rows, held, size = self.constraints()
        self.add_joints(rows)
        frictions = {name: self.add_friction(joint) for name, joint in scenario.friction_joints.items()}
        legs = self.add_legs()
        places = self.contact_places()
        connectors = {name: [self.add_contact(part) for part in parts[1:]] for name, parts in places.items()}
        loads = {name: LoadItem(load, name, self) for name, load in scenario.elements.items()}
        for name, body in linkage.bodies.items() if any(scenario.gravity) else ():
            self.add_weight(name, body)
        mbs.Assemble()
        for friction in frictions.values():
            friction.assembled(self.multiplier(friction.joint.owner), self.bodies)
            friction.lagged = bool(connectors) or scenario.jumps
        weight = sum(body.mass for body in scenario.linkage.bodies.values()) * math.hypot(*scenario.gravity)
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
            legs=EngineLegs(legs, scenario.pump, weight),
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
