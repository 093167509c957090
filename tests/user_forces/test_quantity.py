"""Numbers with units: what pint carries arrives in SI, and what files write is read back to the bit."""

import math
import re
import typing
from decimal import Decimal

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import CubicStep, Part
from user_forces import InputError, JournalBearing, LankaraniNikravesh
from user_forces.values import units as quantity
from user_forces.values.units import Unit

UREG: pint.UnitRegistry = pint.UnitRegistry()
UNITS: dict[str, Unit] = {
    name: alias.__metadata__[0]
    for name, alias in vars(quantity).items()
    if typing.get_origin(alias) is typing.Annotated
}
FINITE = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e30, max_value=1e30)


def test_quantities_are_the_same_as_numbers_in_si() -> None:
    plain = JournalBearing(bore_radius=0.0655, clearance=0.001)
    assert JournalBearing(bore_radius=65.5 * UREG.mm, clearance=UREG("0.1 cm")) == plain
    assert CubicStep(stroke=500 * UREG.mm, start=0 * UREG.ms, end=2 * UREG.s) == CubicStep(start=0.0, end=2.0)


def test_points_may_be_one_quantity_or_two() -> None:
    plain = Part(mass=1000.0, centre=(0.001, 2.0))
    assert Part(mass=1 * UREG.tonne, centre=[1.0, 2000.0] * UREG.mm) == plain
    assert Part(mass=1 * UREG.tonne, centre=(1 * UREG.mm, 2 * UREG.m)) == plain


def test_a_stiffness_is_taken_in_the_papers_unit() -> None:
    law = LankaraniNikravesh(stiffness=857942.947 * UREG.N / UREG.mm**1.5, restitution=UREG("90 percent"))
    # N/mm^1.5 are 10^4.5 N/m^1.5; the power is rounded
    assert law.stiffness == pytest.approx(857942.947 * 10**4.5, rel=1e-14)
    assert law.restitution == 0.9


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (
            {"bore_radius": 1 * UREG.kg, "clearance": 1.0},
            r"bore_radius = .*can be given in m, is one in kilogram",
        ),
        ({"bore_radius": 1.0, "clearance": -1 * UREG.mm}, r"clearance = -0.001: allowed: > 0"),
        ({"bore_radius": 1.0, "clearance": float("nan") * UREG.mm}, r"clearance = nan: .*finite"),
    ],
)
def test_wrong_quantities_are_refused(given: dict[str, typing.Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        JournalBearing(**given)


def test_a_number_without_unit_takes_none() -> None:
    with pytest.raises(InputError, match=r"restitution = .*a number without a unit"):
        LankaraniNikravesh(stiffness=1e9, restitution=0.9 * UREG.mm)


@given(FINITE, st.sampled_from(sorted(UNITS)), st.data())
def test_what_is_written_is_read_to_the_bit(number: float, name: str, data: st.DataObject) -> None:
    unit = UNITS[name]
    ending = data.draw(st.sampled_from(sorted(unit.endings)))
    read = unit.read(Decimal(str(unit.write(number, ending))), ending)
    assert (read, math.copysign(1.0, read)) == (number, math.copysign(1.0, number))


@pytest.mark.parametrize("name", sorted(UNITS))
def test_endings_are_what_pint_says(name: str) -> None:
    """Each file ending, spelled as pint spells units, is so many SI units."""
    unit = UNITS[name]
    for ending, factor in unit.endings.items():
        if ending == "N_per_m_to_n":
            continue  # of an exponent that the law has
        spelled = re.sub("^per_", "1 / ", ending).replace("_per_", " / ").replace("_", " * ")
        spelled = "".join(f"**{c}" if c in "23" else c for c in spelled)
        symbol = next(one for one in unit.symbol.split(" or ") if UREG(spelled).is_compatible_with(one))
        assert (1 * UREG(spelled)).to(symbol).magnitude == pytest.approx(float(factor), rel=1e-14)
