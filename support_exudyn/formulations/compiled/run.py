"""The run of the compiled formulation: scenario in, outcome out."""

import numpy as np

from support_exudyn.formulations import change_points
from support_exudyn.formulations.compiled.integrate import integrate
from support_exudyn.formulations.compiled.outcome import record_sizes, trajectory
from support_exudyn.formulations.compiled.start import error_weights, first_state
from support_exudyn.formulations.statistics.collected import RunStatistics, within_steps
from support_exudyn.formulations.statistics.steps import OF_STEP
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import DataNeeds
from support_exudyn.mechanics.kinetics import joint_impulses
from support_exudyn.mechanics.observed_run import Outcome
from support_exudyn.mechanics.trajectory import Counts, Impulse, OilEvent
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.hydraulics.inlets import Inlet
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.arrays import (
    DEAD_CENTRE,
    FINISHED,
    GOING,
    MOST_OIL_EVENTS,
    PAUSED,
    REPORT,
    STAGES,
    STUCK,
    TOO_MANY_IMPACTS,
    TOO_MANY_OIL_EVENTS,
    TOO_MANY_STEPS,
    Scratch,
    Vector,
)
from support_exudyn.scene.contract import Failure, Progress, SimulationError
from support_exudyn.scene.hydraulics.fill import empty_legs
from support_exudyn.scene.limits import ENDS, past_ends
from support_exudyn.scene.setup import Model, model_of
from user_forces.contact_state import Onset
from user_forces.lawful import UNLAWFUL, LawError, look
from user_forces.normal.law import LoadError

FIRST_STEP = 1e-5  # at most [s]
AT_FIRST = 1e-6  # tolerance below which the first step is shorter
FEWER_STEPS = "Allow a larger tolerance, a shorter duration, or more steps (`solver.most_steps`)."
STEEP = ' Very small hoses and very steep valves need fewer with `formulation = "exudyn"`.'
AT_ONCE = 80_000  # steps times bodies, some 0.3 s: until then it cannot be interrupted, and tells no progress
NUMBERS_AT_ONCE = 400_000  # of the nodes of steps, 3 MB: then they become statistics
CLOSES = "Look whether the posture is near a dead centre, or a pin is pressed far out of its place."
MOST_IMPACTS = 100_000
NOTHING_RESTS = "Look at the contact law: nothing comes to rest."
EMPTY = "Give it end_stops inside of its oil's lengths, or look at what moves it."
JAMS = " Or a joint jams by its friction: take a smaller coefficient, a longer block, or clearance in "
SHORT = "Allow a larger tolerance."
CHATTER = "A valve chatters: give it hysteresis, a poppet or a smaller flow."


