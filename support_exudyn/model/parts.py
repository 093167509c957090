"""What a part of a body can be: fixed to it, or a body of its own. One field of the scenario chooses it."""

from __future__ import annotations

from abc import ABC
from dataclasses import field

from support_exudyn.model.columns import OilColumn, RigidColumn
from user_forces.values.value import Value, value


class PartModel(Value, ABC):
    """How a part that a jack holds on its body is modelled."""


@value
class Lumped(PartModel):
    """Fixed to its body, whose mass and inertia contain it."""


@value
class OwnBody(PartModel):
    """A body of its own on a hinge, locked by its jack, which is not driven.

    Arguments:
        jack: a strut of constant length, or a closed cushion of oil, which carries the static load of the start
            posture, so that a machine at rest stays there.
    """

    jack: RigidColumn | OilColumn = field(default_factory=RigidColumn)
