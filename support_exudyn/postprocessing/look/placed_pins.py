"""Where the pins of a scenario are on their bodies, by the names that channels have for them."""

from __future__ import annotations

from dataclasses import dataclass

from support_exudyn.model.pins import ClearancePin
from support_exudyn.model.to_space import at
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector3


@dataclass(frozen=True)
class End:
    """A body, or "ground", and the point of it at which the pin is, start posture [m]."""

    body: str
    point: Vector3


@dataclass(frozen=True)
class PlacedPin:
    """A pin, in space a bearing; in the plane it stands for those of a pair and lies between them (z = 0).

    Arguments:
        name: as the channels know it.
        first, second: its two ends.
        loose: the scenario's pin if it has clearance, else None.
    """

    name: str
    first: End
    second: End
    loose: ClearancePin | None

    @property
    def bore_is_second(self) -> bool:
        """Whether the second body carries the bore; of an ideal pin the first one counts as doing so."""
        return self.loose is not None and self.loose.bore == "second"

    @property
    def bore(self) -> End:
        """The body that carries the bore, and its centre."""
        return self.second if self.bore_is_second else self.first

    @property
    def journal(self) -> End:
        """The body that carries the journal, and its centre."""
        return self.first if self.bore_is_second else self.second


def placed_pins(scenario: Scenario) -> list[PlacedPin]:
    """All pins of a scenario, in the order of its machine; guides are none."""
    if scenario.dimensions == 2:
        return list(planar_pins(scenario).values())
    loose = scenario.clearance_pins
    return [
        PlacedPin(name, End(b.first, b.first_point), End(b.second, b.second_point), loose.get(b.pin))
        for name, b in scenario.space.bearings.items()
        if not b.is_guide
    ]


def planar_pins(scenario: Scenario) -> dict[str, PlacedPin]:
    """The pins of the plane, by name, also of a scenario in space."""
    loose = scenario.clearance_pins
    return {
        name: PlacedPin(
            name, End(p.first, at(p.first_point, 0.0)), End(p.second, at(p.second_point, 0.0)), loose.get(name)
        )
        for name, p in scenario.linkage.pins.items()
    }
