"""The slider-crank for the reduced formulation: its parameters, and its bodies at the records."""

from __future__ import annotations

import numpy as np

from support_exudyn.formulations.reduced import layout
from support_exudyn.formulations.reduced.bodies import Bodies, Place, moved, placed
from support_exudyn.formulations.reduced.drive import Matrix
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.drives.drive import CubicStep, Held, Reciprocating, Steady
from support_exudyn.model.linkage import Linkage

PIN = "slider_pin"
DRIVES = (Held, Steady, CubicStep, Reciprocating)  # a jump of the crank's speed is not covered


def start(machine: SliderCrank) -> tuple[float, float]:
    """The free coordinates at the start: turn of the rod [rad], way of the slider [m]."""
    del machine
    return 0.0, 0.0


def shifted(before: Linkage, after: Linkage) -> tuple[float, float]:
    """Turn of the rod [rad] and way of the slider [m] between two postures of the linkage."""
    turn = after.bodies["rod"].angle - before.bodies["rod"].angle
    return turn, after.bodies["slider"].centre[0] - before.bodies["slider"].centre[0]


def reaches(machine: SliderCrank) -> tuple[float, float]:
    """By how much the journal moves with the free coordinates: [m/rad], 1."""
    return machine.rod_length, 1.0


def fall(machine: SliderCrank, speed: float) -> float:
    """Acceleration of the journal without its contact besides gravity's [m/s^2] at a crank speed [rad/s]."""
    return machine.crank_length * speed**2


def parameters(machine: SliderCrank) -> dict[str, float]:
    """Parameters by name."""
    rod = machine.linkage().bodies["rod"]
    return {
        "MACHINE": layout.SLIDER_CRANK,
        "CRANK_LENGTH": machine.crank_length,
        "ROD_LENGTH": machine.rod_length,
        "CRANK_MASS": machine.crank_mass,
        "CRANK_INERTIA": machine.crank_inertia,
        "ROD_MASS": machine.rod_mass,
        "ROD_INERTIA": machine.rod_inertia,
        "SLIDER_MASS": machine.slider_mass,
        "CRANK_ANGLE": machine.start_angle,
        "ROD_ANGLE": rod.angle,
        "SLIDER_X": machine.slider_position(machine.start_angle),
    }


def bodies(
    machine: SliderCrank, linkage: Linkage, p: list[float], rows: Matrix, accelerations: Matrix | None
) -> Bodies:
    """Bodies at the records; arguments as of `support_model.bodies`."""
    assert accelerations is not None  # with an ideal pin nothing is free, and `check` refuses it
    rod_turn, way, rod_spin, slide_speed = rows[layout.STATE_ROW : layout.STATE_ROW + 4]
    turn, speed, speeding = rows[layout.EXTENSION : layout.ACCELERATION + 1]
    rod_turning, slide_speeding = accelerations[:2]
    still = np.zeros_like(turn)
    crank, rod = machine.start_angle + turn, p[layout.ROD_ANGLE] + rod_turn
    half = 0.5 * machine.crank_length
    centre = half * np.cos(crank), half * np.sin(crank)
    at_crank = moved((still, still, still, still, still, still), centre, turn, speed, speeding)
    # the crank's tip is as far again
    tip = (*(2.0 * getattr(at_crank, name) for name in ("x", "y", "vx", "vy", "ax", "ay")),)
    half = 0.5 * machine.rod_length
    at_rod = moved(tip, (half * np.cos(rod), half * np.sin(rod)), rod_turn, rod_spin, rod_turning)
    x = p[layout.SLIDER_X] + way
    at_slider = Place(x, still, still, slide_speed, still, still, slide_speeding, still, still)
    return placed(linkage, [at_crank, at_rod, at_slider], {})
