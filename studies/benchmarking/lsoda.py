"""The slider-crank with a clearance slider pin as anyone with scipy would do it: LSODA and its events.

The crank is prescribed; the turn of the rod and the place of the slider are free. Between impacts and
separations, which `solve_ivp` locates, the equations are smooth and the initial impact velocity is a constant.
No friction, no gravity.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

from studies.benchmarking.peers.peer_run import contact_numbers, record_times
from support_exudyn import Scenario, SliderCrank, Steady
from user_forces import Frictionless
from user_forces.contact_state import Onset
from user_forces.values.value import InputError

PIN = "slider_pin"
MOST_PIECES = 2000  # of a run, each ends with an impact or separation
Series = npt.NDArray[np.float64]
Rates = Callable[[float, Any], list[float]]


class Numbers(NamedTuple):
    """Crank's length and speed, rod's length, mass and inertia, slider's mass and place, contact."""

    crank: float  # [m]
    speed: float  # [rad/s]
    angle: float  # at the start [rad]
    rod: float  # [m]
    rod_mass: float  # [kg]
    rod_inertia: float  # about its pin at the crank [kg m^2]
    slider_mass: float  # [kg]
    clearance: float  # [m]
    stiffness: float  # [N/m^1.5]
    factor: float  # chi [-]
    floor: float  # of the initial impact velocity [m/s]


class LsodaRun(NamedTuple):
    """The slider's place at the records [m], and impacts."""

    slider: Series
    onsets: tuple[Onset, ...]


def run_lsoda(scenario: Scenario, tolerance: float) -> LsodaRun:
    """Integrate a scenario.

    Arguments:
        scenario: SliderCrank driven by Steady, slider pin with clearance with its bore in the slider, no
            gravity, start "concentric", LankaraniNikravesh with exponent 1.5, no friction.
        tolerance: of LSODA, relative and absolute, for angle [rad], place [m] and their rates alike.

    Raises InputError if the scenario is not covered, RuntimeError if LSODA gives up.
    """
    numbers, end = _numbers(scenario), scenario.duration
    wanted = record_times(scenario)
    t, state, closed, speed = 0.0, _start(numbers), False, 0.0
    pieces: list[Series] = []
    onsets: list[Onset] = []
    while t < end:
        if len(pieces) > MOST_PIECES:
            raise RuntimeError(
                f"more than {MOST_PIECES} impacts and separations by {t} s: the tolerance is too loose"
            )
        inside = wanted[(wanted > t if pieces else wanted >= t) & (wanted <= end)]
        found = _smooth(numbers, t, end, state, closed, speed, inside, tolerance)
        if not found.success:
            raise RuntimeError(f"LSODA gave up at {t} s: {found.message}")
        pieces.append(found.y[1] if len(found.y) else inside[:0])
        if found.status == 0:
            break
        t, state = float(found.t_events[0][0]), found.y_events[0][0].tolist()
        closed = not closed
        rate = _pin(numbers, t, state)[1]
        if closed:
            speed = max(0.0, rate)
            onsets.append(Onset(t, speed))
        else:
            onsets[-1] = onsets[-1].separated(t, -rate)
    return LsodaRun(np.concatenate(pieces), tuple(onsets))


def _smooth(
    numbers: Numbers,
    begin: float,
    end: float,
    state: list[float],
    closed: bool,
    speed: float,
    inside: Series,
    tolerance: float,
) -> Any:
    """The motion up to the next impact or separation, as `solve_ivp` gives it, at the times inside."""
    side = -1.0 if closed else 1.0

    # just after a change the depth is zero but for rounding: it must not be seen as the next change
    def change(t: float, y: Any) -> float:
        if t == begin and begin > 0.0:
            return -side
        return _pin(numbers, t, y.tolist())[0]

    change.terminal = True  # type: ignore[attr-defined]
    change.direction = side  # type: ignore[attr-defined]
    return solve_ivp(
        rates(numbers, max(speed, numbers.floor) if closed else 0.0),
        (begin, end),
        np.array(state),
        method="LSODA",
        t_eval=inside,
        events=change,
        rtol=tolerance,
        atol=tolerance,
    )


