"""The scenes of the benchmark's rows, by name; those that grow are functions of a number of bars or joints."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from studies.benchmarking.scenes import SCENES as WITH_REFERENCE
from studies.common import paper_machine
from studies.outside.scenes import TURN, loose_crank_rocker
from support_exudyn import ClearancePin, CubicStep, Scenario, SolverSettings, Steady, simple_scenario, value
from support_exudyn.files.machines.linkage import LinkageFile
from support_exudyn.files.toml.reading import read_value
from support_exudyn.machines.machine_data import MachineData
from user_forces import Hertz, LankaraniNikravesh
from user_forces.normal.power_laws import PowerLaw

# [s]; a pressed elastic pin vibrates for ever, and steps that do not follow it damp that out: ones of 2 ms take
# 93 J of it in 20 s, half of all that there is, these 5 J
RESTLESS_STEP = 2e-4
TURNS = 10  # of the crank-rocker
QUICK, CREEP = 20.0, 0.002  # speed of the crank of a ladder [rad/s], and how far it turns where pins rest [rad]
RESTING_BARS = 18  # of the ladder whose pins rest in their bores
CELL = 0.3  # from one rocker of a ladder to the next [m]


# --- machines that grow ---


def ladder(bars: int) -> MachineData:
    """A crank-rocker, and four-bars on it: every rocker drives the next by a coupler as long as the base.

    bars: with that of the ground, 4, 6, 8 and so on; every two are one more four-bar. The pins of rockers on
    the ground are C1, C2 and so on.
    """
    rockers = (bars - 2) // 2
    drawing = {"O": [0.0, 0.0], "A": [0.1, 0.0]}
    bodies: dict[str, Any] = {
        "crank": {"bar": ["O", "A"], "mass_kg": 1.0},
        "coupler1": {"bar": ["A", "B1"], "mass_kg": 3.0},
    }
    pins: dict[str, Any] = {"O": ["ground", "crank"], "A": ["crank", "coupler1"]}
    for n in range(1, rockers + 1):
        away = CELL * (n - 1)
        drawing |= {f"B{n}": [0.365 + away, 0.3], f"C{n}": [0.35 + away, 0.0]}
        bodies[f"rocker{n}"] = {"bar": [f"C{n}", f"B{n}"], "mass_kg": 2.5}
        pins[f"C{n}"] = ["ground", f"rocker{n}"]
        if n == 1:
            pins["B1"] = ["coupler1", "rocker1"]
        else:
            bodies[f"coupler{n}"] = {"bar": [f"B{n - 1}", f"B{n}"], "mass_kg": 3.0}
            # two pins at one point, of which the first carries both couplers' ends on the rocker before
            pins[f"D{n}"] = {"bodies": [f"rocker{n - 1}", f"coupler{n}"], "at": f"B{n - 1}"}
            pins[f"B{n}"] = [f"coupler{n}", f"rocker{n}"]
    table = {
        "kind": "linkage",
        "drawing_m": drawing,
        "bodies": bodies,
        "pins": pins,
        "cranks": {"crank": "crank"},
        "bore_radius_mm": {f"C{n}": 10.0 for n in range(1, rockers + 1)},
    }
    return read_value(LinkageFile, table).data()


def turning_ladder(bars: int, loose: bool = False) -> Scenario:
    """A ladder of so many bars that turns; loose: whether the pin C1 has clearance."""
    return simple_scenario(
        ladder(bars),
        pins={"C1": {"clearance_mm": 0.2, "restitution": 0.5}} if loose else {},
        drive=Steady(rate=QUICK),
        duration_s=0.1,
        record_period_ms=2,
        step_ms=0.5,
    )


def resting_joints(joints: int) -> Scenario:
    """A ladder that creeps along while the pins of so many of its rockers rest in their bores."""
    name = [f"C{n}" for n in range(1, joints + 1)]
    return simple_scenario(
        ladder(RESTING_BARS),
        pins={one: {"clearance_mm": 0.2, "restitution": 0.5} for one in name},
        drive=CubicStep(stroke=CREEP, start=0.0, end=0.1),
        duration_s=0.1,
        record_period_ms=2,
        step_ms=0.5,
        start="settled",
    )


def restless(duration: float) -> Scenario:
    """A support whose pin bounces all the time: held columns, elastic contact, no friction."""
    scenario = WITH_REFERENCE["drop"].scenario
    ((pin, with_clearance),) = scenario.clearance_pins.items()
    law = with_clearance.contact.normal
    assert isinstance(law, PowerLaw)
    elastic = replace(with_clearance.contact, normal=Hertz(stiffness=law.stiffness, exponent=law.exponent))
    return replace(
        scenario,
        pins={pin: replace(with_clearance, contact=elastic)},
        duration=duration,
        record_period=0.01,
        step=RESTLESS_STEP,
        solver=SolverSettings(impact_steps=64, tolerance=1e-5),
    )


# --- the others ---


def quick_rise(friction: float, dimensions: int = 2) -> Scenario:
    """The first 0.4 s of a rise of 100 mm in a second with 1.5 mm of clearance, in the plane or in space."""
    rise = CubicStep(stroke=0.1, start=0.0, end=1.0)
    scene = paper_machine.clearance_rise(1.5, friction, 5e-4, law=paper_machine.PAPERS_LAW)
    return replace(scene, drive=rise, duration=0.4, dimensions=dimensions)  # type: ignore[arg-type]


def five_pins() -> Scenario:
    """A second of the reference support with clearance and friction in all its five pins."""
    names = WITH_REFERENCE["rise"].scenario.linkage.pins
    return simple_scenario(
        "reference",
        pins={name: {"clearance_mm": 1.0, "restitution": 0.7, "friction": 0.1} for name in names},
        drive=CubicStep(stroke=0.1, start=0.0, end=1.0),
        duration_s=1.0,
    )


def crank_rocker() -> Scenario:
    """The published crank-rocker with 0.5 mm in its pin B, ten turns."""
    return replace(loose_crank_rocker(), duration=TURNS * TURN, step=5e-4, solver=SolverSettings())


@value
class OwnLaw(PowerLaw):
    """F = K depth^n (1 + chi rate / v0), chi = 3 (1 - e^2) / 4, as a user writes it."""

    def factor(self, restitution: float) -> float:
        """chi."""
        return 3.0 * (1.0 - restitution * restitution) / 4.0


def on_cylinders() -> Scenario:
    """The paper's rise with the pin along its length, as steel is."""
    rise = WITH_REFERENCE["rise"].scenario
    pin = ClearancePin.simple(clearance=0.0015, bore_radius=0.0655, length=0.7)
    return replace(rise, pins={"rear_base": pin})


