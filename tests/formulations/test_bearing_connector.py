"""The connector of a whole bearing in space: what it tells of sections, and what it does to both bodies."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from support_exudyn.formulations.redundant.clearance.connector_force import Attachment, attachment
from support_exudyn.formulations.redundant.space.bearing_source import (
    PARTS,
    BearingGeometry,
    force_source,
    names,
    spring_source,
)
from support_exudyn.formulations.redundant.space.section_motion import SectionEnd, SectionMover
from support_exudyn.formulations.redundant.space.section_pin import part_of
from support_exudyn.formulations.redundant.space.sections import Section
from support_exudyn.mechanics.space.motion import UNTURNED, turning_matrix
from tests.cases.law_cases import NORMAL_LAWS
from tests.cases.machine_cases import contact
from user_forces import Exact, Frictionless, JournalContact
from user_forces.compilation.flat import compiled

PLACES = (-0.2, 0.0, 0.2)
PARTS_OF = [Section(place, share) for place, share in zip(PLACES, (0.25, 0.5, 0.25), strict=True)]
SPEED, MASS, STIFFNESS = 0.1, 50.0, 1e6
ROUGH, SMOOTH = contact(), replace(contact(), friction=Frictionless())
BY_MASS = replace(SMOOTH, normal=next(law for law in NORMAL_LAWS if isinstance(law, Exact)))
unit = st.floats(-1.0, 1.0, allow_subnormal=False)
vectors = st.tuples(unit, unit, unit)


def end(first: int | None, centre: tuple[float, float, float]) -> SectionEnd:
    """The end of a bearing along z, whose middle is at the origin at the start."""
    x, y, z = centre
    across = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    return SectionEnd(first, centre, (0.0 - x, 0.0 - y, 0.0 - z), across, (0.0, 0.0, 1.0))


def bearing(of: JournalContact, bore: bool, journal: bool, slides: bool) -> BearingGeometry:
    """A bearing whose bore and journal are on bodies that move, or on the ground."""
    return BearingGeometry(
        bore=end(0 if bore else None, (0.4, -0.3, 0.1) if bore else (0.0, 0.0, 0.0)),
        journal=end((7 if bore else 0) if journal else None, (-0.2, 0.5, 0.3) if journal else (0.0, 0.0, 0.0)),
        at=attachment(of, not bore, not journal),
        places=PLACES,
        slides=slides,
    )


@cache
def pressed(of: JournalContact, bore: bool, journal: bool, slides: bool) -> dict[str, Any]:
    """What the force's function is and knows, all sections being in an impact."""
    geometry = bearing(of, bore, journal, slides)
    known = names(geometry)
    for n in range(len(PLACES)):
        known |= {f"in_contact{n}": True, f"speed{n}": SPEED}
    contacts = [part_of(of, part) for part in PARTS_OF]
    return compiled(force_source(geometry, contacts), contacts[0], **known)


@cache
def springs(of: JournalContact) -> dict[str, Any]:
    """The same of springs."""
    geometry = bearing(of, True, True, False)
    return compiled(spring_source(geometry), of, stiffness=lambda n, distance: STIFFNESS, **names(geometry))


@st.composite
def states(draw: st.DrawFn) -> tuple[list[float], list[float]]:
    """Coordinates and rates of two bodies: little turned, by parameters of length 1."""
    found: list[float] = []
    for _ in range(2):
        p = UNTURNED + 0.02 * np.array([0.0, *draw(vectors)])
        found += [*(0.005 * np.array(draw(vectors))), *(p / np.linalg.norm(p) - UNTURNED)]
    return [float(one) for one in found], [draw(unit) for _ in range(14)]


def wrench(end: SectionEnd, q: list[float], forces: list[float]) -> np.ndarray:
    """Force on a body and moment about the origin, from the generalised forces on its coordinates."""
    if end.first is None:
        return np.zeros(6)
    own, of = np.array(q[end.first : end.first + 7]), np.array(forces[end.first : end.first + 7])
    p = own[3:] + UNTURNED
    moment = 0.5 * turning_matrix(p) @ of[3:] / (p @ p)
    return np.concatenate([of[:3], moment + np.cross(np.array(end.centre) + own[:3], of[:3])])


def told(geometry: BearingGeometry, q: list[float], v: list[float]) -> list[Any]:
    """Motions of the sections, their axes and displacements, from the geometry that the program has besides."""
    found = []
    for place in PLACES:
        ends = [
            one._replace(arm=(one.arm[0], one.arm[1], one.arm[2] + place))
            for one in (geometry.bore, geometry.journal)
        ]
        mover = SectionMover(None, ends[0], ends[1], geometry.at)
        bodies = [one.state(q, v) for one in ends]
        found.append((mover.when(q, v), np.array(mover.axes(*bodies)).T, np.array(mover.apart(*bodies)[0])))
    return found


