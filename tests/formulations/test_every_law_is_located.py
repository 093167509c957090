"""Impacts are located in time under every law, whatever the grid of steps."""

from __future__ import annotations

from dataclasses import replace

import pytest

from studies.contact_laws import catalogue
from support_exudyn import ClearancePin, Held, Result, SolverSettings, simulate
from tests.cases.run_cases import PIN, loose_support, paper_contact
from user_forces import FrictionLaw, NormalLaw

# free fall through the clearance, by the independent integrator: it does not depend on the law
TIME, SPEED = 0.01744754, 0.17192479  # [s], [m/s]


def drop(step: float, **laws: NormalLaw | FrictionLaw) -> Result:
    """The journal falls from the middle of its bore and impacts twice."""
    pin = ClearancePin(contact=replace(paper_contact(1.5, 0.0), **laws))
    settings = SolverSettings(impact_steps=100)
    base = loose_support(drive=Held(), duration=0.042, step=step, solver=settings)
    return simulate(replace(base, pins={PIN: pin}))


LAWS = {
    **{name: {"normal": law} for name, law in catalogue.normal_laws(1.5, 0.9).items()},
    **{name: {"friction": law} for name, law in catalogue.friction_laws(0.25).items()},
}


@pytest.mark.parametrize("name", LAWS)
def test_impacts_do_not_depend_on_the_step(name: str) -> None:
    coarse, fine = (drop(step, **LAWS[name]) for step in (1e-3, 2.3e-4))
    for result in (coarse, fine):
        first = result.onsets[PIN][0]
        # flight is right to the fourth order of a step of a millisecond
        assert first.time == pytest.approx(TIME, abs=2e-8)
        assert first.speed == pytest.approx(SPEED, rel=1e-7)
        assert result.counts.cut_steps >= 1
    assert len(coarse.onsets[PIN]) == len(fine.onsets[PIN]) >= 1
    for one, other in zip(coarse.onsets[PIN], fine.onsets[PIN], strict=True):
        # the impact between them has the same number of steps, the grid cuts one of them elsewhere
        assert one.time == pytest.approx(other.time, abs=1e-7)
        assert one.speed == pytest.approx(other.speed, rel=1e-4)
