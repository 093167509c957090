"""Clearance sizes

Four clearances side by side. The tip moves to the rear in proportion to the clearance. The line begins at the
ideal pin: a pin along its length is pressed in by some 0.02 mm only.
"""

from matplotlib import pyplot as plt

from support_exudyn import simple_scenario, simulate

SIZES = (0.0, 0.5, 1.0, 1.5, 2.0)  # [mm]; without clearance a pin is ideal

places = []
for size in SIZES:
    scenario = simple_scenario(
        "reference",
        pins={"rear_base": {"clearance_mm": size}},
        drive={"mode": 2, "stroke_mm": 100, "start_s": 0, "end_s": 0.5},
        duration_s=0.5,
        start="settled",
        accuracy="draft",
    )
    place = simulate(scenario).numbers()["tip.x.mean"]
    print(f"{size} mm: tip at {place}")
    places.append(place.value)
shifts = [1e3 * (place - places[0]) for place in places]

figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
axes.plot(SIZES[1:], shifts[1:], "o-", label="with clearance")
axes.plot(SIZES[0], shifts[0], "s", label="ideal pin")
axes.legend()
axes.set(xlabel="clearance [mm]", ylabel="mean shift of the tip [mm]")
figure.savefig("clearance_sizes.png", dpi=120)
