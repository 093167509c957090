"""What others computed, and how far ours is from it: the cases of cases.toml, and rows of numbers."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from studies.common.data import tables
from studies.common.numbers import Number
from studies.outside.computed_torque import ComputedTorque
from support_exudyn import ClearancePin, CubicStep, Result, Scenario, SolverSettings, Steady, machine
from support_exudyn.files.machines import load_machine
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.guides import ClearanceGuide
from user_forces import (
    Ambrosio,
    Exact,
    FrictionLaw,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
)


@dataclass(frozen=True)
class OutsideCase:
    """A case: title, program and source of its numbers, its scene, and how far off ours may be.

    allowed: relative, unless it is absolute. numbers: as cases.toml has them, with what holds for all.
    """

    name: str
    title: str
    program: str
    source: str
    scene: str
    allowed: float
    numbers: Sequence[Mapping[str, Any]]
    absolute: bool = False


class ComparedNumber(NamedTuple):
    """A number of a case with ours.

    what, unit. theirs, their_error: of the source. ours, our_error: as runs of twice the steps tell it.
    allowed: by how much ours may be off, in the unit.
    """

    case: str
    what: str
    unit: str
    theirs: float
    their_error: float
    ours: float
    our_error: float
    allowed: float

    @property
    def off(self) -> float:
        """The distance of both, in the unit."""
        return abs(self.ours - self.theirs)

    @property
    def met(self) -> bool:
        """Whether that is as asked; what the source's digits leave open does not count."""
        digits = self.their_error if self.their_error < self.allowed else 0.0
        return self.off <= self.allowed + digits

    def number(self) -> Number:
        """The number as summary.json has it: ours, with that of the source."""
        return Number(self.what, self.case, self.ours, self.unit, self.our_error, self.theirs)


COMMON = ("channel", "unit", "impact", "what", "largest", "error")  # of a case, which hold for all its numbers


def cases() -> dict[str, OutsideCase]:
    """All cases by name, in their order."""
    found = {}
    for name, table in tables("studies.outside", "cases.toml", Decimal).items():
        fields = dict(table)
        common = {key: fields.pop(key) for key in COMMON if key in fields}
        numbers = [common | number for number in fields.pop("numbers", ())]
        allowed = float(fields.pop("allowed"))
        found[name] = OutsideCase(name=name, allowed=allowed, numbers=numbers, **fields)
    return found


def compared(case: OutsideCase, fine: Result, coarse: Result) -> list[ComparedNumber]:
    """All numbers of a case with those of a run, and of a run of twice the steps."""
    rows = []
    for number in case.numbers:
        what, measure = _measure(number)
        theirs, ours = float(number["value"]), measure(fine)
        exponent = number["value"].as_tuple().exponent
        error = float(number.get("error", 0.5 * 10.0**exponent))  # half of the last digit
        allowed = case.allowed if case.absolute else case.allowed * abs(theirs)
        off = abs(ours - measure(coarse))
        rows.append(ComparedNumber(case.name, what, str(number["unit"]), theirs, error, ours, off, allowed))
    return rows


def _measure(number: Mapping[str, Any]) -> tuple[str, Callable[[Result], float]]:
    """What a number is called, and how it is read off a run."""
    if "largest" in number:
        pin = number["largest"]
        return f"largest force of {pin}", lambda run: float(run.largest_force[pin])
    if "impact" in number:
        place, n, what = number["impact"], int(number["n"]), number["what"]
        return f"{place}, impact {n}: {what}", lambda run: float(getattr(run.onsets[place][n - 1], what))
    channel, at = number["channel"], float(number["at"])

    def recorded(run: Result) -> float:
        return float(run[channel][round(at / (run.time[1] - run.time[0]))])

    return f"{channel} at {at:g} s", recorded


HERE = Path(__file__).parent
CRANK = 60.0  # of the crank-rocker [rad/s]
TURN = 2.0 * math.pi / CRANK  # [s]
GAP = 0.005  # of the four-bar's pins [m]
STIFF, PLASTIC = 1e9, 0.05  # smooth contact in place of plastic impacts: K [N/m^1.5], restitution
SMOOTH = Frictionless()
KEPT = 1e-9  # rest velocity [m/s]: sources damp a contact by its impact velocity alone


def _pin(
    bearing: JournalBearing,
    normal: NormalLaw,
    bore: Literal["first", "second"],
    friction: FrictionLaw = SMOOTH,
) -> ClearancePin:
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=normal, friction=friction), bore=bore)


