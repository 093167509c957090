"""What commands do before anything else: interruptions while libraries are imported, small consoles."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.simulation.at_start import DEGRADED, be_readable
from tests.hostile import posix_only
from tests.processes import ROOT, environment

INTERRUPTING = """
import os, signal, sys
sys.path.remove({folder!r})
del sys.modules["{name}"]
os.kill(os.getpid(), signal.SIGINT)
import {name}
"""
SHOWING = ["-m", "support_exudyn", "show", "--help"]  # which needs libraries; --version does not
STARTS = [["-m", "support_exudyn", "--version"], ["-m", "studies", "--help"]]


def started(words: list[str], folder: Path, more: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """A command; the installed one as pip writes it."""
    if words[0] == "support-exudyn":
        script = folder / "support-exudyn"
        script.write_text("import sys\nfrom support_exudyn.__main__ import main\nsys.exit(main())\n", "utf-8")
        words = [str(script), *words[1:]]
    known = environment() | more
    known["PYTHONPATH"] = os.pathsep.join([more.get("PYTHONPATH", ""), known["PYTHONPATH"], str(ROOT)])
    return subprocess.run(
        [sys.executable, *words], cwd=ROOT, env=known, capture_output=True, text=True, timeout=120, check=False
    )


@posix_only
@pytest.mark.parametrize("words", [SHOWING, ["support-exudyn", *SHOWING[2:]]], ids=lambda words: words[1])
def test_an_interruption_while_libraries_are_imported_is_a_line(tmp_path: Path, words: list[str]) -> None:
    name = "numpy"
    (tmp_path / f"{name}.py").write_text(INTERRUPTING.format(folder=str(tmp_path), name=name), "utf-8")
    done = started(words, tmp_path, {"PYTHONPATH": str(tmp_path)})
    assert (done.returncode, done.stderr) == (130, "interrupted; nothing half-written is left\n")
    assert done.stdout == ""


@pytest.mark.parametrize(
    ("encoding", "shown"),
    [
        ("ascii", "5 +- 1 m/s^2, 3 A, 4 * 2 -> 1, \\u4e2d"),
        ("cp932", "5 ± 1 m/s^2, 3 A, 4 * 2 → 1, 中"),
        ("gbk", "5 ± 1 m/s^2, 3 A, 4 · 2 → 1, 中"),
        ("utf-8", "5 ± 1 m/s², 3 Å, 4 · 2 → 1, 中"),
    ],
)
def test_letters_that_a_console_has_not_are_written_in_others(
    encoding: str, shown: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    console = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr(sys, "stdout", console)
    be_readable()
    assert console.errors == DEGRADED
    print("5 ± 1 m/s², 3 Å, 4 · 2 → 1, 中", end="", flush=True)
    assert console.buffer.getvalue().decode(encoding) == shown  # type: ignore[attr-defined]


@pytest.mark.parametrize("words", STARTS, ids=lambda words: words[1])
def test_commands_speak_on_the_poorest_console(tmp_path: Path, words: list[str]) -> None:
    done = started(words, tmp_path, {"PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout
