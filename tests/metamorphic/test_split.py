"""A load in parts that add up to it, or a body in parts that weigh as much, changes nothing."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import AppliedForce, CubicStep, Load, Part, Roof, Scenario
from support_exudyn.machines.four_bar_shield import FourBarShield
from tests.metamorphic import drawn
from tests.metamorphic.same import Run, plain, run, scenes, told

SHARES = st.lists(drawn.between(-1.0, 2.0), min_size=1, max_size=2)  # of a force, all but the last
BODIES = ("rear_link", "front_link", "shield", "canopy")


def same_but_for_loads(one: Run, other: Scenario) -> None:
    """The machine moves as it did, and what presses on it adds up."""
    result = told(other)
    mine = {f"{name}." for name in one.result.scenario.loads}
    whole = {name: values for name, values in plain(result).items() if not name.startswith(tuple(mine))}
    one.check(whole)


# --- loads ---


@st.composite
def under_a_force(draw: st.DrawFn) -> Scenario:
    """A support with a force on its canopy."""
    scene = draw(drawn.in_bodies())
    at = scene.linkage.points["tip"]
    push = AppliedForce(
        body=at.body,
        point=at.point,
        full_force=(draw(drawn.between(-1e5, 1e5)), draw(drawn.between(-5e5, 1e5))),
        start=0.0015,
        end=draw(drawn.half_milliseconds(5, 20)),
    )
    return replace(scene, loads={"push": push})


@given(scene=under_a_force(), shares=SHARES, turned=drawn.between(-1.0, 1.0))
@scenes(8)
def test_a_force_in_parts(scene: Scenario, shares: list[float], turned: float) -> None:
    push = scene.loads["push"]
    assert isinstance(push, AppliedForce)
    x, y = push.full_force
    # parts in other directions, too; the last one is what is left
    parts = [(share * x - turned * y, share * y + turned * x) for share in shares]
    parts.append((x - sum(part[0] for part in parts), y - sum(part[1] for part in parts)))
    loads: dict[str, Load] = {f"part_{n}": replace(push, full_force=part) for n, part in enumerate(parts)}
    same_but_for_loads(run(scene), replace(scene, loads=loads))


@st.composite
def under_a_roof(draw: st.DrawFn) -> Scenario:
    """A support under a face that comes down."""
    scene = draw(drawn.in_bodies())
    at = scene.linkage.points["tip"]
    descent = CubicStep(
        stroke=draw(drawn.between(2e-3, 5e-3)), start=5e-4, end=draw(drawn.half_milliseconds(8, 20))
    )
    roof = Roof(
        body=at.body,
        point=at.point,
        descent=descent,
        stiffness=draw(drawn.between(2e7, 2e8)),
        gap=draw(drawn.between(0.0, 1e-3)),
        damping=draw(drawn.between(0.0, 2.0)),
    )
    return replace(scene, loads={"roof": roof})


@given(scene=under_a_roof(), share=drawn.between(0.1, 0.9))
@scenes(8)
def test_a_roof_in_parts(scene: Scenario, share: float) -> None:
    roof = scene.loads["roof"]
    assert isinstance(roof, Roof)
    loads: dict[str, Load] = {
        f"part_{n}": replace(roof, stiffness=part * roof.stiffness)
        for n, part in enumerate((share, 1.0 - share))
    }
    same_but_for_loads(run(scene), replace(scene, loads=loads))


# --- bodies ---


def halves(part: Part, share: float, direction: float, reach: float) -> tuple[Part, Part]:
    """Two parts with mass, centre and moments of one, `reach` times its radius of gyration apart."""
    apart = reach * math.sqrt(part.inertia / part.mass)
    way = np.array([math.cos(direction), math.sin(direction)]) * apart
    left = np.array(part.second_moments) - part.mass * share * (1.0 - share) * np.array(
        [way[0] ** 2, way[1] ** 2, way[0] * way[1]]
    )
    made = []
    for mass, offset in ((share, 1.0 - share), (1.0 - share, -share)):
        xx, yy, xy = (mass * left).tolist()
        x, y = np.array(part.centre) + offset * way
        made.append(
            Part(
                mass=mass * part.mass,
                centre=(float(x), float(y)),
                inertia=xx + yy,
                moments=(xx, yy, xy),
                name=part.name,
            )
        )
    return made[0], made[1]


def cut(scene: Scenario, body: str, share: float, direction: float) -> Scenario:
    """The heaviest part of a body in two."""
    machine = scene.machine
    assert isinstance(machine, FourBarShield)
    parts = list(machine.parts[body])
    heaviest = max(range(len(parts)), key=lambda n: parts[n].mass)
    whole = replace(parts[heaviest], moments=None)  # as of a disc, which can be cut along any line
    two = halves(whole, share, direction, 0.5)
    after = replace(machine, parts={**machine.parts, body: (*parts[:heaviest], *two, *parts[heaviest + 1 :])})
    return replace(scene, machine=after)


cuts = st.tuples(st.sampled_from(BODIES), drawn.between(0.2, 0.8), drawn.between(-3.0, 3.0))


@given(scene=drawn.in_general(), where=cuts)
@scenes(6)
def test_a_body_in_two_in_general(scene: Scenario, where: tuple[str, float, float]) -> None:
    run(scene).check(plain(told(cut(scene, *where))))


@given(scene=drawn.in_bodies(), where=cuts)
@scenes(6)
def test_a_body_in_two_of_bodies(scene: Scenario, where: tuple[str, float, float]) -> None:
    run(scene).check(plain(told(cut(scene, *where))))
