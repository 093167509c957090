"""A support that moves alike on both sides moves in space as it does in its plane, whichever pin is loose."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import ClearancePin, Drive, Result, Scenario, SolverSettings
from support_exudyn.linkages.four_bar_shield import PINS
from tests.metamorphic import drawn
from tests.metamorphic.same import run, scenes, sizes, told
from user_forces import DepthSpeed, TouchSpeed

DAMPING = (DepthSpeed(), TouchSpeed(floor=1e-3))
# Of the largest force: in steps after a kink of the drive multipliers of the plane overshoot, where space takes
# reactions from accelerations; means do not show it
OVERSHOOT = 2e-2
MEAN = 2e-4


@st.composite
def with_a_loose_pin(draw: st.DrawFn, pin: str) -> Scenario:
    """A support with this pin loose, its columns rigid or on oil."""
    duration = drawn.MS * draw(st.integers(10, 20))
    kind = drawn.machine(draw(st.sampled_from(drawn.SUPPORTS)))
    loose: ClearancePin = draw(drawn.loose(0.0655, 2.7e10, compiled=False, apart=False))
    drive: Drive = draw(drawn.strokes(duration))
    return Scenario(
        machine=kind,
        pins={pin: loose},
        columns=drawn.on_oil(kind) if draw(st.booleans()) else {},
        drive=drive,
        start=draw(st.sampled_from(("concentric", "settled"))),
        duration=duration,
        record_period=drawn.MS,
        step=1e-4,
        solver=SolverSettings(impact_steps=drawn.IMPACT_STEPS),
        formulation="redundant",
    )
