"""Where numbers stand in the arrays that compiled functions work on."""

from __future__ import annotations

# Parameters of a run: one vector of floats, SI. Points of canopy and rear link are those of the reference
# posture, from the hinge I and from C.
(
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
    JOURNAL_ON_LINK,  # 1: bore in the base; 0: bore in the rear link
    PARAMETERS,  # how many there are
) = range(52)

# A drive between two breaks: extension = A0 + A1 x + A2 x^2 + A3 x^3, x = (t - ORIGIN) / WIDTH
BEGIN, END, JUMP, ORIGIN, WIDTH, A0, A1, A2, A3, SEGMENT = range(10)  # JUMP: of the speed at BEGIN

# State: turns of canopy and rear link from the reference posture, their rates, energy lost so far
CANOPY, LINK, CANOPY_RATE, LINK_RATE, DAMPING_LOSS, FRICTION_LOSS, STATES = range(7)

# What a clearance pin remembers
TOUCHING, TOUCH_SPEED, MOBILITY_XX, MOBILITY_XY, MOBILITY_YY, MEMORY = range(6)

# State of the contact. DAMPING: power lost by it. PUSH: the law's 1 + chi rate / w, below zero where tension is
# cut; 1 while the surfaces are apart. FORCE: of the base on the rear link. MOMENT: about the link's pin centre.
DEPTH, RATE, SLIP, NORMAL, FRICTION, DAMPING, PUSH = range(7)
FORCE_X, FORCE_Y, MOMENT, OFFSET_X, OFFSET_Y, CONTACT = range(7, 13)

# How near the linkage is to a dead centre: see `posture.dead_centre`
SINE, SWIFTNESS, NEARNESS = range(3)

# A record: one row each in an array of shape (ROWS, n)
TIME = 0
STATE_ROW = 1  # six rows
CANOPY_ACCELERATION = STATE_ROW + STATES
LINK_ACCELERATION = CANOPY_ACCELERATION + 1
CONTACT_ROW = LINK_ACCELERATION + 1
TOUCH_SPEED_ROW = CONTACT_ROW + CONTACT
HINGE_X = TOUCH_SPEED_ROW + 1
HINGE_Y = HINGE_X + 1
FRONT_FORCE = HINGE_Y + 1
REAR_FORCE = FRONT_FORCE + 1
EXTENSION = REAR_FORCE + 1
ROWS = EXTENSION + 1

# A jump of the drive's speed: time, impulse of front and rear column, energy given to the bodies
JUMP_TIME, FRONT_IMPULSE, REAR_IMPULSE, JUMP_ENERGY, JUMP_ROW = range(5)
