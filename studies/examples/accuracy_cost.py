"""An accuracy, and what it costs

The same rise to three accuracies. The picture shows the estimated error of the mean force, and beside it the
time that all runs took.
"""

from time import perf_counter

from matplotlib import pyplot as plt

from support_exudyn import simple_scenario, simulate

ASKED = (1e-2, 1e-3, 1e-5)  # "draft", "standard", "reference"

scenario = simple_scenario(
    "reference",
    pins={"rear_base": {"clearance_mm": 1.5, "friction": 0.25}},
    drive={"mode": 2, "start_s": 3, "end_s": 5},
    duration_s=5,
)
simulate(scenario, accuracy=ASKED[0])  # compiles, the first time
took, errors = [], []
for accuracy in ASKED:
    began = perf_counter()
    result = simulate(scenario, accuracy=accuracy)
    took.append(perf_counter() - began)
    mean = result.numbers(after=3.0)["pin.rear_base.force.mean"]
    errors.append(mean.error / mean.value)
    print(f"{accuracy:g}: {mean}, met: {result.met}, {took[-1]:.2f} s")

figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
axes.loglog(ASKED, ASKED, "--", label="as asked")
axes.loglog(ASKED, errors, "o", label="estimated")
for asked, error, seconds in zip(ASKED, errors, took, strict=True):
    axes.annotate(f"{seconds:.2f} s", (asked, error), xytext=(6, 6), textcoords="offset points")
axes.set(xlabel="accuracy that is asked for", ylabel="relative error of the mean force")
axes.margins(0.2)
axes.legend()
figure.savefig("accuracy_cost.png", dpi=120)
