"""Motion, constraints, reactions and sections in space, against formulas of other sources."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn.formulations.exudyn.scene.sections import lobatto, section_motion
from support_exudyn.mechanics.body_motion import (
    UNTURNED,
    SpatialMotion,
    parameter_rates,
    rotation,
    turning_matrix,
)
from support_exudyn.mechanics.constraints import (
    constraints_in_space,
    frame_of,
    matrix,
)
from support_exudyn.mechanics.kinetics import Instant, gyroscopic, lightness_of, tensor
from support_exudyn.mechanics.reactions import equations
from support_exudyn.model.spatial_linkage import (
    Bearing,
    BearingEnd,
    SpatialActuator,
    SpatialBody,
    SpatialLinkage,
)
from tests.cases.law_cases import NORMAL_LAWS
from user_forces import LoadError, NormalLaw
from user_forces.connector.item import Attachment
from user_forces.normal.part import PartOf

unit = st.floats(-1.0, 1.0, allow_subnormal=False)
vectors = st.tuples(unit, unit, unit)


@st.composite
def directions(draw: st.DrawFn) -> tuple[float, float, float]:
    found = np.array(draw(vectors))
    size = np.linalg.norm(found)
    assume(size > 0.1)
    x, y, z = (found / size).tolist()
    return x, y, z


@st.composite
def parameters(draw: st.DrawFn) -> np.ndarray:
    """Euler parameters of length 1."""
    found = np.array(draw(st.tuples(unit, unit, unit, unit)))
    size = np.linalg.norm(found)
    assume(size > 0.1)
    return found / size


# --- motion ---


@given(p=parameters(), spin=vectors)
def test_euler_parameters_turn_as_quaternions_do(p: np.ndarray, spin: tuple[float, float, float]) -> None:
    turn = rotation(p)
    np.testing.assert_allclose(turn, Rotation.from_quat([*p[1:], p[0]]).as_matrix(), atol=1e-14)  # rounding
    rates = parameter_rates(p, np.array(spin))
    np.testing.assert_allclose(2.0 * turning_matrix(p) @ rates, spin, atol=1e-14)  # inverse; rounding
    assert p @ rates == pytest.approx(0.0, abs=1e-15)  # the length stays 1
    # A' = omega x A, by central differences: h^2/6 of third derivatives below 10
    h = 1e-5
    slope = (rotation(p + h * rates) - rotation(p - h * rates)) / (2.0 * h)
    np.testing.assert_allclose(slope, np.cross(spin, turn, axisb=0, axisc=0), atol=1e-8)


BODY = {"mass": 2.0, "inertia": (1.0, 1.2, 0.9, 0.1, -0.05, 0.02)}


@st.composite
def machines(draw: st.DrawFn) -> SpatialLinkage:
    """Two bodies, a bearing between them and one on the ground, an actuator from far away."""
    first, second = (SpatialBody(centre=draw(vectors), **BODY) for _ in range(2))
    axis, point = draw(directions()), draw(vectors)
    return SpatialLinkage(
        bodies={"a": first, "b": second},
        bearings={
            "p": Bearing(
                first="a",
                second="b",
                first_point=point,
                second_point=draw(vectors),
                first_axis=axis,
                second_axis=axis,
                pin="p",
            ),
            "q": Bearing(
                first="ground", second="a", first_point=point, second_point=point, first_axis=axis, pin="q"
            ),
        },
        actuators={
            "k": SpatialActuator(
                foot="a", head="b", foot_point=(0.0, -20.0, 3.0), head_point=point, actuator="k"
            )
        },
    )


@st.composite
def states(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of two bodies and velocities v and omega of both (6 each)."""
    position = np.concatenate([[*draw(vectors), *(draw(parameters()) - UNTURNED)] for _ in range(2)])
    velocity = np.concatenate([[*draw(vectors), *draw(vectors)] for _ in range(2)])
    return position, velocity


