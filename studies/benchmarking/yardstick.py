"""The support's rise by a compiled integrator written by hand: how fast the same answer can be had at all.

`yardstick.c` has the formulas. Here it is compiled, told the machine, run and read.
"""

import json
import math
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from studies.benchmarking.peers.plain_support import contact_numbers, plain_support
from support_exudyn import CubicStep, HydraulicSupport, Scenario
from support_exudyn.model.linkage import lumped
from support_exudyn.model.plane_geometry import minus, parts_of, side
from user_forces import Ambrosio, JournalContact
from user_forces.contact_state import Onset
from user_forces.values.value import InputError

SOURCE = Path(__file__).with_name("yardstick.c")


class YardstickError(RuntimeError):
    """The yardstick could not be compiled or run."""


class Yardstick(NamedTuple):
    """Outcome of the yardstick.

    seconds: of the best run [s]. mean: of the pin force at the records from the start of the stroke on [N].
    onsets: of the pin.
    """

    seconds: float
    mean: float
    onsets: tuple[Onset, ...]


@contextmanager
def compiled() -> Iterator[Path]:
    """The program, in a temporary folder. Raises YardstickError if there is no C compiler or it refuses."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        raise YardstickError("there is no C compiler: none of cc, gcc, clang is on the path")
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "yardstick"
        command = [compiler, "-O2", "-march=native", "-o", str(program), str(SOURCE), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise YardstickError(f"{' '.join(command)}\n{done.stderr}")
        yield program


def run_yardstick(scenario: Scenario, tolerance: float, *, program: Path, runs: int = 5) -> Yardstick:
    """Run the yardstick.

    Arguments:
        scenario: see `plain_support`, with a CubicStep.
        tolerance: largest error of a step as a share of the clearance.
        program: from `compiled`.
        runs: of which the fastest is reported.

    Raises InputError if the scenario is not covered, YardstickError if the run fails.
    """
    text = "\n".join(repr(float(x)) for x in _numbers(scenario, tolerance)) + f"\n{runs}\n"
    done = subprocess.run([str(program)], input=text, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise YardstickError(done.stderr.strip() or f"the program ended with {done.returncode}")
    found = json.loads(done.stdout)
    return Yardstick(found["seconds"], found["mean"], tuple(Onset(*impact) for impact in found["onsets"]))


# --- the machine in numbers, in the order of the C program ---


def _numbers(scenario: Scenario, tolerance: float) -> list[float]:
    contact = plain_support(scenario).contact  # refuses all other scenes
    machine, drive = scenario.machine, scenario.drive
    if not isinstance(machine, HydraulicSupport) or not isinstance(drive, CubicStep):
        raise InputError("drive: allowed here: CubicStep")
    start = machine.start()
    lever = math.dist(start.rear_shield, machine.rear_base)
    clearance = contact.bearing.clearance
    fall = math.sqrt(math.hypot(*scenario.gravity) * clearance)
    return [
        *_geometry(machine),
        *_masses(machine),
        *scenario.gravity,
        *_contact(contact),
        drive.stroke,
        drive.start,
        drive.end,
        scenario.duration,
        scenario.recorded_every,
        start.canopy,
        start.rear_link,
        lever / clearance / tolerance,
        lever / fall / tolerance,
    ]


def _geometry(m: HydraulicSupport) -> list[float]:
    start = m.start()
    front, rear = m.column_lengths(start)
    canopy, shield, front_link, rear_link = (
        lumped(m.parts[name]).centre for name in ("canopy", "shield", "front_link", "rear_link")
    )
    # centres of the circles about which the hinge turns on the columns
    about_front = minus(m.front_foot, minus(start.ends["front_head"], start.hinge))
    about_rear = minus(m.rear_foot, minus(start.ends["rear_head"], start.hinge))
    bar = minus(m.front_shield, m.hinge)
    return [
        *minus(m.front_head, m.hinge),
        *minus(m.rear_head, m.hinge),
        *minus(canopy, m.hinge),
        *m.front_foot,
        *m.rear_foot,
        *m.front_base,
        *m.rear_base,
        front,
        rear,
        math.dist(m.hinge, m.front_shield),
        math.dist(m.front_base, m.front_shield),
        side(about_front, about_rear, start.hinge),
        side(start.hinge, m.front_base, start.front_shield),
        *parts_of(minus(m.rear_shield, m.hinge), bar),
        *parts_of(minus(shield, m.hinge), bar),
        *parts_of(minus(front_link, m.front_base), minus(m.front_shield, m.front_base)),
        *minus(m.rear_base, m.rear_shield),
        *minus(rear_link, m.rear_shield),
    ]


def _masses(m: HydraulicSupport) -> list[float]:
    lumps = [lumped(m.parts[name]) for name in ("canopy", "shield", "front_link", "rear_link")]
    return [number for lump in lumps for number in (lump.mass, lump.inertia)]


def _contact(contact: JournalContact) -> list[float]:
    friction = contact.friction
    tangential = [0.0, 0.0, 1.0]
    if isinstance(friction, Ambrosio):
        static = friction.static_speed
        tangential = [friction.sliding_coefficient, static, friction.dynamic_speed - static]
    bearing = contact.bearing
    return [bearing.clearance, bearing.bore_radius, *contact_numbers(contact), *tangential]
