"""Four-, six- and eight-bars that are drawn: chains of bars, some of their pins with clearance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from support_exudyn import (
    AppliedForce,
    AppliedTorque,
    Crank,
    CubicStep,
    Drive,
    HarmonicCourse,
    Held,
    PlanarLinkage,
    Scenario,
    SolverSettings,
    SpringDamper,
    Steady,
    TorsionSpring,
    TracePoint,
)
from support_exudyn.mechanics.postures import set_moving
from support_exudyn.model.linkage import GROUND, Linkage
from tests.drawn.drawn_linkages import chain
from tests.metamorphic.drawn import GRAVITY, IMPACT_STEPS, MS, TOLERANCE, between, with_clearance

SIZE = 0.5  # of the linkage [m]
RADIUS, STIFFNESS = 0.01, 1e9  # of bores [m], of contacts [N/m^1.5]


@st.composite
def chains(draw: st.DrawFn) -> Linkage:
    """A chain of one freedom, of two, four or six bars on a crank."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    found = chain(rng, draw(st.integers(1, 3)), SIZE)
    bodies = {name: replace(body, mass=m, inertia=m * body.inertia) for name, body in found.bodies.items()
              for m in (draw(between(0.5, 4.0)),)}  # fmt: skip
    name = list(bodies)[-1]
    return replace(found, bodies=bodies, points={"end": TracePoint(body=name, point=bodies[name].centre)})


def opening_pins(linkage: Linkage) -> list[str]:
    """One pin of each loop: those that join two bars, without which a tree is left."""
    joined = {GROUND}
    opening = []
    places = dict(linkage.pins)
    while places:
        # a pin of something that is joined to something that is not, or else one that closes a loop
        ends = {name: (pin.first in joined) + (pin.second in joined) for name, pin in places.items()}
        name = next((one for one, count in ends.items() if count == 1), None)
        if name is None:
            opening += [one for one, count in ends.items() if count == 2]
            break
        pin = places.pop(name)
        joined |= {pin.first, pin.second}
    return opening


@st.composite
def driven(draw: st.DrawFn, from_rest: bool = False) -> Scenario:
    """A chain whose crank a drive turns, up to two pins of which have clearance; Exudyn formulation.

    from_rest: without weight, by a drive that begins smoothly.
    """
    linkage = draw(chains())
    rate = draw(between(2.0, 20.0)) * draw(st.sampled_from((1.0, -1.0)))
    smooth = CubicStep(stroke=0.02 * rate, start=0.0, end=0.04)
    drive: Drive = smooth if from_rest else draw(st.sampled_from((Steady(rate=rate), smooth)))
    if not from_rest and draw(st.integers(0, 4)) == 0:  # nobody drives it
        machine = PlanarLinkage(drawing=set_moving(linkage, {"crank": rate}))
        drive = Held()
    else:
        machine = PlanarLinkage(drawing=replace(linkage, cranks={"crank": Crank(body="crank")}))
    chosen = draw(st.lists(st.sampled_from(list(linkage.pins)), max_size=2, unique=True))
    return Scenario(
        machine=machine,
        pins={pin: draw(with_clearance(RADIUS, STIFFNESS, False, apart=False)) for pin in chosen},
        drive=drive,
        duration=MS * draw(st.integers(8, 15)),
        record_period=MS,
        step=1e-4,
        gravity=(0.0, 0.0) if from_rest else draw(st.sampled_from(((0.0, 0.0), GRAVITY))),
        formulation="exudyn",
        solver=SolverSettings(impact_steps=IMPACT_STEPS),
    )


@st.composite
def sprung(draw: st.DrawFn) -> Scenario:
    """The same with a spring and a damper, a torsion spring and a torque between two bars, and a force."""
    scene = draw(driven())
    bodies = scene.linkage.bodies
    first, *_, last = bodies
    ends = bodies[last].centre, bodies[first].centre
    apart = float(np.hypot(ends[0][0] - ends[1][0], ends[0][1] - ends[1][1]))
    spring = SpringDamper(
        body=last,
        point=ends[0],
        other=first,
        other_point=(ends[1][0] + 0.1 * SIZE, ends[1][1]),
        stiffness=draw(between(1e2, 1e4)),
        free_length=apart * draw(between(0.5, 1.5)),
        damping=draw(between(0.0, 50.0)),
    )
    coil = TorsionSpring(
        body=last, other=first, stiffness=draw(between(1.0, 100.0)), free_turn=draw(between(-1.0, 1.0))
    )
    motor = AppliedTorque(
        body=last,
        full_torque=draw(between(-10.0, 10.0)),
        course=HarmonicCourse(period=draw(between(0.01, 0.1))),
    )
    push = AppliedForce(body=last, point=ends[0], full_force=(draw(between(-50.0, 50.0)), 20.0))
    return replace(scene, loads={"spring": spring, "coil": coil, "motor": motor, "push": push})


@st.composite
def opened(draw: st.DrawFn) -> Scenario:
    """A chain that nobody drives, with clearance in one pin of every loop."""
    linkage = draw(chains())
    rate = draw(between(2.0, 20.0)) * draw(st.sampled_from((1.0, -1.0)))
    return Scenario(
        machine=PlanarLinkage(drawing=set_moving(linkage, {"crank": rate})),
        pins={
            pin: draw(with_clearance(RADIUS, STIFFNESS, False, apart=False)) for pin in opening_pins(linkage)
        },
        duration=MS * draw(st.integers(8, 15)),
        record_period=MS,
        step=1e-4,
        formulation="compiled",
        solver=SolverSettings(tolerance=TOLERANCE, impact_steps=IMPACT_STEPS),
    )
