"""The faces of falling blocks as places of contact, and their channels."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.mechanics.channels import CONTACT, ChannelDefinition, ChannelDefinitions
from support_exudyn.mechanics.contact_places import GuideContactPlace, HasValues
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.guides import GuideContact
from support_exudyn.model.linkage import Slide
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.plane_geometry import minus, rotated
from user_forces.values.value import Vector2

PLAY = 1e-3  # [m], as of a pin


@dataclass(frozen=True)
class BlockContactPlace(GuideContactPlace):
    """The face of a falling block, which a point of the machine may meet: a slot with one wall.

    The block is the bore. It has no play; that by which steps and errors go is the depth of its first blow, or
    PLAY if that is less.
    """

    @property
    def stem(self) -> str:
        """The block's name."""
        return self.name

    def __post_init__(self) -> None:
        """Tell of what load it is."""
        super().__post_init__()
        object.__setattr__(self, "of", f"loads.{self.name}")

    def depth(self, channels: Mapping[str, HasValues]) -> Series | None:
        """A gap that is negative."""
        found = channels.get(f"{self.stem}.gap")
        return None if found is None else -found.values

    def loads(self, reactions: Mapping[str, Series]) -> Series:
        """Nothing: no joint stands in its place."""
        del reactions
        return np.zeros(2)


def block_places(blocks: Mapping[str, FallingBlock], gravity: Vector2) -> dict[str, BlockContactPlace]:
    """The faces of blocks by the blocks' names, under gravity [m/s^2]."""
    return {
        name: BlockContactPlace(
            name,
            Slide(body=block.body, point=block.reference, direction=block.slope, against=name),
            GuideContact(rotated(minus(block.point, block.reference), -block.slope), 0.0, block.contact),
            min(block.first_depth(gravity) or PLAY, PLAY),
        )
        for name, block in blocks.items()
    }


def in_the_plane(context: Any) -> Mapping[str, ContactSeries]:
    """The contacts of a run in the plane."""
    found: Mapping[str, ContactSeries] = context.run.contacts
    return found


def block_channels(
    name: str, contacts: Callable[[Any], Mapping[str, ContactSeries]] = in_the_plane
) -> ChannelDefinitions:
    """The channels of a block's contact; contacts: gives those of a run."""

    def said(
        what: str, unit: str, meaning: str, values: Callable[[ContactSeries], Series]
    ) -> ChannelDefinitions:
        return {
            f"{name}.{what}": ChannelDefinition(
                unit, meaning, CONTACT, lambda context: values(contacts(context)[name])
            )
        }

    found = said("force", "N", "of the block, along the normal of its face", lambda c: c.normal_force)
    found |= said("gap", "m", "between block and point, along that normal; negative: depth", lambda c: -c.depth)
    found |= said(
        "impact_velocity", "m/s", "impact velocity that the law is told; 0 apart", lambda c: c.impact_velocity
    )
    return found
