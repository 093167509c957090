"""The study of published cases: its sources are read right, ours are near them; slow: every number of it."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import fsolve

from studies.common.options import Options
from studies.outside import run as study
from studies.outside.computed_torque import torque
from studies.outside.sources import SCENES, cases, compared, hinge
from support_exudyn import simulate
from tests.at_once import at_once

# of the reference file of Siconos's example, its last but seven columns: crank, its rate, time, and torque
SICONOS = [
    (1.570823772407980, 0.0, 0.0, -30.34444553866433),
    (1.667922928591141, 4.395065412241380, 0.05, 189.7939140287401),
    (1.985176417328212, 7.926083177617856, 0.10, 83.62724726794308),
    (5.545612442795652, 5.285048107783350, 0.50, -46.57220331844870),
]


@pytest.mark.parametrize(("crank", "rate", "time", "known"), SICONOS)
def test_the_torque_is_that_of_the_example(crank: float, rate: float, time: float, known: float) -> None:
    # the example writes pi in nine digits
    assert torque(crank, rate, time) == pytest.approx(known, rel=1e-5)


@pytest.mark.parametrize("name", ["crank_rocker", "watt_six_bar"])
def test_ideal_cases_are_met(name: str) -> None:
    fine, coarse = simulate(SCENES[name]().refined()), simulate(SCENES[name]())
    mine = [case for case in cases().values() if case.scene == name]
    assert mine
    for case in mine:
        found = compared(case, fine, coarse)
        assert [one.what for one in found if not one.met] == []


def newton_runs(distances: Sequence[float]) -> dict[str, Any]:
    """Runs that stand so far from Newton's impacts [rad], at steps and at half of them."""
    time = np.linspace(0.0, study.AT, 3)
    return {
        scene + fine: {"crank.angle": np.full(3, study.LIMIT - off)} | {"time": time}
        for scene, off in zip(study.STIFFER.values(), distances, strict=True)
        for fine in ("", study.FINE)
    }


@pytest.mark.parametrize(
    ("distances", "met"),
    [
        ((7.5e-5, 1.1e-5, 1.8e-6), [True, True, True]),
        ((3e-4, 1.1e-5, 1.8e-6), [False, True, True]),
        ((7.5e-5, 1.1e-5, 1.1e-5), [True, True, False]),
    ],
)
def test_each_stiffness_has_to_come_as_near_to_newton_as_the_source_tells(
    distances: Sequence[float], met: list[bool], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(study, "crank_at", lambda run: float(run["crank.angle"][-1]))
    assert [one.met for one in study.newton_rows(newton_runs(distances))[:3]] == met


def test_circles_close() -> None:
    # the triangle of the beam closes with the side that the circles do not ask for, a6
    angle = 2.6
    c = 1e3 * complex(*hinge(np.array([angle]))[:, 0])
    e = 640j + 1360.0 * complex(math.cos(angle), math.sin(angle))
    b = 640j - 674.0 * complex(510.0, 440.0) / math.hypot(510.0, 440.0)
    assert abs(c - e) == pytest.approx(1427.70, rel=1e-12)

    def closes(place: np.ndarray) -> list[float]:
        d = complex(*place)
        return [abs(d - b) - 1310.0, abs(d - e) - 382.0]

    d = complex(*fsolve(closes, [e.real - 300.0, e.imag - 250.0]))
    assert abs(d - c) == pytest.approx(1809.68, abs=0.01)


@pytest.mark.slow
def test_every_number_is_met(tmp_path: Path) -> None:
    chapter = study.Outside(Options(tmp_path, at_once())).write()
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert len(summary["numbers"]) > 90
    assert chapter.answer.startswith("Yes: ")
    (sheet,) = (one for one in chapter.sheets if one.name == "table_cases")
    assert [row[-1] for row in sheet.rows] == ["met"] * len(cases())
