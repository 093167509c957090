"""How often a run is recorded if nobody says so: as its machine moves, at round times."""

import math

from support_exudyn.scenario.scenario_data import ScenarioData
from support_exudyn.scenario.timescales import timescales

OF_DRIVE = 500.0  # records in a stroke, or in the time of a crank over its speed
OF_CONTACT = 3.0  # in the time of a loaded contact's vibration over its angular frequency: 19 in a period
FEWEST, MOST = 1000.0, 5000.0  # records of a run
STEPS = (1, 2, 5)  # times powers of ten: periods
ROUNDING = 1e-12  # share of a period


def default_period(scenario: ScenarioData) -> float:
    """Time between records [s] that shows the drive and the contacts of a scenario: 1, 2, 5 times 10^n.

    A 500th of the stroke or of a crank's time over its speed, a third of a contact's time over its vibration's
    angular frequency; at least 1000 records, at most 5000. Not below steps that the scenario gives, which would
    be cut.
    """
    times = timescales(scenario)
    wanted = min(times.drive / OF_DRIVE, times.resting / OF_CONTACT, scenario.duration / FEWEST)
    given = scenario.accuracy is None and not scenario.chooses_steps
    least = max(scenario.duration / MOST, scenario.step if given else 0.0)
    return min(rounded(wanted, least), scenario.duration)


def rounded(wanted: float, least: float) -> float:
    """The largest round period [s] up to the wanted one; the smallest above the least, if that is longer."""
    limit = max(wanted, least)
    power = math.floor(math.log10(limit))
    periods = [float(f"{step}e{n}") for n in (power - 1, power, power + 1) for step in STEPS]
    allowed = [one for one in periods if least * (1.0 - ROUNDING) <= one <= limit * (1.0 + ROUNDING)]
    return allowed[-1] if allowed else next(one for one in periods if one > limit)
