"""How a planar machine extends across its plane: what the spatial model needs besides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from user_forces.values.units import Metres
from user_forces.values.value import NonNegative, Positive, Value, value


@value
class Width(Value):
    """Lateral dimensions of a machine that is symmetric about its plane.

    Arguments:
        spreads: by body, the radius of gyration about the plane of symmetry [m] (of a body of uniform width b:
            b / sqrt(12)); of a body that there are two of, about the plane of each. 0 where none is given.
        pairs: by body, half the distance [m] of the two that it stands for in the plane.
        columns: by column, half the distance [m] of the two that it stands for.
        lengths: by pin, its length [m]; of a pin of a pair, of each. 0 where none is given.
        points: by traced point, half the distance [m] of two more of it, left and right.
    """

    spreads: Mapping[str, Metres[NonNegative]] = field(default_factory=dict)
    pairs: Mapping[str, Metres[Positive]] = field(default_factory=dict)
    columns: Mapping[str, Metres[Positive]] = field(default_factory=dict)
    lengths: Mapping[str, Metres[Positive]] = field(default_factory=dict)
    points: Mapping[str, Metres[Positive]] = field(default_factory=dict)

    def scaled(self, factor: float) -> Width:
        """The same machine larger by a factor."""

        def larger(lengths: Mapping[str, float]) -> dict[str, float]:
            return {name: factor * length for name, length in lengths.items()}

        return Width(
            spreads=larger(self.spreads),
            pairs=larger(self.pairs),
            columns=larger(self.columns),
            lengths=larger(self.lengths),
            points=larger(self.points),
        )
