from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from studies import readme_pictures
from studies.clearance import figures
from studies.common.paper_machine import clearance_rise
from studies.readme_pictures import FOLDER, PICTURES, main
from support_exudyn import simulate
from tests.pages import links, pages

OF_EXAMPLES = ("own_exudyn_model.png",)  # that examples of the same name make
QUICK = ("machine.png", "journal_orbit.png", "spectrum.png")  # rest: many runs, or a movie


def test_the_pages_show_what_is_made() -> None:
    shown = [link.rpartition("/")[2] for page in pages() for link in links(page) if "studies/pictures/" in link]
    made = sorted([*PICTURES, *OF_EXAMPLES])
    assert sorted(shown) == made
    assert sorted(path.name for path in FOLDER.iterdir()) == made


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_can_be_opened(name: str) -> None:
    with Image.open(FOLDER / name) as picture:
        assert picture.width >= 600
        assert getattr(picture, "n_frames", 1) == (26 if name.endswith(".gif") else 1)


@pytest.mark.slow
def test_pictures_are_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from dataclasses import replace

    short = simulate(replace(clearance_rise(1.5, 0.25, 5e-4), duration=0.1))
    monkeypatch.setattr(readme_pictures, "paper", lambda: {figures.DRY: short})
    # in place of 3 to 5 s and of 4 s, which a short run has not
    monkeypatch.setattr(readme_pictures, "MIDDLE", 0.05)
    monkeypatch.setattr(readme_pictures, "RISE", (0.0, 0.1))
    assert main([*QUICK, "--out", str(tmp_path)]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(QUICK)
