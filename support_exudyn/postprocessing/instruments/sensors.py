"""Instruments of mines: pressure gauges and extension sensors of columns, and inclinometers.

    signal --> low-pass --> reading --> samples --> plus noise --> rounded to the resolution

An inclinometer senses gravity less the acceleration of its place, and cannot distinguish the two.

    f = R^T (g - a)               specific force, in the body's own axes: x along the line by which the machine
                                  measures it, y across in the plane, z to the right
    tilt = atan2(-f_x, -f_y)      the angle of the body from +x while it is at rest
    v_P = v + omega x r           velocity of the place P, from the recorded motion of its body
    a_P(t) = (v_P(t + h) - v_P(t - h)) / 2 h

with h between records: the mean acceleration over two of them, exactly, also where impacts lie between. Of a
wave of w rad/s it is smaller than at the instant by the share (w h)^2 / 6. At both ends of the run a parabola
through three records gives it.
"""

import math
from abc import ABC, abstractmethod
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.actuators import OilColumn
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.postprocessing.look.poses import Poses, named_ends
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.units import Hertz, Metres, Pascals, Radians
from user_forces.values.value import InputError, NonNegative, Positive, Value, Whole, value

RECORDS = 20  # in a period of a filter's corner frequency, at least
CLOSE = 1e-6  # share of a period by which records that are evenly spaced may be off


@value
class LowPass(Value):
    """A Butterworth filter as a device has it: causal, so that its output comes late.

    Gain at a frequency f: 1 / sqrt(1 + (f / corner)^(2 order)). Before the first record its input was as there.

    Arguments:
        order: 1 to 8; 1 is a resistor and a capacitor. 2 by default.
        corner: frequency at which the gain is 1 / sqrt(2) [Hz], > 0.
    """

    order: Annotated[Whole, Field(ge=1, le=8)] = 2
    corner: Hertz[Positive]

    def check(self, period: float) -> None:
        """Raise InputError if records are too far apart for this filter; period: between them [s].

        A wave at the corner frequency loses 0.8 % of its height by straight lines between `RECORDS` records,
        and 1.6 % where it is a derivative by them.
        """
        longest = 1.0 / (RECORDS * self.corner)
        if period > longest * (1.0 + CLOSE):
            raise InputError(
                f"low_pass.corner = {self.corner:g} Hz: the records are {period:g} s apart, too far for it; "
                f"allowed: runs with record_period <= {longest:g} s, or a corner up to "
                f"{self.corner * longest / period:g} Hz"
            )

    def filtered(self, values: Series, period: float) -> Series:
        """The filter's output at the records (n, m), exact for an input (n, m) with straight lines between.

        period: between records [s].
        """
        from scipy import signal  # takes a while to import

        time = 2.0 * np.pi * self.corner * period * np.arange(len(values))
        system = signal.butter(self.order, 1.0, analog=True)
        columns = [column[0] + signal.lsim(system, column - column[0], time)[1] for column in values.T]
        return np.stack(columns, axis=-1)


@value
class Instrument(Value, ABC):
    """A device on a machine.

    Arguments:
        rate: samples per second [Hz], > 0, 10 by default; the first at the start of the run.
        low_pass: filter before the samples are taken; None: there is none.
        noise: RMS of white, normally distributed noise, in the unit of the reading, >= 0, 0 by default.
        resolution: step of its digits, in the same unit, >= 0, 0 by default: digits without end.
    """

    UNIT: ClassVar[str]  # of the reading, in SI

    rate: Hertz[Positive] = 10.0
    low_pass: LowPass | None = None
    noise: NonNegative = 0.0
    resolution: NonNegative = 0.0

    @abstractmethod
    def signals(self, result: Result) -> Series:
        """The signals that act on it at every record, shape (n, m).

        Raises InputError if the run has not recorded them, or has no such part.
        """

    def reading(self, signals: Series) -> Series:
        """The reading (n,) of filtered signals (n, m); the first, unless an instrument defines another."""
        return signals[:, 0]


