"""Whether a run that has finished can be believed: what is looked at in every one.

A run that fails is refused, because nothing else tells that its numbers mean nothing. What is allowed is wide:
that a run passes does not make it accurate.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from support_exudyn.formulations import change_points
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.observed_run import Outcome
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scenario.recorded_channels import Channel
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Failure
from support_exudyn.scene.limits import DEEPEST, ENDS, SOFT, too_deep
from user_forces.lawful import UNLAWFUL, is_own
from user_forces.values.value import Vector2

# Energy that the balance may be open by, as a share of what was turned over: kinetic, potential and elastic
# energy, losses and work. The reference support closes to 1e-5.
OPEN = 0.05
GIVEN_BACK = 1e-3  # share of the same by which a loss may become less: powers are integrated over steps
ROUNDING = 1e-8  # [m] by which the weight of all bodies would have to be lifted to make up for rounding
ROUNDING_AT_REST = 1e-12  # [J/kg], of bodies that nothing moves: that of a speed of a micrometre a second
ENERGY = "energy."
TURNED = ("kinetic", "potential", "elastic", "damping_loss", "friction_loss", "work")
COARSE = (
    "Steps are too long for what happens in them: take a smaller `step` or more `solver.impact_steps`, look "
    "whether friction is steep (its ramp from static to dynamic speed), or ask for an accuracy."
)
UNSAID = " If that does not help: a drive of one's own whose speed jumps has to say so in its `breaks`."
SLOT = "Slots have ends, and stops are not covered: end the motion before, or draw a longer slot (`along`)."
APART = 1e-4  # [m] that what is joined may be apart
DRIFTED = "Take a smaller `step` or a smaller `solver.newton_tolerance`."


def result_checks(scenario: Scenario, outcome: Outcome, channels: Mapping[str, Channel]) -> Failure | None:
    """The first reason not to believe a run; None if there is none. channels: all, whatever is asked for."""
    return next(_reasons(scenario, outcome, channels), None)


def _reasons(scenario: Scenario, outcome: Outcome, channels: Mapping[str, Channel]) -> Iterator[Failure]:
    time = channels["time"].values
    for name, channel in channels.items():
        if not np.isfinite(channel.values).all():
            first = float(time[np.argmin(np.isfinite(channel.values))])
            yield Failure(f"{name} is no longer a finite number", COARSE, first, finer=True)
    for name, place in scenario.contact_places.items():
        if (depth := place.depth(channels)) is not None:  # in space the edges have one each
            at = int(np.argmax(depth))
            deepest, bearing = float(depth[at]), place.contact.bearing
            if deepest > DEEPEST * bearing.size:
                yield Failure(too_deep(name, deepest, bearing), SOFT, float(time[at]), finer=True)
    yield from _change_points(scenario, outcome)
    open_by, allowed = energy_open(scenario, channels)
    if (open_by > allowed).any():
        first = int(np.argmax(open_by > allowed))
        reason = (
            f"energy does not add up: it is open by {open_by.max():.3g} J; allowed: {OPEN:.0%} of what was "
            f"turned over, {allowed:.3g} J"
        )
        yield Failure(reason, COARSE + UNSAID, float(time[first]), finer=True)
    yield from _losses(scenario, outcome, channels)
    yield from _pistons_at_ends(scenario, outcome)
    yield from _slots_left(scenario, outcome)
    if (gap := joints_apart(scenario, outcome)) is not None and (gap > APART).any():
        first = int(np.argmax(gap > APART))
        reason = f"what is joined is {1e3 * gap.max():.3g} mm apart; allowed: {1e3 * APART:g} mm"
        yield Failure(reason, DRIFTED, float(time[first]), finer=True)


def _change_points(scenario: Scenario, outcome: Outcome) -> Iterator[Failure]:
    """Whether forces have no limit in a change point or dead centre that the run has passed."""
    run = outcome.trajectory
    if not run.in_space and (point := change_points.passed(scenario, run)) is not None:
        yield Failure(point[1], change_points.ADVICE, point[0])


def _losses(scenario: Scenario, outcome: Outcome, channels: Mapping[str, Channel]) -> Iterator[Failure]:
    """Whether what is lost becomes less, though nothing is given back but what friction laws have stored.

    Laws are checked one by one during the run, see `lawful`; laws with a state only here. By as much as the
    balance is open, the integral of a loss may be off, too.
    """
    largest = max(outcome.largest_force.values(), default=0.0)
    stored = sum(
        float(np.abs(contact.deflection).max()) * largest
        for name, place in scenario.contact_places.items()
        if place.contact.friction.has_state
        for contact in outcome.trajectory.contacts_of(name)
        if contact.deflection is not None
    )
    time, allowed = channels["time"].values, GIVEN_BACK * turned_over(channels) + rounding_of_energy(scenario)
    allowed += float(energy_open(scenario, channels)[0].max())
    lost = {name: channels[ENERGY + name].values for name in ("damping_loss", "friction_loss")}
    for name, more in (("damping_loss", 0.0), ("friction_loss", stored)):
        back = np.maximum.accumulate(lost[name]) - lost[name]
        if (back > allowed + more).any():
            first = int(np.argmax(back > allowed + more))
            yield Failure(
                f"{ENERGY}{name} becomes less by {back.max():.3g} J; allowed: {allowed + more:.3g} J, "
                f"{_who_loses(scenario, name)}",
                UNLAWFUL if _has_own_law(scenario) else COARSE,
                float(time[first]),
            )


def _has_own_law(scenario: Scenario) -> bool:
    """Whether a user's class takes part in what is lost: those of the package keep to the signs of losses."""
    laws: list[object] = [*scenario.acting_loads.values(), *scenario.actuators.values()]
    for pin in scenario.pins.values():
        laws += pin.losses().values()
    for guide in scenario.guides.values():
        laws += guide.losses().values()
    return any(map(is_own, laws))


