"""One definition of a law, two backends: Python's arithmetic and an expression of the engine."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal

import exudyn
import numpy as np
import pytest
from exudyn.advancedUtilities import ConvertFunctionToSymbolic
from hypothesis import example, given, settings
from hypothesis import strategies as st
from support_exudyn.formulations.redundant.clearance.connector import user_function
from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    attachment,
    displacement_scale,
)
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce
from support_exudyn.formulations.redundant.clearance.symbolic_force import SymbolicForce, engine

from support_exudyn import Body, ClearancePin, Held, Result, Scenario, SolverSettings, simulate
from tests.cases.law_cases import (
    BEARING,
    FRICTION_LAWS,
    LENGTH,
    MODULUS,
    NORMAL_LAWS,
    STATELESS_FRICTION,
    kind_of,
    one_of_a_formula,
)
from tests.cases.run_cases import PIN, Pair, loose_support
from tests.often import often
from user_forces import (
    AdamsImpact,
    Ambrosio,
    Anagnostopoulos,
    BengisuAkay,
    BrownMcPhee,
    Exact,
    FrictionLaw,
    Frictionless,
    Johnson,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    Liu,
    LuGre,
    NormalLaw,
    SlipHistory,
    Stribeck,
    Threlfall,
)
from user_forces.contact_state import Onset, PinMemory

Vector = tuple[float, float]
Ground = Literal["bore", "journal"] | None  # what is on the ground
CLEARANCE = BEARING.clearance
SYSTEMS = exudyn.SystemContainer()  # expressions belong to a system of the engine
SMOOTH = Frictionless()
EXACT = Exact(stiffness=2.7e10, restitution=0.7)  # any normal law, for the friction laws
TEXTBOOK = LankaraniNikravesh(stiffness=2.7e10, restitution=0.9, rest_velocity=1e-3)


# --- the expression, outside of a simulation ---


@dataclass(frozen=True)
class State:
    """What the force of a pin depends on. Angles in rad, else SI."""

    displacement: Vector
    velocity: Vector
    turning: float  # of the journal against the bore
    bore_spin: float
    turn: float  # between the marker frames
    step: float
    memory: PinMemory


REST = State((0.0, 0.0), (0.0, 0.0), 0.0, 0.0, 0.0, 1e-5, PinMemory(False, 0.0, 0.0, 0.0))
MIDDLE = replace(REST, velocity=(0.1, 0.2))
PRESSED = replace(
    REST,
    displacement=(0.0, -0.0016),
    memory=PinMemory(True, 0.0, 0.0, 0.0),
)

# in the gap, up to a tenth of a millimetre in the wall, and near the surface, but not so near that rounding
# decides on which side
depths = st.one_of(st.floats(-CLEARANCE, 0.0), st.floats(0.0, 1e-4), st.floats(-1e-7, 1e-7)).filter(
    lambda depth: abs(depth) > 1e-8
)


@st.composite
def memories(draw: st.DrawFn) -> PinMemory:
    return PinMemory(
        in_contact=draw(st.sampled_from([True, True, False])),
        impact_velocity=draw(st.one_of(st.just(0.0), st.floats(1e-6, 1.0))),
        depth=0.0,
        rate=0.0,
        slip=draw(st.floats(-1.0, 1.0)),
        deflection=draw(st.floats(-2e-6, 2e-6)),
    )


@st.composite
def states(draw: st.DrawFn) -> State:
    eccentricity, angle = CLEARANCE + draw(depths), draw(st.floats(-math.pi, math.pi))
    return State(
        displacement=(eccentricity * math.cos(angle), eccentricity * math.sin(angle)),
        velocity=draw(st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))),
        turning=draw(st.floats(-10.0, 10.0)),
        bore_spin=draw(st.floats(-10.0, 10.0)),
        turn=draw(st.floats(-1e-4, 1e-4)),
        step=draw(st.floats(1e-7, 1e-3)),
        memory=draw(memories()),
    )


@cache
def expression(contact: JournalContact, ground: Ground) -> Callable[[State], np.ndarray]:
    """Force and moment of the engine's expression, as a function of the state."""
    system = SYSTEMS.AddSystem()
    at = attachment(contact, ground == "bore", ground == "journal")
    force = SymbolicForce(system, contact, at)
    item, name = user_function(at)
    made = ConvertFunctionToSymbolic(system, force.expression(), name, None, item)
    _, _, _, *arguments = made["argList"]

    def evaluate(state: State) -> np.ndarray:
        force.load(state.memory, state.step, state.bore_spin, state.turn)
        for argument, value in zip(arguments, handed_over(at, state), strict=False):
            if isinstance(value, float):
                argument.SetValue(value)
            else:
                argument.SetVector(engine.Vector(list(value)))
        return np.atleast_1d(made["returnValue"].Evaluate())

    return evaluate


