"""The slider-crank's pin against the engine's own contact: a ball in a hollow ball.

Its Hunt-Crossley factor 3 (1 - e)/2 equals Lankarani and Nikravesh's 3 (1 - e^2)/4 if its restitution is set to
1 - (1 - e^2)/2. It takes the rate at the end of the step that noticed the contact for the initial impact
velocity, so it needs steps that are short against the impact; and it has no normal at the centre, so it starts
beside it.
"""

from __future__ import annotations

from typing import NamedTuple

import exudyn
import pytest
from exudyn.itemInterface import MarkerBodyRigid, NodeGenericData, ObjectContactSphereSphere

from support_exudyn import SolverSettings, simulate
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.formulations.exudyn.solver.solver import quiet_engine
from support_exudyn.model.linkage import Body
from support_exudyn.model.plane_geometry import minus
from tests.cases.run_cases import SLIDER_PIN, loose_slider_crank, slider_crank_contact
from user_forces.values.value import Vector2

DURATION = 1.3e-3  # five impacts [s]
STEP = 1e-8  # [s], in which the initial impact velocity changes by up to 5e-4 m/s
ASIDE = 1e-12  # of the slider, so that there is a normal [m]


class Onset(NamedTuple):
    time: float
    speed: float


def local(body: Body, point: Vector2) -> Vector2:
    """A point of the start posture in a body's axes [m]."""
    return minus(point, body.centre)


def twin_onsets() -> list[Onset]:
    """Onsets of the same mechanism with the engine's contact, fixed steps."""
    scene = build(loose_slider_crank(DURATION))
    mbs, pin = scene.mbs, scene.clearance_joints[SLIDER_PIN]
    contact = slider_crank_contact()
    mbs.SetObjectParameter(pin.item.object, "activeConnector", False)
    position = mbs.systemData.GetODE2Coordinates(exudyn.ConfigurationType.Initial)
    position[scene.bodies["slider"].first] += ASIDE
    node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4))
    slider, rod = scene.bodies["slider"], scene.bodies["rod"]
    place = scene.linkage.pins[SLIDER_PIN]
    journal = mbs.AddMarker(
        MarkerBodyRigid(bodyNumber=rod.object, localPosition=[*local(rod.body, place.second_point), 0.0])
    )
    bore = mbs.AddMarker(
        MarkerBodyRigid(bodyNumber=slider.object, localPosition=[*local(slider.body, place.first_point), 0.0])
    )
    restitution = contact.normal.restitution
    mbs.AddObject(
        ObjectContactSphereSphere(
            markerNumbers=[journal, bore],
            nodeNumber=node,
            spheresRadii=[contact.bearing.journal_radius, contact.bearing.bore_radius],
            isHollowSphere1=True,
            contactStiffness=contact.normal.stiffness,
            contactStiffnessExponent=1.5,
            restitutionCoefficient=1.0 - 0.5 * (1.0 - restitution**2),
            impactModel=1,
            minimumImpactVelocity=1e-3,
        )
    )
    velocity = mbs.systemData.GetODE2Coordinates_t(exudyn.ConfigurationType.Initial)
    mbs.Assemble()
    mbs.systemData.SetODE2Coordinates(position, exudyn.ConfigurationType.Initial)
    mbs.systemData.SetODE2Coordinates_t(velocity, exudyn.ConfigurationType.Initial)

    context: list[Onset] = []
    depths: list[float] = []  # at the ends of steps

    def drive(mbs: object, t: float) -> bool:
        scene.drive_to(t)
        return True

    def watch(mbs: object, t: float) -> bool:
        gap = scene.mbs.GetNodeOutput(node, exudyn.OutputVariableType.Coordinates)[0]
        depths.append(-float(gap))
        if t > 0.0 and len(depths) > 3 and depths[-2] <= 0.0 < depths[-1]:
            before, last, now = depths[-3:]
            share = -last / (now - last)  # of the step, when it makes contact
            slope = (now - last) / STEP
            bend = (now - 2.0 * last + before) / STEP**2
            context.append(Onset(t - (1.0 - share) * STEP, slope + (share - 0.5) * STEP * bend))
        return True

    mbs.SetPreStepUserFunction(drive)
    mbs.SetPostStepUserFunction(watch)
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = DURATION
    settings.timeIntegration.numberOfSteps = round(DURATION / STEP)
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.5
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    with quiet_engine():
        mbs.SolveDynamic(settings)
    return context


@pytest.fixture(scope="module")
def twin() -> list[Onset]:
    return twin_onsets()


@pytest.mark.slow  # 130 000 steps of the engine's own contact
def test_onsets_are_those_of_the_engines_own_contact(twin: list[Onset]) -> None:
    scenario = loose_slider_crank(DURATION, step=5e-7, solver=SolverSettings(impact_steps=1024))
    ours = simulate(scenario).onsets[SLIDER_PIN]
    assert len(ours) == len(twin) == 5
    for mine, theirs in zip(ours, twin, strict=True):
        # asked for; ours are right to 1e-5 at the fifth; theirs are damped with initial impact velocities that
        # are off by up to a step's change, 3e-4 of them, which changes the restitution by a tenth of that
        assert mine.time == pytest.approx(theirs.time, rel=1e-4)
        assert mine.speed == pytest.approx(theirs.speed, rel=1e-4)
