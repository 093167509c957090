"""Where on a frame everything stands."""

from __future__ import annotations

from dataclasses import dataclass

Box = tuple[int, int, int, int]  # left, top, right, bottom [pixels]


@dataclass(frozen=True)
class Layout:
    """Of a frame: a line on top, the machine, a panel on the right of it, and force over time below.

    Arguments:
        width, height: of the frame [pixels].
        has_panel: whether there is a pin to show.
    """

    width: int
    height: int
    has_panel: bool

    @property
    def unit(self) -> float:
        """By what lengths of a frame of 1280 x 720 are multiplied."""
        return min(self.width / 1280, self.height / 720)

    @property
    def margin(self) -> int:
        """Around everything."""
        return max(2, round(14 * self.unit))

    @property
    def line(self) -> Box:
        """On top: what is shown, and when."""
        return self.margin, 0, self.width - self.margin, round(48 * self.unit)

    @property
    def panel(self) -> Box:
        """On the right."""
        left = self.width - self.margin - (round(286 * self.unit) if self.has_panel else 0)
        return left, self.line[3], self.width - self.margin, self.picture[3]

    @property
    def picture(self) -> Box:
        """Of the machine."""
        right = self.width - (round(286 * self.unit) + 2 * self.margin if self.has_panel else 0)
        bottom = self.height - (round(142 * self.unit) if self.has_panel else 0)
        return 0, self.line[3], right, bottom

    @property
    def strip(self) -> Box:
        """Axes of the force over time."""
        top = self.picture[3] + round(28 * self.unit)
        left = self.margin + round(58 * self.unit)
        return left, top, self.width - 2 * self.margin, self.height - round(30 * self.unit)