def short_rise(law: type[PowerLaw]) -> Scenario:
    """The first 0.2 s of a rise by a law."""
    pin = ClearancePin.simple(clearance=0.0015, bore_radius=0.0655, restitution=0.6, law=law)
    drive = CubicStep(stroke=0.005, start=0.0, end=0.2)
    rise = WITH_REFERENCE["rise"].scenario
    return replace(rise, pins={"rear_base": pin}, drive=drive, duration=0.2, record_period=1e-4)


SCENES: Mapping[str, Callable[[], Scenario]] = {
    "rise": lambda: WITH_REFERENCE["rise"].scenario,
    "rise, cylinders": on_cylinders,
    "rise, oil": lambda: WITH_REFERENCE["rise, oil"].scenario,
    "quick rise": partial(quick_rise, 0.0),
    "quick rise, friction": partial(quick_rise, 0.25),
    "quick rise in space": partial(quick_rise, 0.0, 3),
    "quick rise in space, friction": partial(quick_rise, 0.25, 3),
    "five pins": five_pins,
    "crank-rocker": crank_rocker,
    "own law": partial(short_rise, OwnLaw),
    "built-in law": partial(short_rise, LankaraniNikravesh),
    "2 s": partial(restless, 2.0),
    "8 s": partial(restless, 8.0),
    "4 bars": partial(turning_ladder, 4),
    "40 bars": partial(turning_ladder, 40),
    "4 bars, one loose": partial(turning_ladder, 4, loose=True),
    "40 bars, one loose": partial(turning_ladder, 40, loose=True),
    "1 joint": partial(resting_joints, 1),
    "8 joints": partial(resting_joints, 8),
}
