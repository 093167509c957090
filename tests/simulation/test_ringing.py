"""Steps with which a loaded contact rings on."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import ClearancePin, Held, Scenario, SolverSettings, simulate
from support_exudyn.scenario.timescales import loaded_contacts
from support_exudyn.simulation.contact_ringing import (
    FASTEST,
    GONE,
    KEPT,
    numerical_damping,
    ringing_step,
    vibrations,
)
from tests.cases.run_cases import paper_contact, support
from user_forces import Frictionless, KelvinVoigt, LankaraniNikravesh, NormalLaw
from user_forces.normal.hysteresis import REST_VELOCITY

PIN = "rear_base"
GAP = 1e-6  # [m]: across the load a journal then swings ten times as fast as along it


def narrow(normal: NormalLaw | None = None, duration: float = 3.0, clearance: float = GAP) -> Scenario:
    """The support held, its rear pin with clearance by next to nothing, without friction."""
    contact = paper_contact(1.5, 0.0)
    law = LankaraniNikravesh(restitution=0.9, stiffness=2.7e10, exponent=1.5) if normal is None else normal
    bearing = replace(contact.bearing, clearance=clearance)
    contact = replace(contact, bearing=bearing, normal=law, friction=Frictionless())
    return support(
        pins={PIN: ClearancePin(contact=contact)}, drive=Held(), duration=duration, record_period=1e-3
    )


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("phase", [0.05, 0.5, 2.0])
def test_numerical_damping_is_that_of_the_recursion(radius: float, phase: float) -> None:
    # generalised alpha of x'' = -x, in the form of its authors
    m, f = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
    gamma, beta = 0.5 - m + f, 0.25 * (1.0 - m + f) ** 2
    x, v, a = 1.0, 0.0, -1.0
    sizes = []
    for _ in range(4000):
        known_x = x + phase * v + phase**2 * (0.5 - beta) * a
        known_v = v + phase * (1.0 - gamma) * a
        new = -(m * a + f * x + (1.0 - f) * known_x) / (1.0 - m + (1.0 - f) * beta * phase**2)
        x, v, a = known_x + beta * phase**2 * new, known_v + gamma * phase * new, new
        sizes.append(math.hypot(x, v))
        if sizes[-1] < 1e-200:
            break
    half = len(sizes) // 2
    turn = max(10, len(sizes) // 10)
    before, after = max(sizes[half - turn : half]), max(sizes[-turn:])
    measured = math.log(before / after) / (phase * (len(sizes) - half))
    assert numerical_damping(phase, radius) == pytest.approx(measured, rel=0.05)


def test_along_the_load_a_contact_vibrates_as_its_law_is_stiff_and_across_it_like_a_pendulum() -> None:
    stiffness, damping = 1e9, 1e5
    (contact,) = loaded_contacts(narrow(KelvinVoigt(stiffness=stiffness, damping=damping)))[:1]
    free = contact._replace(inverse_mass=np.eye(2) / 300.0, mass=300.0)  # the same in all directions
    across, along = sorted(vibrations(free), key=lambda found: found.fall)
    fall = 0.5 * damping / 300.0
    assert along.fall == pytest.approx(fall, rel=1e-3)
    assert along.time == pytest.approx(1.0 / math.sqrt(stiffness / 300.0 - fall**2), rel=1e-3)
    assert across.fall == pytest.approx(0.0, abs=1e-6)
    assert across.time == pytest.approx(math.sqrt(300.0 * (GAP + free.load / stiffness) / free.load), rel=1e-3)


def test_the_last_of_three_runs_leaves_what_rings() -> None:
    scene = narrow()
    contacts = [found for contact in loaded_contacts(scene) for found in vibrations(contact)]
    step = 0.25 * ringing_step(scene)
    lost = [
        min(scene.duration, GONE / found.fall)
        / found.time
        * numerical_damping(step / found.time, scene.solver.spectral_radius)
        for found in contacts
    ]
    assert max(lost) == pytest.approx(KEPT, rel=1e-3)
    # what the steps damp less may have longer ones, and what has longer to last has shorter ones
    less = replace(scene, solver=SolverSettings(spectral_radius=0.9))
    assert ringing_step(less) > 3.0 * ringing_step(scene)
    assert ringing_step(replace(scene, duration=0.1)) > 2.0 * ringing_step(scene)


@pytest.mark.slow
def test_what_is_left_of_a_fall_rings_as_told() -> None:
    scene = replace(narrow(duration=2.4), formulation="compiled")
    found = max(vibrations(loaded_contacts(scene)[0]), key=lambda one: 1.0 / one.time)
    result = simulate(scene)
    time, force = result.time, result[f"pin.{PIN}.force"]
    sizes = [float(np.ptp(force[(time > t - 0.05) & (time <= t)])) for t in (1.6, 2.4)]
    # steps are for the least damping that the law may have; it falls as one over the impact velocity
    expected = found.fall * FASTEST / REST_VELOCITY
    assert math.log(sizes[0] / sizes[1]) / 0.8 == pytest.approx(expected, rel=0.1)
    kept = simulate(replace(scene, formulation="exudyn", step=0.25 * ringing_step(scene)))[f"pin.{PIN}.force"]
    size = float(np.ptp(kept[(time > 2.35) & (time <= 2.4)]))
    assert 0.5 * math.exp(-KEPT) * sizes[1] < size < 1.1 * sizes[1]
