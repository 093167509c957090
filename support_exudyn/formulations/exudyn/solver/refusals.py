"""Why a run could not go on, in words: reason and advice."""

from support_exudyn.formulations import change_points
from support_exudyn.formulations.exudyn.scene.driven_parts import supply_at
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scene.contract import ENGINE_ADVICE, explained, first_line
from support_exudyn.scene.limits import ENDS, past_ends
from user_forces.lawful import UNLAWFUL, LawError
from user_forces.normal.law import LoadError

ADVICE = (
    "Try a smaller step; if that does not help, look whether the posture is near a dead centre "
    "or a contact is far stiffer than the masses beside it allow."
)
STEEP = (
    "Is friction far steeper than steps can follow (mass times the ramp from static to dynamic speed over the "
    "friction force, against the step)? Widen the ramp, take a smaller step, or formulation = 'compiled' with "
    "more `solver.most_steps`."
)
FEWER_STEPS = (
    "Allow longer steps, fewer of them in an impact (`solver.impact_steps`), a shorter duration, or more steps "
    "in all (`solver.most_steps`)."
)

EMPTY = "Give it end_stops inside of its oil's lengths, or look at what moves it."


def why(error: Exception, scene: EngineScene, ahead: float, calm: Series | None) -> tuple[str, str]:
    """Reason and advice, where the engine has raised an error.

    Raises its cause if that is no matter of the run's numbers.

    Arguments:
        error: the engine's.
        scene, ahead: see `unlawful`.
        calm: see `singular`.
    """
    cause = error.__cause__  # set if a function of ours raised
    if isinstance(cause, LawError):
        return str(cause), UNLAWFUL
    if isinstance(cause, LoadError):
        return "a contact is overloaded", str(cause)
    if isinstance(cause, ArithmeticError):
        return first_line(cause), ADVICE
    if cause is not None:
        raise cause from None
    return unlawful(scene, ahead) or singular(scene, calm) or (explained(error), ENGINE_ADVICE)


def singular(scene: EngineScene, calm: Series | None) -> tuple[str, str] | None:
    """Reason and advice if a linkage has come to a change point or dead centre.

    calm: the last coordinates that are sure if Newton's method has failed; beside such a point the present ones
    may be far off.
    """
    for position in (scene.mbs.systemData.GetODE2Coordinates(), calm):
        if position is not None and (reason := change_points.ended_at(scene.scenario, position)):
            return reason, change_points.ADVICE
    return None


def unlawful(scene: EngineScene, ahead: float) -> tuple[str, str] | None:
    """Reason and advice if a law, a load or a drive gives no number a little further on.

    The engine meets what is no number by shorter and shorter steps, and tells nothing of it in the end.

    Arguments:
        scene: at the last step that could be made.
        ahead: time that was to be reached [s].
    """
    if pressed := past_ends(scene.scenario, scene.legs.lengths()):
        return pressed, ENDS
    if empty := scene.legs.empty():
        return empty, EMPTY
    try:
        scene.legs.follow(ahead)
        for part in scene.driven:
            supply_at(part.drive, ahead)
        motion = scene.instant(()).motion
        for load in scene.loads.values():
            load.probe(ahead, motion)
        for name, friction in scene.frictions.items():
            friction.probe(name)
        for name, pin in scene.clearance_joints.items():
            pin.probe(name)
    except LawError as error:
        return str(error), UNLAWFUL
    return None


def state_of(scene: EngineScene) -> dict[str, float]:
    """What is told of a scene where a run has failed: spins [rad/s], and of clearance pins [m], [m/s]."""
    state = {f"{name}.angular_velocity": spin for name, spin in scene.spins().items()}
    for name, pin in scene.clearance_joints.items():
        stem = scene.scenario.contact_stem(name)
        state[f"{stem}.depth"] = pin.memory.depth
        state[f"{stem}.rate"] = pin.memory.rate
        state[f"{stem}.impact_velocity"] = pin.memory.impact_velocity
    return state
