"""What moves with a clearance pin's depth while others are pressed: closed forms, all formulations."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from studies.benchmarking.fresh_scenes import fresh
from studies.common.paper_machine import oil_columns
from support_exudyn import (
    Body,
    ClearancePin,
    CubicStep,
    Linkage,
    Machine,
    Result,
    Scenario,
    SolverSettings,
    reference_support,
    simulate,
)
from support_exudyn.formulations.compiled.outcome import _Records
from support_exudyn.formulations.compiled.run import _Run
from support_exudyn.formulations.compiled.setup import model_of
from support_exudyn.formulations.contract import silent
from support_exudyn.formulations.redundant.scene.engine_scene import INITIAL
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.formulations.redundant.scene.static_equilibrium import find_static_equilibrium
from support_exudyn.formulations.redundant.space.scene_builder import build as build_in_space
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.pressed_pins import GIVES, inverse_masses, normal
from support_exudyn.model.linkage import GROUND, PinPlace, pinned
from tests.cases.run_cases import paper_contact, support
from tests.often import often
from user_forces import Exact, Hertz, IndentationVelocity, JournalBearing, JournalContact, NormalLaw, value

CLEARANCE = 1e-4  # [m]
PINS = tuple(reference_support().linkage().pins)
UPRIGHT = np.eye(2)  # axes of a bore


@value
class Levers(Machine):
    """Two bars of 1 m on pivots in the ground whose ends meet in a pin; that of the first has a stop too.

    The first bar's journal lies in the stop's bore, whose centre is `resting` above it. The second one's end
    comes down into the bore in the first at `speed` from the middle.
    """

    light: float = 0.3
    heavy: float = 30.0
    resting: float = CLEARANCE
    speed: float = 0.0

    def linkage(self) -> Linkage:
        """Bars of masses `light` and `heavy`."""
        return Linkage(
            bodies={
                "anvil": Body(mass=self.light, inertia=self.light / 12.0, centre=(0.5, 0.0)),
                "hammer": Body(
                    mass=self.heavy,
                    inertia=self.heavy / 12.0,
                    centre=(1.5, 0.0),
                    velocity=(0.0, -0.5 * self.speed),
                    spin=self.speed,
                ),
            },
            pins={
                "pivot": pinned(GROUND, "anvil", (0.0, 0.0)),
                "other_pivot": pinned(GROUND, "hammer", (2.0, 0.0)),
                "hit": pinned("anvil", "hammer", (1.0, 0.0)),
                "stop": PinPlace(
                    first=GROUND, second="anvil", first_point=(1.0, self.resting), second_point=(1.0, 0.0)
                ),
            },
        )


def with_clearance(law: NormalLaw) -> ClearancePin:
    return ClearancePin(
        contact=JournalContact(bearing=JournalBearing(bore_radius=0.02, clearance=CLEARANCE), normal=law)
    )


# --- closed forms ---


def test_a_pressed_stop_takes_a_bar_out_of_the_impact() -> None:
    linkage = Levers().linkage()
    system = kinetics_of(linkage, ("pivot", "other_pivot"))
    alone = system.pin_inverse_mass(np.zeros(6), "hit")
    along = np.array([0.0, 1.0])
    found = inverse_masses(system.pin_inverse_mass(np.zeros(6), "hit", {"stop": along}), UPRIGHT)
    # a bar answers at its end as a third of its mass; the stop holds all of the anvil that can move
    assert found.alone == pytest.approx((alone[0, 0], alone[0, 1], alone[1, 1]), abs=1e-15)
    assert found.alone.mass(0.0, 1.0) == pytest.approx(1.0 / (3.0 / 0.3 + 3.0 / 30.0), rel=1e-12)
    # of the light bar a millionth is left
    assert found.held.mass(0.0, 1.0) == pytest.approx(10.0, rel=1.01e2 * GIVES)
    assert found.held.mass(0.0, 1.0) < 10.0


def test_a_stop_pressed_along_its_surface_holds_nothing() -> None:
    # the bar's end moves across the line from its pivot, and a normal along that line does not see it
    system = kinetics_of(Levers().linkage(), ("pivot", "other_pivot"))
    found = inverse_masses(system.pin_inverse_mass(np.zeros(6), "hit", {"stop": np.array([1.0, 0.0])}), UPRIGHT)
    assert found.held == pytest.approx(found.alone, abs=1e-14)


angles = st.floats(-math.pi, math.pi)


@settings(deadline=None, max_examples=often(60))
@given(
    name=st.sampled_from(PINS),
    turns=st.tuples(*[angles] * 5),
    which=st.sets(st.sampled_from(PINS)),
    bore=angles,
)
def test_what_is_held_is_a_constraint_along_the_normal(
    name: str, turns: tuple[float, ...], which: set[str], bore: float
) -> None:
    linkage = reference_support().linkage()
    system = kinetics_of(linkage, ())
    at = np.zeros(12)
    normals = {
        pin: np.array([math.cos(turn), math.sin(turn)])
        for pin, turn in zip(PINS, turns, strict=True)
        if pin in which and pin != name
    }
    axes = np.array([[math.cos(bore), -math.sin(bore)], [math.sin(bore), math.cos(bore)]])
    found = inverse_masses(system.pin_inverse_mass(at, name, normals), axes).held

    # written out anew: rows of the model, then one for each pressed pin
    rows = [*system.rows(at)]
    rows += [along @ system.relative(at, linkage.pins[pin])[1] for pin, along in normals.items()]
    held = np.array(rows).reshape(-1, 12)
    rate = system.relative(at, linkage.pins[name])[1]
    free = np.eye(12) - np.linalg.pinv(held) @ held  # onto what the constraints allow
    mass = free @ np.diag(system.mass()) @ free
    expected = axes.T @ rate @ np.linalg.pinv(mass, rcond=1e-9) @ rate.T @ axes
    # a millionth of what moves with all others open is left; and rounding
    assert found == pytest.approx(
        (expected[0, 0], expected[0, 1], expected[1, 1]), abs=2.0 * GIVES * np.abs(rate).max() ** 2 / 300.0
    )


def test_pins_that_hold_the_same_twice_hold_it_once() -> None:
    linkage = Levers().linkage()
    twice = replace(linkage, pins={**linkage.pins, "again": linkage.pins["stop"]})
    along = np.array([0.0, 1.0])
    one, two = (
        kinetics_of(linkage, ("pivot", "other_pivot")).pin_inverse_mass(np.zeros(6), "hit", {"stop": along}),
        kinetics_of(twice, ("pivot", "other_pivot")).pin_inverse_mass(
            np.zeros(6), "hit", {"stop": along, "again": along}
        ),
    )
    assert inverse_masses(two, UPRIGHT).held == pytest.approx(inverse_masses(one, UPRIGHT).held, rel=1e-9)


def test_a_pin_is_pressed_where_its_surfaces_overlap() -> None:
    assert normal(0.0, 0.5 * CLEARANCE, CLEARANCE) is None
    assert normal(0.0, 0.0, CLEARANCE) is None
    assert normal(0.0, (1.0 - 1e-6) * CLEARANCE, CLEARANCE) is None
    np.testing.assert_allclose(normal(0.0, -CLEARANCE, CLEARANCE), (0.0, -1.0))
    np.testing.assert_allclose(normal(3.0, 4.0, CLEARANCE), (0.6, 0.8))


# --- what pins begin with ---


def test_a_scene_holds_the_pins_that_are_pressed_at_its_start() -> None:
    law = Exact(stiffness=1e9, restitution=0.7)
    pressed, apart = (
        build(
            Scenario(
                machine=Levers(resting=share * CLEARANCE),
                pins={"hit": with_clearance(law), "stop": with_clearance(law)},
                duration=1e-3,
            )
        )
        for share in (1.01, 0.9)
    )
    hit = pressed.clearance_joints["hit"].kept.inverse_mass
    assert hit == pressed.inverse_masses("hit", INITIAL).held
    assert hit.mass(0.0, 1.0) == pytest.approx(10.0, rel=2e-4)
    assert apart.clearance_joints["hit"].kept.inverse_mass == apart.inverse_masses("hit", INITIAL).alone
    assert apart.clearance_joints["hit"].kept.inverse_mass.mass(0.0, 1.0) == pytest.approx(1.0 / 10.1, rel=1e-9)


def test_a_compiled_run_begins_with_the_pins_that_are_pressed_held() -> None:
    law = Exact(stiffness=1e9, restitution=0.7)
    pins = {"hit": with_clearance(law), "stop": with_clearance(law)}
    scene = Scenario(machine=Levers(resting=1.01 * CLEARANCE), pins=pins, duration=1e-3, formulation="compiled")
    run = _Run(model_of(scene))
    run.go(silent)
    known = build(scene).clearance_joints
    for n, name in enumerate(pins):
        closed, _, *mass = _Records(run.model, run.rows).memory[0, n]
        assert bool(closed) == known[name].kept.in_contact == (name == "stop")
        assert mass == pytest.approx(tuple(known[name].kept.inverse_mass), rel=1e-9, abs=1e-12)


def default_law(clearance_mm: float = 1.5, friction: float = 0.0) -> ClearancePin:
    """The paper's pin, damped by its depth."""
    contact = paper_contact(clearance_mm, friction)
    return ClearancePin(
        contact=replace(contact, normal=replace(contact.normal, damping_speed=IndentationVelocity()))
    )


