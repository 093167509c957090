"""Compare with a measurement

Pressures, extensions and tilts of a support, as a mine's instruments write them: late by their filters, noisy,
in whole digits, by another clock. The same instruments read two models, one with ideal pins and one with 1.5 mm
of clearance in the rear-link pin; the measurement tells which is nearer. It is synthetic, see
`studies/synthetic_measurement.py`. `support-exudyn measure RUN INSTRUMENTS` writes such a table of any run.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

from support_exudyn import ClearancePin, CubicStep, Scenario, machine, simulate
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.comparing.measures import curve_measures, time_shift
from support_exudyn.postprocessing.instruments.station import measure, read_station

here = Path(__file__).parent
measured = read_series(here / "measured_rise.csv").series
station = read_station(here / "measured_rise.toml")
# the same filters; neither noise nor digits, and a clock that starts with the run
perfect = {name: replace(one, noise=0.0, resolution=0.0) for name, one in station.instruments.items()}
station = replace(station, instruments=perfect, clock_offset=0.0)

drive = CubicStep(start=0.5, end=2.5)
rise = Scenario(
    machine=machine("reference"), drive=drive, duration=3.0, start="settled"
)  # at rest, as measured
pin = ClearancePin.simple(clearance=1.5e-3, bore_radius=0.0655, stiffness="paper", friction=0.25)
models = {"ideal pins": rise, "1.5 mm of clearance": replace(rise, pins={"rear_base": pin})}
computed = {name: measure(simulate(one, accuracy="standard"), station) for name, one in models.items()}

# whose clock is ahead, by the extension, which all agree on
reference = next(iter(computed.values()))["front_column.extension"]
extension = measured["front_column.extension"]
late = time_shift(reference.time, reference.values, extension.time, converted(extension, "m"))
print(f"the measurement's clock is ahead by {late.shift:.3f} s")

shown = {
    "rear_link.tilt": "deg",
    "canopy.tilt": "deg",
    "front_column.pressure": "MPa",
    "rear_column.pressure": "MPa",
}
figure, axes = plt.subplots(2, 2, figsize=(9, 6), sharex=True, layout="constrained")
for axis, (name, unit) in zip(axes.flat, shown.items(), strict=True):
    time, values = measured[name].time - late.shift, converted(measured[name], unit)
    axis.plot(time, values, ".", color="0.6", label="measured")
    for model, found in computed.items():
        curve = converted(found[name], unit)
        apart = curve_measures(time, values, np.interp(time, found[name].time, curve))
        print(
            f"{name}, {model}: RMS difference {apart.rms:.3f} {unit}, mean {apart.mean_difference:.3f} {unit}"
        )
        axis.plot(found[name].time, curve, label=model)
    axis.set(ylabel=f"{name} [{unit}]")
axes[0, 0].legend()
for axis in axes[-1]:
    axis.set_xlabel("time [s]")
figure.savefig("measured_rise.png", dpi=120)