def coordinate_rates(position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    found = []
    for q, v in zip(position.reshape(2, 7), velocity.reshape(2, 6), strict=True):
        found += [*v[:3], *parameter_rates(q[3:] + UNTURNED, v[3:])]
    return np.array(found)


def at(linkage: SpatialLinkage, position: np.ndarray) -> SpatialMotion:
    return SpatialMotion(linkage, position[None], np.zeros_like(position)[None])


@given(linkage=machines(), state=states())
def test_rows_are_the_rates_of_what_is_held(
    linkage: SpatialLinkage, state: tuple[np.ndarray, np.ndarray]
) -> None:
    position, velocity = state
    rows = constraints_in_space(linkage, (), ("k",))
    shifts = [row for row in rows if not row.kind.startswith("tilt")]

    def held(q: np.ndarray) -> np.ndarray:
        """Written out anew: coordinates of the second point in the first body's axes; the actuator's length."""
        where = {"ground": (np.eye(3), np.zeros(3), np.zeros(3))}
        for name, own in zip(linkage.bodies, q.reshape(2, 7), strict=True):
            p = own[3:] + UNTURNED
            a, b, c, d = p
            skew = np.array([[0.0, -d, c], [d, 0.0, -b], [-c, b, 0.0]])
            # not divided by the length, which changes in the second order only
            turn = (a * a - p[1:] @ p[1:]) * np.eye(3) + 2.0 * np.outer(p[1:], p[1:]) + 2.0 * a * skew
            where[name] = turn, np.array(linkage.bodies[name].centre), own[:3]

        def point(body: str, start: tuple[float, float, float]) -> np.ndarray:
            turn, centre, moved = where[body]
            return centre + moved + turn @ (np.array(start) - centre)

        found = []
        for row in shifts:
            if row.kind == "actuator":
                actuator = linkage.actuators[row.name]
                apart = point(actuator.head, actuator.head_point) - point(actuator.foot, actuator.foot_point)
                found.append(np.linalg.norm(apart))
                continue
            b = linkage.bearings[row.name]
            apart = point(b.second, b.second_point) - point(b.first, b.first_point)
            k = {"across_1": 0, "across_2": 1, "along": 2}[row.kind]
            found.append((where[b.first][0].T @ apart) @ frame_of(b.first_axis)[:, k])
        return np.array(found)

    rate, h = coordinate_rates(position, velocity), 1e-5
    slope = (held(position + h * rate) - held(position - h * rate)) / (2.0 * h)
    got = matrix(at(linkage, position), shifts)[0] @ velocity
    # central differences: h^2/6 of third derivatives up to 1e3, and rounding of 20 m over 2e-5
    np.testing.assert_allclose(got, slope, atol=1e-7)


@given(linkage=machines(), state=states(), forces=st.lists(unit, min_size=12, max_size=12))
def test_reactions_are_the_smallest_that_do_it(
    linkage: SpatialLinkage, state: tuple[np.ndarray, np.ndarray], forces: list[float]
) -> None:
    motion = at(linkage, state[0])
    rows = constraints_in_space(linkage, (), ("k",))
    doubled = rows + rows
    c = matrix(motion, doubled)[0]
    assume(np.linalg.svd(c[: len(rows)], compute_uv=False).min() > 0.05)
    system = equations(motion, doubled, np.zeros((1, 2)))
    acceleration, multipliers = (found[0] for found in system.solve(np.array([forces])))
    left = np.array(forces) - Instant(motion, doubled).mass @ acceleration
    found, expected = multipliers, np.linalg.pinv(c.T) @ left
    # rounding, which a lift of 1e-9 multiplies, of rows with arms of 20 m; measured 2e-6
    np.testing.assert_allclose(found, expected, atol=3e-5)
    np.testing.assert_allclose(found[: len(rows)], found[len(rows) :], atol=3e-5)  # alike what is alike


@given(p=parameters(), spin=vectors, rate=vectors)
def test_inertia_forces_are_the_rate_of_momentum(
    p: np.ndarray, spin: tuple[float, float, float], rate: tuple[float, float, float]
) -> None:
    body = SpatialBody(centre=(0.0, 0.0, 0.0), **BODY)
    linkage = SpatialLinkage(bodies={"a": body})
    w, alpha, turn = np.array(spin), np.array(rate), rotation(p)
    q = np.array([0.0, 0.0, 0.0, *(p - UNTURNED)])
    motion = SpatialMotion(linkage, q[None], np.array([[0.0, 0.0, 0.0, *parameter_rates(p, w)]]))
    acceleration = np.array([1.0, 2.0, 3.0, *alpha])
    found = Instant(motion, ()).mass @ acceleration + gyroscopic(motion)[0]
    np.testing.assert_allclose(found[:3], [2.0, 4.0, 6.0])
    light = lightness_of(motion, 0.0)(found[None] - gyroscopic(motion))[0]
    np.testing.assert_allclose(light, acceleration, atol=1e-12)
    j = tensor(body)
    own = turn.T @ w
    # Euler's equations in the body's axes; rounding
    expected = turn @ (j @ (turn.T @ alpha) + np.cross(own, j @ own))
    np.testing.assert_allclose(found[3:], expected, atol=1e-12)


# --- sections ---


@pytest.mark.parametrize("number", [2, 3, 4, 5, 9, 17, 64])
def test_lobatto_is_exact_for_polynomials(number: int) -> None:
    places, weights = lobatto(number)
    assert places[0] == -1.0
    assert places[-1] == 1.0
    assert len(places) == number
    np.testing.assert_array_equal(places, -places[::-1])
    np.testing.assert_allclose(weights, weights[::-1], rtol=1e-12)
    assert weights.min() > 0.0
    assert weights.sum() == pytest.approx(1.0, rel=1e-14)
    for degree in range(2 * number - 2):
        mean = 1.0 / (degree + 1) if degree % 2 == 0 else 0.0
        # roots of the derivative of a polynomial of degree 63 lose some digits
        assert weights @ places**degree == pytest.approx(mean, abs=1e-14 if number < 20 else 1e-8)


@given(depth=st.floats(1e-7, 1e-4), rate=st.floats(-0.05, 0.05), number=st.integers(2, 9))
@pytest.mark.parametrize("law", NORMAL_LAWS, ids=lambda law: type(law).__name__)
def test_sections_at_equal_depth_add_up_to_the_law(
    law: NormalLaw, depth: float, rate: float, number: int
) -> None:
    _, weights = lobatto(number)
    parts = [PartOf(law=law, share=share) for share in weights.tolist()]
    impact = 0.05
    try:
        whole = law(depth, rate, impact), law.elastic_force(depth), law.elastic_energy(depth)
    except LoadError:
        assume(False)
    # rounding of a sum
    assert sum(part(depth, rate, impact) for part in parts) == pytest.approx(whole[0], rel=1e-12, abs=1e-9)
    assert sum(part.elastic_force(depth) for part in parts) == pytest.approx(whole[1], rel=1e-12)
    assert sum(part.elastic_energy(depth) for part in parts) == pytest.approx(whole[2], rel=1e-12)
    assert {part.largest_depth for part in parts} == {law.largest_depth}


@given(
    linkage=machines(),
    state=states(),
    place=st.floats(-0.1, 0.1),
    where=st.sampled_from([Attachment.CENTRES, Attachment.MIDDLE, Attachment.BORE]),
)
def test_a_section_has_the_distance_and_the_rate_of_both_its_centres(
    linkage: SpatialLinkage, state: tuple[np.ndarray, np.ndarray], place: float, where: Attachment
) -> None:
    position, velocity = state
    motion = SpatialMotion(linkage, position[None], coordinate_rates(position, velocity)[None])
    bearing = linkage.bearings["p"]
    ends = (
        BearingEnd("a", bearing.first_point, bearing.first_axis),
        BearingEnd("b", bearing.second_point, bearing.second_axis),
    )
    bore, journal = (motion.point(end.body, end.centre(place)) for end in ends)
    apart, rates = journal.position[0] - bore.position[0], journal.velocity[0] - bore.velocity[0]
    axes = motion.carried("a", bearing.first_axis)[0], motion.carried("b", bearing.second_axis)[0]
    assume(np.linalg.norm(axes[0] + axes[1]) > 0.1)
    found = section_motion(motion, *ends, place, where, False)
    x, y, vx, vy, bore_spin, journal_spin = (float(column[0]) for column in found[:6])
    spins = motion.spin("a")[0], motion.spin("b")[0]
    along = axes[0] if where is not Attachment.MIDDLE else sum(axes) / np.linalg.norm(sum(axes))
    assert bore_spin == pytest.approx(spins[0] @ axes[0], abs=1e-12)
    assert journal_spin - bore_spin == pytest.approx((spins[1] - spins[0]) @ along, abs=1e-12)
    if where is not Attachment.CENTRES:  # only what is across the axis counts
        apart, rates = apart - along * (along @ apart), rates - along * (along @ rates)
    assume(math.hypot(x, y) > 1e-3 and np.linalg.norm(apart - along * (along @ apart)) > 1e-3)
    assert math.hypot(x, y) == pytest.approx(np.linalg.norm(apart), rel=1e-11)
    # rounding, of a division by 1e-3
    assert (x * vx + y * vy) == pytest.approx(apart @ rates, abs=1e-10)
