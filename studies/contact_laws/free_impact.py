"""One free impact of a law: as a scenario, as measured, and by scipy in one dimension."""

from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

from support_exudyn import ClearancePin, ImpactStand, Result, Scenario, SolverSettings
from user_forces import JournalBearing, JournalContact, NormalLaw

PIN = "pin"
BORE_MASS, JOURNAL_MASS = 3.0, 2.0  # [kg]
LONGEST = 10.0  # durations of an undamped impact in which every law here has let go
Series = npt.NDArray[np.float64]


def free_impact(law: NormalLaw, speed: float, impact_steps: int, records: int = 10) -> Scenario:
    """A journal of 2 kg flies at a speed [m/s] against the wall of a free bore of 3 kg; nothing else acts.

    The run begins shortly before the impact and ends before the far wall can be reached.
    """
    stand = ImpactStand(bore_mass=BORE_MASS, journal_mass=JOURNAL_MASS, speed=speed)
    depth = law.turning_depth(0.5 * stand.reduced_mass * speed**2)
    time = LONGEST * 2.94 * depth / speed
    flight = 0.01 * time
    clearance = 10.0 * speed * time
    wide = JournalBearing(bore_radius=10.0 * clearance, clearance=clearance)
    contact = JournalContact(bearing=getattr(law, "bearing", wide), normal=law)  # of cylinders it has its own
    start = contact.bearing.clearance - speed * flight
    return Scenario(
        machine=ImpactStand(bore_mass=BORE_MASS, journal_mass=JOURNAL_MASS, speed=speed, eccentricity=start),
        pins={PIN: ClearancePin(contact=contact)},
        duration=flight + time,
        record_period=(flight + time) / records,
        gravity=(0.0, 0.0),
        solver=SolverSettings(impact_steps=impact_steps),
    )


def delivered_restitution(result: Result) -> float:
    """Speed of separation over initial impact velocity."""
    separation = result["bore.velocity_x"][-1] - result["journal.velocity_x"][-1]
    machine: Any = result.scenario.machine
    return float(separation / machine.speed)


def one_dimensional_restitution(law: NormalLaw, mass: float, speed: float) -> float:
    """Restitution of a free impact by scipy: m depth'' = -F, tension cut, until the depth is zero again."""
    scale = law.turning_depth(0.5 * mass * speed**2)  # so that tolerances mean something
    time = scale / speed

    def motion(_: float, state: Series) -> list[float]:
        depth = state[0] * scale
        force = max(0.0, law(float(depth), float(state[1] * speed), speed)) if depth > 0.0 else 0.0
        return [state[1], -force * time / (mass * speed)]

    def separation(_: float, state: Series) -> float:
        return float(state[0])

    separation.terminal, separation.direction = True, -1.0  # type: ignore[attr-defined]
    found = solve_ivp(
        motion, (0.0, 1e4), [0.0, 1.0], "LSODA", events=separation, rtol=1e-10, atol=1e-12, max_step=0.05
    )
    ends: Any = found.y_events
    return float(-ends[0][0][1])
