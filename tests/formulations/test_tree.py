"""Parts of the tree formulation, each against a closed form."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from support_exudyn import CubicStep, Drive, Held, OilColumn, Steady, UniformSpeed, reference_support
from support_exudyn.formulations.time_grid import record_times
from support_exudyn.formulations.tree.branches import ClearanceError, LoopError, Tree, branches
from support_exudyn.formulations.tree.drive_pieces import extension, pieces, speed
from support_exudyn.formulations.tree.dynamics import (
    TreePosture,
    accelerations,
    mass_matrix,
    mass_moment,
    pin_inverse_mass,
)
from support_exudyn.formulations.tree.events import Event, EventKind, event
from support_exudyn.formulations.tree.forces import Forces, JournalPlace
from support_exudyn.formulations.tree.integration import growth
from support_exudyn.formulations.tree.loads import SPEED_X, SPEED_Y, X, Y
from support_exudyn.formulations.tree.run import largest_error
from support_exudyn.formulations.tree.within_steps import POINTS, Ends, largest, motion_within, running, weights
from support_exudyn.mechanics.body_coordinates import BodyItem
from support_exudyn.mechanics.kinetics import Kinetics
from support_exudyn.mechanics.oil_column import fill
from tests.cases.run_cases import PIN, loose_support

GRAVITY = (0.5, -9.81)
OIL = OilColumn(bore_area=0.1, oil_length=0.5, bulk_modulus=1.5e9)
SCENE = loose_support(1.5, 0.2, actuators={"front_column": OIL, "rear_column": OIL}, formulation="tree")
TREE = branches(reference_support().linkage(), {PIN})
STATE = (
    np.array([0.3, -0.5, 0.2, 0.7]),
    np.array([1.0, -2.0, 0.5, 3.0]),
)  # far from the start, to see everything


# --- who carries whom ---


def test_the_support_hangs_on_its_front_link() -> None:
    carriers = {link.name: link.carrier for link in TREE.links}
    names = [link.name for link in TREE.links]
    assert carriers["front_link"] == -1
    assert names[carriers["shield"]] == "front_link"
    assert names[carriers["canopy"]] == names[carriers["rear_link"]] == "shield"
    assert TREE.movers("rear_link") == [TREE.number(n) for n in ("front_link", "shield", "rear_link")]
    assert TREE.movers("ground") == []


def test_loops_and_free_bodies_are_seen() -> None:
    linkage = reference_support().linkage()
    with pytest.raises(LoopError):
        branches(linkage, set())
    with pytest.raises(ClearanceError, match="canopy"):
        branches(linkage, {PIN, "shield_canopy"})


# --- dynamics ---


def bodies_of(tree: Tree, moved: float, velocity: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Positions and velocities of all bodies, flat, after a small time of constant rates."""
    q, v = STATE
    motion = TreePosture(tree, (q + moved * v)[None], (v + velocity)[None]).motion()
    return motion.position[0], motion.velocity[0]


def test_velocities_and_accelerations_are_derivatives() -> None:
    h = 1e-5
    (before, v0), (after, v1) = bodies_of(TREE, -h), bodies_of(TREE, h)
    motion = TreePosture(TREE, STATE[0][None], STATE[1][None]).motion(np.zeros((1, 4)))
    # central differences of second order: h^2 times third derivatives of some tens
    np.testing.assert_allclose((after - before) / (2.0 * h), motion.velocity[0], atol=1e-8)
    np.testing.assert_allclose((v1 - v0) / (2.0 * h), motion.acceleration[0], atol=1e-7)


def test_all_pins_stay_together() -> None:
    motion = TreePosture(TREE, STATE[0][None], STATE[1][None]).motion()
    for name, pin in TREE.linkage.pins.items():
        first, second = motion.point(pin.first, pin.first_point), motion.point(pin.second, pin.second_point)
        apart = float(np.abs(first.position - second.position).max())
        assert (apart > 0.1) if name == PIN else (apart < 1e-14)


def items() -> dict[str, BodyItem]:
    return {
        name: BodyItem(body, None, None, 3 * n) for n, (name, body) in enumerate(TREE.linkage.bodies.items())
    }


