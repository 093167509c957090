"""From a scenario to the arrays of one run, which compiled functions read and fill."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from support_exudyn.formulations.compilation import compiled_law
from support_exudyn.formulations.compiled.closed_forms import layout
from support_exudyn.formulations.compiled.closed_forms.coverage import model_of
from support_exudyn.formulations.compiled.closed_forms.integrate import REPORT
from support_exudyn.formulations.compiled.closed_forms.layout import Matrix, Vector
from support_exudyn.formulations.compiled.closed_forms.machine_model import MachineModel
from support_exudyn.formulations.time_grid import record_times
from support_exudyn.model.drives.drive import Drive, Reciprocating, Steady, Stroke, UniformSpeed
from support_exudyn.model.drives.table_drive import TableDrive
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.scenario import Scenario
from user_forces.compilation.flat import asks_for_mass, law_source
from user_forces.contact import JournalContact
from user_forces.friction.ambrosio import Ambrosio
from user_forces.friction.frictionless import Frictionless
from user_forces.normal.damping_speed import SMALLEST, ImpactVelocity, IndentationVelocity
from user_forces.normal.hertz import Hertz
from user_forces.normal.hysteresis import Hysteresis
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_law import ElasticPower, PowerLaw

TABLE = slice(layout.ORIGIN, layout.A3 + 1)  # of a segment: what a cubic is
SLOWEST = 1e-3  # [m/s], of what the journal may do in its bore, for scenes in which nothing falls


def parameters(scenario: Scenario, machine: Mapping[str, float], pin: ClearancePin | None) -> Vector:
    """The vector of parameters, see `layout`.

    Arguments:
        machine: the machine's parameters by name.
        pin: the clearance pin; without one the contact's are zero, and the bore is in the first body.
    """
    named = {
        **machine,
        "GRAVITY_X": scenario.gravity[0],
        "GRAVITY_Y": scenario.gravity[1],
        **(_contact(pin) if pin else {"BORE_FIRST": 1.0}),
    }
    vector = np.zeros(layout.PARAMETERS)
    constants: list[float] = []
    if pin and not has_family_form(pin.contact):
        source, constants = law_source(pin.contact)
        named["LAW"] = float(compiled_law(source).address)
    for name, number in named.items():
        vector[getattr(layout, name)] = number
    return np.array([*vector, *constants])


def has_family_form(contact: JournalContact) -> bool:
    """Whether a contact is of the family K depth^n with hysteresis damping, and Ambrosio's friction or none.

    The family's force takes the fewest operations; other laws are compiled from their source, see `law_source`.
    """
    return has_power_form(contact.normal) and type(contact.friction) in (Frictionless, Ambrosio)


def has_power_form(law: NormalLaw) -> bool:
    """Whether a law's force is K depth^n (1 + chi rate / w), or K depth^n, and nothing changes that."""
    kind = type(law)
    elastic = isinstance(law, ElasticPower) and all(
        getattr(kind, name) is getattr(ElasticPower, name)
        for name in ("elastic_force", "elastic_energy", "largest_depth")
    )
    if not elastic or kind.__call__ is Hertz.__call__:
        return elastic
    damped = isinstance(law, PowerLaw) and type(law.damping_speed) in (ImpactVelocity, IndentationVelocity)
    return damped and kind.__call__ is Hysteresis.__call__ and kind.forgets is Hysteresis.forgets


def _contact(pin: ClearancePin) -> dict[str, float]:
    bearing, law, friction = pin.contact.bearing, pin.contact.normal, pin.contact.friction
    found = {
        "CLEARANCE": bearing.clearance,
        "BORE_RADIUS": bearing.bore_radius,
        "SPEED_FLOOR": SMALLEST,
        "STATIC_SPEED": 0.0,
        "DYNAMIC_SPEED": 1.0,
        "BORE_FIRST": float(pin.bore == "first"),
        "BY_DEPTH": float(law.forgets),
        "FORGETS": float(law.forgets),
        "RENEWS": float(law.forgets or asks_for_mass(pin.contact)),
    }
    if isinstance(law, ElasticPower):
        found |= {"STIFFNESS": law.stiffness, "EXPONENT": law.exponent}
    if isinstance(law, PowerLaw):
        found["DAMPING_FACTOR"] = law.damping_factor
        if isinstance(law.damping_speed, ImpactVelocity):
            found["SPEED_FLOOR"] = law.damping_speed.floor
    if isinstance(friction, Ambrosio):
        found["SLIDING_COEFFICIENT"] = friction.sliding_coefficient
        found["STATIC_SPEED"] = friction.static_speed
        found["DYNAMIC_SPEED"] = friction.dynamic_speed
    return found


