"""What the README shows works as it stands there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

README = Path(__file__).parents[2] / "README.md"


def said(number: int, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """Lines that the README's example of this number prints."""
    found = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert len(found) == 2
    exec(compile(found[number], "README.md", "exec"), {})
    return capsys.readouterr().out.splitlines()


def test_the_run_to_an_accuracy_says_what_stands_there(capsys: pytest.CaptureFixture[str]) -> None:
    mean, highest, met = said(0, capsys)
    assert mean.startswith("51503.8307 ± ")
    assert mean.endswith(" N")
    assert highest.startswith("3.21586532 ± ")
    assert met == "True"


def test_the_example_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = said(1, capsys)
    assert float(lines[0].split()[0]) > 58000.0  # the static force in the low posture
    assert float(lines[1].split()[0]) < 1e-3
    assert (tmp_path / "pin_1mm.h5").stat().st_size > 0


def test_the_picture_is_there() -> None:
    text = README.read_text(encoding="utf-8")
    for picture in re.findall(r"!\[.*?\]\((.*?)\)", text):
        assert (README.parent / picture).is_file()