def test_the_mass_matrix_and_the_mobility_are_those_of_bodies_with_constraints() -> None:
    ideal = tuple(name for name in TREE.linkage.pins if name != PIN)
    kinetics = Kinetics(TREE.linkage, items(), ideal, ())
    posture = TreePosture(TREE, STATE[0][None], STATE[1][None])
    position, mass = posture.motion().position[0], kinetics.mass()
    unit = [TreePosture(TREE, STATE[0][None], row[None]).motion().velocity[0] for row in np.eye(4)]
    expected = [[float(a @ (mass * b)) for b in unit] for a in unit]
    np.testing.assert_allclose(mass_matrix(posture)[0], expected, rtol=1e-12)
    np.testing.assert_allclose(
        pin_inverse_mass(posture, TREE.linkage.pins[PIN]), kinetics.pin_inverse_mass(position, PIN), rtol=1e-9
    )


def test_power_of_all_forces_is_the_growth_of_kinetic_energy() -> None:
    h = 1e-5
    acceleration = accelerations(TreePosture(TREE, STATE[0][None], STATE[1][None]), GRAVITY, [])[0]

    def energy(t: float) -> float:
        q = STATE[0] + t * STATE[1] + 0.5 * t * t * acceleration
        v = STATE[1] + t * acceleration
        return 0.5 * float(v @ mass_matrix(TreePosture(TREE, q[None], v[None]))[0] @ v)

    weight = mass_moment(TreePosture(TREE, STATE[0][None], np.zeros((1, 4))), GRAVITY)[0]
    # second order again, of energies of some thousand joule
    assert (energy(h) - energy(-h)) / (2.0 * h) == pytest.approx(float(weight @ STATE[1]), rel=1e-6)


@pytest.fixture(scope="module")
def forces() -> Forces:
    return Forces(TREE, SCENE, fill(TREE.linkage, SCENE.oil_columns, SCENE.gravity))


def test_the_compiled_motion_is_that_of_the_posture(forces: Forces) -> None:
    forces(None, 0.0, 0, STATE[0].tolist(), STATE[1].tolist())
    posture = TreePosture(TREE, STATE[0][None], STATE[1][None])
    np.testing.assert_allclose(forces.work[:4, [X, Y]], posture.joint[0], atol=1e-14)
    motion = posture.motion()
    place = TREE.linkage.pins[PIN]
    journal = motion.point(place.second, place.second_point)
    row = forces.work[5]  # after four joints and the bore
    np.testing.assert_allclose(row[[X, Y]], journal.position[0], atol=1e-14)
    np.testing.assert_allclose(row[[SPEED_X, SPEED_Y]], journal.velocity[0], atol=1e-14)


def test_columns_of_oil_hold_the_closed_machine(forces: Forces) -> None:
    # at the start, all pins closed: the actuators carry the weight but for what the rear link's pin carries
    forces(None, 0.0, 0, [0.0] * 4, [0.0] * 4)
    still = TreePosture(TREE, np.zeros((1, 4)), np.zeros((1, 4)))
    left = forces.moments() + mass_moment(still, SCENE.gravity)[0]
    # what is left is a force at the journal: two numbers explain four
    pushes = pin_rows(still)
    force, *_ = np.linalg.lstsq(pushes.T, -left, rcond=None)
    np.testing.assert_allclose(pushes.T @ force, -left, atol=1e-6)
    assert math.hypot(*force) == pytest.approx(58778.944, rel=1e-6)  # as printed in the reference


def pin_rows(posture: TreePosture) -> np.ndarray:
    """Moments of unit forces at the journal, shape (2, 4)."""
    place = TREE.linkage.pins[PIN]
    unit = [TreePosture(TREE, posture.position, row[None]).motion() for row in np.eye(4)]
    return np.array([motion.point(place.second, place.second_point).velocity[0] for motion in unit]).T


# --- the drive ---


