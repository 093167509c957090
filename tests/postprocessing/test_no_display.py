"""Where no window can be opened, `view` says so in a sentence, whatever is missing."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from support_exudyn import Held, simulate
from support_exudyn.__main__ import main
from tests.cases.run_cases import support

if sys.platform != "linux":
    pytest.skip("the displays are of X11", allow_module_level=True)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    result = simulate(support(drive=Held(), duration=0.01))
    return result.save(tmp_path_factory.mktemp("run") / "held.h5")


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """For `view` in this process, in an empty folder; a window would be an error."""
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path / "empty")
    monkeypatch.delenv("EXUDYN_SUPPRESS_UI_WINDOW_OPEN", raising=False)

    def opened(*arguments: object) -> None:
        raise AssertionError

    monkeypatch.setattr("support_exudyn.postprocessing.viewer.view.Window", opened)
    return monkeypatch


def refused_here(run: Path, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["view", str(run)]) == 1
    said = capsys.readouterr().err
    assert said.startswith("error: ")
    assert list(Path().iterdir()) == []
    return said


def test_without_a_display_it_says_what_to_do(
    run: Path, here: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        here.delenv(name, raising=False)
    said = refused_here(run, capsys)
    assert "no display" in said
    assert "render RUN" in said
    assert "xvfb-run" in said
