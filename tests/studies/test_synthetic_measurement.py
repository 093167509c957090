"""The measurement that comes with the examples is what its script makes, and tells what was hidden in it."""

from __future__ import annotations

import numpy as np
import pytest

from studies.synthetic_measurement import EXAMPLES, INSTRUMENTS, MEASURED, measured_scenario
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.instruments.station import read_station

STATION = read_station(EXAMPLES / INSTRUMENTS)
SHIPPED = read_series(EXAMPLES / MEASURED).series


def test_it_has_what_the_instruments_read() -> None:
    assert list(SHIPPED) == list(STATION.instruments)
    scenario = measured_scenario()
    for name, one in SHIPPED.items():
        instrument = STATION.instruments[name]
        count = round(scenario.duration * instrument.rate) + 1
        np.testing.assert_allclose(
            one.time, STATION.clock_offset + np.arange(count) / instrument.rate, atol=1e-9
        )
        digits = converted(one, instrument.UNIT) / instrument.resolution
        np.testing.assert_allclose(digits, np.round(digits), atol=1e-6)
    still = SHIPPED["base.tilt"]
    noise = STATION.instruments["base.tilt"].noise
    # noise, and that of the rounding; five standard errors
    digit = STATION.instruments["base.tilt"].resolution
    expected = np.hypot(noise, digit / np.sqrt(12.0))
    assert np.std(converted(still, "rad")) == pytest.approx(expected, rel=5.0 / np.sqrt(2.0 * still.time.size))