def segments(drive: Drive, duration: float) -> Matrix:
    """The drive between its breaks, one segment a row, see `layout`.

    Arguments:
        drive: Held, Steady, CubicStep, UniformSpeed, Reciprocating or TableDrive.
        duration: of the run [s].
    """
    inner = sorted({t for t in drive.breaks if 0.0 < t < duration})
    edges = [0.0, *inner, duration]
    rows = np.zeros((len(edges) - 1, layout.SEGMENT))
    rows[:, layout.WIDTH] = 1.0
    for row, begin, end in zip(rows, edges, edges[1:], strict=False):
        row[layout.BEGIN], row[layout.END] = begin, end
        row[layout.JUMP] = drive.speed_jump(begin)
        if isinstance(drive, Stroke):
            _fill(row, drive, 0.5 * (begin + end))
        elif isinstance(drive, TableDrive):
            row[TABLE] = drive.cubic(0.5 * (begin + end))
        elif isinstance(drive, Steady):
            row[layout.A1] = drive.rate
        elif isinstance(drive, Reciprocating):
            row[layout.AMPLITUDE], row[layout.FREQUENCY] = 0.5 * drive.stroke, drive.frequency
    return rows


def _fill(row: Vector, drive: Stroke, t: float) -> None:
    """Polynomial of the segment that time t [s] lies in."""
    if t >= drive.end:
        row[layout.A0] = drive.stroke
    elif t > drive.start:
        row[layout.ORIGIN], row[layout.WIDTH] = drive.start, drive.end - drive.start
        if isinstance(drive, UniformSpeed):
            row[layout.A1] = drive.stroke
        else:
            row[layout.A2], row[layout.A3] = 3.0 * drive.stroke, -2.0 * drive.stroke


def error_weights(
    reaches: tuple[float, float], mass: float, fall: float, clearance: float, tolerance: float
) -> Vector:
    """One over the largest error of a step, for each component of the state.

    `tolerance` times: the clearance, for the free coordinates; the speed of a fall through half of it, for
    their rates; the weight of all bodies times the clearance, for energies.

    Arguments:
        reaches: by how much the journal moves with the free coordinates [m/rad] or 1.
        mass: of all bodies [kg]. fall: acceleration of such a fall [m/s^2].
    """
    speed = max(math.sqrt(fall * clearance), SLOWEST)
    way = [reach / clearance / tolerance for reach in reaches]
    rate = [reach / speed / tolerance for reach in reaches]
    energy = 1.0 / (mass * speed**2 * tolerance)
    return np.array([*way, *rate, energy, energy, energy], dtype=np.float64)


MOST_IMPACTS = 100_000


@dataclass(frozen=True)
class RunArrays:
    """A run before it begins; y, memory, rows, onsets, jumps and report are filled by it, see `layout`.

    p: parameters. segments: of the drive. times: of the records [s]. weights: one over the largest error of a
    step, for each component of the state.
    """

    model: MachineModel
    pin: ClearancePin | None
    p: Vector
    segments: Matrix
    times: Vector
    weights: Vector
    y: Vector
    memory: Vector
    rows: Matrix
    onsets: Matrix
    jumps: Matrix
    report: Vector


def outline(scenario: Scenario) -> RunArrays:
    """The arrays of a scenario's run."""
    model = model_of(scenario)
    machine = scenario.machine
    pin = scenario.clearance_pins.get(model.PIN)
    y = np.zeros(layout.STATES)
    y[layout.FIRST], y[layout.SECOND] = np.add(
        model.start(machine), model.shifted(machine.linkage(), scenario.linkage)
    )
    memory = np.zeros(layout.ALL_MEMORY)
    if pin is not None and pin.contact.bearing.depth(math.hypot(*pin.eccentricity)) > 0.0:
        memory[layout.CLOSED] = 1.0  # pressed in from the start on; the journal does not move in its bore then
    times = record_times(scenario.duration, scenario.record_period)
    drive = segments(scenario.drive, scenario.duration)
    return RunArrays(
        model=model,
        pin=pin,
        p=parameters(scenario, model.parameters(machine), pin),
        segments=drive,
        times=times,
        weights=_weights(scenario, model, pin) if pin else np.zeros(layout.STATES),
        y=y,
        memory=memory,
        rows=np.zeros((layout.ROWS, times.size)),
        onsets=np.empty((MOST_IMPACTS if pin else 0, 4)),
        jumps=np.zeros((len(drive), layout.JUMP_ROW)),
        report=np.zeros(REPORT),
    )


def _weights(scenario: Scenario, model: MachineModel, pin: ClearancePin) -> Vector:
    machine = scenario.machine
    mass = sum(body.mass for body in machine.linkage().bodies.values())
    fall = float(np.hypot(*scenario.gravity)) + model.fall(machine, scenario.drive.initial_speed)
    clearance = pin.contact.bearing.clearance
    return error_weights(model.reaches(machine), mass, fall, clearance, scenario.solver.tolerance)
