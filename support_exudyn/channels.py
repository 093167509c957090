"""From raw states to named channels with units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from support_exudyn.connector import recalled
from support_exudyn.loose_pin import LoosePin
from support_exudyn.machine import GROUND
from support_exudyn.oil import oil_force
from support_exudyn.plane import rotated
from support_exudyn.recorder import History
from support_exudyn.scene import Scene
from user_forces.contact import ContactForce, SlipHistory
from user_forces.values import Vector2


@dataclass(frozen=True)
class Channel:
    """A quantity over time: values (n,), unit, and what it is."""

    values: np.ndarray
    unit: str
    meaning: str


def channels(scene: Scene, history: History) -> dict[str, Channel]:
    """All channels of a run, by name."""
    found = {"time": Channel(history.time, "s", "time")}
    found |= _body_channels(scene, history)
    found |= _point_channels(scene, history)
    column_channels, stored = _column_channels(scene, history)
    found |= column_channels
    found |= _crank_channels(scene, history)
    found |= _slide_channels(scene, history)
    for name in scene.linkage.pins:
        if name in scene.loose_pins:
            pin_channels, energy = _loose_pin_channels(scene, history, name)
            found |= pin_channels
            stored += energy
        else:
            found |= _ideal_pin_channels(scene, history, name)
    return found | _energy_channels(scene, history, stored)


class _Motion:
    """Motion of a point of a body: position, velocity (n, 2), and the body's angle and spin (n,)."""

    def __init__(self, scene: Scene, history: History, body: str, point: Vector2) -> None:
        rows = history.time.size
        if body == GROUND:
            self.position = np.tile(point, (rows, 1))
            self.velocity = np.zeros((rows, 2))
            self.spin = self.angle = np.zeros(rows)
            return
        item = scene.bodies[body]
        i = item.first
        self.angle = angle = item.body.angle + history.position[:, i + 2]
        self.spin = history.velocity[:, i + 2]
        c, s = np.cos(angle), np.sin(angle)
        x, y = item.local(point)
        arm = np.column_stack([c * x - s * y, s * x + c * y])
        self.position = np.array(item.body.centre) + history.position[:, i : i + 2] + arm
        turned = np.column_stack([-arm[:, 1], arm[:, 0]])
        self.velocity = history.velocity[:, i : i + 2] + self.spin[:, None] * turned


def _body_channels(scene: Scene, history: History) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    for name, item in scene.bodies.items():
        i = item.first
        q, v, a = history.position, history.velocity, history.acceleration
        cx, cy = item.body.centre
        found |= {
            f"{name}.x": Channel(cx + q[:, i], "m", "centre of mass, forward"),
            f"{name}.y": Channel(cy + q[:, i + 1], "m", "centre of mass, up"),
            f"{name}.velocity_x": Channel(v[:, i], "m/s", "velocity of the centre of mass, forward"),
            f"{name}.velocity_y": Channel(v[:, i + 1], "m/s", "velocity of the centre of mass, up"),
            f"{name}.angle": Channel(item.body.angle + q[:, i + 2], "rad", "orientation from +x"),
            f"{name}.angular_velocity": Channel(v[:, i + 2], "rad/s", "angular velocity"),
            f"{name}.angular_acceleration": Channel(a[:, i + 2], "rad/s^2", "angular acceleration"),
        }
    return found


def _point_channels(scene: Scene, history: History) -> dict[str, Channel]:
    found = {}
    for name, point in scene.linkage.points.items():
        motion = _Motion(scene, history, point.body, point.point)
        found[f"{name}.x"] = Channel(motion.position[:, 0], "m", "position, forward")
        found[f"{name}.y"] = Channel(motion.position[:, 1], "m", "position, up")
    return found


def _column_channels(scene: Scene, history: History) -> tuple[dict[str, Channel], np.ndarray]:
    """Channels of all columns, and the energy stored in their oil [J]."""
    found: dict[str, Channel] = {}
    stored = np.zeros_like(history.time)
    for name, column in scene.linkage.columns.items():
        foot = _Motion(scene, history, column.foot, column.foot_point)
        head = _Motion(scene, history, column.head, column.head_point)
        dx, dy = (head.position - foot.position).T
        length = np.hypot(dx, dy)
        if name in scene.rigid_columns:
            # the multiplier of a distance is the tension
            force = -history.multiplier[:, scene.rigid_columns[name].multiplier]
        else:
            vx, vy = (head.velocity - foot.velocity).T
            rate = (dx * vx + dy * vy) / length
            drive = scene.scenario.drive
            extension = np.array([drive.extension(float(t)) for t in history.time])
            speed = np.array([drive.speed(float(t)) for t in history.time])
            force, energy = oil_force(scene.oil_columns[name], length, rate, extension, speed)
            stored = stored + energy
        found |= {
            f"{name}.angle": Channel(np.arctan2(dy, dx), "rad", "direction from foot to head, from +x"),
            f"{name}.length": Channel(length, "m", "distance of its ends"),
            f"{name}.force": Channel(force, "N", "pushes its ends apart if positive"),
        }
    return found, stored


def _crank_channels(scene: Scene, history: History) -> dict[str, Channel]:
    # the multiplier of a crank's angle is the moment against it
    return {
        f"{name}.moment": Channel(-history.multiplier[:, item.multiplier], "N m", "of the drive on the crank")
        for name, item in scene.cranks.items()
    }


def _slide_channels(scene: Scene, history: History) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    for name, item in scene.slides.items():
        force, moment = history.multiplier[:, item.first], history.multiplier[:, item.first + 1]
        found[f"{name}.force"] = Channel(np.abs(force), "N", "magnitude of the guide's force, across it")
        found[f"{name}.moment"] = Channel(np.abs(moment), "N m", "magnitude of the guide's moment")
    return found


