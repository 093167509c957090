"""Scenes that are drawn: machines, pins, laws, friction, starts, actuators, drives, loads, formulations.

Each is some hundredths of a second long, in which a journal that starts free strikes a few times.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from hypothesis import strategies as st

from studies.common.paper_machine import JACK, hydraulic_cylinders, oil_columns
from support_exudyn import (
    ActuatorModel,
    AppliedForce,
    ClearancePin,
    ClosedInlet,
    CubicStep,
    Drive,
    FallingBlock,
    Held,
    IdealPin,
    Load,
    Machine,
    OilColumn,
    OwnBody,
    PartModel,
    Pin,
    Reciprocating,
    Roof,
    Scenario,
    SolverSettings,
    Steady,
    SuddenOpening,
    UniformSpeed,
    cylinders_and_rods,
    ravn_slider_crank,
)
from support_exudyn.files.machines.read import shipped
from support_exudyn.machines.four_bar_shield import PINS
from user_forces import (
    Ambrosio,
    BrownMcPhee,
    CubicCoulomb,
    Exact,
    Flores,
    FrictionLaw,
    Frictionless,
    Hertz,
    HuntCrossley,
    Johnson,
    JournalBearing,
    JournalContact,
    KelvinVoigt,
    LankaraniNikravesh,
    NormalLaw,
    Stribeck,
)

IMPACT_STEPS = 64  # of the Exudyn formulation: enough, for its errors are known
MS = 1e-3  # [s]
GRAVITY = (0.0, -9.81)
SUPPORTS = ("reference", "zf18000", "two_leg_shield")
COMPILED = (Exact, Flores, HuntCrossley, LankaraniNikravesh)
TOLERANCE = 1e-9  # of formulations with error control: their errors are far below what impacts make of rounding


@cache
def machine(name: str) -> Machine:
    """A machine that comes with the package."""
    return shipped(name).machine


def between(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers of three digits, which a report can show."""
    return st.integers(0, 1000).map(lambda n: low + (high - low) * n / 1000)


def half_milliseconds(low: int, high: int) -> st.SearchStrategy[float]:
    """Times between records, which are whole milliseconds [s]."""
    return st.integers(low, high).map(lambda n: (n + 0.5) * MS)


# --- pins ---


@st.composite
def normals(
    draw: st.DrawFn, bearing: JournalBearing, stiffness: float, compiled: bool, jumps: bool
) -> NormalLaw:
    """A law of any form, about so stiff [N/m^1.5].

    compiled: of those that are. jumps: its force may jump at an impact.
    """
    stiff = stiffness * 2.0 ** draw(st.integers(-2, 1))
    hysteresis = {"restitution": draw(between(0.3, 0.95)), "rest_velocity": draw(st.sampled_from((1e-2, 1e-3)))}
    if compiled:
        return draw(st.sampled_from(COMPILED))(stiffness=stiff, **hysteresis)
    depth = 0.1 * bearing.clearance  # at which a linear law is as stiff
    linear = stiff * depth**0.5
    others: tuple[NormalLaw, ...] = (
        Hertz(stiffness=stiff),
        Johnson(bearing=bearing, length=0.1, effective_modulus=1e11, **hysteresis),
        LankaraniNikravesh(stiffness=stiff, **hysteresis),
        *((KelvinVoigt(stiffness=linear, damping=linear * 1e-4),) if jumps else ()),
    )
    return draw(st.sampled_from(others))


@st.composite
def frictions(draw: st.DrawFn, compiled: bool) -> FrictionLaw:
    """None, or a law without a state."""
    mu, speed = draw(between(0.05, 0.3)), draw(between(0.01, 0.1))
    ramp = Ambrosio(sliding_coefficient=mu, static_speed=0.1 * speed, dynamic_speed=speed)
    if compiled:
        return draw(st.sampled_from((Frictionless(), ramp)))
    others: tuple[FrictionLaw, ...] = (
        Frictionless(),
        ramp,
        CubicCoulomb(sliding_coefficient=mu, dynamic_speed=speed),
        BrownMcPhee(static_coefficient=1.2 * mu, sliding_coefficient=mu, transition_speed=speed),
        Stribeck(
            static_coefficient=1.2 * mu,
            sliding_coefficient=mu,
            stribeck_speed=speed,
            tolerance_speed=0.5 * speed,
        ),
    )
    return draw(st.sampled_from(others))