@pytest.mark.parametrize("drive", [Held(), CubicStep(), UniformSpeed(), Steady(rate=0.1)])
def test_drives_that_are_cubics_are_met_exactly(drive: Drive) -> None:
    found = pieces([drive], 6.0, 1e-18)  # less than rounding, which is not looked for
    assert [p.begin for p in found] == [0.0, *drive.breaks]
    for piece in found:
        for t in np.linspace(piece.begin, piece.end, 7)[1:-1].tolist():
            assert extension(piece.cubic[0], t) == pytest.approx(drive.extension(t), abs=1e-14)
            assert speed(piece.cubic[0], t) == pytest.approx(drive.speed(t), abs=1e-14)


def test_other_drives_are_cut_into_cubics() -> None:
    class Swaying(Held):
        def extension(self, t: float) -> float:
            return 0.1 * math.sin(10.0 * t)

    found = pieces([Swaying()], 1.0, 1e-9)
    assert [p.end for p in found[:-1]] == [p.begin for p in found[1:]]
    t = np.linspace(0.0, 1.0, 1001)[:-1]
    number = np.searchsorted([p.end for p in found], t, side="right")
    cubics = np.array([p.cubic[0] for p in found])[number]
    # between the points that are looked at the error is a little larger
    np.testing.assert_allclose(extension(cubics, t), 0.1 * np.sin(10.0 * t), atol=2e-9)


# --- events ---

C = 1e-3  # clearance [m]


def place(x: float, vx: float, y: float = 0.0, vy: float = 0.0) -> JournalPlace:
    e = math.hypot(x, y)
    return JournalPlace(x, y, vx, vy, e - C, (x * vx + y * vy) / e if e else math.hypot(vx, vy))


def test_a_touch_in_straight_flight() -> None:
    # 0.6 mm to go at 0.1 m/s: 6 ms of 8 ms
    found = event(False, False, place(0.4e-3, 0.1), place(1.2e-3, 0.1), 8e-3, C)
    assert found is not None
    assert found.kind is EventKind.IMPACT
    assert found.fraction == pytest.approx(0.75, abs=1e-9)
    # through the middle, out on the other side
    found = event(False, False, place(-0.4e-3, 0.2), place(0.5e-3, 0.2), 4.5e-3, C)
    assert found is None


def test_a_touch_that_is_over_within_the_step_is_seen() -> None:
    # a chord that leaves the bore and comes back: y = 0.9999 C at x = 0 only with the bend of free fall
    fall = -9.81
    v = 0.03
    step = 2.0 * v / 9.81
    top = 0.5 * v * v / 9.81
    y0 = C - top + 1e-6  # 1 um too high on top
    found = event(False, False, place(0.0, 0.0, y0, v), place(0.0, 0.0, y0, v + fall * step), step, C)
    assert found is not None
    assert found.kind is EventKind.IMPACT
    early = (v - math.sqrt(v * v - 2.0 * 9.81 * (top - 1e-6))) / 9.81
    assert found.fraction == pytest.approx(early / step, rel=1e-6)
    lower = y0 - 2e-6
    assert event(False, False, place(0.0, 0.0, lower, v), place(0.0, 0.0, lower, -v), step, C) is None


def test_a_flight_across_the_bore_is_not_made_in_one_step() -> None:
    found = event(False, False, place(-0.9e-3, 0.5), place(0.9e-3, 0.5), 3.6e-3, C)
    assert found == Event(EventKind.UNCLEAR, 0.0)


def test_a_step_that_ends_at_the_wall_touches_there() -> None:
    assert event(False, False, place(0.9e-3, 0.1), place(C + 1e-12, 0.1), 1e-3, C) == Event(
        EventKind.IMPACT, 1.0
    )
    # one that starts there flies away
    assert event(False, False, place(C - 1e-12, -0.1), place(0.9e-3, -0.1), 1e-3, C) is None


def test_a_parting() -> None:
    found = event(True, False, place(C + 1e-5, -0.1), place(C - 1e-5, -0.1), 2e-4, C)
    assert found is not None
    assert found.kind is EventKind.SEPARATION
    assert found.fraction == pytest.approx(0.5, abs=1e-9)
    # in and out again within a step that begins with the impact
    found = event(True, False, place(C, 0.1), place(C - 1e-6, -0.12), 1e-4, C)
    assert found is not None
    assert found.kind is EventKind.SEPARATION
    assert found.fraction == pytest.approx(2.0 * 0.1 / 0.22, abs=1e-9)  # a parabola


