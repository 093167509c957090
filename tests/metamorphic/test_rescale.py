"""A scene whose lengths, masses and times are all larger shows forces, energies and times that are so, too.

A number of the program's own that has a unit, such as a smallest time or a largest distance, would show.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import CubicStep, Scenario, Steady
from tests.metamorphic import drawn, drawn_linkages
from tests.metamorphic.same import plain, run, scenes, told
from tests.metamorphic.scaling import Scale

FACTORS = st.sampled_from((0.25, 0.5, 0.8, 1.0, 1.5, 2.0, 4.0))
SCALES = st.builds(Scale, length=FACTORS, mass=FACTORS, time=FACTORS)


def steadily(scene: Scenario) -> Scenario:
    """The scene without strokes, whose unit is the metre, also where a crank makes them."""
    return replace(scene, drive=Steady(rate=15.0)) if isinstance(scene.drive, CubicStep) else scene


KINDS = {
    "support in general": drawn.in_general(),
    "support of bodies": drawn.in_bodies(),
    "slider-crank in free coordinates": drawn.cranks(free=True),
    "linkage": drawn_linkages.driven().map(steadily),
}


@pytest.mark.parametrize("kind", KINDS)
@given(data=st.data(), scale=SCALES)
@scenes(8)
def test_a_scene_of_another_size_moves_alike(kind: str, data: st.DataObject, scale: Scale) -> None:
    scene = data.draw(KINDS[kind], label="scene")
    one, other = run(scene), told(scale.scene(scene))
    one.check(plain(other), {name: 1.0 / factor for name, factor in scale.factors(other).items()})
    one.check_touches(other, 1.0 / scale.time)