@cache
def python_function(contact: JournalContact, ground: Ground) -> Callable[[State], np.ndarray]:
    """The same of the user function in Python."""
    at = attachment(contact, ground == "bore", ground == "journal")
    spin = [0.0]
    force = PythonForce(contact, at, lambda: spin[0])

    def evaluate(state: State) -> np.ndarray:
        force.load(state.memory, state.step)
        spin[0] = state.bore_spin
        arguments = handed_over(at, state)
        others = [0.0] * (force.function.__code__.co_argcount - 3 - len(arguments))
        return np.atleast_1d(force.function(None, 0.0, 0, *arguments, *others))

    return evaluate


def handed_over(at: Attachment, state: State) -> list[Any]:
    """The arguments of the engine's user function that are used."""
    if at is Attachment.LINE:
        eccentricity = math.hypot(*state.displacement)
        rate = np.dot(state.displacement, state.velocity) / eccentricity if eccentricity else 0.0
        return [BEARING.depth(eccentricity), float(rate)]
    displacement, velocity = [*state.displacement, 0.0], [*state.velocity, 0.0]
    return [displacement, [0.0, 0.0, state.turn], velocity, [0.0, 0.0, state.turning]]


def computed(contact: JournalContact, ground: Ground, state: State) -> np.ndarray:
    """The same by the contact in Python, and the convention of the engine's connector.

    Force and moment act on the bore and, reversed, on the journal.
    """
    at = attachment(contact, ground == "bore", ground == "journal")
    scale = displacement_scale(state.turn) if at is Attachment.MIDDLE else 1.0
    x, y = scale * state.displacement[0], scale * state.displacement[1]
    spin = {"bore": 0.0, "journal": -state.turning, None: state.bore_spin}[ground]
    memory = state.memory
    history = SlipHistory(memory.deflection, memory.slip, state.step)
    spins = spin, spin + state.turning
    impact = memory.impact_velocity if memory.in_contact else None
    found = contact.force(x, y, *state.velocity, *spins, impact, history)
    if at is Attachment.LINE:
        return np.array([found.normal_force])
    # of the point of action from the journal's centre, against n: that centre, the bore's, the middle
    share = {"bore": 0.0, "journal": 1.0, None: 0.5}[ground]
    moment = -(found.journal_arm + share * math.hypot(x, y)) * found.friction_force
    return np.array([-found.force_x, -found.force_y, 0.0, 0.0, 0.0, moment])


def assert_same(contact: JournalContact, ground: Ground, state: State) -> None:
    expected = computed(contact, ground, state)
    depth = math.hypot(*state.displacement) - CLEARANCE
    # on the way out damping may nearly cancel the elastic force, whose rounding remains
    elastic = contact.normal.elastic_force(depth) if depth > 0.0 and state.memory.in_contact else 0.0
    largest = max(elastic, np.abs(expected).max())
    for made in (expression, python_function):
        got = made(contact, ground)(state)
        # asked for; lengths of 1.5 mm are rounded to 2e-19 m, a part in 5e10 of the smallest depth
        np.testing.assert_allclose(got, expected, rtol=0.0, atol=1e-9 * largest)
        if len(got) == 6:  # the moment, in that of the force
            assert abs(got[5] - expected[5]) <= 1e-9 * BEARING.bore_radius * largest


def contact_of(normal: NormalLaw, friction: FrictionLaw = SMOOTH) -> JournalContact:
    return JournalContact(bearing=BEARING, normal=normal, friction=friction)


grounds = st.sampled_from(["bore", "journal", None])


@pytest.mark.parametrize("normal", one_of_a_formula(NORMAL_LAWS), ids=kind_of)
@settings(max_examples=often(40), deadline=None)
@given(state=states(), ground=grounds)
@example(state=MIDDLE, ground=None)
@example(state=PRESSED, ground=None)
def test_normal_law_is_the_same_in_all(normal: NormalLaw, state: State, ground: Ground) -> None:
    assert_same(contact_of(normal), ground, state)


