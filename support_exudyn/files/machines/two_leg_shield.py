"""Files of two-leg shields."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Literal

from pydantic import Field

from support_exudyn.files.machines.shield_form import PLACES, ShieldForm, WidthForm, places
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.two_leg_shield import TwoLegShield

COLUMNS = {"leg": "legs", "ram": "stabilising ram"}
ENDS = {
    "leg_foot": "leg on base",
    "leg_head": "leg on canopy",
    "ram_foot": "stabilising ram on shield beam",
    "ram_head": "stabilising ram on canopy",
}


class TwoLegWidth(WidthForm):
    """Lateral dimensions, for the spatial model."""

    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = WidthForm.names(COLUMNS)


class Form(ShieldForm):
    """A four-bar shield support on a pair of legs, with a stabilising ram between shield beam and canopy."""

    MACHINE: ClassVar[type[FourBarShield[Any]]] = TwoLegShield
    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = ShieldForm.tables(places(ENDS), COLUMNS)
    REQUIRED: ClassVar[Mapping[str, tuple[str, ...]]] = {"pivots_mm": (*PLACES, *ENDS)}

    kind: Literal["two_leg_shield"] = Field(description="What the machine is.")
    width_mm: TwoLegWidth | None = None
