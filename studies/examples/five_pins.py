"""Five clearance pins: which hits hardest

All five pins have 1 mm of clearance. The table tells of each pin its fastest impact, its largest force at any
step of the run, and when that was.
"""

from matplotlib import pyplot as plt

from support_exudyn import CubicStep, machine, simple_scenario, simulate

pins = machine("reference").linkage().pins  # radii of bores and lengths come from the machine's file
scenario = simple_scenario(
    "reference",
    pins={name: {"clearance_mm": 1.0, "restitution": 0.7} for name in pins},
    drive=CubicStep(stroke=0.002, start=0.0, end=0.16),
    duration_s=0.16,
    record_period_s=1e-4,
)
result = simulate(scenario)

hardest = max(result.largest_force, key=lambda name: result.largest_force[name])
figure, axes = plt.subplots(figsize=(7, 3.4), layout="constrained")
for name, onsets in result.onsets.items():
    first = max(onsets, key=lambda onset: onset.speed)
    peak, when = 1e-3 * result.largest_force[name], 1e3 * result.largest_force_time[name]
    print(
        f"{name}: fastest of the first impacts {1e3 * first.speed:.0f} mm/s at {1e3 * first.time:.1f} ms, "
        f"largest force {peak:.0f} kN at {when:.1f} ms"
    )
    force = 1e-3 * result[f"pin.{name}.force"]
    axes.plot(1e3 * result.time, force, linewidth=2 if name == hardest else 0.7, label=name)
axes.set(xlabel="time [ms]", ylabel="pin force [kN]", title=f"{hardest} hits hardest")
axes.legend(fontsize="small")
figure.savefig("five_pins.png", dpi=120)
