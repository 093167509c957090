"""The growth of small motions, predicted and in runs; and the roots that a motion is made of."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies.common.options import Options
from studies.stability import motions as cases
from studies.stability import run as study
from studies.stability.motions import ALIKE, PinCase, all_scenarios, fastest, growth, prepared, roots
from support_exudyn import ClearancePin, Scenario, simulate
from tests.studies.forms import numbers_of


@pytest.mark.parametrize("growths", [(5.0, -30.0), (-2.0, -8.0), (400.0, -410.0)])
def test_the_roots_of_a_motion_made_of_two_vibrations_are_found(growths: tuple[float, float]) -> None:
    time = np.linspace(0.0, 0.02, 121)
    angles = (400.0, 290.0)
    motion = sum(
        np.exp(rate * time)[:, None] * np.column_stack([np.cos(w * time), share * np.sin(w * time + 0.4)])
        for rate, w, share in zip(growths, angles, (0.7, -1.4), strict=True)
    )
    found = roots(time, 1e-9 * motion)
    assert np.sort(found.real)[::2] == pytest.approx(np.sort(growths), rel=1e-6, abs=1e-4)
    assert np.unique(np.abs(found.imag).round(2)) == pytest.approx(np.sort(angles), rel=1e-4)
    leading = fastest(found)
    assert leading.real == pytest.approx(max(growths), rel=1e-6, abs=1e-4)


def measured(case: PinCase) -> float:
    """By how much the growth of a case in two runs is off, as a share; checks how fine its steps are."""
    one = prepared(case)
    runs = {name: simulate(scenario) for name, scenario in all_scenarios({case.name: one}).items()}
    found = growth(one, runs)
    assert found.by_steps < 0.02
    assert found.frequency == pytest.approx(one.predicted.frequency, rel=0.01)
    assert found.moved < 0.05  # small, so that the prediction can hold
    return found.off


@pytest.mark.parametrize(
    ("pin", "stiffness", "friction"),
    [
        *(("rear_base", stiffness, friction) for stiffness in cases.STIFFNESSES for friction in (0.05, 0.17)),
        ("rear_shield", "cylinders", 0.22),
        ("front_shield", "cylinders", 0.15),
        ("front_base", "cylinders", 0.4),
    ],
)
def test_a_pin_grows_or_decays_as_predicted(pin: str, stiffness: str, friction: float) -> None:
    assert measured(PinCase(pin, stiffness, friction)) < ALIKE


def drawn(seed: int) -> type[PinCase]:
    """Cases of another machine, clearance, bore, restitution and direction, as a generator draws them."""
    random = np.random.default_rng(seed)
    clearance, bore = float(random.uniform(0.3e-3, 2.5e-3)), float(random.uniform(0.04, 0.09))
    restitution, speed = float(random.uniform(0.6, 1.0)), float(random.choice([-1.0, 1.0]) * cases.SPEED)
    heavier, stroke = float(random.uniform(0.5, 3.0)), float(random.uniform(0.0, 0.5))

    class Drawn(PinCase):
        def clearance_pin(self) -> ClearancePin:
            usual = super().clearance_pin()
            return ClearancePin.simple(
                clearance=clearance,
                bore_radius=bore,
                restitution=restitution,
                friction=usual.contact.friction,
                **cases.STIFFNESSES[self.stiffness],
            )

        def scenario(self, duration: float = 0.1, step: float = 1e-3) -> Scenario:
            usual = super().scenario(duration, step)
            machine = usual.machine
            height = cases.reference_support().extended(stroke).hinge[1]
            parts = {
                body: tuple(
                    replace(part, mass=heavier * part.mass, inertia=heavier * part.inertia, moments=None)
                    for part in parts
                )
                for body, parts in machine.parts.items()
            }
            return replace(
                usual,
                machine=replace(machine, start_hinge_height=height, parts=parts),
                drive=replace(usual.drive, rate=speed),
                pins={self.pin: self.clearance_pin()},
            )

    return Drawn


@pytest.mark.parametrize("seed", range(6))
def test_drawn_scenes_grow_as_predicted(seed: int) -> None:
    random = np.random.default_rng(1000 + seed)
    stiffness = str(random.choice(list(cases.STIFFNESSES)))
    assert measured(drawn(seed)("rear_base", stiffness, float(random.uniform(0.03, 0.25)))) < ALIKE


@pytest.mark.slow
def test_the_whole_study(tmp_path: Path) -> None:
    chapter = study.Stability(Options(tmp_path, workers=2)).write()
    assert chapter.answer.startswith("Yes: in 48 cases")
    assert len([case for name, case in numbers_of(tmp_path) if name == "growth_rate"]) == 48
    assert all((tmp_path / f"{name}.png").is_file() for name in ("stability", "map"))
