"""First run

The support rises while one pin has 1.5 mm of clearance. The picture shows the force in that pin and the path
of the canopy's tip.
"""

from matplotlib import pyplot as plt

from support_exudyn import ClearancePin, CubicStep, Scenario, machine, simulate

scenario = Scenario(
    machine=machine("reference"),
    pins={"rear_base": ClearancePin.simple(clearance=0.0015, bore_radius=0.0655, length=0.7, friction=0.25)},
    drive=CubicStep(stroke=0.5, start=0.5, end=2.5),
    duration=2.5,
)
result = simulate(scenario, accuracy="standard")

numbers = result.numbers(after=0.5)
for name in ("mean", "largest", "largest_time"):
    print(name, numbers[f"pin.rear_base.force.{name}"])
for onset in result.onsets["rear_base"][:3]:
    print(f"impact at {1e3 * onset.time:.2f} ms with {1e3 * onset.speed:.1f} mm/s")

# result.plot("pin.rear_base.force", after=0.5) draws one in a line
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
left.plot(result.time, 1e-3 * result["pin.rear_base.force"], linewidth=0.8)
left.set(xlabel="time [s]", ylabel="force in rear_base [kN]", ylim=(0, 200))
right.plot(1e3 * result["tip.x"], 1e3 * result["tip.y"])
right.set(xlabel="tip forward [mm]", ylabel="tip up [mm]")
figure.savefig("first_run.png", dpi=120)
