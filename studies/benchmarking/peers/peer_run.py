"""What a competitor's run gives, how its impacts are found afterwards, and what the competitors share."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
import numpy.typing as npt
from exudyn.itemInterface import NodeGenericData, ObjectContactSphereSphere, SensorMarker

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.simulation.single_run import paused_collector
from user_forces.contact import JournalContact
from user_forces.contact_state import Onset
from user_forces.normal.power_laws import LankaraniNikravesh
from user_forces.values.value import InputError

Series = npt.NDArray[np.float64]


@dataclass(frozen=True)
class PeerRun:
    """Outcome of a competitor's run, at the ends of all its steps.

    time: [s]. force: magnitude in the clearance pin [N]. depth: [m], rate: [m/s], of the contact. solve_time:
    of the solver, on the processor [s].
    """

    time: Series
    force: Series
    depth: Series
    rate: Series
    solve_time: float

    @property
    def onsets(self) -> tuple[Onset, ...]:
        """Impacts, by interpolation of the depth."""
        return impacts(self.time, self.depth, self.rate)


def impacts(
    time: Sequence[float] | Series, depth: Sequence[float] | Series, rate: Sequence[float] | Series
) -> tuple[Onset, ...]:
    """Impacts from time [s], depth [m] and its rate [m/s] at the ends of all steps, and how they end.

    Between two steps the depth is the cubic that fits depth and rate at both; where it passes zero is found
    by bisection, and its slope there is the speed.
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