def _force_channels(name: str, fx: np.ndarray, fy: np.ndarray) -> dict[str, Channel]:
    return {
        f"pin.{name}.force": Channel(np.hypot(fx, fy), "N", "magnitude of the pin force"),
        f"pin.{name}.force_x": Channel(fx, "N", "force of the first body on the second, forward"),
        f"pin.{name}.force_y": Channel(fy, "N", "force of the first body on the second, up"),
    }


def _ideal_pin_channels(scene: Scene, history: History, name: str) -> dict[str, Channel]:
    first = scene.ideal_pins[name].first
    # the engine's joint equation is second minus first, so its multiplier acts on the second reversed
    return _force_channels(name, -history.multiplier[:, first], -history.multiplier[:, first + 1])


def _loose_pin_channels(scene: Scene, history: History, name: str) -> tuple[dict[str, Channel], np.ndarray]:
    place, pin = scene.linkage.pins[name], scene.loose_pins[name]
    ends = [(place.first, place.first_point), (place.second, place.second_point)]
    second_has_journal = scene.scenario.clearance_pins[name].bore == "first"
    if not second_has_journal:
        ends.reverse()
    bore, journal = (_Motion(scene, history, *end) for end in ends)
    offset = journal.position - bore.position
    relative = journal.velocity - bore.velocity
    states = _contact_states(pin, history, offset, relative, bore, journal)

    memories = [recalled(data) for data in history.memory[:, pin.slots].tolist()]

    def column(get: Callable[[ContactForce], float]) -> np.ndarray:
        return np.array([get(state) for state in states])

    sign = 1.0 if second_has_journal else -1.0
    stored = column(lambda s: pin.contact.normal.elastic_energy(s.depth) if s.depth > 0.0 else 0.0)
    speeds = np.array([memory.approach_speed if memory.in_contact else 0.0 for memory in memories])
    found = _force_channels(name, sign * column(lambda s: s.force_x), sign * column(lambda s: s.force_y))
    found |= {
        f"pin.{name}.normal_force": Channel(column(lambda s: s.normal_force), "N", "normal contact force"),
        f"pin.{name}.friction_force": Channel(
            column(lambda s: s.friction_force), "N", "on the journal, along t (n turned by +90 degrees)"
        ),
        f"pin.{name}.depth": Channel(column(lambda s: s.depth), "m", "depth; negative: gap"),
        f"pin.{name}.slip": Channel(column(lambda s: s.slip), "m/s", "slip of the journal's surface, along t"),
        f"pin.{name}.approach_speed": Channel(speeds, "m/s", "touch speed that the laws are told; 0 apart"),
        f"pin.{name}.eccentricity_x": Channel(offset[:, 0], "m", "journal's centre from the bore's, forward"),
        f"pin.{name}.eccentricity_y": Channel(offset[:, 1], "m", "journal's centre from the bore's, up"),
    }
    if pin.contact.friction.has_state:
        found[f"pin.{name}.deflection"] = Channel(
            column(lambda s: s.deflection), "m", "state of the friction law"
        )
    return found, stored


def _contact_states(
    pin: LoosePin,
    history: History,
    offset: np.ndarray,
    relative: np.ndarray,
    bore: _Motion,
    journal: _Motion,
) -> list[ContactForce]:
    """The contact at every record, from state and memory."""
    states = []
    rows = zip(
        offset.tolist(),
        relative.tolist(),
        bore.spin.tolist(),
        journal.spin.tolist(),
        bore.angle.tolist(),
        history.memory[:, pin.slots].tolist(),
        strict=True,
    )
    for (x, y), (vx, vy), bore_spin, journal_spin, bore_angle, data in rows:
        memory = recalled(data)
        touch = memory.touch(*rotated((x, y), -bore_angle))
        # the memory has been taken at the same instant: no time has passed since
        now = SlipHistory(memory.deflection, memory.slip, 0.0)
        states.append(pin.contact.force(x, y, vx, vy, bore_spin, journal_spin, touch, now))
    return states


def _energy_channels(scene: Scene, history: History, stored: np.ndarray) -> dict[str, Channel]:
    kinetic = np.zeros_like(history.time)
    potential = np.zeros_like(history.time)
    gx, gy = scene.scenario.gravity
    for item in scene.bodies.values():
        i, body = item.first, item.body
        vx, vy, spin = history.velocity[:, i : i + 3].T
        kinetic += 0.5 * body.mass * (vx**2 + vy**2) + 0.5 * body.inertia * spin**2
        potential -= body.mass * (gx * history.position[:, i] + gy * history.position[:, i + 1])
    dissipated = history.damping_loss + history.friction_loss
    total = kinetic + potential + stored
    balance = total - total[0] + dissipated - history.work
    return {
        "energy.kinetic": Channel(kinetic, "J", "kinetic energy of all bodies"),
        "energy.potential": Channel(potential, "J", "of weight, zero in the machine's start posture"),
        "energy.elastic": Channel(stored, "J", "stored in contacts and oil"),
        "energy.damping_loss": Channel(
            history.damping_loss, "J", "dissipated by damping in contacts and oil so far"
        ),
        "energy.friction_loss": Channel(history.friction_loss, "J", "dissipated by friction so far"),
        "energy.work": Channel(history.work, "J", "work of the drive so far"),
        "energy.balance": Channel(balance, "J", "gain minus work plus loss; zero if computed exactly"),
    }
