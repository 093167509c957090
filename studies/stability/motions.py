"""The pins whose small motions are predicted and run: the reference support in mid-rise, driven slowly.

A run begins in the posture of the instant, with the journal where it would stay, and a little off. Two runs of
a case differ by nothing but the way in which it is off: their difference is a small motion by itself, free of
all that both do alike, such as following the load's direction as that turns.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from studies.common.numbers import Number
from studies.common.paper_machine import BORE_RADIUS, RESTITUTION
from support_exudyn import ClearancePin, Result, Scenario, SolverSettings, Steady, reference_support
from support_exudyn.mechanics.pin_stability import LoadedJournal, SlidingPin
from support_exudyn.scenario.pin_stability import pin_outlooks
from user_forces import Ambrosio
from user_forces.values.value import InputError

Array = npt.NDArray[np.float64]

PINS = ("rear_base", "front_base", "rear_shield", "front_shield")
CLEARANCE, LENGTH = 1.5e-3, 0.7  # [m]
STIFFNESSES: dict[str, dict[str, Any]] = {
    "Eq. 5": {"stiffness": "paper"},
    "internal": {"stiffness": "internal"},
    "cylinders": {"stiffness": "cylinders", "length": LENGTH},
    "cylinders, rigid": {"stiffness": "cylinders", "length": LENGTH, "backing_stiffness": math.inf},
}
FRICTIONS = (0.1, 0.2, 0.25)
MID_RISE = 0.25  # [m], extension of the columns
# Slow, so that the journal starts nearly as the load's direction turns; friction's ramp is narrowed with it
SPEED, STATIC_SPEED, DYNAMIC_SPEED = 0.02, 1e-6, 1e-4  # of the columns; of friction [m/s]
SMALL = 1e-3  # of the depth: how far off a journal ever is, apart from the motion of both runs
SWINGS = 2.0  # that a run lasts, unless it grows too much by then
FACTOR = 4.0  # exp of that a run may grow by, if one swing is over by then
RECORDS = 120  # of a run
FINE = 0.1  # of the angle by which the fastest of the four motions swings on: a step
TOLERANCE = 1e-10
LOOK_AHEAD = 1e-4  # [s] over which the motion of the equilibrium is measured
SIDES = (1.0, -1.0)


@dataclass(frozen=True)
class PinCase:
    """A pin that is predicted and run: its name, stiffness, coefficient of friction."""

    pin: str
    stiffness: str
    friction: float

    @property
    def name(self) -> str:
        """The name of the case."""
        return f"{self.pin}, {self.stiffness}, mu_d = {self.friction:g}"

    def clearance_pin(self) -> ClearancePin:
        """The pin, its journal in the middle."""
        friction = Ambrosio(
            sliding_coefficient=self.friction, static_speed=STATIC_SPEED, dynamic_speed=DYNAMIC_SPEED
        )
        return ClearancePin.simple(
            clearance=CLEARANCE,
            bore_radius=BORE_RADIUS,
            restitution=RESTITUTION,
            friction=friction,
            **STIFFNESSES[self.stiffness],
        )

    def scenario(self, duration: float = 0.1, step: float = 1e-3) -> Scenario:
        """The machine in mid-rise, moving on, for so long and in such steps [s]."""
        machine = reference_support()
        middle = machine.extended(MID_RISE)
        assert middle is not None
        return Scenario(
            machine=replace(machine, start_hinge_height=middle.hinge[1]),
            drive=Steady(rate=SPEED),
            duration=duration,
            step=step,
            record_period=duration / RECORDS,
            pins={self.pin: self.clearance_pin()},
            channels=(f"pin.{self.pin}.*",),
            formulation="compiled",
            solver=SolverSettings(result_checks=False, tolerance=TOLERANCE),
        )


CASES = tuple(PinCase(pin, stiffness, mu) for pin in PINS for stiffness in STIFFNESSES for mu in FRICTIONS)


class Prepared(NamedTuple):
    """A case, ready to be run.

    predicted: in the middle of the run. runs: two scenarios. depth: at the equilibrium [m].
    """

    case: PinCase
    predicted: SlidingPin
    runs: tuple[Scenario, ...]
    depth: float


def prepared(case: PinCase) -> Prepared:
    """The prediction of a case and its two runs.

    Both begin at rest, while the equilibrium moves on. That by itself excites the motion that grows; they begin
    so far off the equilibrium that it does so least by the end of the run. A run lasts some swings, or until it
    has grown, but one swing at least.
    """
    scenario = case.scenario()

    def outlook(*times: float) -> tuple[LoadedJournal, list[SlidingPin]]:
        ahead = pin_outlooks(scenario, times, (case.pin,))[0]
        pins = [pin for pin in ahead.found if pin is not None]
        if len(pins) < len(times):
            raise InputError(
                "stability: a pin has no place at which it slides; allowed: frictions with which it has"
            )
        return ahead.journals[0], pins

    journal, (pin, later) = outlook(0.0, LOOK_AHEAD)
    swing = 1.0 / pin.frequency
    duration = min(SWINGS * swing, max(FACTOR / max(abs(pin.growth), 1e-9), swing))
    calm = _calm(journal, pin, (later.place - pin.place) / LOOK_AHEAD, duration)
    step = FINE / float(np.abs(pin.roots).max())
    off = SMALL * pin.depth * min(1.0, math.exp(-pin.growth * duration))
    runs = []
    for side in SIDES:
        x, y = (pin.place + calm + side * off * pin.place / np.linalg.norm(pin.place)).tolist()
        there = replace(case.clearance_pin(), eccentricity=(x, y))
        runs.append(replace(case.scenario(duration, step), pins={case.pin: there}))
    _, (middle,) = outlook(0.5 * duration)
    return Prepared(case, middle, tuple(runs), pin.depth)


def _calm(journal: LoadedJournal, pin: SlidingPin, moves: Array, duration: float) -> Array:
    """How far from its equilibrium (2,) [m] a journal at rest is to begin, while that moves on [m/s].

    The start is a sum of the four motions that go with the roots. Of each the part counts that is left, or has
    grown, by the end; their sum of squares is made the least.
    """
    free = np.zeros((4, 4))
    free[:2, 2:] = np.eye(2)
    free[2:, :2] = -journal.inverse_mass @ pin.stiffness
    free[2:, 2:] = -journal.inverse_mass @ pin.damping
    roots, motions = np.linalg.eig(free)
    parts = np.linalg.inv(motions) * np.linalg.norm(motions[:2], axis=0)[:, None]
    parts = parts * np.exp(np.maximum(roots.real * duration, 0.0))[:, None]
    known = parts[:, 2:] @ moves
    both = np.vstack([parts[:, :2].real, parts[:, :2].imag])
    found: Array = np.linalg.lstsq(both, np.concatenate([known.real, known.imag]), rcond=None)[0]
    return found


def all_scenarios(ready: Mapping[str, Prepared]) -> dict[str, Scenario]:
    """Both runs of every case at its steps and at half of them, by name; records stay alike."""
    scenarios = {}
    for name, one in ready.items():
        for side, scenario in enumerate(one.runs):
            scenarios[run_name(name, side, fine=False)] = scenario
            finer = replace(scenario.refined(), record_period=scenario.record_period)
            scenarios[run_name(name, side, fine=True)] = finer
    return scenarios


def run_name(case: str, side: int, *, fine: bool) -> str:
    """What a run of a case is called."""
    return f"{case}, {'inwards' if side else 'outwards'}{', half steps' if fine else ''}"


DELAY = 8  # part of a run after which a motion is compared with itself
RESOLVED = 5e-3  # growth rate as a share of the angular frequency that counts at least: 3 % in a swing
ALIKE = 0.1  # of the growth rate, or of what counts at least


class Growth(NamedTuple):
    """Predicted and measured growth of a case.

    case: its name. prepared: the case with its prediction. predicted: growth rate [1/s]. measured: that of the
    vibration that grows fastest in the run, at half its steps [1/s]. frequency: of that [Hz]. off: distance of
    measured from predicted growth rate. by_steps: what half the steps change; both as a share of the growth
    rate, or of the least that counts. error: what half the steps change [1/s]. moved: largest motion normal to
    the wall over the depth.
    """

    case: str
    prepared: Prepared
    predicted: float
    measured: float
    frequency: float
    off: float
    by_steps: float
    error: float
    moved: float

    def numbers(self) -> list[Number]:
        """Its numbers; what is predicted has the error of a closed form."""
        return [
            Number("predicted_growth_rate", self.case, self.predicted, "1/s", 0.0),
            Number("growth_rate", self.case, self.measured, "1/s", self.error),
            Number("predicted_frequency", self.case, self.prepared.predicted.frequency, "Hz", 0.0),
            Number("frequency", self.case, self.frequency, "Hz", 0.0),
        ]


def roots(time: Array, motion: Array) -> npt.NDArray[np.complex128]:
    """Roots of a motion that is a sum of four exponentials, (4,) [1/s], the fastest growing first.

    Two coordinates now and a delay ago tell those a delay later, by a matrix that least squares find; the roots
    are the logarithms of its eigenvalues over the delay. Each time counts alike, however far the motion has
    grown.

    Arguments:
        time: evenly (n,) [s].
        motion: two coordinates (n, 2).

    Source: Hua and Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38 (1990) 814-824, the matrix pencil.
    """
    delay = len(time) // DELAY
    count = len(time) - 2 * delay
    before = np.hstack([motion[:count], motion[delay : delay + count]])
    after = np.hstack([motion[delay : delay + count], motion[2 * delay : 2 * delay + count]])
    weight = 1.0 / np.linalg.norm(before, axis=1)[:, None]
    forward = np.linalg.lstsq(before * weight, after * weight, rcond=None)[0]
    found = np.log(np.linalg.eigvals(forward).astype(complex)) / (delay * (time[1] - time[0]))
    ordered: npt.NDArray[np.complex128] = found[np.argsort(-found.real)]
    return ordered


def fastest(found: npt.NDArray[np.complex128]) -> complex:
    """Of the roots the vibration that grows fastest, or decays slowest."""
    return complex(next(root for root in found if abs(root.imag) > 0.0))


def growth(one: Prepared, runs: Mapping[str, Result]) -> Growth:
    """The growth of a case in its runs."""
    coarse, fine = (fastest(roots(*difference(one, runs, fine=fine))) for fine in (False, True))
    depth = runs[run_name(one.case.name, 0, fine=True)][f"pin.{one.case.pin}.depth"]
    predicted = one.predicted.growth
    scale = max(abs(predicted), RESOLVED * 2.0 * math.pi * one.predicted.frequency)
    error = abs(fine.real - coarse.real)
    return Growth(
        case=one.case.name,
        prepared=one,
        predicted=predicted,
        measured=fine.real,
        frequency=abs(fine.imag) / (2.0 * math.pi),
        off=abs(fine.real - predicted) / scale,
        by_steps=error / scale,
        error=error,
        moved=float(np.ptp(depth)) / one.depth,
    )


def difference(one: Prepared, runs: Mapping[str, Result], *, fine: bool) -> tuple[Array, Array]:
    """Times (n,) [s] and the difference of both runs of a case (n, 2) [m]."""
    pin = one.case.pin
    both = [runs[run_name(one.case.name, side, fine=fine)] for side in (0, 1)]
    places = [np.column_stack([run[f"pin.{pin}.eccentricity_{axis}"] for axis in "xy"]) for run in both]
    return both[0].time, places[0] - places[1]