@pytest.mark.parametrize("friction", FRICTION_LAWS, ids=kind_of)
@settings(max_examples=often(60), deadline=None)
@given(state=states(), ground=grounds)
@example(state=MIDDLE, ground=None)
@example(state=PRESSED, ground=None)
def test_friction_law_is_the_same_in_all(friction: FrictionLaw, state: State, ground: Ground) -> None:
    assert_same(contact_of(EXACT, friction), ground, state)


@pytest.mark.parametrize("normal", [TEXTBOOK, NORMAL_LAWS[-1]], ids=kind_of)
@pytest.mark.parametrize("friction", STATELESS_FRICTION[:2], ids=kind_of)
@settings(max_examples=often(40), deadline=None)
@given(state=states(), ground=grounds)
def test_other_damping_is_the_same_in_all(
    normal: NormalLaw, friction: FrictionLaw, state: State, ground: Ground
) -> None:
    assert_same(contact_of(normal, friction), ground, state)


@pytest.mark.parametrize("friction", FRICTION_LAWS, ids=kind_of)
@settings(max_examples=often(20), deadline=None)
@given(state=states(), ground=grounds)
def test_nothing_acts_while_the_surfaces_are_apart(friction: FrictionLaw, state: State, ground: Ground) -> None:
    apart = replace(state, memory=state.memory._replace(in_contact=False))
    gap = replace(state, memory=state.memory._replace(in_contact=True))
    for made in (expression, python_function):
        evaluate = made(contact_of(EXACT, friction), ground)
        assert (evaluate(apart) == 0.0).all()
        if math.hypot(*state.displacement) < CLEARANCE:
            assert (evaluate(gap) == 0.0).all()


@pytest.mark.parametrize("in_contact", [True, False])
def test_nothing_acts_in_the_middle_of_the_bore(in_contact: bool) -> None:
    state = replace(MIDDLE, memory=MIDDLE.memory._replace(in_contact=in_contact))
    for friction in FRICTION_LAWS:
        for made in (expression, python_function):
            assert (made(contact_of(EXACT, friction), None)(state) == 0.0).all()


# --- runs ---


def both(make: Callable[[SolverSettings], Scenario], **choice: Any) -> tuple[Result, Result]:
    python, symbolic = (
        simulate(make(SolverSettings(backend=backend, **choice))) for backend in ("python", "symbolic")
    )
    assert python.counts.user_function_calls > 0
    assert symbolic.counts.user_function_calls == 0
    assert symbolic.counts.steps == python.counts.steps
    return python, symbolic


def same_onsets(one: tuple[Onset, ...], two: tuple[Onset, ...], error: float) -> None:
    assert len(one) == len(two) >= 2  # else the test says nothing
    fastest = max(onset.speed for onset in one)
    # times relative to a flight of 10 ms
    np.testing.assert_allclose([a.time for a in two], [a.time for a in one], rtol=0.0, atol=1e-2 * error)
    np.testing.assert_allclose([a.speed for a in two], [a.speed for a in one], rtol=0.0, atol=fastest * error)


def magnitude(result: Result, name: str) -> float:
    """Largest magnitude of a channel; of a component that of its vector, of an energy that of all energies."""
    if name.startswith("energy."):
        group = [other for other in result.channels if other.startswith("energy.")]
    elif name.endswith(("_x", "_y")):
        group = [name[:-1] + axis for axis in "xy"]
    else:
        group = [name]
    return max(float(np.abs(result[other]).max()) for other in group)


def differences(one: Result, two: Result) -> dict[str, float]:
    """Largest difference of every channel, relative to its magnitude."""
    return {
        name: float(np.abs(two[name] - one[name]).max()) / (magnitude(one, name) or 1.0)
        for name in one.channels
    }


ONE = Body(mass=3.0, inertia=0.02, centre=(0.1, 0.2), angle=0.3, velocity=(0.1, 0.3), spin=3.0)
TWO = Body(mass=2.0, inertia=0.01, centre=(0.3, 0.1), angle=-1.0, velocity=(-0.4, 0.2), spin=-5.0)


RUBBING = Ambrosio(sliding_coefficient=0.3)
WITH_BRISTLES = LuGre(static_coefficient=0.3, sliding_coefficient=0.2)


