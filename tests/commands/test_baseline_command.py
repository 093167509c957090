"""`baseline make|check|update`: what is written, what is told, and with which exit codes."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing import baselines as folders

SLOW = """\
machine = "crank_rocker"
duration_s = 0.004
record_period_s = 0.0002
accuracy = "standard"
[drives.crank]
type = "Steady"
rate_rad_per_s = 60
[pins.B]
clearance_mm = 0.5
friction = 0.1
restitution = 0.8
law = "LankaraniNikravesh"
stiffness_N_per_m_to_n = 1e10
"""
FAST = SLOW.replace("= 60", "= 61")


@pytest.fixture
def scenes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two scenarios, and one of each of the other files."""
    monkeypatch.chdir(tmp_path)
    place = tmp_path / "scenes"
    place.mkdir()
    (place / "slow.toml").write_text(SLOW, "utf-8")
    (place / "fast.toml").write_text(FAST, "utf-8")
    (place / "machine.toml").write_text('kind = "linkage"\n', "utf-8")
    (place / "sizes.toml").write_text('scenario = "slow.toml"\n', "utf-8")
    (place / "compare.toml").write_text('tolerances = { "tip.*" = "1 mm" }\n', "utf-8")
    (place / "gauges.toml").write_text('[instruments."canopy.tilt"]\ntype = "Inclinometer"\n', "utf-8")
    return place


class Said(str):
    """What a command printed on standard output; err: on standard error."""

    err: str


def called(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, Said]:
    try:
        code = main(["baseline", *words])
    except SystemExit as ended:
        code = int(ended.code or 0)
    out, err = capsys.readouterr()
    said = Said(out)
    said.err = err
    return code, said


def kept(scenes: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in (scenes / "baseline").iterdir()}


def test_made_checked_changed_and_updated(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, said = called(capsys, "make", "scenes")
    assert (code, set(kept(scenes))) == (0, {"slow.json", "fast.json"})
    assert "scenes/baseline/slow.json: " in said.replace("\\", "/")
    assert "2 impacts" in said
    first = kept(scenes)
    code, said = called(capsys, "check", "scenes")
    assert (code, said.splitlines()[-1]) == (0, "2 same")
    assert "slow: nothing changed (" in said
    # made once more, nothing is written
    code, said = called(capsys, "make", "scenes")
    assert (code, kept(scenes)) == (0, first)
    assert "left as they are: fast, slow" in said

    (scenes / "slow.toml").write_text(SLOW.replace("1e10", "1.001e10"), "utf-8")
    code, said = called(capsys, "check", "scenes")
    assert code == 1
    assert "changed by more than both errors, new, or gone" in said
    assert "stiffness" in said
    assert "1 same, 1 changed" in said
    assert kept(scenes) == first
    # without a name nothing is written where nobody can be asked
    code, said = called(capsys, "update", "scenes")
    assert (code, kept(scenes)) == (1, first)
    assert "1 not written; to write one, name it: update scenes NAME" in said.err
    code, said = called(capsys, "update", "scenes", "slow", "--reason", "stiffer")
    assert code == 0
    assert " -> " in said
    after = kept(scenes)
    assert (after["fast.json"] == first["fast.json"], after["slow.json"] == first["slow.json"]) == (True, False)
    history = json.loads(after["slow.json"])["history"]
    assert [one.get("reason") for one in history] == [None, "stiffer"]
    assert called(capsys, "check", "scenes")[0] == 0


def test_new_and_gone_scenarios_are_told(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    called(capsys, "make", "scenes")
    (scenes / "slow.toml").rename(scenes / "third.toml")
    code, said = called(capsys, "check", "scenes", "--json")
    assert code == 1
    assert {name: one["state"] for name, one in json.loads(said).items()} == {
        "fast": "same", "slow": "gone", "third": "new"
    }  # fmt: skip
    code, said = called(capsys, "update", "scenes", "slow", "third")
    assert (code, set(kept(scenes))) == (0, {"fast.json", "third.json"})
    assert "slow.json: removed" in said


@pytest.mark.parametrize(("answer", "written"), [("y\n", True), ("n\n", False), ("", False)])
def test_update_asks(
    answer: str,
    written: bool,
    scenes: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (scenes / "fast.toml").unlink()

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setattr("sys.stdin", Terminal(answer))
    code, _ = called(capsys, "update", "scenes")
    assert (code, (scenes / "baseline" / "slow.json").exists()) == (0 if written else 1, written)


def test_a_run_that_cannot_be_finished_is_told(
    scenes: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from support_exudyn import Failure, SimulationError

    (scenes / "fast.toml").unlink()
    called(capsys, "make", "scenes")
    before = kept(scenes)

    def fails(*given: object, **more: object) -> None:
        raise SimulationError(Failure("the journal is too deep", "take a stiffer contact", 0.1))

    monkeypatch.setattr(folders, "simulate", fails)
    code, said = called(capsys, "check", "scenes")
    assert code == 1
    assert "slow: its run cannot be finished: " in said
    assert called(capsys, "update", "scenes", "slow")[0] == 1
    assert kept(scenes) == before
    (scenes / "baseline" / "slow.json").unlink()
    code, said = called(capsys, "make", "scenes")
    assert (code, kept(scenes)) == (1, {})
    assert "slow: not made" in said.err


def test_an_interruption_leaves_whole_files(
    scenes: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate, runs = folders.simulate, []

    def interrupted(scenario: object, **more: object) -> object:
        runs.append(scenario)
        if len(runs) == 2:
            raise KeyboardInterrupt
        return simulate(scenario, **more)  # type: ignore[call-overload]

    monkeypatch.setattr(folders, "simulate", interrupted)
    assert called(capsys, "make", "scenes")[0] == 130
    assert set(kept(scenes)) == {"fast.json"}
    monkeypatch.undo()
    monkeypatch.chdir(scenes.parent)
    assert called(capsys, "make", "scenes")[0] == 0
    assert called(capsys, "check", "scenes")[0] == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("check", "nowhere"), "nowhere: is no folder; allowed:"),
        (("check", "empty"), "empty: has no scenario; allowed:"),
        (("check", "scenes", "slow"), "check takes DIR alone; allowed:"),
        (("make", "scenes", "--reason", "x"), "make takes DIR alone; allowed:"),
        (("update", "scenes", "slwo"), "slwo: no such scenario in scenes; allowed: fast, slow"),
        (("check", "broken"), "broken"),
    ],
)
def test_a_wrong_input_ends_with_2_and_a_sentence(
    words: tuple[str, ...], said: str, scenes: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (scenes.parent / "empty").mkdir()
    (scenes.parent / "broken").mkdir()
    (scenes.parent / "broken" / "one.toml").write_text("machine = ", "utf-8")
    code, told = called(capsys, *words)
    assert (code, str(told)) == (2, "")
    assert told.err.startswith("error: ")
    assert said in told.err


def test_a_damaged_baseline_ends_with_2(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (scenes / "fast.toml").unlink()
    called(capsys, "make", "scenes")
    path = scenes / "baseline" / "slow.json"
    path.write_bytes(path.read_bytes()[:-100])
    for words in (("check", "scenes"), ("update", "scenes", "slow")):
        code, said = called(capsys, *words)
        assert code == 2
        assert "slow.json: is no baseline, damaged, or changed by hand" in said.err
        assert "take it from version control" in said.err
