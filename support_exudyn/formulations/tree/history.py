"""All steps of a run, for what is computed afterwards."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix
from support_exudyn.mechanics.contact_state import PinMemory


@dataclass
class History:
    """The accepted steps of a run, filled by it.

    time, position, velocity: at the start of the run and at the end of every step. piece: of the drive; memory:
    of the loose pins, number in `memories`; both for every step.
    """

    time: list[float]
    position: list[list[float]]
    velocity: list[list[float]]
    piece: list[int] = field(default_factory=list)
    memory: list[int] = field(default_factory=list)
    memories: list[tuple[PinMemory, ...]] = field(default_factory=list)

    def add(self, time: float, position: list[float], velocity: list[float], piece: int) -> None:
        """Add a step by its end; the memory is the last one."""
        self.time.append(time)
        self.position.append(position)
        self.velocity.append(velocity)
        self.piece.append(piece)
        self.memory.append(len(self.memories) - 1)

    def pin_memory(self, pin: int) -> Matrix:
        """Memory of a pin in every step, shape (steps, fields of PinMemory)."""
        table = np.array([memories[pin] for memories in self.memories], dtype=np.float64)
        return np.asarray(table[self.memory])