def test_a_contact_pressed_on_again() -> None:
    start, end = place(C + 1e-5, -0.1), place(C + 1e-5, 0.1)
    # depth 1e-5 - 0.1 t + ..., lowest in the middle: a quarter of rate times step
    assert event(True, False, start, end, 1e-4, C) is None
    assert event(True, True, start, end, 1e-4, C) == Event(EventKind.RETURN, pytest.approx(0.5))
    out = event(True, True, start, end, 1e-3, C)
    assert out is not None
    assert out.kind is EventKind.SEPARATION


# --- within steps ---


def test_quintics_are_met_exactly() -> None:
    rng = np.random.default_rng(1)
    curve = [np.polynomial.Polynomial(rng.normal(size=6)) for _ in range(3)]
    edges = np.array([0.0, 0.5, 0.8])

    def ends(t: np.ndarray) -> Ends:
        return Ends(*(np.column_stack([c.deriv(k)(t) for c in curve]) for k in range(3)))

    number, fraction = np.array([0, 0, 1, 1]), np.array([0.3, 1.0, 0.0, 0.7])
    t = edges[number] + fraction * np.diff(edges)[number]
    position, velocity = motion_within(ends(edges[:-1]), ends(edges[1:]), np.diff(edges), number, fraction)
    exact = ends(t)
    # rounding, some ten times
    np.testing.assert_allclose(position, exact.position, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(velocity, exact.velocity, rtol=1e-11, atol=1e-12)


def test_velocities_in_tiny_steps_do_not_drown_in_rounding() -> None:
    one = np.ones((1, 1))
    step = 1e-9
    start = Ends(0.5 * one, one, 2.0 * one)
    end = Ends((0.5 + step) * one, (1.0 + 2.0 * step) * one, 2.0 * one)
    _, velocity = motion_within(start, end, np.array([step]), np.array([0]), np.array([0.5]))
    assert velocity[0, 0] == pytest.approx(1.0 + step, abs=1e-13)


def test_integrals_are_exact_to_their_degree() -> None:
    assert weights(np.ones(1))[0] @ POINTS**7 == pytest.approx(1.0 / 8.0, rel=1e-14)
    assert weights(np.array([0.3]))[0] @ POINTS**4 == pytest.approx(0.3**5 / 5.0, rel=1e-12)
    step = np.array([0.2, 0.5])
    t = np.array([0.0, 0.2])[:, None] + step[:, None] * POINTS
    number, fraction = np.array([0, 1, 1]), np.array([0.5, 0.0, 0.4])
    found = running(np.array([t**3]), step, number, fraction)[0]
    until = np.array([0.1, 0.2, 0.4])
    np.testing.assert_allclose(found, until**4 / 4.0, rtol=1e-12)


def top(curve: Callable[[np.ndarray], np.ndarray], steps: int = 1) -> float:
    """The top that is found of a quantity, a function of step plus fraction."""
    values = curve(np.arange(steps)[:, None] + POINTS)
    return largest(values, lambda number, fraction: curve(number + fraction))[0]


@pytest.mark.parametrize("where", [0.05, 0.3, 0.41, 0.6, 0.9, 0.97, 1.0, 1.7])
def test_the_top_between_the_points_is_found(where: float) -> None:
    # a parabola, and a corner: the narrowest looked at is a ten-thousandth of a step
    assert top(lambda t: 7.0 - 3.0 * (t - where) ** 2, 2) == pytest.approx(7.0, rel=1e-8)
    assert top(lambda t: 7.0 - 3.0 * abs(t - where), 2) == pytest.approx(7.0, rel=1e-5)


def test_the_top_is_sought_in_more_than_the_step_with_the_highest_point() -> None:
    # a corner that its step's points miss by more than those of the next step miss theirs
    assert top(lambda t: np.maximum(7.0 - 1.0 * abs(t - 0.25), 6.95 - 0.5 * abs(t - 1.5)), 2) == pytest.approx(
        7.0, rel=1e-5
    )


def test_there_may_be_no_top() -> None:
    assert top(lambda t: t) == 1.0  # rising: at the end
    assert top(lambda t: -1.0 - t) == 0.0
    assert largest(np.empty((0, 5)), lambda number, fraction: fraction) == (0.0, 0)


@pytest.mark.parametrize(("where", "step"), [(0.3, 0), (1.7, 1), (2.41, 2)])
def test_the_step_of_the_top_is_told(where: float, step: int) -> None:
    def curve(t: np.ndarray) -> np.ndarray:
        return np.asarray(7.0 - 3.0 * abs(t - where))

    values = curve(np.arange(3)[:, None] + POINTS)
    assert largest(values, lambda number, fraction: curve(number + fraction))[1] == step


# --- steps and records ---


def test_steps_grow_with_the_fifth_root_of_the_error() -> None:
    assert growth(1.0, 1.0) < 1.0
    assert growth(1e-30, 1e-30) == 5.0
    # in the long run, errors being alike: 0.2 - 0.75 b + b less than a fifth by b / 4
    assert growth(1e-2, 1e-2) / growth(1.0, 1.0) == pytest.approx(1e-2 ** -(0.2 - 1.75 * 0.08), rel=1e-12)


def test_the_end_is_a_record() -> None:
    assert record_times(1.0, 0.4).tolist() == pytest.approx([0.0, 0.4, 0.8, 1.0])
    assert record_times(0.3, 0.1).tolist() == [0.0, 0.1, 0.2, 0.3]


# --- what planted faults showed to be untested ---


def test_a_touch_that_is_over_at_once_is_looked_at_more_closely() -> None:
    assert event(True, False, place(C, 0.1), place(C - 9e-5, -1.9), 1e-4, C) == Event(EventKind.UNCLEAR, 0.0)


def test_a_bulge_between_two_inward_ends_touches() -> None:
    found = event(False, False, place(0.95e-3, -0.8), place(0.95e-3, -0.8), 1e-3, C)
    assert found is not None
    assert found.kind is EventKind.IMPACT
    assert 0.5 < found.fraction < 0.79


def test_what_grazes_the_wall_and_leaves_does_not_touch() -> None:
    assert event(False, False, place(0.9e-3, 2.0), place(C - 1e-12, -1e-7), 1e-4, C) is None


def test_after_a_parting_the_surfaces_must_be_seen_apart() -> None:
    start, end = place(C + 5e-11, -1e-4), place(C + 1e-5, 0.3)
    assert event(False, False, start, end, 1e-4, C) == Event(EventKind.UNCLEAR, 0.0)
    assert event(False, False, start, end, 1e-10, C) == Event(EventKind.IMPACT, 1.0)


def test_the_error_of_a_step_moves_no_journal_by_more_than_the_tolerance() -> None:
    pin = TREE.linkage.pins[PIN]
    apart = []
    for unit in np.eye(len(TREE.links)):
        motion = TreePosture(TREE, np.zeros((1, unit.size)), unit[None]).motion()
        one, other = motion.point(pin.first, pin.first_point), motion.point(pin.second, pin.second_point)
        apart.append(float(np.linalg.norm(one.velocity - other.velocity)))
    speed = math.sqrt(9.81 * 1.5e-3)  # of a fall through half the clearance
    expected = SCENE.solver.tolerance * speed / max(apart) / math.sqrt(2.0 * len(TREE.links))
    assert largest_error(TREE, SCENE) == pytest.approx(expected, rel=1e-9)


def test_a_drive_that_its_cubic_meets_in_the_middle_is_cut_all_the_same() -> None:
    class Wave(Held):
        def extension(self, t: float) -> float:
            return 0.1 * math.sin(2.0 * math.pi * t)

    assert len(pieces([Wave()], 1.0, 1e-9)) > 10


def test_an_impact_between_two_parts_of_a_flight_is_met_there() -> None:
    # so near to the wall that the first part of the flight ends within what counts as met, and not beyond it
    clearance, met, way = 1e-4, 1e-11, 1e-6
    depth = 0.5 * met - 0.25 * way
    start, end = (
        JournalPlace(clearance + at, 0.0, way / 1e-5, 0.0, at, way / 1e-5) for at in (depth, depth + way)
    )
    assert event(False, False, start, end, 1e-5, clearance) == Event(EventKind.IMPACT, 0.25)
