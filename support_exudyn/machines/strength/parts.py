"""Parts of a support under load: stresses in a pin and its eyes, buckling of a cylinder, tipping of the whole.

A pin carries F on a middle eye of width b between two outer ones of width a, at gaps c, each pressed evenly:

    bearing pressure    p = F / (d min(b, 2 a))         against the yield stress of the eyes
    shear, two sections tau = F / (2 A), A = pi d^2/4   against yield stress / sqrt(3) (von Mises)
    bending             sigma = M / W, M = F (b + 2 a + 4 c) / 8, W = pi d^3/32   against that of the pin

A cylinder of several stages between two pins buckles as a column whose bending stiffness EI changes from
stage to stage (Euler): w'' + P/(E I) w = 0 with w = 0 at both ends. In a stage w = a sin(k s + phase), k =
sqrt(P/(E I)); where the next begins, w and w' go on. The least load is that at which the phase reaches pi at
the far end. It lies between the loads of uniform columns of the weakest and the stiffest stage, and the phase
grows with P, so that it is the only one in that range. Johnson, for columns that yield before: P = P_y (1 -
P_y/(4 P_E)) where P_E > P_y/2, with P_y = yield stress times the least area of steel.

A support tips about an edge of its base when the common centre of mass stands above that edge:

    angle = atan(horizontal distance of the edge / height above the floor)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.shield_layout import RODS
from support_exudyn.machines.strength.strength_data import (
    BaseFrame,
    CylinderStage,
    CylinderStrength,
    PinStrength,
)
from support_exudyn.model.linkage import Linkage
from user_forces.roots import bracketed_root
from user_forces.values.value import InputError, Vector2

Segment = tuple[float, float]  # length [m] and bending stiffness [N m^2]
Mass = tuple[float, Vector2]  # [kg], and its centre [m]
KnownPin = tuple[PinStrength, float, bool]  # eyes, diameter [m], and whether the eyes are assumed
CLOSE = 1e-12  # of the load


# --- pins ---


@dataclass(frozen=True)
class PinStresses:
    """Stresses of a pin under a force.

    Arguments:
        force: on all pins together that the plane takes as one [N].
        bearing, shear, bending: [Pa].
        safeties: yield over stress, of "bearing", "shear" and "bending" [-]; infinite without a force.
    """

    force: float
    bearing: float
    shear: float
    bending: float
    safeties: dict[str, float]

    @property
    def least(self) -> tuple[str, float]:
        """What yields first, and its safety."""
        return min(self.safeties.items(), key=lambda item: item[1])


def stresses(pin: PinStrength, diameter: float, force: float) -> PinStresses:
    """The stresses of a pin of this diameter [m] under a force on all of its kind together [N]."""
    one = force / pin.count
    bearing = one / (diameter * min(pin.middle, 2.0 * pin.outer))
    shear = one / (2.0 * 0.25 * math.pi * diameter**2)
    moment = one * (pin.middle + 2.0 * pin.outer + 4.0 * pin.gap) / 8.0
    bending = moment / (math.pi * diameter**3 / 32.0)
    pin_yield, eye_yield = pin.yields
    allowed = {
        "bearing": (eye_yield, bearing),
        "shear": (pin_yield / math.sqrt(3.0), shear),
        "bending": (pin_yield, bending),
    }
    safeties = {name: limit / stress if stress > 0.0 else math.inf for name, (limit, stress) in allowed.items()}
    return PinStresses(force, bearing, shear, bending, safeties)


def pin_data(data: MachineData, pin: str) -> KnownPin | None:
    """A pin's eyes, its diameter [m], and whether they are assumed; None if too little is known.

    Assumed of a pin whose length L alone is known: a middle eye of L/2 between two of L/4. A pin of a body that
    stands for two is two pins. Its diameter is that of the bore.
    """
    known = data.strength.pins.get(pin) if data.strength else None
    bore = data.bore_radii.get(pin)
    diameter = known.diameter if known and known.diameter else None if bore is None else 2.0 * bore
    if diameter is None:
        return None
    if known:
        return known, diameter, False
    width = data.machine.widths()
    length = width.lengths.get(pin) if width else None
    if width is None or length is None:
        return None
    place = data.machine.linkage().pins[pin]
    count = 2 if {place.first, place.second} & width.pairs.keys() else 1
    return PinStrength(middle=0.5 * length, outer=0.25 * length, count=count), diameter, True


# --- buckling ---


def euler_load(segments: Sequence[Segment]) -> float:
    """The least load [N] at which a pinned column of these segments buckles."""
    length = math.fsum(part for part, _ in segments)
    ends = [(math.pi / length) ** 2 * stiffness for _, stiffness in segments]
    low, high = min(ends), max(ends)
    if high - low <= CLOSE * high:
        return low
    return bracketed_root(lambda load: _phase(segments, load) - math.pi, low, high, xtol=CLOSE * low)


def _phase(segments: Sequence[Segment], load: float) -> float:
    """Phase of the deflection at the far end [rad], 0 at the near one."""
    phase, before = 0.0, 1.0
    for length, stiffness in segments:
        k = math.sqrt(load / stiffness)
        # the deflection and its slope go on; the phase stays within its quarter turn
        changed = math.atan2(k * math.sin(phase), before * math.cos(phase))
        phase += math.remainder(changed - phase, 2.0 * math.pi) + k * length
        before = k
    return phase


def seen_stages(cylinder: CylinderStrength, length: float) -> list[tuple[float, CylinderStage]]:
    """Lengths [m] of the stages that are seen when a cylinder is so long [m], with the stages, foot first.

    The first stage is seen whole. The thicker moves out first, as its larger area does at a lower pressure.
    Where two overlap, the outer one alone counts.

    Raises InputError if all stages together are not so long, or the first is longer.
    """
    first, *others = cylinder.stages
    left = length - first.length
    if left <= 0.0:
        raise InputError(
            f"stages[0].length = {first.length:.6g} m: the cylinder is {length:.6g} m long there; allowed: less"
        )
    found = [(first.length, first)]
    for stage in others:
        seen = min(stage.length, left)
        if seen > 0.0:
            found.append((seen, stage))
        left -= seen
    if left > CLOSE * length:
        raise InputError(
            f"stages: together {length - left:.6g} m long, and the cylinder has to be {length:.6g} m; allowed: "
            "stages that reach so far"
        )
    return found


def buckling_loads(cylinder: CylinderStrength, length: float) -> tuple[float, float | None]:
    """Loads [N] of one cylinder that is so long [m]: Euler's, and Johnson's where the yield stress is known.

    Raises InputError as `seen_stages` does.
    """
    seen = seen_stages(cylinder, length)
    euler = euler_load([(part, cylinder.elastic_modulus * stage.second_moment) for part, stage in seen])
    if cylinder.yield_stress is None:
        return euler, None
    squash = cylinder.yield_stress * min(stage.area for _, stage in seen)
    # slender, or stocky
    return euler, euler if euler <= 0.5 * squash else squash * (1.0 - squash / (4.0 * euler))


# --- tipping ---


@dataclass(frozen=True)
class Tipping:
    """How far a support can be inclined.

    Arguments:
        mass: of all with the base [kg].
        centre: of that mass, x and y [m].
        angles: "forward", "rearward" and "sideways" [rad]; negative: it tips on level ground. Left and right
            are alike: a machine of the plane is symmetric.
    """

    mass: float
    centre: Vector2
    angles: dict[str, float]


def cylinder_masses(data: MachineData, linkage: Linkage) -> list[Mass]:
    """Cylinders in a posture of the linkage, with those rods that no body of it contains, as far as known."""
    parts = data.machine.parts if isinstance(data.machine, FourBarShield) else {}
    told = {part.name for some in parts.values() for part in some}
    found: list[Mass] = []
    for name, one in data.actuators.items():
        place = linkage.actuators[name]
        foot, head = place.foot_point, place.head_point
        found.append((one.cylinder_mass, _between(foot, head, one.cylinder_centre)))
        if name + RODS not in told:
            found.append((one.rod_mass, _between(head, foot, one.rod_centre)))
    return found


def _between(start: Vector2, end: Vector2, far: float) -> Vector2:
    """The point so far [m] from the start towards the end."""
    share = far / math.dist(start, end)
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])


def tipping_of(linkage: Linkage, base: BaseFrame, besides: Sequence[Mass] = ()) -> Tipping:
    """Angles at which a support in this posture tips.

    besides: masses that are not among the bodies of the linkage, with their centres.

    Raises InputError if its centre of mass does not lie above the floor.
    """
    parts = [(one.mass, one.centre) for one in linkage.bodies.values()]
    parts += [*besides, (base.mass, base.centre)]
    mass = math.fsum(part for part, _ in parts)
    x, y = (math.fsum(part * centre[k] for part, centre in parts) / mass for k in (0, 1))
    height = y - base.floor
    if height <= 0.0:
        raise InputError(
            f"strength.base.floor = {base.floor:.6g} m: the common centre of mass is {y:.6g} m high; allowed: "
            "a floor below it"
        )
    ways = {"forward": base.front - x, "rearward": x - base.rear, "sideways": 0.5 * base.width}
    return Tipping(mass, (x, y), {name: math.atan2(way, height) for name, way in ways.items()})