class _Run:
    """A run while it lasts."""

    def __init__(self, model: Model) -> None:
        self.model, self.scenario = model, model.scenario
        self.y = first_state(model)
        self.statistics = RunStatistics(self.scenario)
        width = sum(record_sizes(model))
        at_once = min(AT_ONCE // model.scene.bodies.size, NUMBERS_AT_ONCE // (OF_STEP * width))
        self.at_once = max(1, at_once)
        count = OF_STEP * self.at_once + 1 if self.statistics.wanted else 0
        self.nodes = np.empty((1 + count, width))  # of steps, behind the record at the start
        self.room = self._scratch(width)
        self.rows, self.report = self.room.rows, self.room.report[0]
        self.impulses: list[Impulse] = []
        self.code = FINISHED

    def _scratch(self, width: int) -> Scratch:
        """Room for the run, whose records have so many numbers."""
        model, tolerance = self.model, self.scenario.solver.tolerance
        scene, states = model.scene, self.y.size
        weights = error_weights(model, self.y, tolerance)
        going = np.zeros(1, GOING)
        # steps that only growth limits follow the tolerance too, or runs at several tolerances would be alike
        going["next_step"] = FIRST_STEP * min(1.0, (tolerance / AT_FIRST) ** 0.2)
        return Scratch(
            right=np.zeros(scene.rows.size),
            impulses=np.zeros(scene.rows.size),
            end=np.zeros(states),
            probe=np.zeros(states),
            slope=np.zeros(states),
            along=np.zeros(states),
            path=np.zeros((5, states)),
            rates=np.zeros((STAGES, states)),
            now=scene.contacts.copy(),
            then=scene.contacts.copy(),
            going=going,
            report=np.zeros(1, REPORT),
            weights=weights,
            times=model.times,
            rows=np.zeros((model.times.size, width)),
            forces=bool(needs(self.scenario) & (DataNeeds.ACCELERATION | DataNeeds.JOINTS)),
            nodes=self.nodes[1:],
            onsets=np.empty((MOST_IMPACTS if model.contacts else 0, 5)),
            oil_events=np.empty((MOST_OIL_EVENTS if model.legs.names else 0, 3)),
        )

    def go(self, progress: Progress) -> None:
        """Integrate to the end, or to where it cannot go on."""
        model, scenario = self.model, self.scenario
        pause = self.at_once
        for segment, begin, end in zip(model.courses.segments, model.edges, model.edges[1:], strict=False):
            model.scene.courses[:] = segment
            jumps = self._jumps(begin)
            if begin == 0.0:
                model.scene.courses["jump"] = jumps
                for course, one in zip(model.scene.courses, self._followed(), strict=False):  # loads' are last
                    course["still"] = 0.0 in one.breaks
            most = scenario.solver.most_steps
            while (code := integrate(model.scene, self.room, self.y, begin, end, jumps, most, pause)) == PAUSED:
                self.take_nodes()
                pause += self.at_once
                progress(float(self.room.going[0]["at"] / scenario.duration))
            held = model.scene.joints["course"]
            if jumps[held[held >= 0]].any():  # oil gives way
                self._note_jump(begin)
            if code != FINISHED:
                self.code = code
                return

    def take_nodes(self) -> None:
        """Take the nodes of the steps since the last pause into the statistics."""
        count = int(self.report["nodes"])
        if count > 0:
            nodes = self.room.nodes
            self.nodes[0] = self.rows[0]
            rows = self.nodes[: 1 + OF_STEP * count]
            time = rows[1:, 0].reshape(count, OF_STEP).copy()
            rows[1:, 0] = within_steps(time).ravel()
            self.statistics.add(time, trajectory(self.model, rows, _oil_events(self), self.statistics.needs))
            nodes[0], self.report["nodes"] = nodes[OF_STEP * count], 0.0

    def stop_before_first_nan(self) -> None:
        """Mark the run as stopped at its first record that is not finite, in the posture that leads there."""
        first = int(np.argmin(np.isfinite(self.rows.sum(axis=1))))
        self.code, self.report["not_a_number"] = STUCK, 1.0
        self.report["stopped_at"] = self.model.times[first]
        if first > 0:
            count, last = 3 * self.model.scene.bodies.size, self.rows[first - 1]
            self.y[: 2 * count] = last[1 : 1 + 2 * count]
            self.y[:count] += (self.model.times[first] - last[0]) * self.y[count : 2 * count]

    def _followed(self) -> list[Drive | Inlet]:
        """What drives and valves follow, in the order of the courses."""
        drives = [self.scenario.drive_of(name) for name in self.model.drives]
        return [*drives, *(self.scenario.valved[name].inlet for name in self.model.valves)]

    def _jumps(self, t: float) -> Vector:
        """Jumps of the rates of all courses at t [s]."""
        found = np.zeros(self.model.scene.courses.size)
        for n, name in enumerate(self.model.drives):
            if t in (drive := self.scenario.drive_of(name)).breaks:
                found[n] = drive.speed_jump(t)
        return found

    def _note_jump(self, t: float) -> None:
        """Keep the impulses by which velocities have jumped at t [s]."""
        found = {name: -float(self.room.impulses[row]) for name, row in self.model.driven_rows.items()}
        cranks = {name: found.pop(name) for name in self.scenario.linkage.cranks}
        held = self.scenario.held.kinetics.constraints
        joints = joint_impulses(held, self.room.impulses[self.model.order])
        self.impulses.append(Impulse(t, found, float(self.report["jump_energy"]), cranks, joints))


def run(scenario: Scenario, progress: Progress) -> Outcome:
    """Run a scenario. Raises SimulationError if it cannot be finished."""
    going = _Run(model_of(scenario))
    going.go(progress)
    if going.code == FINISHED and not np.isfinite(going.rows.sum()):
        going.stop_before_first_nan()
    if going.code != FINISHED:
        raise SimulationError(_failure(going))
    going.take_nodes()
    progress(1.0)
    return _outcome(going)


def _outcome(going: _Run) -> Outcome:
    model, report = going.model, going.report
    impacts: dict[str, list[Onset]] = {name: [] for name in model.contacts}
    for number, *onset in going.room.onsets[: int(report["impacts"])].tolist():
        impacts[model.contacts[int(number)]].append(Onset(*onset))
    contacts, events = model.scene.contacts, _oil_events(going)
    return Outcome(
        trajectory=trajectory(model, going.rows, events, needs(going.scenario)),
        onsets={name: tuple(found) for name, found in impacts.items()},
        largest_force=dict(zip(model.contacts, contacts["largest"].tolist(), strict=True)),
        largest_force_time=dict(zip(model.contacts, contacts["largest_at"].tolist(), strict=True)),
        impulses=tuple(going.impulses),
        oil_events=events,
        statistics=going.statistics.finished(),
        counts=Counts(
            steps=int(report["accepted"]),
            cut_steps=int(report["cuts"]),
            evaluations=int(report["evaluations"]),
            clamped_steps=int(report["clamped"]),
        ),
    )


def _oil_events(going: _Run) -> dict[str, tuple[OilEvent, ...]]:
    """What happened in each leg with elements."""
    legs, arrays = going.model.legs, going.model.scene.legs
    if arrays is None:
        return {}
    found: dict[str, list[OilEvent]] = {name: [] for name in legs.names if going.scenario.legs[name].elements}
    for t, k, side in going.room.oil_events[: int(going.report["oil_events"])].tolist():
        leg = legs.names[arrays.gaps[int(k)]["leg"]]
        found[leg].append(OilEvent(t, legs.gaps[int(k)], side > 0.0))
    return {name: tuple(events) for name, events in found.items()}


def _failure(going: _Run) -> Failure:
    """Why a run stopped."""
    report, scenario = going.report, going.scenario
    count = 3 * len(scenario.linkage.bodies)
    state = {"step": float(report["last_step"])}
    for n, name in enumerate(scenario.linkage.bodies):
        state[f"{name}.angular_velocity"] = float(going.y[count + 3 * n + 2])
    state["impacts"] = float(report["impacts"])
    code, legs = going.code, going.model.scene.legs
    if code == TOO_MANY_STEPS:
        reason, advice = (
            f"more than {scenario.solver.most_steps} steps",
            FEWER_STEPS + (STEEP if scenario.legs else ""),
        )
    elif code == TOO_MANY_IMPACTS:
        reason, advice = f"more than {MOST_IMPACTS} impacts", NOTHING_RESTS
    elif code == TOO_MANY_OIL_EVENTS:
        reason, advice = f"more than {MOST_OIL_EVENTS} openings and closings of valves", CHATTER
    elif broken := _broken_law(going):
        reason, advice = broken
    elif pressed := _pressed_through(going):
        reason, advice = pressed, ENDS
    elif legs is not None and (empty := empty_legs(going.model.legs, legs)):
        reason, advice = empty, EMPTY
    elif singular := change_points.ended_at(scenario, going.y[:count]):
        reason, advice = singular, change_points.ADVICE
    elif code == DEAD_CENTRE:
        reason, advice = "the linkage is at a dead centre", CLOSES
    elif report["not_a_number"]:
        reason, advice = "the linkage cannot close, or a value is no longer a finite number", CLOSES
    else:
        reason, advice = "the step became too short", SHORT
    if advice in (CLOSES, SHORT) and scenario.friction_laws:
        advice += f"{JAMS}{', '.join(scenario.friction_laws)}."
    return Failure(reason, advice, float(report["stopped_at"]), state)


def _pressed_through(going: _Run) -> str:
    """The message that a piston is beyond an end of its cylinder where the run stopped; empty: none is."""
    linkage, size = going.scenario.linkage, 3 * len(going.scenario.linkage.bodies)
    motion = BodyMotion(linkage, going.y[None, :size], going.y[None, size : 2 * size])
    lengths = {name: motion.lengthening(one)[0][0] for name, one in linkage.actuators.items()}
    return past_ends(going.scenario, lengths)


def _broken_law(going: _Run) -> tuple[str, str] | None:
    """What the laws of a contact say, asked in Python, where the run could not go on by what they give."""
    for name, record in zip(going.model.contacts, going.model.scene.contacts, strict=True):
        if record["asked_depth"] == 0.0:
            continue
        contact = going.scenario.contact_places[name].contact
        depth, rate, slip = (float(record[f"asked_{what}"]) for what in ("depth", "rate", "slip"))
        try:
            asked = contact.normal(depth, rate, float(record["impact_velocity"]))
            normal, elastic = 0.0 if asked < 0.0 else asked, contact.normal.elastic_force(depth)
            friction = contact.friction(slip, normal, float(record["asked_deflection"]))
            look(contact, depth, rate, slip, normal, friction, elastic, name)
        except LoadError as error:
            return "a contact is overloaded", str(error)
        except LawError as error:
            return str(error), UNLAWFUL
        except ArithmeticError:
            pass
        except Exception as error:  # whatever a user's law does wrong
            return f"{name}: a law of the contact fails: {type(error).__name__}: {error}", UNLAWFUL
    return None
