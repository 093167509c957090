"""A law of one's own

A normal law is a damping factor, a friction law a function of numbers, and a pin takes them as any other.
Scenario files name them by file and class: `law = "own_law.py:SoftLanding"`, and `--import own_law.py` allows
it. `support-exudyn init own_law` writes such files.
"""

from matplotlib import pyplot as plt

from support_exudyn import ClearancePin, CubicStep, Scenario, machine, simulate, value
from user_forces import LankaraniNikravesh, PowerLaw, friction_law


@value
class SoftLanding(PowerLaw):
    """F = K depth^n (1 + chi rate / v0), chi = (1 - e) / e."""

    def factor(self, restitution: float) -> float:
        """chi."""
        return (1.0 - restitution) / restitution


@friction_law
def rounded_coulomb(slip: float, normal_force: float, coefficient: float, smoothing: float = 0.001) -> float:
    """F_t = -mu F_n v / (|v| + v_s); coefficient: mu, smoothing: v_s [m/s]."""
    return -coefficient * normal_force * slip / (abs(slip) + smoothing)


figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for law in (SoftLanding, LankaraniNikravesh):
    friction = rounded_coulomb(coefficient=0.2)
    pin = ClearancePin.simple(clearance=0.0015, bore_radius=0.0655, restitution=0.6, law=law, friction=friction)
    scenario = Scenario(
        machine=machine("reference"),
        pins={"rear_base": pin},
        drive=CubicStep(stroke=0.005, start=0.0, end=0.2),
        duration=0.2,
        record_period=1e-4,
    )
    result = simulate(scenario, accuracy="draft")
    axes.plot(1e3 * result.time, 1e-3 * result["pin.rear_base.force"], linewidth=0.8, label=law.__name__)
    print(law.__name__, result.numbers()["pin.rear_base.largest_force"])
axes.set(xlabel="time [ms]", ylabel="pin force [kN]")
axes.legend()
figure.savefig("own_law.png", dpi=120)
