"""Laws, drives and machines of any parameters, evaluated anywhere within their contracts."""

from __future__ import annotations

import dataclasses
import math
from contextlib import suppress
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Drive, Machine
from tests import strategies as some
from tests.sound import sound_drive, sound_machine
from user_forces import JournalContact, LoadError, NormalLaw
from user_forces.normal.part import PartOf

depths = st.floats(1e-18, 1e-2)
rates = st.floats(-100.0, 100.0)
speeds = st.sampled_from((0.0, 1e-12, 1e-6, 1e-3, 1.0, 100.0)) | st.floats(0.0, 100.0)


def complete(law: Any) -> Any:
    """The law with a mass where it lacks the number that a scenario would compute."""
    if isinstance(law, PartOf):
        return dataclasses.replace(law, law=complete(law.law))
    return dataclasses.replace(law, mass=1.0) if getattr(law, "mass", 0.0) is None else law


normal_laws = some.values(NormalLaw).map(complete)


@given(law=normal_laws, depth=depths, ratio=st.floats(1.0, 10.0), rate=rates, impact=speeds)
@some.tried("normal laws")
def test_a_normal_law_gives_numbers_within_its_range(
    law: NormalLaw, depth: float, ratio: float, rate: float, impact: float
) -> None:
    inside = min(depth, law.largest_depth)
    assert math.isfinite(law(inside, rate, impact))
    assert 0.0 <= law.elastic_force(inside) < math.inf
    assert 0.0 <= law.elastic_energy(inside) < math.inf
    deeper = min(ratio * inside, law.largest_depth)
    # rounding; of a closed form that cancels next to where it is replaced by its series
    assert law.elastic_energy(deeper) >= law.elastic_energy(inside) * (1.0 - 1e-10)
    assert law.elastic_force(deeper) >= law.elastic_force(inside) * (1.0 - 1e-10)
    with suppress(LoadError):
        assert math.isfinite(law(depth, rate, impact))


places = st.floats(-1.0, 1.0)


@given(pin=some.values(JournalContact), x=places, y=places, vx=rates, vy=rates, spin=rates, impact=speeds)
@some.tried("contacts")
def test_a_contact_gives_numbers_or_is_pressed_too_deep(
    pin: JournalContact, x: float, y: float, vx: float, vy: float, spin: float, impact: float
) -> None:
    pin = dataclasses.replace(pin, normal=complete(pin.normal))
    with suppress(LoadError):
        assert all(map(math.isfinite, pin.force(x, y, vx, vy, spin, -spin, impact)))


@given(drive=some.values(Drive))
@some.tried("drives")
def test_a_drive_can_be_asked_at_any_time(drive: Drive) -> None:
    sound_drive(drive)


@given(machine=some.values(Machine))
@some.tried("machines")
def test_a_machine_can_be_laid_out_and_asked_how_far_it_reaches(machine: Machine) -> None:
    sound_machine(machine)
