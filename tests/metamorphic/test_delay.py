"""A scene that rests in static equilibrium for a while before anything happens then moves as it did."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import (
    AppliedForce,
    CubicStep,
    FallingBlock,
    Held,
    HydraulicCylinder,
    Load,
    Reciprocating,
    Roof,
    Scenario,
    SuddenOpening,
    UniformSpeed,
)
from support_exudyn.model.drives.drive import Drive
from tests.metamorphic import drawn, drawn_linkages
from tests.metamorphic.moving import FROM_THE_START
from tests.metamorphic.same import EvaluationContext, plain, run, scenes, told

DWELLS = st.integers(1, 12)  # [ms]


def settled(scene: Scenario) -> Scenario:
    """The scene from rest, with what can be put off."""
    loads = {name: load for name, load in scene.loads.items() if not isinstance(load, FallingBlock)}
    drive = Held() if isinstance(scene.drive, Reciprocating) else scene.drive
    return replace(scene, start="settled", loads=loads, drive=drive)


def later(scene: Scenario, dwell: float) -> Scenario:
    """Everything that happens put off by a time [s]."""

    def load(one: Load) -> Load:
        if isinstance(one, AppliedForce):
            return replace(one, start=one.start + dwell, end=one.end + dwell)
        assert isinstance(one, Roof)
        return replace(one, descent=drive(one.descent))

    def drive(one: Drive) -> Drive:
        if isinstance(one, (CubicStep, UniformSpeed)):
            return replace(one, start=one.start + dwell, end=one.end + dwell)
        assert isinstance(one, Held)
        return one

    actuators = dict(scene.actuators)
    for name, actuator in actuators.items():
        if isinstance(actuator, HydraulicCylinder) and isinstance(inlet := actuator.inlet, SuddenOpening):
            opens = replace(inlet, start=inlet.start + dwell, end=inlet.end + dwell)
            actuators[name] = replace(actuator, inlet=opens)
    return replace(
        scene,
        actuators=actuators,
        loads={name: load(one) for name, one in scene.loads.items()},
        drive=drive(scene.drive),
        duration=scene.duration + dwell,
    )


def after(context: EvaluationContext, records: int, dwell: float) -> EvaluationContext:
    """From a record on, which is the first from then on."""
    found = {name: values[records:] for name, values in context.items()}
    found["time"] = found["time"] - dwell
    return {name: v - v[0] if name.endswith(FROM_THE_START) else v for name, v in found.items()}


KINDS = {
    "support in general": drawn.in_general().map(settled),
    "support of bodies": drawn.in_bodies().map(settled),
    "linkage": drawn_linkages.driven(from_rest=True),
}
SLOW = "support of bodies"


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[pytest.mark.slow] if kind == SLOW else []) for kind in KINDS]
)
@given(data=st.data(), milliseconds=DWELLS)
@scenes(8)
def test_a_scene_that_begins_later_moves_alike(kind: str, data: st.DataObject, milliseconds: int) -> None:
    scene, dwell = data.draw(KINDS[kind], label="scene"), milliseconds * drawn.MS
    one, other = run(scene), told(later(scene, dwell))
    one.check(after(plain(other), milliseconds, dwell))
