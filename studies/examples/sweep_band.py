"""Sweep over distributions, and a band

Restitution and friction are uncertain. Eighty runs are drawn from their distributions. Percentiles, each with
its confidence interval, tell how large the force may get, and a ranking which of the two matters more. In a
terminal: `support-exudyn sweep sweep.toml`, and then `show`, `chart` and `table` with its folder.
"""

from pathlib import Path

from support_exudyn.postprocessing.figures.style import look
from support_exudyn.postprocessing.figures.sweeps import histogram
from support_exudyn.sweeps import read_sweep, read_table, sweep
from support_exudyn.sweeps.statistics import percentiles, ranking

SCENARIO = """
machine = "reference"
duration_s = 0.1
record_period_ms = 0.1
accuracy = "draft"

[drive]
mode = 2
stroke_mm = 1
start_s = 0
end_s = 0.1

[pins.rear_base]
clearance_mm = 1.5
"""
SWEEP = """
scenario = "fall.toml"
method = "latin_hypercube"
samples = 80
seed = 1

[vary]
"pins.rear_base.restitution" = { distribution = "normal", mean = 0.8, std = 0.1, from = 0.5, to = 0.95 }
"pins.rear_base.friction" = { distribution = "log_uniform", from = 0.05, to = 0.3 }

[record]
numbers = ["pin.rear_base.largest_force", "pin.rear_base.force.mean"]
"""

if __name__ == "__main__":  # runs are processes of their own
    Path("fall.toml").write_text(SCENARIO, encoding="utf-8")
    Path("sweep.toml").write_text(SWEEP, encoding="utf-8")
    sweep(read_sweep("sweep.toml"), "sweep_band_runs", workers=2)
    runs = read_table("sweep_band_runs")  # of pyarrow; runs.to_pandas() is a DataFrame
    peaks = runs["pin.rear_base.largest_force_N"].to_pylist()
    for one in percentiles(peaks):
        low, high = 1e-3 * one.low, 1e-3 * one.high
        print(f"{100 * one.share:g} %: {1e-3 * one.value:.0f} kN ({low:.0f} to {high:.0f})")
    inputs = {name: runs[f"pins.rear_base.{name}"].to_pylist() for name in ("restitution", "friction")}
    for rank in ranking(inputs, peaks):
        print(f"{rank.name}: rank correlation {rank.correlation:+.2f} ({rank.low:+.2f} to {rank.high:+.2f})")
    with look():  # of all figures of the package
        histogram(runs, "pin.rear_base.largest_force").savefig("sweep_band.png", dpi=120)
