"""`baseline make|check|update`: what is written, what is reported, and with which exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from support_exudyn import Failure, SimulationError
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing import baselines

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
FILES = {
    "scenes/slow.toml": SLOW,
    "scenes/fast.toml": SLOW.replace("= 60", "= 61"),
    "scenes/machine.toml": 'kind = "linkage"\n',
    "scenes/sizes.toml": 'scenario = "slow.toml"\n',
    "scenes/compare.toml": 'tolerances = { "tip.*" = "1 mm" }\n',
    "scenes/gauges.toml": '[instruments."canopy.tilt"]\ntype = "Inclinometer"\n',
    "broken/one.toml": "machine = ",
}


@pytest.fixture
def scenes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two scenarios, and one of each of the other files; a broken scenario; an empty folder."""
    monkeypatch.chdir(tmp_path)
    for folder in ("scenes", "broken", "empty"):
        (tmp_path / folder).mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, "utf-8")
    return tmp_path / "scenes"


def called(capsys: pytest.CaptureFixture[str], words: str) -> tuple[int, str, str]:
    """The exit code, and what was printed on standard output and standard error."""
    return main(["baseline", *words.split()]), *capsys.readouterr()


def kept(scenes: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in (scenes / "baseline").iterdir()}


def test_made_checked_changed_and_updated(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def check(words: str, code: int, *parts: str) -> None:
        printed = called(capsys, words)
        assert (printed[0], [part for part in parts if part not in "".join(printed[1:])]) == (code, [])

    check("make scenes", 0)
    first = kept(scenes)
    assert set(first) == {"slow.json", "fast.json"}
    check("check scenes", 0, "2 same")
    check("make scenes", 0, "left as they are: fast, slow")
    (scenes / "slow.toml").write_text(SLOW.replace("1e10", "1.001e10"), "utf-8")
    check("check scenes", 1, "changed by more than both errors, new, or gone", "stiffness", "1 same, 1 changed")
    check("update scenes", 1, "1 not written; to write one, name it: update scenes NAME")
    assert kept(scenes) == first
    check("update scenes slow", 0, " -> ")
    assert kept(scenes)["fast.json"] == first["fast.json"]
    check("check scenes", 0)
    (scenes / "slow.toml").rename(scenes / "third.toml")
    code, printed, _ = called(capsys, "check scenes --json")
    states = {name: each["state"] for name, each in json.loads(printed).items()}
    assert (code, states) == (1, {"fast": "same", "slow": "gone", "third": "new"})
    check("update scenes slow third", 0, "slow.json: removed")
    assert set(kept(scenes)) == {"fast.json", "third.json"}
    path = scenes / "baseline" / "fast.json"
    path.write_bytes(path.read_bytes()[:-100])
    check("check scenes", 2, "fast.json: is no baseline, or damaged")


def test_a_run_that_cannot_be_finished_or_is_interrupted(
    scenes: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate, runs = baselines.simulate, list[object]()

    def stopped(scenario: object, **more: object) -> object:
        runs.append(scenario)
        if len(runs) == 2:
            raise KeyboardInterrupt
        if len(runs) > 2:
            raise SimulationError(Failure("the journal is too deep", "take a stiffer contact", 0.1))
        return simulate(scenario, **more)  # type: ignore[call-overload]

    monkeypatch.setattr(baselines, "simulate", stopped)
    assert called(capsys, "make scenes")[0] == 130
    before = kept(scenes)
    assert set(before) == {"fast.json"}
    code, said, _ = called(capsys, "check scenes")
    assert (code, "slow: its run cannot be finished: " in said) == (1, True)
    assert called(capsys, "update scenes fast")[0] == 1
    code, _, err = called(capsys, "make scenes")
    assert (code, "slow: not made" in err, kept(scenes)) == (1, True, before)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("check nowhere", "nowhere: is no folder; allowed:"),
        ("check empty", "empty: has no scenario; allowed:"),
        ("check scenes slow", "check takes FOLDER alone; allowed:"),
        ("update scenes slwo", "slwo: no such scenario in scenes; allowed: fast, slow"),
        ("check broken", "broken"),
    ],
)
def test_a_wrong_input_ends_with_2_and_a_sentence(
    words: str, said: str, scenes: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, err = called(capsys, words)
    assert (code, out, err.startswith("error: "), said in err) == (2, "", True, True)