def on_oil(*pins: str, friction: float = 0.0, **changes: object) -> Scenario:
    """The support on oil, at rest until it rises."""
    fields: dict[str, object] = {
        "drive": CubicStep(start=0.01, end=0.15, stroke=0.03),
        "duration": 0.04,
        "actuators": oil_columns(),
        "pins": {name: default_law(friction=friction) for name in pins},
        "start": "settled",
        "solver": SolverSettings(impact_steps=32),
    }
    return support(**fields | changes)


# --- a free impact on what is pressed ---

WAYS: dict[str, dict[str, object]] = {
    "python": {"solver": SolverSettings(backend="python")},
    "symbolic": {"solver": SolverSettings(backend="symbolic")},
    "compiled": {"formulation": "compiled", "solver": SolverSettings(tolerance=1e-9)},
}


@pytest.mark.parametrize(
    "way", [*(pytest.param(way, marks=pytest.mark.slow) for way in ("python", "symbolic")), "compiled"]
)
def test_an_impact_on_a_pressed_bar_delivers_the_laws_restitution(way: str) -> None:
    stop = Hertz(stiffness=1e13)
    machine = Levers(speed=0.2, resting=CLEARANCE + stop.resting_depth(0.5 * 0.3 * 0.1))
    pins = {"hit": with_clearance(Exact(stiffness=1e9, restitution=0.5)), "stop": with_clearance(stop)}
    fields = {"duration": 4e-3, "step": 1e-5, "record_period": 1e-4, "gravity": (0.0, -0.1)} | WAYS[way]
    scene = Scenario(machine=machine, pins=pins, **fields)  # type: ignore[arg-type]
    impact = simulate(scene).onsets["hit"][0]
    # the stop gives a little, a hundredth of what the pin does; with the mass of the bar that is pressed in
    # place of what it lies on, 0.94
    assert impact.separation_velocity / impact.speed == pytest.approx(0.5, abs=0.02)


