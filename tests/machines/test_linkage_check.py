"""What `check` says of any linkage: against closed forms of four-bars, slider-cranks and parallelograms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from support_exudyn.machines.check import CheckReport, check_machine
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.planar_linkage import PlanarLinkage
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.linkage import GROUND, Body, Crank, LinearActuator, Linkage, Slide, pinned
from support_exudyn.model.loads.applied import AppliedForce, AppliedTorque
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.loads.springs import SpringDamper, TorsionSpring
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.linkage_check import check_figure
from tests.drawn.drawn_linkages import bar_of, towards
from tests.linkages import four_bar
from tests.often import often
from user_forces import InputError

CRANK_ROCKER = 0.1, 0.4, 0.3, 0.35
DOUBLE_ROCKER = 0.3, 0.2, 0.3, 0.45


def driven(linkage: Linkage, *cranks: str) -> Linkage:
    return replace(linkage, cranks={name: Crank(body=name) for name in cranks})


def checked(linkage: Linkage, stroke: float | None = None) -> CheckReport:
    return check_machine(MachineData(PlanarLinkage(drawing=linkage), "tried", kind="linkage"), stroke)


def corner(one: float, other: float, opposite: float) -> float:
    """Angle between two sides of a triangle, by the third [rad]."""
    return math.acos((one**2 + other**2 - opposite**2) / (2.0 * one * other))


def told(report: CheckReport, drive: str, what: str) -> list[tuple[float, str, str]]:
    """Points of a way: angle [degrees] or length [mm], part and what lies in line."""
    (way,) = (one for one in report.ways if one.drive == drive)
    return [(way.shown(one.travel), one.part, one.why) for one in way.points if one.what == what]


# --- the way of a drive ---


@pytest.mark.parametrize("start", [0.0, 60.0, -170.0])
def test_a_rocker_turns_back_where_crank_and_coupler_lie_in_line(start: float) -> None:
    a, b, c, g = CRANK_ROCKER
    report = checked(driven(four_bar(a, b, c, g, start), "crank"))
    assert "crank: turns right round, without a dead centre" in report.facts
    stretched, folded = corner(b + a, g, c), corner(b - a, g, c) + math.pi
    found = {round(math.remainder(degrees - start, 360.0) % 360.0, 6): why for degrees, _, why in told(
        report, "crank", "turns back")}  # fmt: skip
    expected = [round((math.degrees(angle) - start) % 360.0, 6) for angle in (stretched, folded)]
    assert sorted(found) == pytest.approx(sorted(expected), abs=1e-5)
    assert set(found.values()) == {"crank in line with coupler"}


def test_dead_centres_of_a_double_rocker() -> None:
    a, b, c, g = DOUBLE_ROCKER
    report = checked(driven(four_bar(a, b, c, g), "crank"))
    limit = math.degrees(corner(a, g, b + c))
    found = told(report, "crank", "dead centre")
    assert [one[0] for one in found] == pytest.approx([-limit, limit], abs=1e-6)
    assert {one[2] for one in found} == {"coupler in line with rocker"}
    assert f"crank at {limit:.2f} degrees: dead centre: coupler in line with rocker" in report.warnings[1]
    # no force is told where it has no bound
    assert all(abs(one["cranks_N_m"]["crank"]) < 100.0 for one in report.numbers["stations"])


@settings(max_examples=often(8), deadline=None)
@given(lengths=st.tuples(*[st.floats(0.15, 0.5)] * 4), degrees=st.floats(-170.0, 170.0))
def test_ends_of_the_way_of_any_four_bar(lengths: tuple[float, float, float, float], degrees: float) -> None:
    """By the triangle of coupler, rocker and the way from crank pin to rocker pivot."""
    a, b, c, g = lengths
    reach = math.dist(towards(degrees, a), (g, 0.0))
    margin = 0.03
    if not abs(b - c) + margin < reach < b + c - margin:
        return
    if min(abs(abs(a - g) - abs(b - c)), abs(a + g - b - c), abs(a - g)) < margin:
        return  # next to a change point
    report = checked(driven(four_bar(a, b, c, g, degrees), "crank"))
    (way,) = report.ways
    outer = corner(a, g, b + c) if a + g > b + c else None
    inner = corner(a, g, abs(b - c)) if abs(a - g) < abs(b - c) else None
    angle = abs(math.radians(degrees))
    limits = {round(one, 6) for one in (outer, inner) if one is not None}
    if not limits:
        assert way.right_round
        return
    found = {round(abs(math.remainder(math.radians(way.shown(end)), 2.0 * math.pi)), 6) for end in way.ends}
    assert sorted(found) == pytest.approx(sorted(limits), abs=2e-6)
    assert (inner or 0.0) <= angle <= (outer or math.pi)


def test_transmission_angles_are_those_of_the_triangle() -> None:
    a, b, c, g = CRANK_ROCKER
    report = checked(driven(four_bar(a, b, c, g), "crank"))
    (found,) = report.transmission["crank"]
    assert (found.pin, found.coupler, found.output) == ("B", "coupler", "rocker")
    assert found.least[1] == pytest.approx(corner(b, c, g - a), abs=1e-9)
    assert found.largest[1] == pytest.approx(corner(b, c, g + a), abs=1e-9)
    assert "40 to 140 degrees are usual" in report.warnings[0]  # it is 38.6 degrees
    for moved, angle in zip(report.ways[0].moved, found.angles, strict=True):
        apart = math.dist(towards(60.0 + math.degrees(moved.travel), a), (g, 0.0))
        assert angle == pytest.approx(corner(b, c, apart), abs=1e-9)


def boom() -> Linkage:
    """A boom on a cylinder, a stick on another, and at its end a bucket moved by a third through two links."""
    p, k, s, head, foot = (0.0, 0.0), (2.6, 1.3), (4.6, 0.4), (1.4, 1.15), (0.4, -0.3)
    seat, horn, r, t, u = (1.5, 1.6), (2.75, 1.75), (4.3, 0.75), (4.75, 0.95), (5.0, 0.6)

    def plate(mass: float, a: tuple[float, float], b: tuple[float, float]) -> Body:
        return bar_of(a, b, mass)

    return Linkage(
        bodies={
            "boom": plate(900.0, p, k),
            "stick": plate(400.0, k, s),
            "bell": plate(40.0, r, t),
            "link": plate(30.0, t, u),
            "bucket": plate(350.0, s, (5.1, -0.6)),
        },
        pins={
            "P": pinned(GROUND, "boom", p),
            "K": pinned("boom", "stick", k),
            "S": pinned("stick", "bucket", s),
            "R": pinned("stick", "bell", r),
            "T": pinned("bell", "link", t),
            "U": pinned("link", "bucket", u),
        },
        actuators={
            "lift": LinearActuator(foot=GROUND, head="boom", foot_point=foot, head_point=head),
            "crowd": LinearActuator(foot="boom", head="stick", foot_point=seat, head_point=horn),
            "curl": LinearActuator(foot="stick", head="bell", foot_point=(3.0, 1.75), head_point=t),
        },
    )


@pytest.fixture(scope="module")
def excavator() -> CheckReport:
    return checked(boom())


def test_each_cylinder_of_several_has_its_way_with_the_others_held(excavator: CheckReport) -> None:
    report = excavator
    assert [way.drive for way in report.ways] == ["lift", "crowd", "curl"]
    shortest = math.hypot(1.4, 1.15) - math.hypot(0.4, 0.3)
    assert told(report, "lift", "dead centre") == [
        (pytest.approx(1e3 * shortest, abs=1e-5), "", "boom in line with lift")
    ]
    knee, seat, horn = (2.6, 1.3), (1.5, 1.6), (2.75, 1.75)
    longest = math.dist(knee, seat) + math.dist(knee, horn)
    ((length, _, why),) = told(report, "crowd", "dead centre")
    assert length == pytest.approx(1e3 * longest, abs=1e-5)
    assert why == "stick in line with crowd"
    assert {one.output for one in report.transmission["curl"]} == {"bucket"}
    assert report.transmission["lift"] == []
    assert "the way of each is that with the others held" in report.notes[0]
    with pytest.raises(InputError, match="no single actuator drives"):
        checked(boom(), 0.1)


# --- loads ---

LOADS: dict[str, ActingLoad] = {
    "spring": SpringDamper(
        body="rocker", point=(0.4, 0.2), other_point=(0.6, 0.1), stiffness=500.0, free_length=0.1, damping=50.0
    ),
    "between": SpringDamper(
        body="crank", point=(0.05, 0.08), other="coupler", other_point=(0.2, 0.2), stiffness=900.0
    ),
    "twist": TorsionSpring(body="coupler", other="crank", stiffness=3.0, free_turn=0.4),
    "push": AppliedForce(body="coupler", point=(0.3, 0.3), full_force=(-30.0, -10.0), start=1.0, end=2.0),
    "turn": AppliedTorque(body="rocker", full_torque=4.0),
}


def test_the_moment_on_a_crank_is_what_its_energy_grows_by() -> None:
    """Virtual work: energy of weight and springs, less the work of forces, along the way of the crank."""
    linkage = driven(four_bar(*CRANK_ROCKER), "crank")
    machine = PlanarLinkage(drawing=linkage, acting=LOADS)
    report = check_machine(MachineData(machine, "loaded", kind="linkage"))
    assert "under weight and spring, between, twist, push and turn" in report.facts[-1]
    kinetics, moved = kinetics_of(linkage), report.ways[0].moved

    def energy(position: np.ndarray) -> float:
        def at(body: str, point: tuple[float, float]) -> np.ndarray:
            return kinetics.point(position, body, point)[0]

        weight = sum(9.81 * body.mass * at(name, body.centre)[1] for name, body in linkage.bodies.items())
        spring = math.dist(at("rocker", (0.4, 0.2)), (0.6, 0.1)) - 0.1
        between = math.dist(at("crank", (0.05, 0.08)), at("coupler", (0.2, 0.2)))
        crank, coupler, rocker = position[2::3]
        twist = coupler - crank - 0.4
        push = np.array([-30.0, -10.0]) @ at("coupler", (0.3, 0.3))
        stored = 250.0 * spring**2 + 450.0 * between**2 + 1.5 * twist**2
        return float(weight + stored - push - 4.0 * rocker)

    energies = np.array([energy(one.position) for one in moved])
    moments = np.array([one.forces.cranks["crank"] for one in moved])
    travel = np.array([one.travel for one in moved])
    slope = CubicSpline(travel, energies).derivative()(travel)
    np.testing.assert_allclose(moments[2:-2], slope[2:-2], atol=2e-3 * np.abs(slope).max())
    with style.look():
        check_figure(report).canvas.draw()


def with_an_arm() -> Linkage:
    """A crank-rocker with an arm that is free to turn about the pin of coupler and rocker."""
    linkage = driven(four_bar(*CRANK_ROCKER), "crank")
    b = linkage.pins["B"].first_point
    return replace(
        linkage,
        bodies={**linkage.bodies, "arm": bar_of(b, (b[0] + 0.2, b[1]))},
        pins={**linkage.pins, "D": pinned("rocker", "arm", b)},
    )


# --- freedoms ---


def parallelogram(degrees: float = 60.0) -> Linkage:
    """Three equal bars side by side under one coupler: one of them is more than needed."""
    linkage = driven(four_bar(0.2, 0.5, 0.2, 0.5, degrees), "crank")
    top = towards(degrees, 0.2, (0.25, 0.0))
    return replace(
        linkage,
        bodies={**linkage.bodies, "third": bar_of((0.25, 0.0), top)},
        pins={
            **linkage.pins,
            "D": pinned(GROUND, "third", (0.25, 0.0)),
            "E": pinned("coupler", "third", top),
        },
    )


def test_a_bar_too_many_is_told_and_moves_all_the_same() -> None:
    report = checked(parallelogram())
    assert report.numbers["degrees_of_freedom"] == {"counted": 0, "free": 1, "driven": 1, "left": 0}
    assert report.warnings[0].startswith(
        "pins.O, pins.A, pins.B, pins.C, pins.D and pins.E: one of their 12 conditions repeats the others"
    )
    assert report.ways[0].right_round
    assert [one[0] for one in told(report, "crank", "change point")] == pytest.approx([180.0, 360.0], abs=1e-4)
    for one in report.ways[0].moved:
        turns = one.position[2::3]
        assert turns == pytest.approx([one.travel, 0.0, one.travel, one.travel], abs=1e-5)


def test_a_free_crank_moves_freely_and_is_not_warned_of() -> None:
    report = checked(four_bar(*CRANK_ROCKER))
    assert report.warnings == []
    said = report.facts[-1]
    assert said.startswith("it moves freely in one way: crank turns about pin O, coupler turns about (")
    assert said.endswith("mm, rocker turns about pin C")
    # the coupler turns about where the lines of crank and rocker meet
    x, y = map(float, said.partition("coupler turns about (")[2].partition(")")[0].split(", "))
    crank, rocker = (report.linkage.bodies[name].angle for name in ("crank", "rocker"))
    pole = np.linalg.solve(
        [[math.sin(crank), -math.cos(crank)], [math.sin(rocker), -math.cos(rocker)]],
        [0.0, 350.0 * math.sin(rocker)],
    )
    assert (x, y) == pytest.approx(tuple(pole), rel=1e-3)


def test_a_freedom_too_many_is_told_with_what_moves() -> None:
    arm = with_an_arm()
    (said,) = checked(arm).warnings
    assert said.startswith("1 degree of freedom is left with all driven parts held: arm turns about pin D;")
    loose = replace(arm, bodies={**arm.bodies, "plate": bar_of((1.0, 0.0), (1.0, 1.0))})
    assert "bodies.plate: nothing joins it to the ground" in checked(loose).warnings


# --- all of it ---


@pytest.mark.parametrize("length", [0.7, 1.9])
def test_a_mass_on_an_upright_guide_over_a_jack_has_no_dead_centre(length: float) -> None:
    linkage = Linkage(
        bodies={"head": Body(mass=1e4, inertia=100.0, centre=(0.0, length))},
        slides={"upright": Slide(body="head", point=(0.0, length), direction=0.5 * math.pi)},
        actuators={
            "jack": LinearActuator(foot=GROUND, head="head", foot_point=(0.0, 0.0), head_point=(0.0, length))
        },
    )
    report = checked(linkage)
    assert report.warnings == []
    (way,) = report.ways
    assert way.ends == pytest.approx((-0.3 * length, 0.3 * length))
    assert not way.locks
    check_figure(report)  # it has no pins, whose forces would be drawn


def test_two_cranks_that_fight_are_told() -> None:
    report = checked(driven(four_bar(*CRANK_ROCKER), "crank", "rocker"))
    assert report.warnings[0].startswith("cranks.crank and cranks.rocker: one drive too many")
    assert report.ways == []
