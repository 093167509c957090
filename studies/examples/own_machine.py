"""A machine of one's own

A four-bar crank-rocker with 0.2 mm of clearance between coupler and rocker. `support-exudyn init own_machine`
writes the same with scenario files.
"""

from dataclasses import replace
from math import acos, atan2, cos, hypot, pi, sin

from matplotlib import pyplot as plt

from support_exudyn import (
    Body,
    ClearancePin,
    Crank,
    Linkage,
    Machine,
    PinPlace,
    Scenario,
    Steady,
    simulate,
    value,
)

A, D, CRANK, COUPLER, ROCKER = (0.0, 0.0), (0.28, 0.0), 0.10, 0.25, 0.20  # [m]


def bar(a: tuple[float, float], b: tuple[float, float]) -> Body:
    """A uniform bar of 2 kg/m."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    mass, centre = 2.0 * length, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    return Body(mass=mass, inertia=mass * length**2 / 12, centre=centre, angle=atan2(b[1] - a[1], b[0] - a[0]))


@value
class FourBar(Machine):
    """Crank AB, coupler BC, rocker DC; start_angle: of the crank [rad]."""

    start_angle: float = 1.0

    def linkage(self) -> Linkage:
        """The start posture."""
        b = (CRANK * cos(self.start_angle), CRANK * sin(self.start_angle))
        across = hypot(D[0] - b[0], D[1] - b[1])
        opening = acos((COUPLER**2 + across**2 - ROCKER**2) / (2 * COUPLER * across))
        turn = atan2(D[1] - b[1], D[0] - b[0]) + opening
        c = (b[0] + COUPLER * cos(turn), b[1] + COUPLER * sin(turn))
        places = {"A": ("ground", "crank", A), "B": ("crank", "coupler", b)}
        places |= {"C": ("coupler", "rocker", c), "D": ("ground", "rocker", D)}
        return Linkage(
            bodies={"crank": bar(A, b), "coupler": bar(b, c), "rocker": bar(D, c)},
            pins={
                n: PinPlace(first=f, second=s, first_point=p, second_point=p) for n, (f, s, p) in places.items()
            },
            cranks={"crank": Crank(body="crank")},
        )


ideal = Scenario(machine=FourBar(), drive=Steady(rate=2 * pi), duration=0.3, record_period=2e-4)
pin = ClearancePin.simple(clearance=0.0002, bore_radius=0.01, stiffness=1e9, restitution=0.5)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for name, pins in {"0.2 mm of clearance": {"C": pin}, "ideal": {}}.items():
    result = simulate(replace(ideal, pins=pins), accuracy="draft")
    axes.plot(result.time, result["pin.C.force"], linewidth=0.8, label=name)
    print(name, result.numbers()["pin.C.force.mean"])
axes.set(xlabel="time [s]", ylabel="force in pin C [N]", ylim=(0, 40))
axes.legend()
figure.savefig("own_machine.png", dpi=120)
