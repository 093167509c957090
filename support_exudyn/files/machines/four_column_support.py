"""Files of four-column supports."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Literal

from pydantic import Field

from support_exudyn.files.machines.shield_form import PLACES, ShieldForm, WidthForm, places
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.four_column_support import HydraulicSupport

COLUMNS = {"front_column": "front columns", "rear_column": "rear columns"}
ENDS = {
    "front_foot": "front column on base",
    "front_head": "front column on canopy",
    "rear_foot": "rear column on base",
    "rear_head": "rear column on canopy",
}


class FourColumnWidth(WidthForm):
    """Lateral dimensions, for the spatial model."""

    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = WidthForm.names(COLUMNS)


class Form(ShieldForm):
    """A four-bar shield support on two pairs of columns between base and canopy."""

    MACHINE: ClassVar[type[FourBarShield[Any]]] = HydraulicSupport
    NAMES: ClassVar[Mapping[str, Mapping[str, str]]] = ShieldForm.tables(places(ENDS), COLUMNS)
    REQUIRED: ClassVar[Mapping[str, tuple[str, ...]]] = {"pivots_mm": (*PLACES, *ENDS)}

    kind: Literal["four_column_support"] = Field(description="What the machine is.")
    width_mm: FourColumnWidth | None = None
