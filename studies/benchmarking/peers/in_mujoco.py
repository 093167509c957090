"""The slider-crank in MuJoCo, its pin a tendon between the centres of journal and bore.

MuJoCo knows no journal in a bore: its collision shapes are convex. What it has is a tendon from one site to
another. Its length is the eccentricity, its velocity the rate of that, and its Jacobian says what a force along
it does, so nothing of the kinematics is written by hand. The crank keeps its speed by an armature beside which
all else is nothing. The classical Runge-Kutta method of order four makes equal steps.

Two ways lead to a contact. In `run_mujoco` the law of contact is a user's function of passive forces
(`mjcb_passive`): the law is exact, and the initial impact velocity is that at zero depth, interpolated at the
end of the step in which the surfaces met. In `run_limit` the clearance is the limit of the tendon, and MuJoCo's
own constraint solver pushes. Its constraints are linear springs and dampers, so the exponent of 1.5 cannot be
had: what remains is one stiffness and one damping (`solref` in its direct form), taken here so that the first
impact lasts as long as by Hertz and that every impact has the restitution.
"""

import math
import time
from typing import Any

import numpy as np

from studies.benchmarking.peers.bare_scene import joint_start, smooth_slider_crank
from studies.benchmarking.peers.peer_run import PeerRun, StepLog, contact_numbers, undisturbed
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact

FLYWHEEL = 1e8  # armature of the crank [kg m^2]; a moment of 100 N m changes its speed by 1e-8 rad/s in 10 ms
HERTZ_TIME = 2.943  # duration of an elastic impact by Hertz, in depths per speed
FIRM = "0.9999 0.9999 0.001 0.5 1"  # impedance as large as MuJoCo allows: the spring alone decides
MODEL = """<mujoco>
  <option timestep="{step}" gravity="0 0 0" integrator="RK4"/>
  <worldbody>
    <body>
      <joint type="hinge" axis="0 0 1" armature="{flywheel}"/>
      <inertial pos="{half_crank} 0 0" mass="{crank_mass}" diaginertia="{crank_inertia}"/>
      <body pos="{crank} 0 0">
        <joint type="hinge" axis="0 0 1"/>
        <inertial pos="{half_rod} 0 0" mass="{rod_mass}" diaginertia="{rod_inertia}"/>
        <site name="journal" pos="{rod} 0 0"/>
      </body>
    </body>
    <body>
      <joint type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="{slider_mass}" diaginertia="{crank_inertia}"/>
      <site name="bore"/>
    </body>
  </worldbody>
  <tendon>
    <spatial {limit}><site site="bore"/><site site="journal"/></spatial>
  </tendon>
</mujoco>"""


def run_mujoco(scenario: Scenario, step: float) -> PeerRun:
    """Run with the law of contact in a Python function of passive forces.

    Arguments:
        scenario: see `smooth_slider_crank`; its own step and solver are not used.
        step: length of all steps [s].

    Raises InputError if the scenario is not covered, ImportError if there is no MuJoCo.
    """
    import mujoco

    machine, speed, contact = smooth_slider_crank(scenario)
    model, data = _model(mujoco, machine, speed, step, "")
    stiffness, factor, floor = contact_numbers(contact)
    clearance = contact.bearing.clearance
    length, rate_of, along, passive = (
        data.ten_length,
        data.ten_velocity,
        data.ten_J.reshape(-1),
        data.qfrc_passive,
    )
    log, looked, impact_speed, calls = StepLog(), False, 0.0, 0

    def push(model: Any, data: Any) -> None:
        nonlocal looked, impact_speed, calls
        calls += 1
        depth, rate = float(length[0]) - clearance, float(rate_of[0])
        if not looked:  # the first of a step, with what the last step ended
            looked = True
            _note(log, data, depth, rate)
            impact_speed = (impact_speed or log.met_with()) if depth > 0.0 else 0.0
        if depth > 0.0:
            damped = 1.0 + factor * rate / max(impact_speed or rate, floor)
            passive[:] -= max(0.0, stiffness * depth * math.sqrt(depth) * damped) * along

    mujoco.set_mjcb_passive(push)
    try:
        with undisturbed():
            began = time.process_time()
            for _ in range(round(scenario.duration / step)):
                looked = False
                mujoco.mj_step(model, data)
            looked = False
            mujoco.mj_forward(model, data)  # looks at the end of the last step
            took = time.process_time() - began
    finally:
        mujoco.set_mjcb_passive(None)
    return log.run(scenario, contact, took, calls)