@pytest.mark.parametrize(
    ("friction", "bore"),
    [
        (Frictionless(), "first"),
        (RUBBING, "second"),
        (WITH_BRISTLES, "first"),
        pytest.param(Frictionless(), "second", marks=pytest.mark.slow),
        pytest.param(RUBBING, "first", marks=pytest.mark.slow),
        pytest.param(WITH_BRISTLES, "second", marks=pytest.mark.slow),
    ],
    ids=kind_of,
)
def test_two_free_bodies_move_alike(bore: Literal["first", "second"], friction: FrictionLaw) -> None:
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.02, clearance=0.001),
        normal=LankaraniNikravesh(stiffness=1e9, restitution=0.9),
        friction=friction,
    )

    def scenario(solver: SolverSettings) -> Scenario:
        return Scenario(
            machine=Pair(one=ONE, two=TWO, one_point=(0.2, 0.25), two_point=(0.2, 0.25)),
            pins={"pin": ClearancePin(contact=contact, bore=bore)},
            duration=0.03,
            step=1e-4,
            gravity=(0.0, 0.0),
            solver=solver,
        )

    # with friction the engine repeats its steps until the bore's spin is right, so Newton's method goes further
    # there than in Python: at the default tolerance of 1e-8 that alone is a difference of 2e-9
    python, symbolic = both(scenario, newton_tolerance=1e-10)
    same_onsets(python.onsets["pin"], symbolic.onsets["pin"], 1e-9)
    for name, difference in differences(python, symbolic).items():
        assert difference < 1e-9, name  # asked for


def softer(law: NormalLaw, by: float) -> NormalLaw:
    """The same law with a stiffness that differs by a factor of 1 - by."""
    name = "effective_modulus" if isinstance(law, (Johnson, Liu)) else "stiffness"
    return replace(law, **{name: getattr(law, name) * (1.0 - by)})


CYLINDERS = {"bearing": BEARING, "length": LENGTH, "effective_modulus": MODULUS, "restitution": 0.7}


@pytest.mark.parametrize(
    ("normal", "friction"),
    [
        (LankaraniNikravesh(stiffness=2.7e10, restitution=0.9), Ambrosio(sliding_coefficient=0.25)),
        (TEXTBOOK, BengisuAkay(static_coefficient=0.3, sliding_coefficient=0.2)),
        pytest.param(Johnson(**CYLINDERS), Threlfall(sliding_coefficient=0.25), marks=pytest.mark.slow),
        pytest.param(
            Liu(**CYLINDERS),
            BrownMcPhee(static_coefficient=0.3, sliding_coefficient=0.2),
            marks=pytest.mark.slow,
        ),
        (
            AdamsImpact(stiffness=3.16e9, full_damping=5e4, full_damping_depth=1e-4),
            Stribeck(static_coefficient=0.3, sliding_coefficient=0.2),
        ),
        (
            Anagnostopoulos(stiffness=1e9, restitution=0.7),
            LuGre(static_coefficient=0.3, sliding_coefficient=0.2),
        ),
    ],
    ids=kind_of,
)
def test_drop_of_a_journal_is_the_same(normal: NormalLaw, friction: FrictionLaw) -> None:
    def scenario(law: NormalLaw, solver: SolverSettings) -> Scenario:
        pin = ClearancePin(contact=JournalContact(bearing=BEARING, normal=law, friction=friction))
        return replace(loose_support(drive=Held(), duration=0.08, step=5e-4, solver=solver), pins={PIN: pin})

    # In a linkage accelerations are differences of positions of metres, rounded to 1e-16 m, over squares of
    # steps down to 1e-6 s; so even runs in Python differ by far more than 1e-9 if a stiffness differs in its
    # last digits. How much they do is what the backends may differ by; coarse impacts keep it small.
    choice = {"impact_steps": 32, "newton_tolerance": 1e-10}
    python, symbolic = both(lambda solver: scenario(normal, solver), **choice)
    changed = [scenario(softer(normal, by), SolverSettings(**choice)) for by in (3e-16, 1e-15, 1e-14)]
    noise = [differences(python, simulate(other)) for other in changed]
    same_onsets(python.onsets[PIN], symbolic.onsets[PIN], 1e-8)
    for name, difference in differences(python, symbolic).items():
        # the largest of three such runs may be a tenth of another's; 1e-9 was asked for
        assert difference < max(1e-9, 30.0 * max(run[name] for run in noise)), name
        # of the contact itself and the posture, whatever the noise
        if name.startswith(f"pin.{PIN}.") or name.endswith((".x", ".y", ".angle")):
            assert difference < 1e-7, name
