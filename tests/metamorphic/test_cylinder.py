"""A hydraulic cylinder whose valve is closed moves a machine as a column of oil of the same stiffness does.

The cylinder's chambers get stiffer as they are compressed, B / V, by a share that the test allows for.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import ActuatorModel, Held, HydraulicCylinder, OilColumn, Reciprocating, Scenario
from tests.metamorphic import drawn
from tests.metamorphic.same import plain, run, scenes

HOSES = 1.0  # of what the cylinder holds
OF_OIL = (".pressure", ".flow", ".oil")  # that a column of as stiff oil has otherwise
ENERGY = "energy.elastic"  # of which only the change is the same: oil around the rod stores none at the start
# Share by which the stiffness changes along with the compression of some 0.5 mm in 0.5 m and more of oil
CURVED = 2e-3


@st.composite
def preloaded(draw: st.DrawFn) -> HydraulicCylinder:
    """A cylinder with a closed valve and little in its hoses."""
    area = draw(drawn.between(0.05, 0.15))
    return HydraulicCylinder(
        bore_area=area,
        rod_side_area=area * draw(drawn.between(0.1, 0.5)),
        oil_length=draw(drawn.between(0.4, 0.8)),
        rod_side_length=draw(drawn.between(0.4, 0.8)),
        bulk_modulus=draw(drawn.between(1e9, 2e9)),
        system_pressure=31.5e6,
        nominal_flow=6e-3,
    )


def with_hoses(cylinder: HydraulicCylinder) -> HydraulicCylinder:
    """About as stiff a cylinder whose hoses hold as much as its chambers do."""
    return replace(
        cylinder,
        hose_volume=HOSES * cylinder.bore_area * cylinder.oil_length,
        rod_side_hose_volume=HOSES * cylinder.rod_side_area * cylinder.rod_side_length,
        bulk_modulus=cylinder.bulk_modulus * (1.0 + HOSES),
    )


def as_oil(cylinder: HydraulicCylinder) -> OilColumn:
    """The column of oil that is as stiff; neither is damped."""
    return OilColumn(
        bore_area=cylinder.bore_area,
        oil_length=cylinder.oil_length,
        bulk_modulus=cylinder.stiffness(0.0) * cylinder.oil_length / cylinder.bore_area,
    )


@st.composite
def at_rest(draw: st.DrawFn) -> tuple[Scenario, Mapping[str, HydraulicCylinder]]:
    """A support without cylinders, and closed ones for one or both of its actuators, which are not driven."""
    scene = draw(drawn.in_bodies())
    drive = Held() if isinstance(scene.drive, Reciprocating) else scene.drive
    names = drawn.actuators_of(scene.machine)
    chosen = names if draw(st.booleans()) else names[:1]
    found = {name: draw(preloaded()) for name in chosen}
    return replace(scene, actuators={}, drive=Held() if len(chosen) == 2 else drive), found


def compared(scene: Scenario, cylinders: Mapping[str, HydraulicCylinder]) -> None:
    filled_up = {name: with_hoses(cylinder) for name, cylinder in cylinders.items()}
    with_oil: dict[str, ActuatorModel] = {name: as_oil(one) for name, one in filled_up.items()}
    # all are told: what is said of the drive of a leg is the ram's, too
    driven = {name: scene.drive for name in drawn.actuators_of(scene.machine) if name not in cylinders}
    oil = replace(scene, actuators=with_oil, drives=driven | dict.fromkeys(cylinders, Held()))
    one, two = run(oil), run(replace(scene, actuators=filled_up, drives=driven))
    # methods differ, for a cylinder's pressures are states: each has its error
    both = {name: allowed + two.allowed[name] for name, allowed in one.allowed.items()}
    other = {name: values for name, values in plain(two.result).items() if not name.endswith(OF_OIL)}
    other[ENERGY] = other[ENERGY] - other[ENERGY][0] + one.result[ENERGY][0]
    replace(one, allowed=both).check(other, rounding=CURVED)


@given(scene=at_rest())
@scenes(6)
def test_a_closed_cylinder_moves_a_machine_as_a_column_of_oil_does(
    scene: tuple[Scenario, Mapping[str, HydraulicCylinder]],
) -> None:
    compared(*scene)