@st.composite
def with_clearance(
    draw: st.DrawFn, radius: float, stiffness: float, compiled: bool, apart: bool
) -> ClearancePin:
    """A pin with clearance.

    apart: of formulations with error control. Its journal may start anywhere in it, and its force may jump at
    an impact, which leaves steps of fixed length with large errors.
    """
    clearance = radius * draw(between(0.004, 0.02))
    bearing = JournalBearing(bore_radius=radius, clearance=clearance)
    contact = JournalContact(
        bearing=bearing,
        normal=draw(normals(bearing, stiffness, compiled, apart)),
        friction=draw(frictions(compiled)),
    )
    part = between(-0.6, 0.6)
    place = (clearance * draw(part), clearance * draw(part)) if apart and draw(st.booleans()) else (0.0, 0.0)
    return ClearancePin(contact=contact, bore=draw(st.sampled_from(("first", "second"))), eccentricity=place)


# --- supports ---


@st.composite
def strokes(draw: st.DrawFn, duration: float) -> Drive:
    """Of actuators; they begin and end between records."""
    last = round(duration / MS)
    start = draw(half_milliseconds(0, last // 2))
    end = start + MS * draw(st.integers(last // 2, 2 * last))
    stroke = draw(between(-0.1, 0.1)) * (end - start)
    kinds: tuple[Drive, ...] = (
        Held(),
        CubicStep(stroke=stroke, start=start, end=end),
        UniformSpeed(stroke=stroke, start=start, end=end),
        Reciprocating(stroke=stroke, period=end),
    )
    return draw(st.sampled_from(kinds))


def actuators_of(kind: Machine) -> tuple[str, ...]:
    """Names of the actuators."""
    return tuple(kind.linkage().actuators)


def on_oil(kind: Machine) -> dict[str, ActuatorModel]:
    """All actuators on oil."""
    return dict.fromkeys(actuators_of(kind), oil_columns()["front_column"])


@st.composite
def actuators(draw: st.DrawFn, kind: Machine, name: str) -> Mapping[str, ActuatorModel]:
    """Of any kind, of one or both actuators."""
    oil, cylinder = oil_columns()["front_column"], hydraulic_cylinders(ClosedInlet())["front_column"]
    opened = replace(cylinder, inlet=SuddenOpening(start=draw(half_milliseconds(0, 8)), end=0.1, extent=0.5))
    heavy = cylinders_and_rods(draw(st.sampled_from((None, oil)))) if name == "reference" else {}
    one, two = actuators_of(kind)
    kinds = ({}, {one: oil}, {one: oil, two: oil}, {one: opened, two: oil}, {two: cylinder}, heavy)
    return draw(st.sampled_from(kinds))


@st.composite
def tails(draw: st.DrawFn, kind: Machine) -> Mapping[str, PartModel]:
    """Mostly fixed; now and then a body of its own on a cushion of oil, if the machine has such a beam."""
    return (
        {"tail_beam": OwnBody(jack=JACK)}
        if getattr(kind, "tail_hinge", None) and not draw(st.integers(0, 3))
        else {}
    )


@st.composite
def loads(draw: st.DrawFn, kind: Machine, level: bool) -> Mapping[str, Load]:
    """Forces on the canopy in any direction; `level`: roofs and blocks, too, which know what is down."""
    linkage = kind.linkage()
    tip, centre = linkage.points["tip"].point, linkage.bodies["canopy"].centre
    share = draw(between(0.0, 1.0))
    at: Any = {
        "body": "canopy",
        "point": tuple(share * a + (1 - share) * b for a, b in zip(tip, centre, strict=True)),
    }
    start = draw(half_milliseconds(0, 10))
    force = AppliedForce(
        full_force=(draw(between(-1e5, 1e5)), draw(between(-5e5, 1e5))), start=start, end=start + 0.02, **at
    )
    descent = CubicStep(stroke=draw(between(1e-3, 5e-3)), start=start, end=start + 0.02)
    roof = Roof(descent=descent, stiffness=1e8, gap=draw(between(0.0, 1e-3)), damping=1.0, **at)
    block = FallingBlock(mass=500.0, height=0.0, speed=1.0, stiffness=1e8, restitution=0.5, **at)
    kinds: tuple[Mapping[str, Load], ...] = ({}, {"push": force})
    if level:
        kinds = (*kinds, {"roof": roof}, {"push": force, "roof": roof}, {"block": block})
    return draw(st.sampled_from(kinds))


@st.composite
def in_general(draw: st.DrawFn, level: bool = True) -> Scenario:
    """Any support for the compiled formulation by the equations of any linkage; `level`: see `in_bodies`."""
    if draw(st.booleans()):
        return draw(on_columns_of_oil())
    return replace(draw(in_bodies(level)), formulation="compiled", solver=SolverSettings(tolerance=TOLERANCE))


@st.composite
def on_columns_of_oil(draw: st.DrawFn) -> Scenario:
    """A support on oil; one pin of its four-bar is with clearance, in which the journal may start anywhere."""
    duration = MS * draw(st.integers(10, 25))
    kind = machine(draw(st.sampled_from(SUPPORTS)))
    return Scenario(
        machine=kind,
        pins={draw(st.sampled_from(PINS[:4])): draw(with_clearance(0.0655, 2.7e10, False, apart=True))},
        actuators=on_oil(kind),
        parts=draw(tails(kind)),
        drive=draw(strokes(duration)),
        start=draw(st.sampled_from(("concentric", "settled"))),
        duration=duration,
        record_period=MS,
        formulation="compiled",
        solver=SolverSettings(tolerance=TOLERANCE, impact_steps=IMPACT_STEPS),
    )


@st.composite
def in_bodies(draw: st.DrawFn, level: bool = True) -> Scenario:
    """Any support for the Exudyn formulation; `level`: with loads that know what is down."""
    duration = MS * draw(st.integers(10, 20))
    name = draw(st.sampled_from(SUPPORTS))
    kind = machine(name)
    pins: dict[str, Pin] = {
        pin: draw(with_clearance(0.0655, 2.7e10, False, apart=False))
        for pin in draw(st.lists(st.sampled_from(PINS), max_size=2, unique=True))
    }
    if draw(st.integers(0, 4)) == 0:
        rubbing = IdealPin(friction=CubicCoulomb(sliding_coefficient=0.1), radius=0.06)
        pins = {draw(st.sampled_from(PINS)): rubbing} | pins
    made_of = draw(actuators(kind, name))
    return Scenario(
        machine=kind,
        pins=pins,
        actuators=made_of,
        parts=draw(tails(kind)),
        loads=draw(loads(kind, level)),
        drive=draw(strokes(duration)) if len(cylinders_in(made_of)) < 2 else Held(),
        start=draw(st.sampled_from(("concentric", "settled"))),
        duration=duration,
        record_period=MS,
        step=1e-4,
        formulation="exudyn",
        solver=SolverSettings(impact_steps=IMPACT_STEPS),
    )


def cylinders_in(made_of: Mapping[str, ActuatorModel]) -> list[str]:
    """Actuators that no drive moves."""
    return [name for name, actuator in made_of.items() if not isinstance(actuator.hydraulic, OilColumn)]


@st.composite
def cranks(draw: st.DrawFn, free: bool) -> Scenario:
    """The slider-crank at some thousand turns a minute, its slider's pin with clearance.

    free: for the compiled formulation.
    """
    rate = draw(between(100.0, 550.0)) * draw(st.sampled_from((1.0, -1.0)))
    compiled = free and draw(st.booleans())
    pin = draw(with_clearance(0.01, 6.6e10, compiled, apart=free))
    period = 1e-4
    return Scenario(
        machine=replace(ravn_slider_crank(), start_angle=draw(between(-3.0, 3.0))),
        pins={"slider_pin": pin},
        drive=Steady(rate=rate),
        duration=period * draw(st.integers(10, 20) if free else st.integers(5, 8)),
        record_period=period,
        step=2e-5,
        gravity=draw(st.sampled_from(((0.0, 0.0), GRAVITY))),
        formulation="compiled" if free else "exudyn",
        solver=SolverSettings(tolerance=TOLERANCE, impact_steps=IMPACT_STEPS),
    )
