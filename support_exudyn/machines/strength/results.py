"""What was found of what a support must stand, section by section; SI."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from support_exudyn.machines.strength.pins import PinStresses
from support_exudyn.machines.strength.roof_forces import RoofContact, RoofForce
from support_exudyn.machines.strength.strength_data import CylinderStrength
from support_exudyn.machines.strength.tipping import Tipping


@dataclass(frozen=True)
class SupportForce:
    """Support force in one posture, all legs at a pressure and rams without force; None where none balances.

    A single leg leaves the place of the roof force open. All are then the largest over the places of the
    canopy, infinite where the leg does not feel the roof.

    Arguments:
        stroke: of the legs from the start on [m].
        contact: where the roof lies.
        setting: at the setting pressure, None without one. yielding: at the yield pressure.
        least: at the yield pressure of a single leg, where it holds the least; None of two.
        rubbed: at the yield pressure with the roof's friction, by its coefficient.
        pull, push: at the yield pressure with rams at their largest pull and push; None without rams.
        over: places x [m] on the canopy, each with the largest force there that opens no valve
            and lifts no leg [N].
        largest: of all places.
    """

    stroke: float
    contact: RoofContact
    setting: RoofForce | None
    yielding: RoofForce | None
    least: RoofForce | None
    rubbed: Mapping[float, RoofForce | None]
    pull: RoofForce | None
    push: RoofForce | None
    over: Sequence[tuple[float, float]]
    largest: RoofForce


@dataclass(frozen=True)
class PinLoad:
    """The forces in a pin over the used height [N].

    Arguments:
        nominal: largest with all legs at yield, rams without force, a roof that does not rub; by the factor on
            the yield force.
        worst: largest under any roof force on the canopy that the cylinders hold, likewise by factor; NaN if
            it has no bound, as a roof force loads the pin that no cylinder feels.
        rubbed: the same with a roof that rubs either way.
        stresses: of `worst` and `rubbed` at 1.2 times yield; None where too little is known of the pin.
        yields: yield stresses of pin and eyes [Pa] against which it is judged; None where too little is known.
        assumed: whether its eyes are.
    """

    nominal: Mapping[float, float]
    worst: Mapping[float, float]
    rubbed: Mapping[float, float]
    stresses: tuple[PinStresses, PinStresses] | None
    yields: tuple[float, float] | None
    assumed: bool


@dataclass(frozen=True)
class Buckling:
    """Buckling of one cylinder at its longest.

    Arguments:
        length: [m]. force: on one at its yield pressure [N].
        euler, johnson: loads [N]; the second None without a yield stress.
    """

    length: float
    force: float
    euler: float
    johnson: float | None

    @property
    def least(self) -> float:
        """The load at which it fails [N]."""
        return self.euler if self.johnson is None else min(self.euler, self.johnson)


@dataclass(frozen=True)
class OffMiddle:
    """A roof force beside the middle in one posture.

    Arguments:
        height: of the roof [m]. aside: e [m]. nominal: the roof force in the middle [N].
        moment: Q e that the linkage carries while all legs push alike [N m].
        pins: largest force in one bearing of a pin of the plane then, by pin, with the least moments [N].
        centred: the same with e = 0.
        tilts: largest moment in one bearing of a pin, by pin, with the least forces [N m].
        links: pins that are not on the canopy.
        legs_alone: largest roof force that legs alone carry at e, no roll passed on [N].
    """

    height: float
    aside: float
    nominal: float
    moment: float
    pins: Mapping[str, float]
    centred: Mapping[str, float]
    tilts: Mapping[str, float]
    links: Sequence[str]
    legs_alone: float


@dataclass(frozen=True)
class StandReport:
    """What a support must stand.

    Arguments:
        name, kind: of the machine.
        cylinders: by actuator. legs: names of those on the ground.
        forces: by posture, from the lowest on.
        rated: support force [N], and whether the file says it.
        pins: by name. unknown_pins: of which too little is known.
        buckling: by actuator.
        unbuckled: actuators whose buckling is not told, with the reason.
        off_middle: in the lowest, middle and highest posture, or in words why not.
        tipping: by posture of `forces`; None without a base.
        wander: of the tip over the used height [m]; None of machines that are no four-bar support.
        assumed: what was assumed, in sentences. sources: of the numbers, in sentences.
    """

    name: str
    kind: str
    cylinders: Mapping[str, CylinderStrength]
    legs: Sequence[str]
    forces: Sequence[SupportForce]
    rated: tuple[float, bool]
    pins: Mapping[str, PinLoad]
    unknown_pins: Sequence[str]
    buckling: Mapping[str, Buckling]
    unbuckled: Mapping[str, str]
    off_middle: Sequence[OffMiddle] | str
    tipping: Sequence[Tipping] | None
    wander: float | None
    assumed: Sequence[str]
    sources: Sequence[str]
