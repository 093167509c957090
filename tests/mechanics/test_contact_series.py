"""A contact at all records at once is what it is record by record."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import ClearancePin
from support_exudyn.mechanics.contact_places import RelativeMotion, series
from tests.cases.run_cases import paper_contact
from user_forces import Ambrosio, FrictionLaw, Frictionless, friction_law
from user_forces.contact import SlipHistory
from user_forces.contact_state import PinMemory

BASE = paper_contact(1.5, 0.0)
NORMAL = replace(BASE.normal, restitution=0.5)  # asks for the mass that moves
CLEARANCE = BASE.bearing.clearance


@friction_law
def branching(slip: float, normal_force: float) -> float:
    """Coulomb's friction with an `if`."""
    if slip > 0.0:
        return -0.25 * normal_force
    return 0.25 * normal_force


speeds = st.floats(-1.0, 1.0)
records = st.lists(
    st.tuples(
        st.floats(0.0, 7.0),  # direction of the journal from the bore's centre
        st.floats(-1e-4, -1e-8) | st.floats(1e-8, 1e-4),  # depth
        speeds,
        speeds,
        speeds,
        speeds,
        st.floats(0.0, 0.05),  # speed of the impact, often less than what the depth stores
        st.booleans(),  # in contact
    ),
    min_size=1,
    max_size=6,
)


@pytest.mark.parametrize("friction", [Frictionless(), Ambrosio(sliding_coefficient=0.25), branching()])
@given(rows=records)
def test_all_at_once_is_one_by_one(friction: FrictionLaw, rows: list[tuple[float, ...]]) -> None:
    pin = ClearancePin(contact=replace(BASE, normal=NORMAL, friction=friction))
    angle, depth, vx, vy, bore_spin, journal_spin, impact, closed = np.array(rows, dtype=np.float64).T
    far = CLEARANCE + depth
    moving = RelativeMotion(
        far * np.cos(angle),
        far * np.sin(angle),
        vx,
        vy,
        bore_spin,
        journal_spin,
    )
    memories = [PinMemory(bool(c), v, 0.0, 0.0) for c, v in zip(closed, impact, strict=True)]
    found = series(pin.contact, moving, memories)
    for n, memory in enumerate(memories):
        x, y = moving.x[n], moving.y[n]
        known = memory.impact_velocity
        motion = x, y, vx[n], vy[n], bore_spin[n], journal_spin[n]
        want = pin.contact.force(*motion, known if memory.in_contact else None, SlipHistory(0.0, 0.0, 0.0))
        for name in ("force_x", "force_y", "normal_force", "friction_force", "depth", "slip"):
            got = getattr(found, name)[n]
            # a depth of 1e-8 is known to 1e-11 of itself; powers and quotients of it to a few times that
            assert got == pytest.approx(getattr(want, name), rel=1e-9, abs=1e-9 * (1.0 + want.normal_force)), (
                name
            )
        stored = pin.contact.normal.elastic_energy(depth[n]) if depth[n] > 0.0 else 0.0
        assert found.stored[n] == pytest.approx(stored, rel=1e-9)
        assert found.impact_velocity[n] == (memory.impact_velocity if memory.in_contact else 0.0)