def rates(n: Numbers, speed: float) -> Rates:
    """Right-hand side for rod's angle, slider's place and their rates; initial impact velocity 0: apart."""
    half, end_inertia = 0.5 * n.rod * n.rod_mass, n.rod_inertia
    square = n.speed * n.speed
    damping = n.factor / speed if speed else 0.0

    def right(t: float, y: Any) -> list[float]:
        turn, place, spin, velocity = y.tolist()
        c, s = math.cos(turn), math.sin(turn)
        angle = n.angle + n.speed * t
        bx, by = n.crank * math.cos(angle), n.crank * math.sin(angle)
        # moment of the rod's inertia in the acceleration of its pin, -speed^2 (bx, by)
        moment = half * square * (c * by - s * bx)
        push = 0.0
        if speed:
            x, z = bx + n.rod * c - place, by + n.rod * s
            eccentricity = math.sqrt(x * x + z * z)
            depth = eccentricity - n.clearance
            if depth > 0.0:
                x, z = x / eccentricity, z / eccentricity
                vx = -n.speed * by - n.rod * s * spin - velocity
                vz = n.speed * bx + n.rod * c * spin
                force = n.stiffness * depth * math.sqrt(depth) * (1.0 + damping * (x * vx + z * vz))
                if force > 0.0:
                    moment -= n.rod * force * (c * z - s * x)
                    push = force * x
        return [spin, velocity, moment / end_inertia, push / n.slider_mass]

    return right


def _pin(n: Numbers, t: float, y: Sequence[float]) -> tuple[float, float]:
    """Depth [m] and its rate [m/s]."""
    turn, place, spin, velocity = y
    angle = n.angle + n.speed * t
    bx, by = n.crank * math.cos(angle), n.crank * math.sin(angle)
    c, s = math.cos(turn), math.sin(turn)
    x, z = bx + n.rod * c - place, by + n.rod * s
    vx, vz = -n.speed * by - n.rod * s * spin - velocity, n.speed * bx + n.rod * c * spin
    eccentricity = math.sqrt(x * x + z * z)
    return eccentricity - n.clearance, (x * vx + z * vz) / (eccentricity or 1.0)


def _start(n: Numbers) -> list[float]:
    """State with an ideal pin."""
    bx, by = n.crank * math.cos(n.angle), n.crank * math.sin(n.angle)
    along = math.sqrt(n.rod**2 - by**2)
    spin = -n.speed * bx / along
    return [math.atan2(-by, along), bx + along, spin, -n.speed * by + spin * by]


def _numbers(scenario: Scenario) -> Numbers:
    machine, drive = scenario.machine, scenario.drive
    if not isinstance(machine, SliderCrank) or not isinstance(drive, Steady):
        raise InputError("this takes a SliderCrank and a Steady drive")
    if tuple(scenario.clearance_pins) != (PIN,) or any(scenario.gravity) or scenario.start != "concentric":
        raise InputError(f"this takes one clearance pin, {PIN}, no gravity and start = 'concentric'")
    contact = scenario.clearance_pins[PIN].contact
    if not isinstance(contact.friction, Frictionless):
        raise InputError("friction: allowed here: Frictionless")
    stiffness, factor, floor = contact_numbers(contact)
    return Numbers(
        crank=machine.crank_length,
        speed=drive.rate,
        angle=machine.start_angle,
        rod=machine.rod_length,
        rod_mass=machine.rod_mass,
        rod_inertia=machine.rod_inertia + 0.25 * machine.rod_mass * machine.rod_length**2,
        slider_mass=machine.slider_mass,
        clearance=contact.bearing.clearance,
        stiffness=stiffness,
        factor=factor,
        floor=floor,
    )