@cache
def rattling(way: str) -> Result:
    """A hammer that falls on a bar in a stop, both of ordinary stiffness."""
    pins = dict.fromkeys(("hit", "stop"), with_clearance(Exact(stiffness=1e9, restitution=0.8)))
    machine = Levers(light=3.0, resting=0.9 * CLEARANCE, speed=0.05)
    fields = {"duration": 0.045, "step": 1e-5, "record_period": 1e-4} | WAYS[way]
    return simulate(Scenario(machine=machine, pins=pins, **fields))  # type: ignore[arg-type]


@pytest.mark.parametrize("way", [pytest.param("symbolic", marks=pytest.mark.slow), "compiled"])
def test_formulations_agree_on_two_pins_in_series(way: str) -> None:
    one, other = rattling("python"), rattling(way)
    for pin in ("hit", "stop"):
        name = f"pin.{pin}.force"
        largest = np.abs(one[name]).max()
        assert len(one.onsets[pin]) >= 4
        # measured 4e-6 for the compiled formulation, 2e-11 for the engine's own evaluation of the same formulas
        np.testing.assert_allclose(other[name], one[name], atol=(1e-4 if way == "compiled" else 1e-8) * largest)


def test_a_contact_pressed_on_again_has_the_mass_at_its_turn() -> None:
    # a drawn scene in which another pin begins to press in the step of the turn: with the mass at the end of
    # the step the force was off by 7e-4, with half the steps, too; measured 1.6e-5
    scene = fresh(7, 209, "several pins").scenario
    exact = simulate(replace(scene, formulation="compiled", solver=SolverSettings(tolerance=1e-10)))
    force = simulate(replace(scene, formulation="redundant")).largest_force["rear_shield"]
    assert force == pytest.approx(exact.largest_force["rear_shield"], rel=1e-4)


