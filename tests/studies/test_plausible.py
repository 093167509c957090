"""Plausible machines: how they are drawn, and what follows from a sample."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.claims import plausible
from studies.claims.plausible import (
    BODIES,
    FACTORS,
    LOT,
    MEMBERS,
    REFERENCE,
    REFERENCE_SCALE,
    Factor,
    machine,
    pin,
    samples,
)
from studies.claims.plausible_runs import CASES, scenario
from studies.common import paper_machine
from support_exudyn import CubicStep, HydraulicSupport, UniformSpeed, reference_support
from support_exudyn.model.linkage import lumped
from support_exudyn.model.machine import links_stiffness
from user_forces import STEEL, STEEL_35CRMO, InputError, LankaraniNikravesh, PinInBore
from user_forces.backing import pin_stiffness

RANGES = [factor for factor in FACTORS if not factor.choices]
PIVOTS = ("rear_base", "front_base", "hinge", "front_foot", "rear_head", "tip")
EXACT = 1e-13  # rounding of a few products


def changed(**values: plausible.Choice) -> dict[str, plausible.Choice]:
    """The reference support's sample, changed."""
    assert set(values) <= set(REFERENCE)
    return REFERENCE | values


def mass(support: HydraulicSupport) -> float:
    return sum(part.mass for parts in support.parts.values() for part in parts)


# --- drawing ---


@pytest.mark.parametrize("second", [False, True])
@pytest.mark.parametrize("factor", RANGES, ids=lambda f: f.name)
def test_every_stratum_of_every_range_has_one_machine_of_a_lot(factor: Factor, second: bool) -> None:
    drawn = [float(sample[factor.name]) for sample in samples(2 * LOT, 11, second=second)]
    if factor.second_only and not second:
        assert set(drawn) == {factor.reference}
        return
    low, high = (float(factor.at(end, second=second)) for end in (0.0, 1.0))
    for lot in (drawn[:LOT], drawn[LOT:]):
        for n, x in enumerate(sorted(lot)):
            share = math.log(x / low) / math.log(high / low) if factor.powers else (x - low) / (high - low)
            # rounding may carry a value over the border of its stratum
            assert n / LOT - 1e-12 <= share <= (n + 1) / LOT + 1e-12


def test_machines_of_the_first_hypercube_have_what_the_paper_prints() -> None:
    steel_sphere = [paper_machine.STIFFNESS[size] for size in (0.5, 1.0, 1.5, 2.0)]  # Table 2
    for sample in samples(LOT, 1):
        support = machine(sample)
        for size, printed in zip((0.5, 1.0, 1.5, 2.0), steel_sphere, strict=True):
            scene = scenario(sample, f"{size} mm", support)
            bearing, normal = (getattr(scene.pins["rear_base"].contact, name) for name in ("bearing", "normal"))
            assert (1e3 * bearing.bore_radius, 1e3 * bearing.clearance) == pytest.approx((65.5, size))
            assert isinstance(normal, LankaraniNikravesh)
            assert normal.stiffness / 1e3**1.5 == pytest.approx(printed, abs=5.1e-4)
        for case in CASES:
            scene = scenario(sample, case, support)
            assert scene.drive == (UniformSpeed if "mode 1" in case else CubicStep)(
                stroke=0.5, start=3.0, end=5.0
            )
            assert scene.duration == 5.0


# --- the machine of a sample ---


@given(scale=st.floats(0.6, 1.0))
def test_masses_go_with_the_cube_of_the_scale(scale: float) -> None:
    support, base, ratio = machine(changed(scale=scale)), reference_support(), scale / REFERENCE_SCALE
    assert mass(support) == pytest.approx(ratio**3 * mass(base), rel=EXACT)
    assert support.start_hinge_height == pytest.approx(ratio * base.start_hinge_height, rel=EXACT)
    for name in PIVOTS:
        assert getattr(support, name) == pytest.approx(ratio * np.array(getattr(base, name)), rel=EXACT)
    for body in MEMBERS:
        ours, its = lumped(support.parts[body]), lumped(base.parts[body])
        assert ours.mass == pytest.approx(ratio**3 * its.mass, rel=EXACT)
        assert ours.centre == pytest.approx(ratio * np.array(its.centre), rel=EXACT)
        assert ours.inertia == pytest.approx(ratio**5 * its.inertia, rel=10 * EXACT)  # a longer sum
    # the same shape: the same posture at the start
    assert support.start().rear_link == pytest.approx(base.start().rear_link, abs=1e-11)  # of a root search


@pytest.mark.parametrize("name", BODIES)
def test_a_mass_factor_multiplies_its_parts_alone(name: str) -> None:
    body, places = BODIES[name]
    support, base = machine(changed(**{f"mass_{name}": 1.5})), reference_support()
    for other, parts in base.parts.items():
        for place, part in enumerate(parts):
            factor = 1.5 if other == body and place in places else 1.0
            ours = support.parts[other][place]
            assert ours.mass == pytest.approx(factor * part.mass, rel=EXACT)
            assert ours.inertia == pytest.approx(factor * part.inertia, rel=EXACT)
            assert ours.centre == part.centre


def test_a_machine_that_cannot_be_closed_is_refused() -> None:
    with pytest.raises(InputError, match=r"start_hinge_height = .*cannot bring the hinge there; allowed:"):
        machine(changed(start_height=5.0))


# --- the pin of a sample ---


def test_cylinders_are_as_long_as_the_machines_pin_and_held_by_pin_and_link() -> None:
    support = machine(changed(scale=0.8))
    made = pin(changed(scale=0.8, contact="cylinders", backing=2.0, law="flores"), 1.5, support)
    law = made.contact.normal
    assert isinstance(law, PinInBore)
    assert law.damping == "Flores"
    assert law.length == pytest.approx(0.7 * 0.8 / REFERENCE_SCALE, rel=EXACT)
    stiffness = 1.0 / (
        1.0 / pin_stiffness(made.contact.bearing.journal_radius, law.length, STEEL_35CRMO)
        + 1.0 / links_stiffness(support, "rear_base", STEEL)
    )
    assert law.backing_stiffness == pytest.approx(2.0 * stiffness, rel=EXACT)
