"""Where numbers stand in the arrays that compiled functions work on, and what the drive does by its numbers."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.compilation import inlined

# Parameters of a run: one vector of floats, SI. Points of canopy and rear link of a support are those of the
# reference posture, from the hinge I and from C.
(
    MACHINE,  # SUPPORT or SLIDER_CRANK
    FRONT_HEAD_X,  # E from I
    FRONT_HEAD_Y,
    REAR_HEAD_X,  # G from I
    REAR_HEAD_Y,
    CANOPY_X,  # centre of mass from I
    CANOPY_Y,
    FRONT_FOOT_X,  # F
    FRONT_FOOT_Y,
    REAR_FOOT_X,  # H
    REAR_FOOT_Y,
    FRONT_BASE_X,  # A
    FRONT_BASE_Y,
    REAR_BASE_X,  # B
    REAR_BASE_Y,
    FRONT_LENGTH,  # of the columns at the start
    REAR_LENGTH,
    SHIELD_LENGTH,  # of ID
    LINK_LENGTH,  # of AD
    HINGE_SIDE,  # +1 or -1: which of two intersections of circles
    SHIELD_SIDE,
    SHIELD_PIN_ALONG,  # C from I in parts of D - I and of the same turned by 90 degrees
    SHIELD_PIN_ACROSS,
    SHIELD_ALONG,  # the shield's centre of mass from I, likewise
    SHIELD_ACROSS,
    LINK_ALONG,  # the front link's centre of mass from A, in parts of D - A
    LINK_ACROSS,
    PIN_X,  # the rear link's end at B, from C
    PIN_Y,
    REAR_LINK_X,  # the rear link's centre of mass from C
    REAR_LINK_Y,
    CANOPY_MASS,
    CANOPY_INERTIA,
    SHIELD_MASS,
    SHIELD_INERTIA,
    FRONT_LINK_MASS,
    FRONT_LINK_INERTIA,
    REAR_LINK_MASS,
    REAR_LINK_INERTIA,
    CRANK_LENGTH,  # of a slider-crank; centres of mass are in the middle
    ROD_LENGTH,
    CRANK_MASS,
    CRANK_INERTIA,
    ROD_MASS,
    ROD_INERTIA,
    SLIDER_MASS,
    CRANK_ANGLE,  # at the start
    ROD_ANGLE,
    SLIDER_X,
    GRAVITY_X,
    GRAVITY_Y,
    CLEARANCE,
    BORE_RADIUS,
    STIFFNESS,
    EXPONENT,
    DAMPING_FACTOR,
    BY_DEPTH,  # 1: w = max(v0, sqrt(2E/m)); 0: w = max(v0, floor)
    SPEED_FLOOR,
    SLIDING_COEFFICIENT,
    STATIC_SPEED,
    DYNAMIC_SPEED,
    LAW,  # address of the compiled law, see `compiled.call_law`; 0: the family K depth^n by the numbers above
    RENEWS,  # 1: something changes where a contact is pressed on again without having separated,
    FORGETS,  # 1: the impact velocity, which becomes 0
    BORE_FIRST,  # 1: the pin's first body has the bore, see `Linkage.pins`; 0: the second
    PARAMETERS,  # how many there are; behind them the constants of a compiled law
) = range(66)

SUPPORT, SLIDER_CRANK = 0.0, 1.0

# A drive between two breaks: extension = A0 + A1 x + A2 x^2 + A3 x^3 + AMPLITUDE (1 - cos(FREQUENCY t)),
# x = (t - ORIGIN) / WIDTH; JUMP: of the speed at BEGIN
BEGIN, END, JUMP, ORIGIN, WIDTH, A0, A1, A2, A3, AMPLITUDE, FREQUENCY, SEGMENT = range(12)

# State: the two free coordinates, their rates, energy lost so far, work of the drive so far. Of a support the
# turns of canopy and rear link from the reference posture; of a slider-crank the turn of the rod and the way of
# the slider from the start.
FIRST, SECOND, FIRST_RATE, SECOND_RATE, DAMPING_LOSS, FRICTION_LOSS, WORK, STATES = range(8)
WEIGHED = WORK  # components before it count in the error of a step

# What a clearance pin remembers
CLOSED, IMPACT_VELOCITY, INVERSE_MASS_XX, INVERSE_MASS_XY, INVERSE_MASS_YY, MEMORY = range(6)
# and behind that, where since the last step the law has given what no force can be; ASKED_DEPTH 0: nowhere
ASKED_DEPTH, ASKED_RATE, ASKED_SLIP, ASKED_MASS, ALL_MEMORY = range(MEMORY, MEMORY + 5)

# State of the contact. DAMPING: power lost by it. PUSH: the law's 1 + chi rate / w, or a number of the same
# sign, below zero where tension is cut; 1 while the surfaces are apart. FORCE: of the bore on the journal.
# OFFSET: journal's centre from bore's. STORED: elastic energy, of the family.
DEPTH, RATE, SLIP, NORMAL, FRICTION, DAMPING, PUSH = range(7)
FORCE_X, FORCE_Y, JOURNAL_ARM, OFFSET_X, OFFSET_Y, STORED, CONTACT = range(7, 14)

# How near the linkage is to a dead centre: see `support_posture.dead_centre`
SINE, SWIFTNESS, NEARNESS = range(3)

# A record: one row each in an array of shape (ROWS, n)
TIME = 0
STATE_ROW = 1  # STATES rows
MEMORY_ROW = STATE_ROW + STATES  # MEMORY rows
EXTENSION = MEMORY_ROW + MEMORY  # of the drive
SPEED = EXTENSION + 1
ACCELERATION = SPEED + 1
ROWS = ACCELERATION + 1

# A jump of the drive's speed: time, impulse of front and rear column, energy given to the bodies
JUMP_TIME, FRONT_IMPULSE, REAR_IMPULSE, JUMP_ENERGY, JUMP_ROW = range(5)


Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]


class DriveValues(NamedTuple):
    """Extension [m] of actuators or turn [rad] of a crank, its speed and its acceleration."""

    extension: float
    speed: float
    acceleration: float


@inlined
def driven(segment: Vector, t: float) -> DriveValues:
    """What the drive does at time t [s] of a segment, see `layout`; also beyond its ends."""
    width = segment[WIDTH]
    x = (t - segment[ORIGIN]) / width
    a1, a2, a3 = segment[A1], segment[A2], segment[A3]
    extension = segment[A0] + x * (a1 + x * (a2 + x * a3))
    speed = (a1 + x * (2.0 * a2 + 3.0 * a3 * x)) / width
    acceleration = (2.0 * a2 + 6.0 * a3 * x) / (width * width)
    frequency = segment[FREQUENCY]
    if frequency != 0.0:  # of the segment: one branch for all times, and no cosine where none is needed
        amplitude = segment[AMPLITUDE]
        cosine, sine = math.cos(frequency * t), math.sin(frequency * t)
        extension = extension + amplitude * (1.0 - cosine)
        speed = speed + amplitude * frequency * sine
        acceleration = acceleration + amplitude * frequency * frequency * cosine
    return DriveValues(extension, speed, acceleration)
