"""What a competitor's run gives, how its impacts are found afterwards, and what the competitors share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import exudyn
import numpy as np
import numpy.typing as npt
from exudyn.itemInterface import NodeGenericData, ObjectContactSphereSphere, SensorMarker

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.single_run import paused_collector
from user_forces.contact import JournalContact
from user_forces.contact_state import Onset
from user_forces.normal.power_laws import LankaraniNikravesh
from user_forces.values.value import InputError

Series = npt.NDArray[np.float64]
ASIDE = 1e-12  # of a bore from its journal, so that the engine's own contact has a normal [m]


@dataclass(frozen=True)
class PeerRun:
    """Outcome of a competitor's run; all series at the scenario's records.

    time: [s]. force: magnitude in the clearance pin [N]. angular_acceleration: of the link that the clearance
    pin ends (rear link, rod) [rad/s^2], nan if it is not noted. x, y: canopy tip or slider [m]. onsets: by
    interpolation of the depth at the ends of steps. largest_force: at the end of any step [N]. solve_time: of
    the solver, on the processor [s]. steps: accepted.
    user_function_calls: of the force, in Python; 0 where they are not counted. newton_iterations: of the
    solver, 0 if it has none.
    """

    time: Series
    force: Series
    angular_acceleration: Series
    x: Series
    y: Series
    onsets: tuple[Onset, ...]
    largest_force: float
    solve_time: float
    steps: int
    user_function_calls: int
    newton_iterations: int


def impacts(time: Sequence[float], depth: Sequence[float], rate: Sequence[float]) -> tuple[Onset, ...]:
    """Impacts from time [s], depth [m] and its rate [m/s] at the ends of all steps, and how they end.

    Between two steps the depth is the cubic that fits depth and rate at both; where it passes zero is found by
    bisection, and its slope there is the speed.
    """
    t, d, r = (np.asarray(series, dtype=np.float64) for series in (time, depth, rate))
    found: list[Onset] = []
    for n in np.flatnonzero((d[:-1] <= 0.0) != (d[1:] <= 0.0)).tolist():
        h = float(t[n + 1] - t[n])
        x, slope = _crossing(float(d[n]), float(d[n + 1]), h * float(r[n]), h * float(r[n + 1]))
        if d[n] <= 0.0:
            found.append(Onset(float(t[n]) + x * h, slope / h))
        elif found:  # else it began in contact
            found[-1] = found[-1].separated(float(t[n]) + x * h, -slope / h)
    return tuple(found)


def _crossing(first: float, last: float, first_slope: float, last_slope: float) -> tuple[float, float]:
    """The place between 0 and 1 where the cubic with these values and slopes passes zero, and its slope."""
    a, b, c = last - first, first_slope, last_slope
    cubic = np.array([b + c - 2.0 * a, 3.0 * a - 2.0 * b - c, b, first])
    low, high = 0.0, 1.0
    for _ in range(60):
        x = 0.5 * (low + high)
        if (np.polyval(cubic, x) > 0.0) == (last > 0.0):
            high = x
        else:
            low = x
    return high, float(np.polyval(np.polyder(cubic), high))


def record_times(scenario: Scenario) -> Series:
    """The times of a scenario's records [s]."""
    count = round(scenario.duration / scenario.recorded_every)
    found: Series = np.arange(float(count + 1)) * scenario.recorded_every
    return found


def cubic(wanted: Series, t: Series, x: Series, rate: Series) -> Series:
    """Values at the wanted times by the cubic that fits values and rates at both ends of the step around."""
    n = np.clip(np.searchsorted(t, wanted, side="right") - 1, 0, len(t) - 2)
    h = t[n + 1] - t[n]
    s = (wanted - t[n]) / h
    z = 1.0 - s
    start, end = x[n] * (1.0 + 2.0 * s) + h * rate[n] * s, x[n + 1] * (3.0 - 2.0 * s) - h * rate[n + 1] * z
    found: Series = start * z * z + end * s * s
    return found


@dataclass
class StepLog:
    """What a competitor notes of a slider-crank at the ends of all steps.

    Time [s], depth [m], its rate [m/s], place [m] and velocity [m/s] of the slider.
    """

    time: list[float] = field(default_factory=list)
    depth: list[float] = field(default_factory=list)
    rate: list[float] = field(default_factory=list)
    slider: list[float] = field(default_factory=list)
    velocity: list[float] = field(default_factory=list)

    def met_with(self) -> float:
        """The speed at zero depth in the last step, in which the surfaces met [m/s]."""
        ends = slice(-2, None)
        (met,) = impacts(self.time[ends], self.depth[ends], self.rate[ends])
        return met.speed

    def drop_last(self) -> None:
        """Forget the last step."""
        for series in (self.time, self.depth, self.rate, self.slider, self.velocity):
            series.pop()

    def run(self, scenario: Scenario, contact: JournalContact, took: float, calls: int) -> PeerRun:
        """The outcome, with forces that follow from depth and rate; accelerations are not noted."""
        t, depth, rate = np.array(self.time), np.array(self.depth), np.array(self.rate)
        wanted = np.minimum(record_times(scenario), t[-1])
        force = contact_forces(contact, depth, rate)
        return PeerRun(
            time=wanted,
            force=np.interp(wanted, t, force),
            angular_acceleration=np.full(len(wanted), np.nan),
            x=cubic(wanted, t, np.array(self.slider), np.array(self.velocity)),
            y=np.zeros(len(wanted)),
            onsets=impacts(self.time, self.depth, self.rate),
            largest_force=float(force.max()),
            solve_time=took,
            steps=len(t) - 1,
            user_function_calls=calls,
            newton_iterations=0,
        )


