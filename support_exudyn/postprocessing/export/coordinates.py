"""The engine's coordinates of all bodies at the records of a run, from its channels, whatever computed it."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.channels import chosen
from support_exudyn.mechanics.space.motion import UNTURNED, parameter_rates
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.poses import WHY, Poses
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

IN_PLANE = ("x", "y", "angle", "velocity_x", "velocity_y", "angular_velocity")
IN_SPACE = (
    *("x", "y", "z", "angle", "roll", "yaw", "velocity_x", "velocity_y", "velocity_z"),
    *("angular_velocity", "angular_velocity_x", "angular_velocity_y"),
)


def channels_of_bodies(scenario: Scenario) -> list[str]:
    """Names of the channels from which the coordinates follow."""
    if scenario.dimensions == 3:
        return [f"{body}.{what}" for body in scenario.space.bodies for what in IN_SPACE]
    return [f"{body}.{what}" for body in scenario.linkage.bodies for what in IN_PLANE]


def check_recorded(scenario: Scenario) -> None:
    """Raise InputError if a run of the scenario will lack a channel from which the coordinates follow."""
    recorded = set(chosen(scenario.recipes, scenario.channels))
    missing = [name for name in channels_of_bodies(scenario) if name not in recorded]
    if missing:
        raise InputError(
            f"channels = {scenario.channels}: lacks {len(missing)} by which a solution file says where the "
            f"bodies are, such as {missing[0]!r}; allowed with a solution file: patterns that match all of "
            "them, or ('*',)"
        )


def coordinates(result: Result) -> dict[str, tuple[Series, Series]]:
    """Coordinates of every body in the engine and their rates, shapes (n, 3) in the plane, (n, 7) in space.

    They are what has changed since the start posture: place of the centre of mass [m], then the angle [rad],
    or the four Euler parameters. Raises InputError if a channel that this needs was not recorded.
    """
    if result.scenario.dimensions == 3:
        poses = Poses(result)
        return {body: _in_space(poses, body) for body in result.scenario.space.bodies}
    return {body: _in_plane(result, body) for body in result.scenario.linkage.bodies}


def _in_plane(result: Result, name: str) -> tuple[Series, Series]:
    body = result.scenario.linkage.bodies[name]
    columns = [result.recorded(f"{name}.{what}", WHY) for what in IN_PLANE]
    return np.column_stack(columns[:3]) - [*body.centre, body.angle], np.column_stack(columns[3:])


def _in_space(poses: Poses, name: str) -> tuple[Series, Series]:
    pose = poses.of(name)
    parameters = euler_parameters(pose.turn)
    place = np.hstack([pose.place - np.array(pose.start), parameters - UNTURNED])
    return place, np.hstack([pose.velocity, parameter_rates(parameters, pose.spin)])


def euler_parameters(turn: Series) -> Series:
    """Of rotations (n, 3, 3) that follow each other: (n, 4), without jumps of sign, the first positive."""
    found = Rotation.from_matrix(turn).as_quat()[:, [3, 0, 1, 2]]
    follows = np.sum(found[1:] * found[:-1], axis=1) >= 0.0
    first = 1.0 if found[0, 0] >= 0.0 else -1.0
    signs = first * np.cumprod([1.0, *np.where(follows, 1.0, -1.0)])
    steady: Series = signs[:, None] * found
    return steady
