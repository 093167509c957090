"""From an accuracy to settings: formulation, step, steps of an impact, tolerance."""

import math
from dataclasses import replace

from support_exudyn.formulations.registry import CHEAPEST_FIRST, FormulationName, formulation
from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.scenario_data import LARGEST_STEP
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED, MOST_IMPACT_STEPS, SMALLEST_TOLERANCE
from support_exudyn.scenario.timescales import timescales
from support_exudyn.simulation.contact_ringing import ringing_step

# Errors of the Exudyn formulation are of second order in its steps. At these shares of a scene's times, and
# with so many steps an impact, statistics of the reference support are right to 1e-4.
GOAL_OF_SHARES = 1e-4
FLIGHT, RESTING, DRIVE = 1.0 / 35.0, 0.2, 1.0 / 250.0
IMPACT_STEPS = 512
FEWEST_IMPACT_STEPS = 32
MOST_AT_FIRST = MOST_IMPACT_STEPS // 4  # so that they can be doubled twice, without which no error is known
# Errors of an error-controlled method are about its tolerance, a share of the clearance, times what impacts
# make of it; forces in a contact follow from depths of a tenth of the clearance and less.
TOLERANCE_FOR_GOAL = 1e-2
LARGEST_TOLERANCE = 1e-5
MOST_FRICTION_TIMES = 2e6  # times of friction in a run, of which an explicit step takes some three


def settings_for(scenario: Scenario, goal: float) -> Scenario:
    """The scenario with formulation and settings for a goal, and no accuracy asked for any more.

    Raises InputError if the formulation that the scenario asks for does not cover it.
    """
    plain = replace(scenario, accuracy=None, record_period=scenario.recorded_every)
    name = scenario.formulation
    if name == "auto":
        name = cheapest(plain)
    formulation(name).check(plain)
    finer = math.sqrt(GOAL_OF_SHARES / goal)
    times = timescales(plain)
    step = min(FLIGHT * times.flight, RESTING * times.resting, DRIVE * times.drive) / finer
    impact_steps = round(IMPACT_STEPS * finer) if plain.contact_places else FEWEST_IMPACT_STEPS
    solver = replace(
        plain.solver,
        impact_steps=min(max(impact_steps, FEWEST_IMPACT_STEPS), MOST_AT_FIRST),
        tolerance=min(max(TOLERANCE_FOR_GOAL * goal, SMALLEST_TOLERANCE), LARGEST_TOLERANCE),
    )
    # else a vibration that all runs damp out by their steps would be missing in all of them alike
    step = min(step, ringing_step(plain), scenario.recorded_every, LARGEST_STEP)
    return replace(plain, formulation=name, step=step, solver=solver)


def covered(scenario: Scenario) -> Scenario:
    """A scenario without an accuracy, compiled where "auto" meets friction in joints that repeat each other."""
    shares = scenario.friction_laws and repeated_count(scenario.held)[0]
    if scenario.formulation != "auto" or not shares or formulation("auto").covers(scenario):
        return scenario
    free = replace(scenario, formulation="compiled")
    return free if formulation("compiled").covers(free) else scenario


def cheapest(scenario: Scenario) -> FormulationName:
    """The first formulation that covers a scenario; `exudyn` covers every one whose settings fit it.

    Explicit methods have to follow friction's ramp, however steep it is: not where that takes too many steps.
    """
    found: FormulationName = next((one.name for one in CHEAPEST_FIRST if one.covers(scenario)), "exudyn")
    if found in ERROR_CONTROLLED and scenario.duration > MOST_FRICTION_TIMES * timescales(scenario).rubbing:
        return "exudyn"
    return found
