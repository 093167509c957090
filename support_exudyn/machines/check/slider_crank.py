"""The check of a slider-crank."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from support_exudyn.machines.check.report import CheckReport, CheckTable
from support_exudyn.machines.check.statics import Statics, mobility, statics
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.slider_crank import SliderCrank

STATIONS, FINE = 13, 361  # of one revolution
LONG = 2.0  # rod to crank: shorter rods press hard on the guide


@dataclass(frozen=True)
class Turn:
    """A posture of a revolution: crank angle and angle of the rod to the guide [rad], slider [m], forces."""

    angle: float
    rod: float
    slider: float
    residual: float
    forces: Statics


@dataclass(frozen=True)
class CrankReport(CheckReport):
    """A check of a slider-crank; fine: postures over one revolution."""

    machine: SliderCrank = field(repr=False)
    fine: Sequence[Turn] = field(repr=False)


def check_crank(data: MachineData, machine: SliderCrank) -> CrankReport:
    """The report of a slider-crank before it is run, over one revolution of the crank."""
    fine = [_turn(machine, 2.0 * math.pi * n / (FINE - 1)) for n in range(FINE)]
    told = fine[:: (FINE - 1) // (STATIONS - 1)]
    free = mobility(machine.linkage())
    travel = [one.slider for one in fine]
    residual, error = max(one.residual for one in fine), max(one.forces.error for one in fine)
    steepest = math.asin(machine.crank_length / machine.rod_length)
    ratio = machine.rod_length / machine.crank_length
    facts = [
        free.said(),
        f"slider: x from {1e3 * min(travel):.2f} to {1e3 * max(travel):.2f} mm over one revolution",
        f"closure: the rod keeps its length within {1e3 * residual:.1e} mm at {FINE} postures",
        "dead centres: crank at 0 and 180 degrees, where the slider cannot turn it; a driven crank passes them",
        f"steepest rod: {math.degrees(steepest):.2f} degrees to the guide, crank at 90 and 270 degrees",
        f"static forces: under weight alone; numerical error below {max(error, 1e-12):.0e} N",
    ]
    warnings = []
    if ratio < LONG:
        warnings.append(
            f"rod_length_mm is {ratio:.2f} times crank_length_mm: the rod stands steep and presses on the guide"
        )
    for name, radius in data.bore_radii.items():
        if radius > 0.5 * machine.crank_length:
            warnings.append(
                f"bore_radius_mm.{name} = {1e3 * radius:g}: more than half the crank; is it a diameter?"
            )
    if machine.crank_length > 5.0:
        warnings.append(f"crank_length_mm: {machine.crank_length:g} m; is it given in mm?")
    notes = [f"assumed: {said}" for said in data.assumed]
    if not data.bore_radii:
        notes.append(
            "no [bore_radius_mm]: a scenario that gives a pin a clearance has to say its bore's radius"
        )
    notes.append("it is known in its plane only")
    notes += [f"source of {name}: {said}" for name, said in data.sources.items()]
    return CrankReport(
        name=data.name,
        kind=data.kind,
        facts=facts,
        sheets=[_sheet(machine, told)],
        warnings=warnings,
        notes=notes,
        numbers={
            "degrees_of_freedom": free.data(),
            "slider_least_m": min(travel),
            "slider_largest_m": max(travel),
            "closure_residual_m": residual,
            "force_error_N": error,
            "dead_centres_rad": [0.0, math.pi],
            "stations": [_data(one) for one in told],
        },
        machine=machine,
        fine=fine,
    )


def _turn(machine: SliderCrank, angle: float) -> Turn:
    start, linkage = machine.start_angle, machine.linkage()
    r, l_ = machine.crank_length, machine.rod_length
    pin = np.array([r * math.cos(angle), r * math.sin(angle)])
    slider = np.array([machine.slider_position(angle), 0.0])
    rod = math.atan2(-pin[1], slider[0] - pin[0])
    rod_at_start = linkage.bodies["rod"].angle
    position = np.zeros(9)
    position[0:2] = 0.5 * pin - linkage.bodies["crank"].centre
    position[2] = angle - start
    position[3:5] = 0.5 * (pin + slider) - linkage.bodies["rod"].centre
    position[5] = rod - rod_at_start
    position[6:8] = slider - linkage.bodies["slider"].centre
    return Turn(
        angle, rod, float(slider[0]), abs(float(np.hypot(*(slider - pin))) - l_), statics(linkage, position)
    )


def _sheet(machine: SliderCrank, told: list[Turn]) -> CheckTable:
    pins = tuple(machine.linkage().pins)
    return CheckTable(
        "one revolution, crank driven (angles from +x [degrees]; static forces [N], moment of the drive [N m])",
        ("crank", "slider [mm]", "rod", *pins, "guide", "drive"),
        [
            (
                f"{math.degrees(one.angle):.0f}",
                f"{1e3 * one.slider:.3f}",
                f"{math.degrees(one.rod):.2f}",
                *(f"{float(np.hypot(*one.forces.pins[name])):.4f}" for name in pins),
                f"{one.forces.slides['guide']:.4f}",
                f"{one.forces.cranks['crank']:.4f}",
            )
            for one in told
        ],
    )


def _data(one: Turn) -> dict[str, Any]:
    return {
        "crank_rad": one.angle,
        "slider_m": one.slider,
        "rod_rad": one.rod,
        "pins_N": {name: force.tolist() for name, force in one.forces.pins.items()},
        "guide_N": one.forces.slides["guide"],
        "drive_N_m": one.forces.cranks["crank"],
    }
