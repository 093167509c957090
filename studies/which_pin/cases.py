"""Which pins are clearance, with how much clearance and friction, in the cases of `which_pin`."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

from studies.common import paper_machine
from studies.common.numbers import Found, Number
from support_exudyn import ClearancePin, Scenario, SolverSettings
from support_exudyn.machines.four_bar_shield import PINS
from user_forces import IndentationVelocity, LankaraniNikravesh

CLEARANCE_MM = 1.5
FRICTIONS = (paper_machine.SLIDING_COEFFICIENT, 0.0)
CONDITIONS = ((0.25, 1.5), (0.1, 1.5), (0.25, 0.5), (0.0, 1.5))  # friction and clearance [mm], single pins
ADDS_UP = 2.0  # [%]: shifts whose sum is off by less are said to add up; ten times that for shaking
ALIKE = 0.05  # pins whose effects differ by less of the larger are said to be alike
IDEAL = "ideal"
ALL = "all five"
COLUMNS = ("front_column", "rear_column")
FORCES = {**{f"pin.{name}.force": name for name in PINS}, **{f"{name}.force": name for name in COLUMNS}}
SHAKEN = ("rear_link", "shield", "canopy")  # bodies whose angular acceleration is looked at


def clearance_pin(friction: float, clearance_mm: float = CLEARANCE_MM) -> ClearancePin:
    """The paper's pin, with a damping that forgets how its contact once began.

    With the textbook's, which remembers it, a pin that was settled gently shakes eight times as much in the
    same rise as one that was dropped: pins could not be compared.
    """
    pin = paper_machine.clearance_joint(clearance_mm, friction)
    law = LankaraniNikravesh(
        stiffness=paper_machine.stiffness(clearance_mm),
        restitution=paper_machine.RESTITUTION,
        damping_speed=IndentationVelocity(),
    )
    return replace(pin, contact=replace(pin.contact, normal=law))


def case_name(pins: Sequence[str], friction: float, clearance_mm: float = CLEARANCE_MM) -> str:
    """What a case is called: its clearance pins, their friction, and their clearance if it is another one."""
    named = ALL if len(pins) == len(PINS) else " + ".join(pins)
    other = "" if clearance_mm == CLEARANCE_MM else f", {clearance_mm:g} mm"
    return f"{named}, mu_d = {friction:g}{other}"


def alone(found: Found, name: str, friction: float, clearance_mm: float = CLEARANCE_MM) -> dict[str, Number]:
    """A number of each pin alone, by the name of the pin."""
    return {pin: found[name, case_name((pin,), friction, clearance_mm)] for pin in PINS}


def scenarios(quick: bool) -> dict[str, Scenario]:
    """The ideal support, each pin alone and all together with and without friction, and in the full form pairs.

    They start settled, as a support stands that waits to be raised. The full form also has the single pins with
    less friction and with less clearance.
    """
    settings = SolverSettings(
        impact_steps=16 if quick else 128, growth=8.0 if quick else 1.0, backend="symbolic"
    )
    ideal = replace(paper_machine.ideal_rise(1e-3), record_period=2e-3 if quick else 1e-3)

    def clearance(pins: Sequence[str], friction: float, clearance_mm: float = CLEARANCE_MM) -> Scenario:
        with_clearance = {name: clearance_pin(friction, clearance_mm) for name in pins}
        return replace(
            ideal, pins=with_clearance, step=2e-3 if quick else 5e-4, solver=settings, start="settled"
        )

    conditions = [(friction, CLEARANCE_MM) for friction in FRICTIONS] if quick else CONDITIONS
    cases = {case_name(PINS, friction): clearance(PINS, friction) for friction in FRICTIONS} | {IDEAL: ideal}
    cases |= {case_name((pin,), *how): clearance((pin,), *how) for how in conditions for pin in PINS}
    if not quick:
        cases |= {case_name(pins, 0.0): clearance(pins, 0.0) for pins in combinations(PINS, 2)}
    return cases
