"""The page on runs: what stands on it, what is refused, and how it behaves in a browser."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from support_exudyn import simulate
from support_exudyn.__main__ import main
from tests.cases.run_cases import loose_slider_crank, loose_support, support


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of three short runs: a clearance pin with an accuracy, ideal pins, a slider-crank."""
    folder = tmp_path_factory.mktemp("runs")
    simulate(loose_support(1.5, 0.25, duration=0.05), accuracy="draft").save(folder / "loose.h5")
    simulate(support(duration=0.05)).save(folder / "ideal.h5")
    crank = loose_slider_crank(0.005, formulation="compiled", record_period=5e-5)
    simulate(crank).save(folder / "crank.h5")
    return folder


@pytest.fixture(scope="module")
def page(runs: Path) -> Path:
    """The page of two of them."""
    out = runs / "both.html"
    assert main(["report", str(runs / "ideal.h5"), str(runs / "loose.h5"), "--out", str(out)]) == 0
    return out


def test_the_page_has_all_its_parts_and_loads_nothing(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert len(text) < 5_000_000
    assert "<title>Runs ideal, loose</title>" in text
    for said in (
        "clearance in rear_base", "pin.rear_base.force.mean", "CubicStep (stroke 0.5", "formulation",
        "wall time", "exudyn 1.", "Run loose when the force in rear_base is largest",
        "estimated numerical error",
    ):  # fmt: skip
        assert said in text, said
    elements = re.sub(r"(?s)<script.*?</script>", "", text)
    for outside in re.findall(r'(?:src|href)="([^"]*)"', elements):
        assert outside.startswith(("data:", "#")), outside
    assert "pin.rear_base.depth [" in text
    assert "tip.x [mm]" in text
    assert elements.count("data:image/png") == 3  # machine, print of the channels, still


def test_a_folder_takes_report_html_and_scripts_are_told_where(
    runs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def none(*_: object, **__: object) -> None:
        raise RuntimeError("no renderer on this machine")

    monkeypatch.setattr("support_exudyn.postprocessing.render.still", none)
    assert main(["report", str(runs / "ideal.h5"), "--out", str(tmp_path / "new"), "--json"]) == 0
    path = tmp_path / "new" / "report.html"
    assert json.loads(capsys.readouterr().out) == {"report": str(path)}
    text = path.read_text(encoding="utf-8")
    assert "There is no rendered picture: no renderer on this machine" in text
    assert "Numerical errors are not known" in text


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["ideal.h5", "ideal.h5"], "is given twice"),
        (["ideal.h5", "pin.middle.force"], "no such channel"),
        (["ideal.h5", "*"], r"channels to draw over time; allowed: 1 to 24"),
        (["none.h5"], "none.h5"),
    ],
)
def test_what_cannot_be_is_said_in_a_line(
    runs: Path, words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    given = [str(runs / word) if word.endswith(".h5") else word for word in words]
    assert main(["report", *given]) == 1
    error = capsys.readouterr().err
    assert re.search(told, error)
    assert len(error.splitlines()) == 1


# --- in a browser ---
