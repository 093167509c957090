"""A scene whose lengths, masses and times are all larger shows forces, energies and times that are so, too.

A number of the program's own that has a unit, such as a smallest time or a largest distance, would show.
"""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Scenario
from tests.metamorphic import drawn
from tests.metamorphic.same import plain, run, scenes, told
from tests.metamorphic.scaling import Scale

factors = st.sampled_from((0.25, 0.5, 0.8, 1.0, 1.5, 2.0, 4.0))
scales = st.builds(Scale, length=factors, mass=factors, time=factors)


def rescaled(scene: Scenario, scale: Scale) -> None:
    one, other = run(scene), told(scale.scene(scene))
    one.check(plain(other), {name: 1.0 / factor for name, factor in scale.factors(other).items()})
    one.check_touches(other, 1.0 / scale.time)


@given(scene=drawn.in_general(), scale=scales)
@scenes(8)
def test_a_support_in_general(scene: Scenario, scale: Scale) -> None:
    rescaled(scene, scale)


@given(scene=drawn.in_bodies(), scale=scales)
@scenes(6)
def test_a_support_of_bodies(scene: Scenario, scale: Scale) -> None:
    rescaled(scene, scale)


@given(scene=drawn.cranks(free=True), scale=scales)
@scenes(6)
def test_a_slider_crank_in_free_coordinates(scene: Scenario, scale: Scale) -> None:
    rescaled(scene, scale)