def loose_crank_rocker() -> Scenario:
    """The crank-rocker with a clearance of 0.5 mm in the pin of coupler and rocker, one turn."""
    normal = LankaraniNikravesh(stiffness=1e10, restitution=0.9, rest_velocity=KEPT)
    return Scenario(
        machine=machine("crank_rocker"),
        pins={"B": _pin(JournalBearing(bore_radius=0.01, clearance=0.0005), normal, "second")},
        drive=Steady(rate=CRANK),
        duration=TURN,
        step=3e-6,  # by which flights and impacts, of 2560 steps, err alike
        record_period=TURN / 400,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=2560),
    )


def three_loose_pins() -> Scenario:
    """The four-bar with three loose pins; smooth contact of low restitution in place of plastic impacts."""
    four_bar = load_machine(HERE / "four_bar.toml").machine
    bearing = JournalBearing(bore_radius=0.06, clearance=GAP)
    normal, friction = Exact(stiffness=STIFF, restitution=PLASTIC), Ambrosio(sliding_coefficient=0.1)
    bores: dict[str, Literal["first", "second"]] = {"A": "second", "B": "second", "C": "first"}
    start = four_bar.linkage().bodies["crank"].angle
    return Scenario(
        machine=four_bar,
        loads={"motor": ComputedTorque(body="crank", start=start)},
        pins={name: _pin(bearing, normal, bore, friction) for name, bore in bores.items()},
        duration=1.0,
        step=2e-4,
        record_period=1e-2,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=32),
    )


def guided(stiffness: float, duration: float, step: float, friction: FrictionLaw = SMOOTH) -> Scenario:
    """The slider-crank with a clearance of 1 mm on either side of its guide, left to itself.

    Arguments:
        stiffness: of the contact at every corner [N/m^1.5]. duration, step: [s]. friction: its law.
    """
    guide = ClearanceGuide(
        gaps=(1e-3, 1e-3),
        block=(0.1, 0.05),
        normal=Exact(stiffness=stiffness, restitution=0.4, rest_velocity=KEPT),
        friction=friction,
    )
    return Scenario(
        machine=machine("slider_crank_guide"),
        guides={"slot": guide},
        duration=duration,
        step=step,
        record_period=1e-3,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=128),
    )


def driven(name: str, drive: Drive, duration: float, step: float, period: float = 1e-3) -> Scenario:
    """A shipped machine with ideal pins and a drive; duration, step and time between records [s]."""
    return Scenario(machine=machine(name), drive=drive, duration=duration, step=step, record_period=period)


SCENES: dict[str, Callable[[], Scenario]] = {
    "crank_rocker": lambda: driven("crank_rocker", Steady(rate=CRANK), 0.08, 2e-5),
    "loose_crank_rocker": loose_crank_rocker,
    "watt_six_bar": lambda: driven("watt_six_bar", Steady(rate=40.0), 0.05, 1e-5),
    "free_crank_rocker": lambda: Scenario(  # that a spring, a damper and a torque move
        machine=load_machine(HERE / "free_crank_rocker.toml").machine,
        duration=2.0,
        step=2e-5,
        record_period=0.1,
    ),
    "three_loose_pins": three_loose_pins,
    "slider_crank": lambda: guided(1e9, 0.05, 5e-6),
    "stiffer_slider_crank": lambda: guided(1e11, 0.02, 5e-6),
    "stiffest_slider_crank": lambda: guided(1e13, 0.02, 2.5e-6),
    # as Siconos has run it
    "rough_slider_crank": lambda: guided(1e9, 0.02, 1e-5, Ambrosio(sliding_coefficient=0.01)),
    "velenje_shield": lambda: driven(
        "velenje_shield", CubicStep(stroke=0.6, start=0.0, end=1.0), 1.0, 1e-3, 1e-2
    ),
}


# mm: pivots A and B on the base, and lengths: A E, D E, B D, E C, and the angle of the beam at E
BASE, ABOVE, LEVEL = 674.0, 440.0, 510.0  # a1, and its direction: O - Q over N
FRONT, SHORT, REAR = 1360.0, 382.0, 1310.0  # a2, a3, a4
BEAM, BENT = 1427.70, np.radians(179.34)  # a5, and its angle to E D
HEIGHT = 640.0  # O, of A over the floor


def hinge(front_angle: Series) -> Series:
    """Places of the hinge (2, n) [m], for angles of the front link from A to E (n,) [rad]."""
    first = 1j * HEIGHT
    second = first - BASE * (LEVEL + 1j * ABOVE) / np.hypot(LEVEL, ABOVE)
    e = first + FRONT * np.exp(1j * front_angle)
    way = e - second
    along = (REAR**2 - SHORT**2 + np.abs(way) ** 2) / (2.0 * np.abs(way))
    d = second + way / np.abs(way) * (along + 1j * np.sqrt(REAR**2 - along**2))  # on the left of the way to E
    c = e + BEAM * np.exp(-1j * BENT) * (d - e) / np.abs(d - e)
    return 1e-3 * np.array([c.real, c.imag])
