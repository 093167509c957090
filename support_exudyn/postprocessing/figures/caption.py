"""Words below a figure: what is drawn, and what it cannot show."""

from __future__ import annotations

import textwrap

from matplotlib.figure import Figure

SIZE = 7  # points
LETTER_MM = 1.3  # width of one at that size, of a line that has many wide ones


def caption(drawing: Figure, text: str) -> None:
    """Write a text below all panels, in lines as long as the figure is wide."""
    width_mm = 25.4 * float(drawing.get_figwidth())
    lines = textwrap.fill(text, int((width_mm - 6.0) / LETTER_MM))
    drawing.supxlabel(lines, fontsize=SIZE, x=0.01, ha="left", linespacing=1.3)
