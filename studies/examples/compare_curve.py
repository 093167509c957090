"""Compare with a curve

A measured or published curve is a file whose columns are named as channels, with their units; here a CSV.
It is drawn beside the run, and the difference is given in numbers. `support-exudyn plot RUN curve.csv` draws
the same.
"""

from pathlib import Path

import numpy as np

from support_exudyn import CubicStep, Scenario, machine, simulate
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.figures.overlay import overlay
from support_exudyn.postprocessing.figures.style import look

# in place of a measurement: time and angular velocity of the rear link
CHANNEL = "rear_link.angular_velocity"
CURVE = """time_s,rear_link.angular_velocity_deg_per_s
0.1,-4.6
0.25,-10.3
0.5,-14.1
0.75,-10.6
0.9,-5.5
"""
Path("curve.csv").write_text(CURVE, encoding="utf-8")
curves = read_series("curve.csv")
curve = curves.series[CHANNEL]

drive = CubicStep(stroke=0.25, start=0.0, end=1.0)
scenario = Scenario(machine=machine("reference"), drive=drive, duration=1.0, step=1e-3)
result = simulate(scenario, errors=True)
measured = converted(curve, "rad/s")
difference = np.degrees(np.interp(curve.time, result.time, result[CHANNEL]) - measured)
largest, rms = np.abs(difference).max(), np.sqrt(np.mean(difference**2))
print(f"largest difference {largest:.2f} deg/s, RMS {rms:.2f} deg/s")

with look():  # of all figures of the package
    drawing = overlay({"computed": result}, [CHANNEL], curves={"curve.csv": curves})
    drawing.savefig("compare_curve.png", dpi=120)
