"""The entry: scenario in, result out."""

from collections.abc import Callable
from dataclasses import replace
from typing import Literal, overload

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.scenario_data import Accuracy
from support_exudyn.scene.contract import Failure, Progress, SimulationError, error_text, silent
from support_exudyn.simulation.automatic_settings import covered
from support_exudyn.simulation.halved_steps import run_halving_steps
from support_exudyn.simulation.provenance import FORMULATION_ASKED
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.single_run import single_run
from support_exudyn.simulation.to_accuracy import run_to_accuracy
from user_forces.lawful import UNLAWFUL, LawError, check_friction_law, check_laws
from user_forces.values.value import InputError, short

OWN = "A law, load or machine of one's own does that; allowed: to raise an exception."


@overload
def simulate(
    scenario: Scenario,
    *,
    accuracy: Accuracy | None = ...,
    errors: bool = ...,
    progress: Progress = ...,
    throw: Literal[True] = ...,
) -> Result: ...
@overload
def simulate(
    scenario: Scenario,
    *,
    accuracy: Accuracy | None = ...,
    errors: bool = ...,
    progress: Progress = ...,
    throw: bool,
) -> Result | Failure: ...


def simulate(
    scenario: Scenario,
    *,
    accuracy: Accuracy | None = None,
    errors: bool = False,
    progress: Progress = silent,
    throw: bool = True,
) -> Result | Failure:
    """Run a scenario.

    Arguments:
        scenario: machine, pins, drive, start and how it is computed.
        accuracy: in place of the scenario's own: "draft", "standard", "reference", or a number; see `Scenario`.
            The result then carries the estimated error of every number.
        errors: with steps that the scenario chooses itself, run it at half and at a quarter of them, too: the
            result is that of the shortest, and carries the estimated error of every number. If these do not
            settle, or steps are too long for a run to be finished, they are halved up to three times more
            (`Result.scenario` has the steps that were taken); if that does not help it ends in a
            SimulationError. With an accuracy errors are estimated anyway.
        progress: called now and then with the share that is done, 0 to 1.
        throw: what to do if the run cannot be finished: raise SimulationError, or return its Failure
            (for sweeps, where one failed run is a row and not the end).

    Returns:
        Result with all channels, onsets, counts, energy and provenance.
    """
    if not isinstance(scenario, Scenario):
        raise InputError(f"scenario = {short(scenario)}: allowed: a Scenario")
    if accuracy is not None:
        scenario = replace(scenario, accuracy=accuracy)
    plain = run_halving_steps if errors else single_run
    run: Callable[[Scenario, Progress], Result] = plain if scenario.goal is None else run_to_accuracy
    try:
        return _run(run, scenario, progress)
    except SimulationError as error:
        if throw:
            raise
        return error.failure


def _run(run: Callable[[Scenario, Progress], Result], scenario: Scenario, progress: Progress) -> Result:
    try:
        if scenario.solver.result_checks:
            look_at_laws(scenario)
        result = run(scenario if scenario.goal else covered(scenario), progress)
        if scenario.formulation == result.scenario.formulation:
            return result
        asked = {FORMULATION_ASKED: scenario.formulation}  # of "auto" it is told why which one ran
        return replace(result, provenance={**result.provenance, **asked})
    except SystemExit as error:  # it would end the program without a word, and perhaps as if all was done
        raise SimulationError(Failure(f"the program was asked to end: {error_text(error)}", OWN, 0.0)) from None


def look_at_laws(scenario: Scenario) -> None:
    """Raise SimulationError if a law is none, as far as calls before the run show."""
    try:
        for name, place in scenario.contact_places.items():
            check_laws(place.contact, name)
        for name, law in scenario.friction_laws.items():
            check_friction_law(law, name)
    except LawError as error:
        raise SimulationError(Failure(str(error), UNLAWFUL, 0.0)) from error
