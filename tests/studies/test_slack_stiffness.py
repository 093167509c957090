"""Slack of a canopy by loops and by virtual work, on made-up loops and on a support."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from studies.common.options import Options
from studies.common.support_legs import support
from studies.slack_stiffness import run as study
from studies.slack_stiffness.run import FRICTION, Loop, PushedSupport, pin_shares
from support_exudyn import simulate

CASE = PushedSupport("reference", 0.5, 0.3, FRICTION)
SLACK, STIFFNESS, LEAN = 0.012, 2e8, -3e6


@dataclass(frozen=True)
class MadeUp:
    """Records of a support with this slack, this stiffness beyond it, and legs that lean on."""

    case: PushedSupport

    @property
    def time(self) -> npt.NDArray[np.float64]:
        return np.linspace(0.0, self.case.time(5), 4001)

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        knots = [0.0, *(self.case.time(n) for n in (0, 1, 3, 5))]
        push = self.case.push * np.interp(self.time, knots, [0.0, 0.0, 1.0, -1.0, 1.0])
        turn = np.where(np.abs(push) < 0.1 * self.case.push, 0.0, np.sign(push))
        shift = push / STIFFNESS + 0.5 * SLACK * turn
        found = {
            "push.force_x": push,
            "canopy.x": 3.0 + shift,
            "front_column.force": -LEAN * shift,
        }
        return found.get(name, np.zeros_like(push))


def test_what_a_made_up_loop_consists_of_is_found() -> None:
    loop = Loop(CASE, MadeUp(CASE)).measures()
    assert loop["slack"] == pytest.approx(1e3 * SLACK, rel=1e-6)
    assert loop["beyond"] == pytest.approx(1e-6 * STIFFNESS, rel=1e-6)
    assert loop["within"] == pytest.approx(1e-6 * LEAN, rel=1e-6)
    moved = SLACK + 2.0 * CASE.push / STIFFNESS
    assert loop["whole"] == pytest.approx(2e-6 * CASE.push / moved, rel=1e-3)
    assert loop["leg_share"] == pytest.approx(LEAN * moved / (2.0 * CASE.push), rel=1e-3)


@pytest.mark.slow  # a support is pushed slowly
def test_the_slack_of_a_support_is_that_of_virtual_work() -> None:
    ideal = replace(CASE, clearance_mm=0.0, friction=0.0)
    shares = pin_shares(ideal, simulate(replace(ideal.scenario(), accuracy=None)))
    loop = Loop(CASE, simulate(replace(CASE.scenario(), accuracy=None))).measures()
    assert loop["slack"] == pytest.approx(2.0 * CASE.clearance_mm * sum(shares.values()), rel=0.04)
    # the legs alone, of nearly one length, are a parallelogram that a load on it tips
    machine = support("reference")
    lengths = machine.column_lengths(machine.start())
    weight = 9.81 * sum(body.mass for body in machine.linkage().bodies.values())
    assert 1e6 * loop["within"] == pytest.approx(-(CASE.roof_load + 0.5 * weight) / np.mean(lengths), rel=0.1)


@pytest.mark.slow
def test_pushed_faster_the_study_makes_a_chapter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        PushedSupport, "time", lambda case, quarters: study.BEGIN + 0.1 * quarters * case.quarter
    )
    chapter = study.SlackStiffness(Options(out=tmp_path, workers=2)).write()
    assert (tmp_path / "loops.png").is_file()
    assert not any(text.strip() == "" for text in (chapter.answer, *chapter.findings))
