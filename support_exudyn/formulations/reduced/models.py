"""The machines that the reduced formulation covers. A new one is its formulas, its model, and a line here."""

from __future__ import annotations

from typing import Any, Protocol, cast

from support_exudyn.formulations.reduced import slider_crank_model, support_model
from support_exudyn.formulations.reduced.bodies import Bodies
from support_exudyn.formulations.reduced.drive import Matrix
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.machine import Machine


class Model(Protocol):
    """What a machine's module offers. PIN: the pin that may be loose; DRIVES: that it covers."""

    PIN: str
    DRIVES: tuple[type[Drive], ...]

    def start(self, machine: Any) -> tuple[float, float]:
        """The free coordinates at the start."""

    def shifted(self, before: Linkage, after: Linkage) -> tuple[float, float]:
        """By how much the free coordinates differ between two postures of the linkage."""

    def reaches(self, machine: Any) -> tuple[float, float]:
        """By how much the journal moves with the free coordinates."""

    def fall(self, machine: Any, speed: float) -> float:
        """Acceleration of the journal without its contact besides gravity's [m/s^2] at a speed of the drive."""

    def parameters(self, machine: Any) -> dict[str, float]:
        """Parameters by name, see `layout`."""

    def bodies(
        self, machine: Any, linkage: Linkage, p: list[float], rows: Matrix, accelerations: Matrix | None
    ) -> Bodies:
        """Bodies and columns at the records."""


MODELS: dict[type[Machine], Model] = {
    HydraulicSupport: cast(Model, support_model),
    SliderCrank: cast(Model, slider_crank_model),
}
