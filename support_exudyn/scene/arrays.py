"""A scene as arrays of records, on which compiled functions work: one a body, point, joint, contact, force.

Every record has what is known before the run, and behind it what is computed at an instant. Numbers of bodies
are -1 for the ground, of points and courses -1 for none. The state y of a scene with b bodies is

    y = [x, y, turn of each body | their rates | states of friction laws, legs | losses, work]

with positions from those at the start.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.scene.hydraulics.records import LegArrays, record_of

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]
Whole = npt.NDArray[np.int64]
Records = npt.NDArray[np.void]


# lightness: one over mass and inertia; of the latter that which stands in for a point mass's, 0 else; weight;
# centre of mass at the start | direction, force, moment, acceleration, moment that gives back what stands in
BODY = record_of("", "light light_turn stand_in weight_x weight_y x0 y0 c s fx fy m ax ay a given")
# arm: from the centre of mass at the start, of the ground the place itself | arm now, place, velocity
POINT = record_of("body", "arm_x arm_y rx ry x y vx vy")
# a time course: its pieces in the segment; still: for a record before it begins, at a break at 0 s | its jump
# of the rate then; its value, and both derivatives
COURSE = record_of("low high still", "jump value rate bend")
PIECE = record_of("", "begin half")
# kinds: see PIN and so on. ratio: of a gear. length, angle: at the start
JOINT = record_of("kind row first second course conditions", "length angle ratio")
PIN, ACTUATOR, CRANK, SLIDE, GEAR = range(5)
# two bodies, the carrier of a gear, and what its rate takes of their rates; first: of the row in the factors |
# what C a has to be, multiplier, what is left of the position, and the rate that it has to have
ROW = record_of("body other carrier first", "x y t ox oy ot carrier_x carrier_y carrier_t wanted held off rate")
# rows that share a body, i >= j, and the places in `row_numbers` of what each takes of it. Indices without a
# sign: numba asks of all others whether they are negative
PAIR = np.dtype([(name, np.uint64) for name in ("i", "j", "body", "one", "two")])
# journal `second` in bore `first`, both points. slot: corner between walls, or ONE_SIDED of one wall alone.
# law: address of both laws, with constants from `constants` on. state: of the friction law in y.
# radius: of the bore, or of a pin in a slot. angle: of a slot at the start. | closed, impact velocity: what it
# remembers. Then the contact now, the largest force and its time, where the law last gave no possible force.
ONE_SIDED = 2
CONTACT = record_of(
    "first second slot constants state",
    "law clearance radius angle arm closed impact_velocity "
    "depth rate slip normal friction damping push x y vx vy nx ny fx fy "
    "largest largest_at asked_depth asked_rate asked_slip asked_deflection",
)
# a force on point `point` against `origin`, a moment on their bodies, or forces up on both, with the heights
# of these at the start; the first of its own courses, and how many; from which places of out on its action
# takes their values, `first`, and gives its powers
FORCE, MOMENT, STRETCH = range(3)
LOAD = record_of(
    "point origin kind constants course courses first powers", "law point_y origin_y fx fy work loss"
)
# friction of an ideal pin (BOLT) or guide (GUIDED; BLOCK with a moment); row: the first of the joint; state: of
# the friction law in y | direction and speed along a guide, slip, arm of the friction force, the force and its
# moment, by how much the last round changed it
BOLT, GUIDED, BLOCK = range(3)
RUBBING = record_of(
    "kind row body other first second constants state",
    "law radius half_length half_height angle ax ay speed slip lever force moment left",
)


class SceneArrays(NamedTuple):
    """All that an evaluation of the equations of motion takes. square: C M^-1 C^T and its factors.

    row_numbers: all that stands in the rows, as one vector.
    repeats: of each row that repeats others, the multipliers of all that cancel each other, (repeats, rows).
    counts: factor of each row [m], see `Kinetics.counts`. spare: a number a row. rounds: in which multipliers
    and accelerations are solved for, at most, see `motion.refine`.
    legs: None without any. Compiled code that is for legs then has nothing to do by the type of the scene, and
    is not compiled before a scene has legs.
    """

    bodies: Records
    points: Records
    courses: Records
    pieces: Records
    coefficients: Matrix
    joints: Records
    rows: Records
    row_numbers: Vector
    pairs: Records
    square: Matrix
    repeats: Matrix
    counts: Vector
    spare: Vector
    rounds: int
    contacts: Records
    legs: LegArrays | None
    loads: Records
    rubbing: Records
    constants: Vector
    out: Vector


class Scratch(NamedTuple):
    """What a run works on and keeps.

    right, impulses: a number a row. end, probe, slope, along: states; see `stabilised`. path: of the
    interpolation. rates: of a step's stages. now, then: contacts at its start and end.
    going, report: one record each, see `GOING` and `REPORT`.
    weights: one over the largest error of a step, for each component of the state.
    times: of the records [s], from 0; rows: the records. forces: whether these need accelerations and what
    joints carry.
    nodes: of the steps since the last pause, four each, with room for all until the next and one row more.
    onsets: of impacts. oil_events: of legs: time, gap and side of each.
    """

    right: Vector
    impulses: Vector
    end: Vector
    probe: Vector
    slope: Vector
    along: Vector
    path: Matrix
    rates: Matrix
    now: Records
    then: Records
    going: Records
    report: Records
    weights: Vector
    times: Vector
    rows: Matrix
    forces: bool
    nodes: Matrix
    onsets: Matrix
    oil_events: Matrix


def leg_arrays(legs: LegArrays) -> LegArrays | None:
    """Legs as a run changes them; None without legs."""
    return legs.copies() if legs.records.size else None


STAGES = 7  # of a step
MOST_OIL_EVENTS = 100_000

# what the next step needs: whether a run is in the midst of a segment, time, next step, last error; the fastest
# decay, above 0 while steps are stabilised; the explicit step before these; steps since it was looked for; how
# many steps have lately been cut where a law begins or ceases to ask for tension, and for how many more none is
GOING = record_of("", "midst at next_step last_error decay explicit_step stiff_steps cut_steps uncut")
# what a run counts and where it stopped
REPORT = record_of(
    "",
    "steps evaluations accepted cuts clamped impacts jump_energy records stopped_at last_step not_a_number "
    "stiff oil_events nodes",
)
FINISHED, STUCK, TOO_MANY_STEPS, TOO_MANY_IMPACTS, DEAD_CENTRE, PAUSED, TOO_MANY_OIL_EVENTS = range(7)
LOSSES = 3  # last components of the state: damping, friction, and the work of what drives
DAMPING_LOSS, FRICTION_LOSS, WORK = -3, -2, -1

# what a record keeps of a contact besides the state, see `ContactSeries`
CONTACT_PARTS = (
    *("force_x", "force_y", "normal_force", "friction_force", "depth", "slip"),
    *("impact_velocity", "eccentricity_x", "eccentricity_y"),
)
CONTACT_NUMBERS = len(CONTACT_PARTS)
