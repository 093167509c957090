"""Linkages of any kind: what a check says, and a turn or a rise

Six machines that come with the package as files of `kind = "linkage"`. Each is checked and moved: a crank turns
right round, cylinders go out; lines join the pins of every body, from the start (dark) on. Nobody drives the
slider-crank, which goes on as it started.
"""

import numpy as np
from matplotlib import pyplot as plt

from support_exudyn import CubicStep, Held, Result, Scenario, Steady, simulate
from support_exudyn.files.machines import shipped
from support_exudyn.machines.check import check_machine

TURN = Steady(rate=2.0 * np.pi)
MOVES = {
    "crank_rocker": TURN,
    "watt_six_bar": TURN,
    "toggle_press": TURN,
    "slider_crank_guide": None,
    "excavator_bucket": CubicStep(stroke=0.25, start=0.0, end=1.0),
    "velenje_shield": CubicStep(stroke=0.5, start=0.0, end=1.0),
}


def lines(result: Result, body: str, record: int) -> np.ndarray:
    """The points of a body at which something is joined, at a record, once round."""
    linkage = result.scenario.linkage
    ends = [
        end for p in linkage.pins.values() for end in ((p.first, p.first_point), (p.second, p.second_point))
    ]
    ends += [
        end for a in linkage.actuators.values() for end in ((a.foot, a.foot_point), (a.head, a.head_point))
    ]
    ends += [(point.body, point.point) for point in linkage.points.values()]
    points = np.array([point for name, point in ends if name == body]) - linkage.bodies[body].centre
    turn = result[f"{body}.angle"][record] - linkage.bodies[body].angle
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    placed = points @ rotation.T + (result[f"{body}.x"][record], result[f"{body}.y"][record])
    return np.vstack([placed, placed[:1]])


figure, panels = plt.subplots(2, 3, figsize=(11, 6.4), layout="constrained")
for axes, (name, drive) in zip(panels.flat, MOVES.items(), strict=True):
    data = shipped(name)
    print(name, *check_machine(data).facts, sep="\n  ")
    duration = 0.04 if drive is None else 1.0
    scenario = Scenario(
        machine=data.machine, drive=drive or Held(), duration=duration, step=5e-4, record_period=duration / 100
    )
    result = simulate(scenario)
    for place, record in enumerate((0, 25, 50, 75)):
        for body in result.scenario.linkage.bodies:
            axes.plot(
                *lines(result, body, record).T, ".-", color=plt.get_cmap("viridis")(0.3 * place), linewidth=1.2
            )
    axes.set(title=name, aspect="equal", xlabel="x [m]", ylabel="y [m]")
figure.savefig("any_linkage.png", dpi=120)
