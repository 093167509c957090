"""Figures with a counterpart in the paper name it in their captions."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import studies
from studies.common.words import TEMPLATE

FIGURE = re.compile(r"^- fig(\d+)_\w+: (.+?)(?=^- |^$)", re.MULTILINE | re.DOTALL)
TEMPLATES = (Path(studies.__path__[0]) / name / TEMPLATE for name in (
    "clearance_influence", "clearance_size", "drive_mode",
))  # fmt: skip
COUNTERPARTS = [found for path in TEMPLATES for found in FIGURE.findall(path.read_text(encoding="utf-8"))]


def test_all_figures_of_the_papers_results_have_a_counterpart() -> None:
    numbers = {int(number) for number, _ in COUNTERPARTS}
    assert numbers == {3, 4, 5, 6, 7, 8, 9, 10, 11, 13}  # 1, 2 and 12 are sketches


@pytest.mark.parametrize(("number", "caption"), COUNTERPARTS)
def test_a_caption_names_the_papers_figure(number: str, caption: str) -> None:
    assert re.search(
        rf"[Pp]aper: Fig\. {number}\b|Counterpart of the paper's Fig\. {number}\b", " ".join(caption.split())
    )