@pytest.mark.parametrize("slides", [False, True])
@pytest.mark.parametrize("of", [ROUGH, SMOOTH, BY_MASS], ids=["rough", "smooth", "by mass"])
@pytest.mark.parametrize("ends", [(True, True), (False, True), (True, False)], ids=str)
@settings(max_examples=25, deadline=None)
@given(state=states())
def test_forces_are_those_of_all_sections_and_keep_momenta(
    of: JournalContact, ends: tuple[bool, bool], slides: bool, state: tuple[list[float], list[float]]
) -> None:
    geometry = bearing(of, *ends, slides)
    contacts = [part_of(of, part) for part in PARTS_OF]
    force = pressed(of, *ends, slides)
    q, v = (one[: 7 * sum(ends)] for one in state)
    sections = told(geometry, q, v)
    assume(all(np.hypot(*motion[1][:2]) > 1e-4 for motion, _, _ in sections))
    found = force["force"](None, 0.0, 0, q, v)
    bore, journal = (wrench(end, q, found) for end in (geometry.bore, geometry.journal))
    size = 1.0 + np.abs(found).max()
    if all(ends):
        np.testing.assert_allclose(bore + journal, 0.0, atol=1e-12 * size)
    expected = np.zeros(3)
    for n, (((*_, bore_spin), (x, y, vx, vy, _, spin)), axes, apart) in enumerate(sections):
        if geometry.at is not Attachment.LINE:
            mine = force["last"][PARTS * n : PARTS * n + PARTS]
            np.testing.assert_allclose(mine[:2] + mine[3:5], (x, y, vx, vy), rtol=0.0, atol=1e-13)
        one = contacts[n].force(x, y, vx, vy, bore_spin, spin, SPEED)
        if isinstance(of.friction, Frictionless):  # it acts along both centres
            expected -= one.normal_force * apart / np.linalg.norm(apart)
        else:
            expected += axes[:, :2] @ [one.force_x, one.force_y]
    acting = journal[:3] if ends[1] else -bore[:3]
    # rounding of places of 1 m, in depths of 1e-3 m
    np.testing.assert_allclose(acting, expected, rtol=0.0, atol=1e-9 * size)


@settings(max_examples=25, deadline=None)
@given(state=states())
@pytest.mark.parametrize("of", [ROUGH, SMOOTH], ids=["rough", "smooth"])
def test_springs_pull_every_section_to_the_middle(
    of: JournalContact, state: tuple[list[float], list[float]]
) -> None:
    geometry = bearing(of, True, True, False)
    q, v = state
    found = springs(of)["spring"](None, 0.0, 0, q, v)
    bore, journal = (wrench(end, q, found) for end in (geometry.bore, geometry.journal))
    np.testing.assert_allclose(bore + journal, 0.0, atol=1e-12 * (1.0 + np.abs(found).max()))
    expected = np.zeros(3)
    for _, axes, apart in told(geometry, q, v):
        along = axes[:, 2] if geometry.at is Attachment.MIDDLE else np.zeros(3)
        expected -= STIFFNESS * (apart - along * (along @ apart))
    # rounding of places of 1 m
    np.testing.assert_allclose(journal[:3], expected, rtol=0.0, atol=1e-14 * STIFFNESS)


def test_surfaces_that_are_apart_push_nothing() -> None:
    geometry = bearing(ROUGH, True, True, False)
    contacts = [part_of(ROUGH, part) for part in PARTS_OF]
    force = compiled(force_source(geometry, contacts), contacts[0], **names(geometry))["force"]
    assert force(None, 0.0, 0, [0.01] * 14, [0.0] * 14) == [0.0] * 14


def test_little_motion_is_known_to_more_than_the_rounding_of_places() -> None:
    # a stiff contact shows that rounding as steps of its force, on which Newton's method ends nowhere
    mover = SectionMover(None, end(None, (0.0,) * 3), end(0, (40.0, -30.0, 0.0)), Attachment.JOURNAL)
    shift, half = 1e-7, 5e-10
    turned = [shift, 0.0, 0.0, -2.0 * math.sin(0.5 * half) ** 2, 0.0, 0.0, math.sin(half)]
    x, y = mover.when(turned, [0.0] * 7)[1][:2]
    less, sine = -2.0 * math.sin(half) ** 2, math.sin(2.0 * half)
    # the journal's middle is at (-40, 30) on its body
    assert x == pytest.approx(shift - 40.0 * less - 30.0 * sine, rel=1e-13, abs=0.0)
    assert y == pytest.approx(-40.0 * sine + 30.0 * less, rel=1e-13, abs=0.0)