@contextmanager
def undisturbed() -> Iterator[None]:
    """The engine is silent and garbage is not collected: neither is part of what is measured."""
    with quiet_engine(), paused_collector():
        yield


# --- the contact ---


def contact_numbers(contact: JournalContact) -> tuple[float, float, float]:
    """Stiffness [N/m^1.5], damping factor [-], rest velocity [m/s]; InputError otherwise."""
    law = contact.normal
    if not isinstance(law, LankaraniNikravesh) or law.exponent != 1.5:
        raise InputError(f"normal = {law}: allowed here: LankaraniNikravesh with exponent 1.5")
    return law.stiffness, law.damping_factor, law.rest_velocity


def contact_forces(contact: JournalContact, depth: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """Force [N] at the ends of all steps, with the impact velocity at the end of the first in contact."""
    stiffness, factor, floor = contact_numbers(contact)
    closed = depth > 0.0
    begins = closed & ~np.concatenate(([False], closed[:-1]))
    which = np.maximum.accumulate(np.where(begins, np.arange(len(depth)), 0))
    speed = np.maximum(rate[which], floor)
    inside = np.maximum(depth, 0.0)
    force: np.ndarray = np.maximum(stiffness * inside**1.5 * (1.0 + factor * rate / speed), 0.0)
    return force


def add_ball(mbs: Any, contact: JournalContact, journal: Any, bore: Any) -> None:
    """Add the engine's own contact: a ball in a hollow ball is a journal in a bore.

    Its Hunt-Crossley factor 3 (1 - e)/2 equals Lankarani and Nikravesh's 3 (1 - e^2)/4 if its restitution is
    set to 1 - (1 - e^2)/2. It notes the initial impact velocity at the end of the step that noticed the
    contact, and it has no normal at the centre, so it starts beside it.
    """
    stiffness, _, floor = contact_numbers(contact)
    bearing, restitution = contact.bearing, contact.normal.restitution  # type: ignore[attr-defined]
    node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4))
    mbs.AddObject(
        ObjectContactSphereSphere(
            markerNumbers=[journal, bore],
            nodeNumber=node,
            spheresRadii=[bearing.journal_radius, bearing.bore_radius],
            isHollowSphere1=True,
            contactStiffness=stiffness,
            contactStiffnessExponent=1.5,
            restitutionCoefficient=1.0 - 0.5 * (1.0 - restitution**2),
            impactModel=1,
            minimumImpactVelocity=floor,
        )
    )


def pin_sensors(mbs: Any, journal: Any, bore: Any) -> tuple[Any, ...]:
    """Sensors of the position and velocity of journal and bore at every step."""
    output = exudyn.OutputVariableType
    return tuple(
        mbs.AddSensor(
            SensorMarker(markerNumber=marker, outputVariableType=what, storeInternal=True, writeToFile=False)
        )
        for what in (output.Position, output.Velocity)
        for marker in (journal, bore)
    )


@dataclass(frozen=True)
class PinSeries:
    """Time [s], depth [m], rate [m/s], force [N] at all steps; the bore's place [m] and velocity along x."""

    time: np.ndarray
    depth: np.ndarray
    rate: np.ndarray
    force: np.ndarray
    bore: np.ndarray
    bore_speed: np.ndarray

    @staticmethod
    def read(mbs: Any, contact: JournalContact, sensors: Sequence[Any]) -> PinSeries:
        """What the sensors of `pin_sensors` have written."""
        journal, bore, journal_speed, bore_speed = (mbs.GetSensorStoredData(sensor) for sensor in sensors)
        apart, moving = journal[:, 1:3] - bore[:, 1:3], journal_speed[:, 1:3] - bore_speed[:, 1:3]
        eccentricity = np.hypot(*apart.T)
        depth = eccentricity - contact.bearing.clearance
        rate = (apart * moving).sum(axis=1) / np.maximum(eccentricity, 1e-300)
        force = contact_forces(contact, depth, rate)
        return PinSeries(journal[:, 0], depth, rate, force, bore[:, 1], bore_speed[:, 1])
