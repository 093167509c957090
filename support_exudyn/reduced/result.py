"""What comes out of a run of the reduced formulation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from support_exudyn.impulse import Impulse
from support_exudyn.onset import Onset
from support_exudyn.reduced.posture import Vector
from support_exudyn.scenario import Scenario


@dataclass(frozen=True)
class ReducedResult:
    """A finished run.

    scenario: what was run. channels: quantities over time by name, SI, names and signs of `Result`.
    onsets: beginnings of contact of the loose pin; largest_force: its largest force [N], also between records.
    impulses: where the columns' speed jumped. steps: tried ones; evaluations: of the equations of motion.
    wall_time: [s].
    """

    scenario: Scenario
    channels: Mapping[str, Vector]
    onsets: Mapping[str, tuple[Onset, ...]]
    largest_force: Mapping[str, float]
    impulses: tuple[Impulse, ...]
    steps: int
    evaluations: int
    wall_time: float

    def __getitem__(self, name: str) -> Vector:
        """Values of a channel, shape (n,), in SI."""
        if name not in self.channels:
            raise KeyError(f"{name!r}: no such channel; there are {', '.join(self.channels)}")
        return self.channels[name]

    @property
    def time(self) -> Vector:
        """Times of the records [s], shape (n,)."""
        return self["time"]

    @property
    def dissipated(self) -> float:
        """Energy dissipated in the loose pin over the run [J]; 0 with ideal pins."""
        names = ("energy.damping_loss", "energy.friction_loss")
        return float(np.sum([self.channels[name][-1] for name in names if name in self.channels]))