@value
class PressureGauge(Instrument):
    """A gauge of the pressure in a column, against the air.

    Of a hydraulic cylinder it is the recorded pressure of that side. Otherwise the side that the force F loads
    has |F| / A, and the other none: the piston side where the column is pressed together, the rod side where
    it is pulled apart. A is the area of that side, all cylinders of the column together. The scenario of a
    column of oil defines it.

    Arguments:
        column: name of an actuator; in space also of one of a pair, such as front_column_left.
        side: "piston", by default, or "rod".
        bore: diameter of a cylinder's bore [m]; None: as in the scenario.
        rod: diameter of its rod [m], less than the bore; for the rod side.
        cylinders: number of cylinders that the column stands for, 1 by default.
        rate, low_pass, noise [Pa], resolution [Pa]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "Pa"

    column: str
    side: Literal["piston", "rod"] = "piston"
    bore: Metres[Positive] | None = None
    rod: Metres[Positive] | None = None
    cylinders: Annotated[Whole, Field(ge=1)] = 1
    noise: Pascals[NonNegative] = 0.0
    resolution: Pascals[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """The pressure (n, 1) [Pa]."""
        scenario, piston = result.scenario, self.side == "piston"
        whole, _ = column_of(scenario, self.column)
        area, leg = self.area(scenario), scenario.legs.get(whole)
        plain = isinstance(leg, OilColumn) and not (piston and leg.elements)
        if leg is not None and not plain:
            name = f"{self.column}.{'pressure' if piston else 'rod_pressure'}"
            return result.recorded(name, "a gauge shows it")[:, None]
        force = result.recorded(f"{self.column}.force", "a pressure gauge needs it")
        pressure: Series = np.maximum(force if piston else -force, 0.0) / area
        return pressure[:, None]

    def area(self, scenario: Scenario) -> float:
        """Area on which the oil of its side presses [m^2], all cylinders together.

        That of the gauge goes before that of the scenario. Raises InputError if neither defines it.
        """
        piston = self.side == "piston"
        if self.bore is not None and (piston or self.rod is not None):
            rod = 0.0 if piston or self.rod is None else self.rod
            if rod >= self.bore:
                raise InputError(
                    f"gauge on {self.column}: rod = {1e3 * rod:g} mm: allowed: less than the bore, "
                    f"{1e3 * self.bore:g} mm"
                )
            return self.cylinders * math.pi / 4.0 * (self.bore**2 - rod**2)
        whole, share = column_of(scenario, self.column)
        leg = scenario.legs.get(whole)
        if isinstance(leg, HydraulicCylinder) and not piston:
            return share * leg.rod_side_area
        if isinstance(leg, (HydraulicCylinder, OilColumn)) and piston:
            return share * leg.bore_area
        raise InputError(
            f"gauge on {self.column}: the area on which the oil presses is not known; allowed: "
            f"{'bore_mm' if piston else 'bore_mm and rod_mm'} of the gauge, diameters, with the number of "
            "cylinders; or a scenario whose column is a HydraulicCylinder, or on the piston side an OilColumn"
        )


@value
class ExtensionSensor(Instrument):
    """A sensor of a column's extension: its length less that in the machine's start posture.

    Arguments:
        column: name of an actuator.
        rate, low_pass, noise [m], resolution [m]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "m"

    column: str
    noise: Metres[NonNegative] = 0.0
    resolution: Metres[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """The extension (n, 1) [m]."""
        scenario = result.scenario
        whole, _ = column_of(scenario, self.column)
        ends = machine_of(scenario).actuators
        parts = [self.column] if self.column in ends else list(scenario.space.parts_of_actuator(whole))
        zero = float(np.mean([ends[part].start_length for part in parts]))
        return (result.recorded(f"{self.column}.length", "a sensor of extension shows it") - zero)[:, None]


@value
class Inclinometer(Instrument):
    """A device that takes the direction of the specific force for that of gravity, so that it errs in motion.

    The filter acts on the specific force, axis by axis. At rest the reading is the angle of the body from the
    horizontal [rad], positive counterclockwise; with gravity along -y that is the channel BODY.angle.

    Arguments:
        body: name of the body on which it sits; "ground" is the base of a machine.
        at: where: a traced point, pin or actuator whose point on this body it is; None: its centre of mass.
        direction: "forward", by default: in the plane; "sideways": how far the body's right side is down.
        rate, low_pass, noise [rad], resolution [rad]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "rad"

    body: str
    at: str | None = None
    direction: Literal["forward", "sideways"] = "forward"
    noise: Radians[NonNegative] = 0.0
    resolution: Radians[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """The specific force at the place (n, 3) [m/s^2], in the body's own axes."""
        return specific_force(result, self.body, self.at)

    def reading(self, signals: Series) -> Series:
        """The tilt (n,) [rad] that the device assigns to the body."""
        x, y, z = signals.T
        if self.direction == "sideways":
            return np.asarray(np.arctan2(z, np.hypot(x, y)))
        return np.asarray(np.unwrap(np.arctan2(0.0 - x, -y)))  # of 0, not of -0


def specific_force(result: Result, body: str, at: str | None = None) -> Series:
    """Gravity less the acceleration of a place, in the axes of its body (n, 3) [m/s^2].

    Arguments:
        result: a run in the plane or in space.
        body: name of the body, or "ground".
        at: the place: a traced point, pin or actuator whose point on this body it is; None: centre of mass.

    Raises InputError if the machine has no such body or place, or if the run has not recorded its motion.
    """
    linkage = machine_of(result.scenario)
    gravity = np.array([*result.scenario.gravity, 0.0])
    if body != GROUND and body not in linkage.bodies:
        raise InputError(
            f"body = {body!r}: the machine has no such body; {meant(body, [GROUND, *linkage.bodies])}"
        )
    places = {name: point for name, on, point in named_ends(linkage) if on == body}
    if at is not None and at not in places:
        raise InputError(f"at = {at!r}: no such place on {body}; {meant(at, places)}")
    if body == GROUND:
        return np.tile(gravity, (result.time.size, 1))
    pose = Poses(result).of(body)
    turn = pose.turn
    arm = np.zeros(3) if at is None else np.array([*places[at], 0.0][:3]) - pose.start
    velocity = pose.velocity + np.cross(pose.spin, turn @ arm)
    acceleration = np.gradient(velocity, float(result.time[1] - result.time[0]), axis=0, edge_order=2)
    axes = turn @ Rotation.from_euler("z", linkage.bodies[body].angle).as_matrix()
    return np.asarray(np.einsum("nji,nj->ni", axes, gravity - acceleration))


def machine_of(scenario: Scenario) -> Linkage | SpatialLinkage:
    """The linkage of a scenario, in the plane or in space."""
    return scenario.space if scenario.dimensions == 3 else scenario.linkage


def column_of(scenario: Scenario, name: str) -> tuple[str, float]:
    """The actuator of the plane that a column is or is a part of, and its share of the piston area.

    Raises InputError if there is none of this name.
    """
    if name in scenario.linkage.actuators:
        return name, 1.0
    parts = scenario.space.actuators if scenario.dimensions == 3 else {}
    if name in parts:
        return parts[name].actuator, parts[name].share
    known = meant(name, [*scenario.linkage.actuators, *parts])
    raise InputError(f"column = {name!r}: the machine has no such actuator; {known}")
