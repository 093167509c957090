"""From a trajectory to named channels with units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support_exudyn.body_motion import BodyMotion
from support_exudyn.machine import Linkage
from support_exudyn.scenario import Scenario
from support_exudyn.trajectory import ContactSeries, Series, Trajectory


@dataclass(frozen=True)
class Channel:
    """A quantity over time: values (n,), unit, and what it is."""

    values: Series
    unit: str
    meaning: str


def channels(scenario: Scenario, run: Trajectory) -> dict[str, Channel]:
    """All channels of a run, by name."""
    linkage = scenario.linkage
    motion = BodyMotion(linkage, run.position, run.velocity, run.acceleration)
    found = {"time": Channel(run.time, "s", "time")}
    found |= _body_channels(motion)
    found |= _point_channels(motion)
    found |= _column_channels(motion, run)
    found |= {
        f"{name}.moment": Channel(moment, "N m", "of the drive on the crank")
        for name, moment in run.cranks.items()
    }
    found |= _slide_channels(run)
    for name in linkage.pins:
        if name in run.contacts:
            second_has_journal = scenario.clearance_pins[name].bore == "first"
            found |= _loose_pin_channels(name, run.contacts[name], 1.0 if second_has_journal else -1.0)
        else:
            found |= _force_channels(name, *run.ideal_pins[name].T)
    found |= {
        f"pin.{name}.friction_moment": Channel(moment, "N m", "of friction on the second body")
        for name, moment in run.friction_moments.items()
    }
    return found | _energy_channels(scenario, linkage, run)


def _body_channels(motion: BodyMotion) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    for name, body in motion.linkage.bodies.items():
        i = motion.first(name)
        q, v, a = motion.position, motion.velocity, motion.acceleration
        cx, cy = body.centre
        found |= {
            f"{name}.x": Channel(cx + q[:, i], "m", "centre of mass, forward"),
            f"{name}.y": Channel(cy + q[:, i + 1], "m", "centre of mass, up"),
            f"{name}.velocity_x": Channel(v[:, i], "m/s", "velocity of the centre of mass, forward"),
            f"{name}.velocity_y": Channel(v[:, i + 1], "m/s", "velocity of the centre of mass, up"),
            f"{name}.angle": Channel(body.angle + q[:, i + 2], "rad", "orientation from +x"),
            f"{name}.angular_velocity": Channel(v[:, i + 2], "rad/s", "angular velocity"),
            f"{name}.angular_acceleration": Channel(a[:, i + 2], "rad/s^2", "angular acceleration"),
        }
    return found


def _point_channels(motion: BodyMotion) -> dict[str, Channel]:
    found = {}
    for name, point in motion.linkage.points.items():
        position = motion.point(point.body, point.point).position
        found[f"{name}.x"] = Channel(position[:, 0], "m", "position, forward")
        found[f"{name}.y"] = Channel(position[:, 1], "m", "position, up")
    return found


def _column_channels(motion: BodyMotion, run: Trajectory) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    for name, column in motion.linkage.columns.items():
        foot = motion.point(column.foot, column.foot_point).position
        head = motion.point(column.head, column.head_point).position
        dx, dy = (head - foot).T
        found |= {
            f"{name}.angle": Channel(np.arctan2(dy, dx), "rad", "direction from foot to head, from +x"),
            f"{name}.length": Channel(np.hypot(dx, dy), "m", "distance of its ends"),
            f"{name}.force": Channel(run.columns[name], "N", "pushes its ends apart if positive"),
        }
    return found


def _slide_channels(run: Trajectory) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    for name, magnitudes in run.slides.items():
        force, moment = magnitudes.T
        found[f"{name}.force"] = Channel(force, "N", "magnitude of the guide's force, across it")
        found[f"{name}.moment"] = Channel(moment, "N m", "magnitude of the guide's moment")
    return found


def _force_channels(name: str, fx: Series, fy: Series) -> dict[str, Channel]:
    return {
        f"pin.{name}.force": Channel(np.hypot(fx, fy), "N", "magnitude of the pin force"),
        f"pin.{name}.force_x": Channel(fx, "N", "force of the first body on the second, forward"),
        f"pin.{name}.force_y": Channel(fy, "N", "force of the first body on the second, up"),
    }


def _loose_pin_channels(name: str, contact: ContactSeries, sign: float) -> dict[str, Channel]:
    """Channels of a loose pin; sign: +1 if the second body has the journal."""
    found = _force_channels(name, sign * contact.force_x, sign * contact.force_y)
    found |= {
        f"pin.{name}.normal_force": Channel(contact.normal_force, "N", "normal contact force"),
        f"pin.{name}.friction_force": Channel(
            contact.friction_force, "N", "on the journal, along t (n turned by +90 degrees)"
        ),
        f"pin.{name}.depth": Channel(contact.depth, "m", "depth; negative: gap"),
        f"pin.{name}.slip": Channel(contact.slip, "m/s", "slip of the journal's surface, along t"),
        f"pin.{name}.approach_speed": Channel(
            contact.approach_speed, "m/s", "touch speed that the laws are told; 0 apart"
        ),
        f"pin.{name}.eccentricity_x": Channel(
            contact.eccentricity_x, "m", "journal's centre from the bore's, forward"
        ),
        f"pin.{name}.eccentricity_y": Channel(
            contact.eccentricity_y, "m", "journal's centre from the bore's, up"
        ),
    }
    if contact.deflection is not None:
        found[f"pin.{name}.deflection"] = Channel(contact.deflection, "m", "state of the friction law")
    return found


def _energy_channels(scenario: Scenario, linkage: Linkage, run: Trajectory) -> dict[str, Channel]:
    kinetic = np.zeros_like(run.time)
    potential = np.zeros_like(run.time)
    gx, gy = scenario.gravity
    for n, body in enumerate(linkage.bodies.values()):
        i = 3 * n
        vx, vy, spin = run.velocity[:, i : i + 3].T
        kinetic += 0.5 * body.mass * (vx**2 + vy**2) + 0.5 * body.inertia * spin**2
        potential -= body.mass * (gx * run.position[:, i] + gy * run.position[:, i + 1])
    stored = run.oil_energy + sum(contact.stored for contact in run.contacts.values())
    dissipated = run.damping_loss + run.friction_loss
    total = kinetic + potential + stored
    balance = total - total[0] + dissipated - run.work
    return {
        "energy.kinetic": Channel(kinetic, "J", "kinetic energy of all bodies"),
        "energy.potential": Channel(potential, "J", "of weight, zero in the machine's start posture"),
        "energy.elastic": Channel(stored, "J", "stored in contacts and oil"),
        "energy.damping_loss": Channel(
            run.damping_loss, "J", "dissipated by damping in contacts and oil so far"
        ),
        "energy.friction_loss": Channel(run.friction_loss, "J", "dissipated by friction so far"),
        "energy.work": Channel(run.work, "J", "work of the drive so far"),
        "energy.balance": Channel(balance, "J", "gain minus work plus loss; zero if computed exactly"),
    }