# --- the plane and space ---


@pytest.mark.parametrize(
    ("pins", "friction"),
    [
        *(((name,), 0.0) for name in PINS),
        pytest.param(("front_base", "front_shield"), 0.0, marks=pytest.mark.slow),
        (("rear_base", "front_shield"), 0.1),
        pytest.param(PINS, 0.1, marks=pytest.mark.slow),
    ],
    ids=str,
)
def test_every_pin_of_the_plane_is_that_of_space(pins: tuple[str, ...], friction: float) -> None:
    scene = on_oil(*pins, friction=friction, step=2e-4)
    plane, space = simulate(scene), simulate(replace(scene, dimensions=3))
    for name in (f"pin.{pin}.force" for pin in PINS):
        # Newton's tolerance, and what tens of swings make of it: measured 6e-7 without friction, 1.3e-4 for all
        # five with; the mass of one journal of a pair in place of that of both is 1e-2 off
        close = 5e-4 if friction else 1e-5
        np.testing.assert_allclose(space[name], plane[name], atol=close * plane[name].max(), err_msg=name)


def test_journals_of_a_pair_that_are_both_pressed_have_the_mass_of_the_plane() -> None:
    scene = on_oil("front_base")
    plane, space = build(scene), build_in_space(replace(scene, dimensions=3))
    concentric = space.inverse_masses("front_base_left", INITIAL)
    assert concentric.held == concentric.alone  # each hits by itself
    for one in (plane, space):
        find_static_equilibrium(one)
    wanted = plane.inverse_masses("front_base", INITIAL).held
    for side in ("left", "right"):
        found = space.inverse_masses(f"front_base_{side}", INITIAL)
        # the same matrices, eliminated in another order
        assert found.held == pytest.approx(wanted, rel=1e-9)
        # one by itself tilts the shield
        assert found.alone.xx < (1.0 - 1e-3) * wanted.xx
        for pin in space.sections[f"front_base_{side}"]:
            assert pin.kept.inverse_mass == found.held
    for each in (plane, space):
        each.release()


def test_a_journal_of_a_pair_moves_half_the_pins_law_with_its_own_mass() -> None:
    # the law of the pin on twice the mass is half the law on the mass
    scene = build_in_space(replace(on_oil("front_base"), dimensions=3))
    kinetics = scene.kinetics(INITIAL)
    own = kinetics.answers(kinetics.bearing_rate(*scene.ends_of("front_base_left")))
    found = scene.inverse_masses("front_base_left", INITIAL).alone
    assert found == pytest.approx((0.5 * own[0, 0], 0.5 * own[0, 1], 0.5 * own[1, 1]), rel=1e-12)
    scene.release()
