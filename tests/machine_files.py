"""A four-column support that does not come with the package, as somebody writes it from a pivot table."""

from __future__ import annotations

from pathlib import Path

PIVOTS = """
rear_base = [0, 380]
front_base = [560, 700]
rear_shield = [-690, 1330]
front_shield = [-420, 1560]
hinge = [520, 2500]
front_foot = [2050, 260]
front_head = [2300, 2480]
rear_foot = [1150, 230]
rear_head = [1150, 2470]
tip = [3900, 2650]
"""
MASSES = """
rear_link = 900
front_link = 700
shield = 4200
canopy = 5200
front_column_rods = 350
rear_column_rods = 350
"""
OURS = f"""
kind = "four_column_support"
name = "a support of ours"
start_hinge_height_mm = 2050
stroke_mm = 600

[pivots_mm]
{PIVOTS}
[masses_kg]
{MASSES}
"""


def written(folder: Path, old: str = "", new: str = "", text: str = OURS) -> Path:
    """The file with one thing changed."""
    assert old in text
    path = folder / "ours.toml"
    path.write_text(text.replace(old, new, 1) if old else text, encoding="utf-8")
    return path
