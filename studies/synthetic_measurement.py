"""`python -m studies.synthetic_measurement`: the measurement that an example compares with, made again.

It is computed, for nobody has measured the reference support. The run behind it is what a real support is and
a model mostly is not: its columns are oil, the rear-link pin has 1.5 mm of clearance and friction. It starts at
rest and is computed to the accuracy "reference". The instruments of `measured_rise.toml` read it: late by their
filters, with noise, in whole digits, and by a clock that is 0.37 s ahead of the run. A reader of the CSV knows
none of this.
"""

from dataclasses import replace
from pathlib import Path

from studies.common.paper_machine import CLEARANCE_PIN, STEP, clearance_joint, ideal_rise, oil_columns
from support_exudyn import CubicStep, Scenario, simulate
from support_exudyn.postprocessing.instruments.station import measure, read_station, write_measured

EXAMPLES = Path(__file__).parent / "examples"
INSTRUMENTS, MEASURED = "measured_rise.toml", "measured_rise.csv"
CLEARANCE_MM, FRICTION = 1.5, 0.25


def measured_scenario() -> Scenario:
    """The run that is measured: a rise of 500 mm from 0.5 to 2.5 s."""
    return replace(
        ideal_rise(STEP),
        pins={CLEARANCE_PIN: clearance_joint(CLEARANCE_MM, FRICTION)},
        actuators=oil_columns(),
        drive=CubicStep(start=0.5, end=2.5),
        duration=3.0,
        start="settled",
        accuracy="reference",
    )


if __name__ == "__main__":
    measured = measure(simulate(measured_scenario()), read_station(EXAMPLES / INSTRUMENTS))
    print(write_measured(measured, EXAMPLES / MEASURED))
