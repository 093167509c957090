"""A jump of velocities."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Impulse:
    """A jump of velocities.

    time: [s]. columns: impulse of each rigid column [N s], positive in compression. energy: given to the bodies
    by it [J]. cranks: angular impulse on each crank [N m s].
    """

    time: float
    columns: dict[str, float]
    energy: float
    cranks: dict[str, float] = field(default_factory=dict)
