"""The support in MuJoCo: four hinged bodies, columns as constrained tendons, the contact as passive forces.

MuJoCo knows no journal in a bore, since its collision shapes are convex. The law of contact is a user's
function of passive forces (`mjcb_passive`). The columns are spatial tendons whose lengths an equality
constraint keeps; it is MuJoCo's spring and damper on the acceleration, `a = -b v - k x`, and its reference is
moved so that it follows the drive exactly. The classical Runge-Kutta method of order four makes equal steps.
"""

from typing import Any

import numpy as np

from studies.benchmarking.peers.plain_support import (
    COLUMN_LINK,
    JOURNAL_LINK,
    JournalLog,
    PeerRun,
    PlainSupport,
    plain_support,
    undisturbed,
)
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

STIFF = 0.5  # natural frequency of the columns' constraint times the step; the method is stable up to 2.8
NEXT_STAGE = (0.5, 0.0, 0.5, 0.0)  # from a stage of the method to the next one, in steps
FIRM = "0.9999 0.9999 0.001 0.5 1"  # impedance as large as MuJoCo allows


def run_mujoco(scenario: Scenario, step: float) -> PeerRun:
    """Run with equal steps.

    Arguments:
        scenario: see `plain_support`; its own step and solver are not used.
        step: length of all steps [s].

    Raises InputError if the scenario is not covered, ImportError if there is no MuJoCo.
    """
    import mujoco

    support = plain_support(scenario)
    own, damping = (STIFF / step) ** 2, 2.0 * STIFF / step
    model = mujoco.MjModel.from_xml_string(_model(support, step, own, damping))
    data = mujoco.MjData(model)
    log, stage = JournalLog(support), 0
    along, turn = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    x, y = support.bore
    site = model.site("journal").id

    def push(model: Any, data: Any) -> None:
        nonlocal stage
        # the constraint of a stage is made before this is called: what is set here holds for the next stage
        extension, rate, second = support.motion(data.time + NEXT_STAGE[stage] * step)
        model.eq_data[:, 0] = extension + (damping * rate + second) / own
        mujoco.mj_jacSite(model, data, along, turn, site)
        px, py = float(data.site_xpos[site, 0]) - x, float(data.site_xpos[site, 1]) - y
        (vx, vy), spin = (along[:2] @ data.qvel).tolist(), float(turn[2] @ data.qvel)
        if stage == 0:  # at the end of the last step
            log.note(data.time, (px, py), (vx, vy), spin)
        stage += 1
        fx, fy, moment = support.force(px, py, vx, vy, spin, log.speed)
        if fx or fy:
            data.qfrc_passive += fx * along[0] + fy * along[1] + moment * turn[2]

    mujoco.set_mjcb_passive(push)
    try:
        with undisturbed():
            for _ in range(round(scenario.duration / step)):
                stage = 0
                mujoco.mj_step(model, data)
            stage = 0
            mujoco.mj_forward(model, data)  # notes the end of the last step
    finally:
        mujoco.set_mjcb_passive(None)
    return log.run()


def _model(support: PlainSupport, step: float, own: float, damping: float) -> str:
    """The model in MuJoCo's XML; all joints are zero at the start."""
    gx, gy = support.gravity
    feet = "".join(f'<site name="{one.name} foot" pos="{_at(one.foot)}"/>' for one in support.columns)
    lengths = "".join(
        f'<spatial name="{one.name}"><site site="{one.name} foot"/><site site="{one.name} head"/></spatial>'
        for one in support.columns
    )
    held = "".join(
        f'<tendon tendon1="{one.name}" solref="{-own!r} {-damping!r}" solimp="{FIRM}"/>'
        for one in support.columns
    )
    return f"""<mujoco>
      <option timestep="{step!r}" gravity="{gx!r} {gy!r} 0" integrator="RK4" tolerance="1e-12"/>
      <worldbody>{_body(support, 0)}{feet}</worldbody>
      <tendon>{lengths}</tendon>
      <equality>{held}</equality>
    </mujoco>"""


def _body(support: PlainSupport, n: int) -> str:
    """A link with all that hangs on it."""
    link = support.links[n]
    parent = support.links[link.parent].pin if link.parent >= 0 else (0.0, 0.0)
    sites = ""
    if n == JOURNAL_LINK:
        sites = f'<site name="journal" pos="{_at(support.bore, link.pin)}"/>'
    if n == COLUMN_LINK:
        sites = "".join(
            f'<site name="{one.name} head" pos="{_at(one.head, link.pin)}"/>' for one in support.columns
        )
    carried = "".join(_body(support, k) for k, one in enumerate(support.links) if one.parent == n)
    inertia = f"{link.inertia!r} " * 3  # only that about the third axis matters, and others have to be possible
    return f"""<body name="{link.name}" pos="{_at(link.pin, parent)}">
      <joint type="hinge" axis="0 0 1"/>
      <inertial pos="{_at(link.centre, link.pin)}" mass="{link.mass!r}" diaginertia="{inertia}"/>
      {sites}{carried}
    </body>"""


def _at(point: Vector2, origin: Vector2 = (0.0, 0.0)) -> str:
    """A place in the frame that begins at an origin."""
    return f"{point[0] - origin[0]!r} {point[1] - origin[1]!r} 0"
