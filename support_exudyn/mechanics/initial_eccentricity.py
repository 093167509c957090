"""A linkage whose clearance journals do not start in the middle of their bores."""

from collections.abc import Mapping

import numpy as np

from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.postures import laid_out, posture
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import InputError, Vector2


def eccentric(linkage: Linkage, offsets: Mapping[str, Vector2]) -> Linkage:
    """The linkage with journals moved in their bores, all else held together.

    Of the postures in which the other pins are closed, guides are followed, and actuators and cranks are where
    they were, the one that is reached by the steps of least mass times distance squared.

    Arguments:
        offsets: for each pin that is moved, centre of its second body's point minus that of the first [m].

    Raises InputError if the linkage cannot be moved so.
    """
    moved = {name: offset for name, offset in offsets.items() if offset != (0.0, 0.0)}
    if not moved:
        return linkage
    closed = kinetics_of(linkage)
    position = posture(closed, np.zeros(3 * len(linkage.bodies)), moved, {})
    if position is not None:
        return laid_out(closed, position)
    raise InputError(
        f"eccentricity of {', '.join(moved)} = {', '.join(map(str, moved.values()))} m: the linkage cannot be "
        "laid out so; allowed: what actuators, guides and the other pins leave free, such as (0, 0)"
    )
