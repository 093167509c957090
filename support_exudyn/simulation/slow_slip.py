"""Warnings on friction: laws that cannot stick, and slip below the speed of their full friction.

A regularised law has no friction at rest, and its full friction above some speed. What it should hold creeps at
the speed at which the law gives just enough, and a slow joint rubs less than its coefficient says.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.observed_run import Outcome
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scenario.scenario import Scenario
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless

FULL, NONE = 0.99, 0.01  # shares of the largest coefficient between which friction counts as partial
MOST = 0.5  # share of the loaded time from which on that is reported


class _Rubbing(NamedTuple):
    """A contact or a joint with friction at the records: slip (n,) [m/s], and whether anything presses it."""

    where: str
    law: FrictionLaw
    slip: Series
    loaded: np.ndarray


def friction_warnings(scenario: Scenario, outcome: Outcome) -> list[str]:
    """A sentence or two for each pin and guide."""
    time = outcome.trajectory.time
    weights = np.zeros_like(time)  # [s] that each record stands for
    weights[:-1] += 0.5 * np.diff(time)
    weights[1:] += 0.5 * np.diff(time)
    worst: dict[str, tuple[float, str]] = {}  # of all corners or sections of a joint
    for one in _all_rubbing(scenario, outcome):
        creep, sentence = _partial(one, weights)
        if sentence and creep > worst.get(one.where, (0.0, ""))[0]:
            worst[one.where] = creep, f"{one.where}: {sentence}"
    return [sentence for _, sentence in worst.values()] + _moments_left_out(scenario, outcome)


def _partial(one: _Rubbing, weights: Series) -> tuple[float, str]:
    """How far a law creeps [m], and what that is; an empty sentence if it mostly does not."""
    least, full = one.law.slip_speed(NONE), one.law.slip_speed(FULL)
    speed = np.abs(one.slip)
    slow = one.loaded & (speed > least) & (speed < full)
    loaded, slowly = float(weights[one.loaded].sum()), float(weights[slow].sum())
    if not slowly > MOST * loaded:
        return 0.0, ""
    creep = float((weights * speed)[slow].sum())
    sizes = np.array([abs(one.law(v, 1.0)) for v in speed[slow].tolist()])
    share = float((weights[slow] * sizes).sum()) / slowly / one.law.largest_coefficient
    return creep, (
        f"{type(one.law).__name__} slips below its full-friction speed of {1e3 * full:.3g} mm/s for "
        f"{slowly / loaded:.0%} of the loaded time. It creeps {1e3 * creep:.4g} mm, at "
        f"{1e3 * creep / slowly:.3g} mm/s on average, with {share:.0%} of its full friction. LuGre sticks; a "
        "lower dynamic speed creeps less."
    )


def _all_rubbing(scenario: Scenario, outcome: Outcome) -> Iterator[_Rubbing]:
    """Everything whose friction law has no state."""
    run = outcome.trajectory
    for name, place in scenario.contact_places.items():
        law = place.contact.friction
        if not law.has_state and not isinstance(law, Frictionless):
            for contact in run.contacts_of(name):
                yield _Rubbing(place.of, law, np.asarray(contact.slip), np.asarray(contact.normal_force) > 0.0)
    pins, guides = scenario.friction_pins, scenario.friction_guides
    if run.in_space or not (pins or guides):
        return
    forces = [np.hypot(*run.pins[name].T) for name in pins]
    forces += [np.abs(run.slides[name]).max(axis=1) for name in guides]
    for (where, joint), force in zip(scenario.friction_joints.items(), forces, strict=True):
        if not joint.law.has_state:  # of pins in slots the slip is that without their turning
            yield _Rubbing(where, joint.law, joint.slips(run.motion), force > 0.0)


def _moments_left_out(scenario: Scenario, outcome: Outcome) -> list[str]:
    """Guides with friction that carry a moment, but have no block whose ends it would press on the walls."""
    run = outcome.trajectory
    if run.in_space:
        return []
    found = []
    for name, guide in scenario.friction_guides.items():
        force, moment = np.abs(run.slides[name]).max(axis=0).tolist()
        if guide.block is None and moment > 0.0:
            found.append(
                f"guides.{name}: friction by the moment of up to {moment:.4g} N m is left out, beside a force "
                f"of up to {force:.4g} N. Its block (block_mm) is missing, whose ends press on the walls."
            )
    return found