def _who_loses(scenario: Scenario, kind: str) -> str:
    """What of a scenario may lose energy in this way, with its laws."""
    kinds = {f"pins.{name}": pin.losses() for name, pin in scenario.pins.items()}
    kinds |= {f"guides.{name}": guide.losses() for name, guide in scenario.guides.items()}
    laws = {name: losses[kind] for name, losses in kinds.items() if kind in losses}
    found = [f"{name} = {type(law).__name__}" for name, law in laws.items()]
    if kind == "damping_loss":
        loads = {**scenario.acting_loads, **scenario.blocks}
        found += [f"loads.{name} = {type(load).__name__}" for name, load in loads.items()]
        found += [f"actuators.{name}" for name in scenario.compliant_actuators]
    return "of " + ", ".join(found)


def _pistons_at_ends(scenario: Scenario, outcome: Outcome) -> Iterator[Failure]:
    """Whether a piston has come to an end of its cylinder, which nothing in the model stops it at."""
    run = outcome.trajectory
    if not scenario.valved or run.in_space:
        return
    for name, cylinder in scenario.valved.items():
        actuator = scenario.linkage.actuators[name]
        extension = run.motion.lengthening(actuator)[0] - actuator.start_length
        reasons = (cylinder.past_end(float(one), name) for one in extension)
        first, reason = next(((n, one) for n, one in enumerate(reasons) if one), (0, ""))
        if reason:
            yield Failure(reason, ENDS, float(run.time[first]))


def _slots_left(scenario: Scenario, outcome: Outcome) -> Iterator[Failure]:
    """Whether a pin has left its slot at an end, which the model has no stop for."""
    run, slides = outcome.trajectory, scenario.linkage.slides.items()
    if run.in_space:
        return
    for name, slide in slides:
        beyond = run.motion.past_ends(slide)
        if slide.turns and beyond.any():
            first = int(np.argmax(beyond > 0.0))
            x, y = 1e3 * run.motion.place(slide.body, slide.point)[first]
            reason = (
                f"guides.{name}: its pin leaves the slot at ({x:.4g}, {y:.4g}) mm and goes up to "
                f"{1e3 * beyond.max():.4g} mm beyond the end; the slot is {1e3 * slide.length:.4g} mm long"
            )
            yield Failure(reason, SLOT, float(run.time[first]))


def energy_open(scenario: Scenario, channels: Mapping[str, Channel]) -> tuple[Series, float]:
    """The gap of the energy balance at the records (n,) [J], and the largest that is allowed [J]."""
    allowed = OPEN * turned_over(channels) + rounding_of_energy(scenario)
    return np.abs(channels[ENERGY + "balance"].values), allowed


def rounding_of_energy(scenario: Scenario) -> float:
    """The gap of the energy balance that rounding may leave [J]."""
    mass = sum(body.mass for body in scenario.linkage.bodies.values())
    return (ROUNDING * float(np.hypot(*scenario.gravity)) + ROUNDING_AT_REST) * mass


def turned_over(channels: Mapping[str, Channel]) -> float:
    """Energy that changed hands in a run [J]: how far each kind of it went, and the motion at the start."""
    energies = [channels[ENERGY + name].values for name in TURNED]
    return sum(float(np.abs(energy - energy[0]).max()) for energy in energies) + float(energies[0][0])


def joints_apart(scenario: Scenario, outcome: Outcome) -> Series | None:
    """Largest distance of what ideal pins, rigid actuators and guides hold together, at the records (n,) [m].

    That of a crank from where its drive wants it is counted at the size of the linkage.

    None for runs in space.
    """
    run = outcome.trajectory
    if run.in_space:
        return None
    linkage, time, motion = scenario.linkage, run.time, run.motion
    gaps = np.zeros_like(time)  # squared
    extensions: dict[int, Series] = {}  # of drives, which actuators share
    for name, pin in linkage.pins.items():
        if scenario.pin(name).holds:
            x, y = _apart(motion, (pin.first, pin.first_point), (pin.second, pin.second_point))
            gaps = np.maximum(gaps, x * x + y * y)
    for name, actuator in linkage.actuators.items():
        if name not in scenario.compliant_actuators:
            x, y = _apart(motion, (actuator.head, actuator.head_point), (actuator.foot, actuator.foot_point))
            drive = scenario.drive_of(name)
            if id(drive) not in extensions:
                extensions[id(drive)] = np.array([drive.extension(t) for t in time.tolist()])
            wanted = actuator.start_length + extensions[id(drive)]
            gaps = np.maximum(gaps, (np.sqrt(x * x + y * y) - wanted) ** 2)
    size = scenario.held.size
    for name, crank in linkage.cranks.items():
        drive = scenario.drive_of(name)
        turned = motion.turn(crank.body) - np.array([drive.extension(t) for t in time.tolist()])
        gaps = np.maximum(gaps, (size * turned) ** 2)
    for slide in scenario.guided_linkage.slides.values():
        x, y = _apart(motion, (slide.body, slide.point), (slide.against, slide.point))
        along = slide.direction + motion.turn(slide.against)
        gaps = np.maximum(gaps, (np.cos(along) * y - np.sin(along) * x) ** 2)
    return np.sqrt(gaps)


def _apart(motion: BodyMotion, one: tuple[str, Vector2], other: tuple[str, Vector2]) -> tuple[Series, Series]:
    """How far a point of a body is from one of another, in both directions (n,) [m]."""
    (x, y), (other_x, other_y) = motion.place(*one).T, motion.place(*other).T
    return x - other_x, y - other_y
