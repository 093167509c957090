"""Steps with which a loaded contact rings on: generalised alpha damps what its steps do not resolve.

A vibration of angular frequency w falls by exp(-D) within a time t,

    D = w t d(w h),   d = -ln|z| / (w h),   z the largest eigenvalue of a step of length h

With long steps it is gone before the first record. It then is with half of them, too, so that runs agree on
numbers that lack it: halving the steps tells errors only if the shortest of them leaves it as it is. There d is
of third order. A vibration that the law damps itself has not long to be left.

A journal that a load N presses into its bore, the sum e of clearance and depth away from the centre, vibrates
along the load and across it, where it swings like a pendulum of length e:

    dv/dt = -W (K x + C v),   K = k n n' + (N / e) t t',   C = c n n'

W its inverse effective mass, k and c stiffness and damping of the law. Friction is left out: many a law holds
nothing below some speed of sliding.
"""

import math
from typing import NamedTuple

import numpy as np

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.timescales import LoadedContact, loaded_contacts
from user_forces.normal.law import LoadError
from user_forces.roots import bracketed_root

RUNS = 3  # each with half the steps of the one before, from which errors are told
KEPT = 0.5  # D of the last of them; that before has eight times as much, so that the two differ
GONE = 18.0  # D, by the law itself, of a vibration that no longer counts: 1e-8 is left
SHORTEST, LONGEST = 1e-4, 2.0  # steps looked at, times the angular frequency
FASTEST = (
    10.0  # [m/s]: no journal makes contact faster; laws that keep the speed of their touch then damp least
)
SMALL = 1e-6  # share of a depth or a rate that is small


class Vibration(NamedTuple):
    """A small free vibration.

    time: one over its angular frequency [s]. fall: -d ln(size)/dt by the law's own damping [1/s].
    """

    time: float
    fall: float


def ringing_step(scenario: Scenario) -> float:
    """The longest step [s] from which three runs, with steps halved, show how loaded contacts ring.

    Infinite if nothing rings, or if the integrator damps nothing.
    """
    if scenario.solver.spectral_radius == 1.0:
        return math.inf
    steps = [
        _step(vibration, scenario.duration, scenario.solver.spectral_radius)
        for contact in loaded_contacts(scenario)
        for vibration in vibrations(contact)
    ]
    return 2.0 ** (RUNS - 1) * min(steps, default=math.inf)


def _step(vibration: Vibration, duration: float, spectral_radius: float) -> float:
    """The longest step [s] that leaves a vibration as it is."""
    lasts = duration / vibration.time
    if vibration.fall > 0.0:
        lasts = min(lasts, GONE / (vibration.fall * vibration.time))

    def excess(phase: float) -> float:
        return lasts * numerical_damping(phase, spectral_radius) - KEPT

    if excess(LONGEST) <= 0.0:
        return LONGEST * vibration.time
    if excess(SHORTEST) >= 0.0:
        return SHORTEST * vibration.time
    return bracketed_root(excess, SHORTEST, LONGEST, xtol=1e-6) * vibration.time


def numerical_damping(phase: float, spectral_radius: float) -> float:
    """Damping ratio of a vibration by steps of generalised alpha.

    phase: length of a step times the angular frequency. spectral_radius: see `SolverSettings`.
    """
    rho = spectral_radius
    share_m, share_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
    gamma = 0.5 - share_m + share_f
    beta = 0.25 * (1.0 - share_m + share_f) ** 2
    square = phase * phase
    # of place, speed times step, and algorithmic acceleration times its square, after a step and before
    after = [[1.0, 0.0, -beta], [0.0, 1.0, -gamma], [(1.0 - share_f) * square, 0.0, 1.0 - share_m]]
    before = [[1.0, 1.0, 0.5 - beta], [0.0, 1.0, 1.0 - gamma], [-share_f * square, 0.0, -share_m]]
    sizes = np.abs(np.linalg.eigvals(np.linalg.solve(np.array(after), np.array(before))))
    return max(0.0, -math.log(float(sizes.max())) / phase)


def vibrations(contact: LoadedContact) -> list[Vibration]:
    """The vibrations of a contact under its load, with the least that its law may damp them.

    None of a law that gives what is no number: the run refuses it with its name.
    """
    law = contact.contact.normal
    depth = law.resting_depth(contact.load) if contact.stiffness else 0.0
    if not (0.0 < contact.stiffness < math.inf and 0.0 < depth < math.inf):
        return []
    rate = SMALL * depth / contact.time
    try:
        damping = (law(depth, rate, FASTEST) - law(depth, -rate, FASTEST)) / (2.0 * rate)
    except (LoadError, ArithmeticError):
        damping = 0.0
    damping = damping if math.isfinite(damping) else 0.0
    along = np.outer(contact.along, contact.along)
    bearing = contact.contact.bearing
    across = 0.0 if bearing.is_slot else contact.load / (bearing.clearance + depth)  # walls are straight
    stiffness = contact.stiffness * along + across * (np.eye(2) - along)
    nothing, one = np.zeros((2, 2)), np.eye(2)
    answer = -contact.inverse_mass
    rates = np.linalg.eigvals(np.block([[nothing, one], [answer @ stiffness, answer @ (damping * along)]]))
    return [Vibration(1.0 / z.imag, max(0.0, -z.real)) for z in rates.tolist() if z.imag > SMALL * abs(z)]