def run_limit(scenario: Scenario, step: float) -> PeerRun:
    """Run with MuJoCo's own constraint: the clearance is the limit of the tendon.

    Arguments and errors are those of `run_mujoco`. The largest force is what the law would have for the depth.
    """
    import mujoco

    machine, speed, contact = smooth_slider_crank(scenario)
    limit = f'limited="true" range="0 {contact.bearing.clearance}" solimplimit="{FIRM}"'
    model, data = _model(mujoco, machine, speed, step, limit)
    log, clearance, is_set = StepLog(), contact.bearing.clearance, False
    with undisturbed():
        began = time.process_time()
        for n in range(round(scenario.duration / step) + 1):
            if n:
                mujoco.mj_step(model, data)
            mujoco.mj_fwdPosition(model, data)
            mujoco.mj_fwdVelocity(model, data)
            depth, rate = float(data.ten_length[0]) - clearance, float(data.ten_velocity[0])
            _note(log, data, depth, rate)
            if not is_set and rate > 0.0 and depth > -rate * step:  # the last step before the first impact
                model.tendon_solref_lim[0] = _spring(mujoco, model, data, contact, rate)
                is_set = True
        took = time.process_time() - began
    return log.run(scenario, contact, took, 0)


def _note(log: StepLog, data: Any, depth: float, rate: float) -> None:
    log.time.append(data.time)
    log.depth.append(depth)
    log.rate.append(rate)
    log.slider.append(float(data.qpos[2]))
    log.velocity.append(float(data.qvel[2]))


def _spring(mujoco: Any, model: Any, data: Any, contact: JournalContact, speed: float) -> list[float]:
    """`solref` for impacts at a speed [m/s]: stiffness and damping for a mass of 1 kg, both negative."""
    along = np.array(data.ten_J).reshape(1, -1)
    moved = np.zeros_like(along)
    mujoco.mj_solveM(model, data, moved, along)
    mass = 1.0 / float(moved[0] @ along[0])
    stiffness, _, _ = contact_numbers(contact)
    depth = (1.25 * mass * speed * speed / stiffness) ** 0.4
    restitution = contact.normal.restitution  # type: ignore[attr-defined]
    rate = math.pi * speed / (HERTZ_TIME * depth)
    loss = -math.log(restitution) / math.hypot(math.pi, math.log(restitution))
    own = rate / math.sqrt(1.0 - loss * loss)  # undamped
    return [-own * own, -2.0 * loss * own]


def _model(mujoco: Any, m: SliderCrank, speed: float, step: float, limit: str) -> tuple[Any, Any]:
    """Model and data at the start, with the velocities of the ideal machine."""
    text = MODEL.format(
        step=repr(step),
        flywheel=FLYWHEEL,
        crank=m.crank_length,
        half_crank=0.5 * m.crank_length,
        crank_mass=m.crank_mass,
        crank_inertia=_round_inertia(m.crank_inertia),
        rod=m.rod_length,
        half_rod=0.5 * m.rod_length,
        rod_mass=m.rod_mass,
        rod_inertia=_round_inertia(m.rod_inertia),
        slider_mass=m.slider_mass,
        limit=limit,
    )
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = joint_start(m, speed)
    return model, data


def _round_inertia(inertia: float) -> str:
    """An inertia about all axes alike; only that about the third matters, and others have to be possible."""
    return f"{inertia!r} {inertia!r} {inertia!r}"
