"""Figures with a counterpart in the paper name it in their captions."""

from __future__ import annotations

import re

import pytest

from studies.clearance_influence import run as clearance_influence
from studies.clearance_size import figures as clearance_size_figures
from studies.common.chapter import Picture
from studies.drive_mode import figures as drive_mode_figures

PICTURES = (
    *clearance_influence._pictures(),
    *clearance_size_figures.pictures(),
    *drive_mode_figures.pictures(),
)
COUNTERPARTS = [picture for picture in PICTURES if picture.stem.startswith("fig")]


def test_all_figures_of_the_papers_results_have_a_counterpart() -> None:
    numbers = {int(re.match(r"fig(\d+)_", picture.stem).group(1)) for picture in COUNTERPARTS}
    assert numbers == {3, 4, 5, 6, 7, 8, 9, 10, 11, 13}  # 1, 2 and 12 are sketches


@pytest.mark.parametrize("picture", COUNTERPARTS, ids=lambda picture: picture.stem)
def test_a_caption_names_the_papers_figure(picture: Picture) -> None:
    number = re.match(r"fig(\d+)_", picture.stem).group(1)
    assert f"Counterpart of the paper's Fig. {number}" in " ".join(picture.caption.split())
