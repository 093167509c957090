"""The two-leg shield: its ram keeps the canopy level; columns that are driven apart."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest

from support_exudyn import CubicStep, Drive, Held, Scenario, Steady, UniformSpeed, reference_support
from support_exudyn.files.machines.read import read_machine
from support_exudyn.machines.two_leg_shield import TwoLegShield
from support_exudyn.model.drives.coupled_drive import CoupledDrive
from support_exudyn.model.plane_geometry import distance
from user_forces import InputError, value

STROKE = 1.15


@pytest.fixture(scope="module")
def shield() -> TwoLegShield:
    machine = read_machine("two_leg_shield").machine
    assert isinstance(machine, TwoLegShield)
    return machine


@pytest.fixture(scope="module")
def scenario(shield: TwoLegShield) -> Scenario:
    return Scenario(machine=shield, drive=CubicStep(stroke=STROKE), duration=5.0)


def test_the_tip_wanders_less_than_the_rule_allows(shield: TwoLegShield) -> None:
    """MT/T 556-1996, 4.6.4: 80 mm; the design promises some 11 mm."""
    posture, tips = shield.start(), []
    for extension in np.linspace(0.0, STROKE, 116):
        posture = shield.extended(float(extension), posture) or posture
        tips.append(posture.tip[0])
    assert shield.column_lengths(posture)[0] == pytest.approx(
        shield.column_lengths(shield.start())[0] + STROKE, abs=1e-11
    )
    assert max(tips) - min(tips) < 0.0125


def test_the_ram_follows_the_leg_within_a_nanometre(shield: TwoLegShield, scenario: Scenario) -> None:
    """Against lengths of closed-form postures between the points that the curve was made from."""
    ram, leg = scenario.drive_of("ram"), scenario.drive_of("leg")
    assert isinstance(ram, CoupledDrive)
    start, posture = shield.start(), shield.start()
    at_start = distance(start.ends["ram_foot"], start.ends["ram_head"])
    for t in np.linspace(3.0, 5.0, 401):
        found = shield.extended(leg.extension(float(t)), posture)
        assert found is not None
        posture = found
        exact = distance(posture.ends["ram_foot"], posture.ends["ram_head"]) - at_start
        assert ram.extension(float(t)) == pytest.approx(exact, abs=1e-9)
    assert ram.extension(0.0) == 0.0


def test_its_speed_is_the_derivative_of_its_extension(scenario: Scenario) -> None:
    """Central differences; error h^2 / 6 times a third derivative of some m/s^3, and rounding 1e-16 / h."""
    ram, h = scenario.drive_of("ram"), 1e-5
    for t in np.linspace(3.1, 4.9, 37):
        slope = (ram.extension(float(t) + h) - ram.extension(float(t) - h)) / (2.0 * h)
        assert ram.speed(float(t)) == pytest.approx(slope, abs=1e-9)


def test_breaks_jumps_and_starts_are_those_of_the_leg(shield: TwoLegShield) -> None:
    sudden = UniformSpeed(stroke=0.5)
    ram = Scenario(machine=shield, drive=sudden, duration=5.0).drive_of("ram")
    assert ram.breaks == sudden.breaks
    after = ram.speed(math.nextafter(3.0, 4.0))
    # rounding of a time of 3 s moves the leg by 1e-16 m
    assert ram.speed(3.0) + ram.speed_jump(3.0) == pytest.approx(after, rel=1e-12)
    assert ram.speed(5.0) + ram.speed_jump(5.0) == pytest.approx(0.0, abs=1e-15)
    steady = Scenario(machine=shield, drive=Steady(rate=0.1), duration=2.0).drive_of("ram")
    assert steady.initial_speed == steady.speed(0.0) != 0.0


@pytest.mark.parametrize(
    ("drives", "said"),
    [
        ({"ram": CubicStep(stroke=-2.0)}, r"drives\.ram: ram cannot follow beyond 3\.99"),
        ({"leg": CubicStep(stroke=3.0)}, r"leg extension = .* m: .*allowed: up to 1\.52"),
        ({"leg": CubicStep(stroke=3.0), "ram": Held()}, r"drives\.leg: leg cannot follow beyond"),
    ],
)
def test_what_cannot_be_followed_is_told(shield: TwoLegShield, drives: dict[str, Drive], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Scenario(machine=shield, drive=CubicStep(stroke=0.2), drives=drives, duration=5.0)


# --- columns that are driven apart ---


SUPPORT = reference_support()


def driven(front: Drive, rear: Drive, duration: float = 5.0) -> Scenario:
    return Scenario(machine=SUPPORT, drives={"front_column": front, "rear_column": rear}, duration=duration)


def test_a_way_that_is_open_is_taken_though_its_corners_are_not() -> None:
    """One column alone cannot come so far; both together can, nearly."""
    with pytest.raises(InputError, match="rear_column cannot follow"):
        driven(CubicStep(stroke=0.0), CubicStep(stroke=0.8))
    driven(CubicStep(stroke=0.8), CubicStep(stroke=0.79))


def test_columns_one_after_the_other_are_told_when() -> None:
    """At its own end a drive would do; before the other has come, it does not."""
    with pytest.raises(InputError, match=r"drives\.rear_column: rear_column cannot follow beyond 1\.\d+ s"):
        driven(CubicStep(stroke=0.8, start=3.0, end=4.0), CubicStep(stroke=0.79, start=1.0, end=2.0))


def test_what_was_followed_for_a_while_is_checked_anew_for_longer() -> None:
    """The same drives: so far they go, and then no farther."""
    front, rear = CubicStep(stroke=0.0), CubicStep(stroke=0.8, start=1.0, end=3.0)
    driven(front, rear, duration=1.2)
    with pytest.raises(InputError, match="rear_column cannot follow"):
        driven(front, rear, duration=3.0)


@value
class Stages(Drive):
    """A drive of one's own with a field that has no hash."""

    strokes: Mapping[str, float]

    def extension(self, t: float) -> float:
        return t * math.fsum(self.strokes.values())

    def speed(self, t: float) -> float:
        del t
        return math.fsum(self.strokes.values())

    @property
    def initial_speed(self) -> float:
        return self.speed(0.0)

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, self.extension(duration)


def test_the_ram_follows_a_drive_without_a_hash(shield: TwoLegShield) -> None:
    steady, own = (
        Scenario(machine=shield, drive=drive, duration=2.0).drive_of("ram")
        for drive in (Steady(rate=0.1), Stages(strokes={"inner": 0.06, "outer": 0.04}))
    )
    # the same but for rounding
    assert own.extension(2.0) == pytest.approx(steady.extension(2.0), abs=1e-12)
