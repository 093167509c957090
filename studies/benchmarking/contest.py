"""The slider-crank computed by every program there is, by ever finer settings: what an error costs in each.

Half a revolution at 5000 rpm. Looked at: the slider's place at all records, against a tight reference, and time
and speed of the first five impacts, against an independent solution.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from math import inf
from typing import NamedTuple

import numpy as np

from studies.benchmarking.lsoda import run_lsoda
from studies.benchmarking.peers.built_in import run_built_in
from studies.benchmarking.peers.in_drake import run_drake
from studies.benchmarking.peers.in_mujoco import run_limit, run_mujoco
from studies.benchmarking.peers.peer_run import PeerRun
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.peers.tree import run_tree
from studies.benchmarking.references import Series, references, thinned
from studies.benchmarking.row import Setting, steps, tolerance
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.stopwatch import fastest
from studies.slider_crank.run import REFERENCE
from support_exudyn import Scenario, simulate
from support_exudyn.formulations.registry import FORMULATIONS
from user_forces.contact_state import Onset

SCENE = "slider-crank"
TOLERANCES = tuple(tolerance(10.0**-n) for n in range(3, 9))
OURS = "ours, "
# ours by formulation; one that does not exist here is left out
FORMULATION_SETTINGS: Mapping[str, Sequence[Setting]] = {
    "compiled": TOLERANCES,
    "exudyn": tuple(
        steps(step, each, 1.0) for step, each in ((1e-5, 64), (1e-5, 128), (5e-6, 256), (2e-6, 512))
    ),
}


class Found(NamedTuple):
    """The slider at the records [m], and impacts."""

    slider: Series
    onsets: Sequence[Onset]


@dataclass(frozen=True)
class Entrant:
    """A program, how it is used here, and its settings from coarse to fine.

    package: that has to be installed, or the formulation of ours. run: with one of the settings.
    """

    name: str
    package: str
    settings: Sequence[Setting]
    run: Callable[[Scenario, Setting], Found]

    @property
    def missing(self) -> str:
        """Why it is left out; empty if it is not."""
        if self.name.startswith(OURS):
            return "" if self.package in FORMULATIONS else "there is no such formulation"
        try:
            return "" if find_spec(self.package) else f"{self.package} is not installed"
        except (ImportError, ValueError) as error:
            return f"{self.package} cannot be imported: {error}"


class Standing(NamedTuple):
    """What a setting came to: processor time [s], largest error of the slider [m], of impact times [s] and of
    their speeds (relative); infinite if impacts are lacking.
    """

    program: str
    setting: str
    seconds: float
    slider: float
    times: float
    speeds: float


def _of_peer(run: Callable[[Scenario, float], PeerRun]) -> Callable[[Scenario, Setting], Found]:
    def found(scenario: Scenario, setting: Setting) -> Found:
        done = run(scenario, setting.number)
        return Found(done.x, done.onsets)

    return found


def _of_lsoda(scenario: Scenario, setting: Setting) -> Found:
    done = run_lsoda(scenario, setting.number)
    return Found(done.slider, done.onsets)


def _of_ours(formulation: str) -> Callable[[Scenario, Setting], Found]:
    def found(scenario: Scenario, setting: Setting) -> Found:
        done = simulate(setting.applied(scenario, formulation))
        ((pin, _),) = scenario.clearance_pins.items()
        return Found(done["slider.x"], done.onsets[pin])

    return found


def _settings(words: str, *numbers: float) -> tuple[Setting, ...]:
    return tuple(Setting(f"{words} {x:g}", number=x) for x in numbers)


def _entrants() -> tuple[Entrant, ...]:
    by_step = _settings("step", 5e-6, 2e-6, 1e-6, 2.5e-7)
    finer = _settings("step", 5e-6, 2e-6, 1e-6, 5e-7, 2.5e-7)
    by_error = _settings("tolerance", 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
    by_accuracy = _settings("accuracy", 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
    return (
        *(
            Entrant(f"{OURS}{name}", name, settings, _of_ours(name))
            for name, settings in FORMULATION_SETTINGS.items()
        ),
        Entrant("scipy's LSODA", "scipy", by_error, _of_lsoda),
        Entrant("MuJoCo, law in a callback", "mujoco", finer, _of_peer(run_mujoco)),
        Entrant("MuJoCo, limit of a tendon", "mujoco", by_step, _of_peer(run_limit)),
        Entrant("Drake, force in a system", "pydrake", by_accuracy, _of_peer(run_drake)),
        Entrant("Exudyn, hollow spheres, DOPRI5", "exudyn", by_error, _of_peer(run_tree)),
        Entrant("Exudyn, hollow spheres", "exudyn", by_step, _of_peer(run_built_in)),
        Entrant("Exudyn, Python function", "exudyn", by_step, _of_peer(run_stock)),
    )


ENTRANTS: Mapping[str, Entrant] = {one.name: one for one in _entrants()}


def errors(found: Found, exact: Series) -> tuple[float, float, float]:
    """Largest errors of the slider [m], of the times of the first impacts [s] and of their speeds."""
    slider = float(np.abs(thinned(found.slider) - exact).max())
    if len(found.onsets) < len(REFERENCE):
        return slider, inf, inf
    pairs = tuple(zip(found.onsets, REFERENCE, strict=False))
    times = max(abs(one.time - 1e-6 * known) for one, (known, _) in pairs)
    speeds = max(abs(one.speed / known - 1.0) for one, (_, known) in pairs)
    return slider, times, speeds


def standings(name: str) -> Iterator[Standing]:
    """Run an entrant by all its settings, the coarsest first."""
    entrant, scenario = ENTRANTS[name], SCENES[SCENE].scenario
    exact = references()[SCENE].path[0]
    entrant.run(replace(scenario, duration=scenario.recorded_every), entrant.settings[0])  # imports, compiles
    for setting in entrant.settings:
        yield standing(entrant, setting, scenario, exact)


def standing(entrant: Entrant, setting: Setting, scenario: Scenario, exact: Series) -> Standing:
    """Time and errors of an entrant by a setting."""
    found: list[Found] = []
    seconds = fastest(lambda: found.append(entrant.run(scenario, setting)))
    return Standing(entrant.name, setting.words, seconds, *errors(found[0], exact))


def cheapest_within(found: Sequence[Standing], error: float) -> Standing | None:
    """The fastest setting of a program that has the slider right to an error [m]; None if there is none."""
    good = [one for one in found if one.slider <= error]
    return min(good, key=lambda one: one.seconds) if good else None
