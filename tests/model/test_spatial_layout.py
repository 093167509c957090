"""From the plane and a width to a machine in space."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn import (
    Body,
    Crank,
    LinearActuator,
    Linkage,
    OilColumn,
    Part,
    Scenario,
    Slide,
    TracePoint,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
)
from support_exudyn.mechanics.kinetics import tensor
from support_exudyn.model.drives.drive import CubicStep
from support_exudyn.model.linkage import bar, check_moments, lumped, pinned, turned_moments
from support_exudyn.model.spatial_linkage import Bearing, SpatialBody, SpatialLinkage
from support_exudyn.model.to_space import Width, lift
from tests.cases.machine_cases import support as narrow_support
from user_forces import InputError

coordinates = st.floats(-2.0, 2.0)
points = st.tuples(coordinates, coordinates)
lengths = st.floats(0.05, 2.0)
REFERENCE = reference_support()
LINKAGE = REFERENCE.linkage()


@st.composite
def widths(draw: st.DrawFn) -> Width:
    pairs = draw(st.sets(st.sampled_from(["rear_link", "front_link"])))
    distance = draw(lengths)
    return Width(
        spreads={name: draw(lengths) for name in LINKAGE.bodies},
        pairs=dict.fromkeys(pairs, distance),
        actuators={name: draw(lengths) for name in draw(st.sets(st.sampled_from(sorted(LINKAGE.actuators))))},
        lengths={name: draw(lengths) for name in draw(st.sets(st.sampled_from(sorted(LINKAGE.pins))))},
        points={"tip": draw(lengths)} if draw(st.booleans()) else {},
    )


@given(width=widths())
def test_both_sides_add_up_to_the_plane(width: Width) -> None:
    space = lift(LINKAGE, width)
    for name, body in LINKAGE.bodies.items():
        sides = ("_left", "_right") if name in width.pairs else ("",)
        parts = [space.bodies[name + side] for side in sides]
        # rounding of sums of two
        assert sum(part.mass for part in parts) == pytest.approx(body.mass, rel=1e-14)
        assert sum(part.inertia[2] for part in parts) == pytest.approx(body.inertia, rel=1e-14)
        for part in parts:
            assert part.centre[:2] == body.centre
            assert np.linalg.eigvalsh(tensor(part)).min() > 0.0
        assert sum(part.centre[2] for part in parts) == 0.0
        # the second moment across the plane is that of the spread
        xx, yy, zz = (sum(part.inertia[k] for part in parts) for k in range(3))
        assert 0.5 * (xx + yy - zz) == pytest.approx(body.mass * width.spreads[name] ** 2, rel=1e-9)
    for name in LINKAGE.pins:
        bearings = space.parts_of_pin(name)
        assert sum(b.share for b in bearings.values()) == 1.0
        assert {b.length for b in bearings.values()} == {width.lengths.get(name, 0.0)}
    for name in LINKAGE.actuators:
        actuators = {key: c for key, c in space.actuators.items() if c.actuator == name}
        assert set(actuators) == ({f"{name}_left", f"{name}_right"} if name in width.actuators else {name})
        assert sum(c.share for c in actuators.values()) == 1.0
        for actuator in actuators.values():
            assert actuator.start_length == pytest.approx(LINKAGE.actuators[name].start_length, rel=1e-14)
    assert set(space.points) == {"tip"} | ({"tip_left", "tip_right"} if width.points else set())


def test_a_plate_has_the_inertia_of_a_plate() -> None:
    a, b, m = 0.7, 0.4, 6.0
    plate = bar(m, (0.0, 0.0), (a, 0.0))
    linkage = Linkage(
        bodies={"a": Body(mass=m, inertia=plate.inertia, centre=plate.centre, moments=plate.moments)}
    )
    body = lift(linkage, Width(spreads={"a": b / math.sqrt(12.0)})).bodies["a"]
    # m b^2/12 about x, m (a^2 + b^2)/12 about y, m a^2/12 about z
    assert body.inertia[:3] == pytest.approx((m * b**2 / 12, m * (a**2 + b**2) / 12, m * a**2 / 12), rel=1e-14)


BODY = Body(mass=1.0, inertia=1.0, centre=(0.0, 0.0))
ALL_WIDE = dict.fromkeys(LINKAGE.bodies, 0.1)
ONE_OF_TWO = Width(spreads={"a": 0.1}, pairs={"a": 0.2})
PIN = {"p": pinned("ground", "a", (0.0, 0.0))}
JACK = LinearActuator(foot="ground", head="a", foot_point=(0.0, -1.0), head_point=(0.0, 0.0))
NOT_LIFTED = {
    "width.spreads.rear_link: missing": (LINKAGE, Width()),
    "at different distances": (
        LINKAGE,
        Width(spreads=ALL_WIDE, pairs={"front_link": 0.4, "rear_link": 0.3, "shield": 0.3}),
    ),
    "actuators.front_column": (LINKAGE, Width(spreads=ALL_WIDE, pairs={"canopy": 0.4})),
    r"points\.t on a, which is a pair": (
        Linkage(bodies={"a": BODY}, pins=PIN, points={"t": TracePoint(body="a", point=(0.0, 0.0))}),
        ONE_OF_TWO,
    ),
    r"cranks\.c: not covered in space": (
        Linkage(bodies={"a": BODY}, pins=PIN, cranks={"c": Crank(body="a")}),
        ONE_OF_TWO,
    ),
    r"slides\.s: not covered in space": (
        Linkage(bodies={"a": BODY}, slides={"s": Slide(body="a", point=(0.0, 0.0))}),
        ONE_OF_TWO,
    ),
    r"actuators\.k on a, which is a pair": (Linkage(bodies={"a": BODY}, actuators={"k": JACK}), ONE_OF_TWO),
}


@pytest.mark.parametrize("said", NOT_LIFTED)
def test_what_cannot_be_lifted_is_said(said: str) -> None:
    with pytest.raises(InputError, match=said):
        lift(*NOT_LIFTED[said])


# --- second moments ---


@given(
    cloud=st.lists(points, min_size=3, max_size=8),
    masses=st.lists(st.floats(0.1, 10.0), min_size=8, max_size=8),
    angle=st.floats(-math.pi, math.pi),
)
def test_second_moments_are_those_of_a_cloud_of_points(
    cloud: list[tuple[float, float]], masses: list[float], angle: float
) -> None:
    parts = [Part(mass=m, centre=p) for m, p in zip(masses, cloud, strict=False)]
    whole = lumped(parts)
    m, p = np.array([part.mass for part in parts]), np.array(cloud)
    away = p - m @ p / m.sum()
    moments = np.einsum("n,ni,nj->ij", m, away, away)
    # rounding of coordinates up to 2 and 80 kg
    assert whole.second_moments == pytest.approx((moments[0, 0], moments[1, 1], moments[0, 1]), abs=1e-11)
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    expected = turn @ moments @ turn.T
    got = turned_moments(whole.second_moments, angle)
    assert got == pytest.approx((expected[0, 0], expected[1, 1], expected[0, 1]), abs=1e-11)
    # what has turned is still possible
    assume(whole.inertia > 1e-3)
    check_moments(got, whole.inertia)


@pytest.mark.parametrize("moments", [(1.0, 1.0, 0.0), (-1.0, 3.0, 0.0), (1.0, 1.0, 1.5), (0.5, 1.5, 0.9)])
def test_impossible_second_moments_are_refused(moments: tuple[float, float, float]) -> None:
    inertia = 2.0 if moments != (1.0, 1.0, 0.0) else 3.0
    kinds: tuple[Any, ...] = (Part, Body)
    for kind in kinds:
        with pytest.raises(InputError, match="moments"):
            kind(mass=1.0, centre=(0.0, 0.0), inertia=inertia, moments=moments)


# --- values ---


def test_impossible_bodies_and_bearings_are_refused() -> None:
    with pytest.raises(InputError, match="positive definite"):
        SpatialBody(mass=1.0, inertia=(1.0, 1.0, 1.0, 0.0, 0.0, 2.0), centre=(0.0, 0.0, 0.0))
    place = {"first_point": (0.0, 0.0, 0.0), "second_point": (0.0, 0.0, 0.0), "pin": "p"}
    with pytest.raises(InputError, match="length 1"):
        Bearing(first="ground", second="a", first_axis=(0.0, 1.0, 1.0), **place)
    with pytest.raises(InputError, match="twice"):
        Bearing(first="a", second="a", **place)
    with pytest.raises(InputError, match="no such body"):
        SpatialLinkage(bodies={}, bearings={"p": Bearing(first="ground", second="a", **place)})


# --- scenarios in space ---


def scenario(**changes: object) -> Scenario:
    fields: dict[str, object] = {"machine": REFERENCE, "duration": 1.0, "dimensions": 3}
    return Scenario(**fields | changes)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"machine": narrow_support()}, "dimensions = 3: HydraulicSupport: knows no lateral dimensions"),
        ({"machine": ravn_slider_crank()}, "dimensions = 3: SliderCrank: knows no lateral dimensions"),
        ({"formulation": "compiled"}, "formulation = 'compiled': is planar"),
        (
            {"drives": {"front_column_left": CubicStep(start=0.1, end=0.5, stroke=0.01)}},
            "drives.front_column_left: is not the drive of front_column_right, .*allowed for a pair of rigid",
        ),
        ({"actuators": {"front_column_left": cylinders_and_rods()["front_column"]}}, "unknown actuator"),
        ({"channels": ("tip_middle.z",)}, "tip_middle"),
    ],
)
def test_what_is_not_covered_in_space_is_said(changes: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        scenario(**changes)


def test_ideal_bearings_have_to_fit_at_the_start() -> None:
    from tests.cases.spatial_cases import InSpace

    body = SpatialBody(mass=1.0, inertia=(1.0, 1.0, 1.0, 0.0, 0.0, 0.0), centre=(0.0, 0.0, 0.0))
    for changes, said in (
        ({"second_point": (0.0, 0.0, 0.1)}, "0.1 m apart"),
        ({"second_axis": (0.0, 0.6, 0.8)}, "tilted by"),
    ):
        place = {"first_point": (0.0, 0.0, 0.0), "second_point": (0.0, 0.0, 0.0)} | changes
        bearing = Bearing(first="ground", second="a", pin="p", **place)
        with pytest.raises(InputError, match=said):
            scenario(machine=InSpace(space=SpatialLinkage(bodies={"a": body}, bearings={"p": bearing})))


def test_refining_in_space_refines_sections_too() -> None:
    one = scenario()
    assert one.refined().solver.sections == 9  # half as far apart: 4 gaps become 8
    assert one.refined(4).solver.sections == 17
    assert one.refined(19).solver.sections == 64  # the most there can be
    assert one.refined(0.1).solver.sections == 2
    assert scenario(dimensions=2).refined().solver.sections == one.solver.sections


def test_oil_of_each_actuator_of_a_pair_has_to_reach() -> None:
    oil = OilColumn(bore_area=0.1, oil_length=0.02, bulk_modulus=1.5e9)
    lowered = {"front_column_right": CubicStep(start=0.1, end=0.5, stroke=-0.03)}
    with pytest.raises(InputError, match=r"actuators\.front_column_right\.oil_length = 0\.02 m"):
        scenario(actuators={"front_column": oil}, drives=lowered)
