"""The right-hand side, state in and its rate out, and a step by Dormand and Prince's method of order 5(4).

Source: Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19-26; the interpolation of order 4 is that of
Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.6.
"""

from support_exudyn.formulations.compilation import compiled, inlined
from support_exudyn.formulations.compiled.closed_forms import slider_crank, support
from support_exudyn.formulations.compiled.closed_forms.contact import (
    Balance,
    PinState,
    accelerations,
    closing_rates,
    contact_force,
    inverse_mass,
)
from support_exudyn.formulations.compiled.closed_forms.layout import (
    DAMPING,
    DAMPING_LOSS,
    FIRST,
    FIRST_RATE,
    FRICTION,
    FRICTION_LOSS,
    INVERSE_MASS_XX,
    INVERSE_MASS_XY,
    INVERSE_MASS_YY,
    MACHINE,
    SECOND,
    SECOND_RATE,
    SINE,
    SLIDER_CRANK,
    SLIP,
    STATES,
    SWIFTNESS,
    WEIGHED,
    WORK,
    DriveValues,
    Matrix,
    Vector,
    driven,
)

# one machine a module; compiled functions know each other by plain names
slider_crank_pin, slider_crank_law = slider_crank.pin_state, slider_crank.pin_and_law
slider_crank_power = slider_crank.power
support_pin, support_law, support_power = support.pin_state, support.pin_and_law, support.power
support_dead_centre, support_posture = support.dead_centre, support.posture_and_rates


@compiled
def pin_at(p: Vector, drive: DriveValues, y: Vector) -> PinState:
    """The clearance pin in the state y."""
    if p[MACHINE] == SLIDER_CRANK:
        return slider_crank_pin(p, drive, y)
    return support_pin(p, drive, y)


@compiled
def law_at(p: Vector, drive: DriveValues, y: Vector, weight: float) -> tuple[PinState, Balance]:
    """The clearance pin and the equations of motion; weight: 1, or 0 to leave gravity out."""
    if p[MACHINE] == SLIDER_CRANK:
        return slider_crank_law(p, drive, y, weight)
    at, rate = support_posture(p, drive, y)
    return support_law(p, drive, y, at, rate, weight)


@inlined
def evaluate(
    p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, slope: Vector, contact: Vector
) -> None:
    """Write the rate of the state y at time t [s] into `slope` and the contact into `contact`."""
    drive = driven(segment, t)
    if p[MACHINE] == SLIDER_CRANK:
        first, second, power = slider_crank_moves(p, drive, memory, y, contact)
    else:
        first, second, power = support_moves(p, drive, memory, y, contact)
    slope[FIRST], slope[SECOND] = y[FIRST_RATE], y[SECOND_RATE]
    slope[FIRST_RATE], slope[SECOND_RATE] = first, second
    slope[DAMPING_LOSS] = contact[DAMPING]
    slope[FRICTION_LOSS] = -contact[FRICTION] * contact[SLIP]
    slope[WORK] = power


@inlined
def slider_crank_moves(
    p: Vector, drive: DriveValues, memory: Vector, y: Vector, contact: Vector
) -> tuple[float, float, float]:
    """Accelerations of the free coordinates and power of the drive [W]; `contact` is written."""
    pin, law = slider_crank_law(p, drive, y, 1.0)
    contact_force(p, memory, pin, contact)
    first, second = accelerations(pin, law, contact)
    power = slider_crank_power(p, drive, y, first, contact) if drive.speed != 0.0 else 0.0
    return first, second, power


@inlined
def support_moves(
    p: Vector, drive: DriveValues, memory: Vector, y: Vector, contact: Vector
) -> tuple[float, float, float]:
    """Accelerations of the free coordinates and power of the drive [W]; `contact` is written."""
    at, rate = support_posture(p, drive, y)
    pin, law = support_law(p, drive, y, at, rate, 1.0)
    contact_force(p, memory, pin, contact)
    first, second = accelerations(pin, law, contact)
    power = support_power(p, drive, y, at, rate, first, second, contact) if drive.speed != 0.0 else 0.0
    return first, second, power


@compiled
def observe(p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, contact: Vector) -> None:
    """The contact alone, without accelerations."""
    contact_force(p, memory, pin_at(p, driven(segment, t), y), contact)


@compiled
def impact_velocity(p: Vector, segment: Vector, t: float, y: Vector, near: Vector) -> None:
    """Write into `near` how near the state y is to a dead centre, see `support_posture.dead_centre`."""
    near[SINE], near[SWIFTNESS] = 1.0, 0.0  # a slider-crank has none: its rod is longer than its crank
    if p[MACHINE] != SLIDER_CRANK:
        support_dead_centre(p, driven(segment, t), y, near)


@compiled
def freeze_inverse_mass(p: Vector, segment: Vector, memory: Vector, t: float, y: Vector) -> None:
    """Remember how easily the journal moves against the bore now, in the bore's axes."""
    pin, law = law_at(p, driven(segment, t), y, 0.0)
    memory[INVERSE_MASS_XX], memory[INVERSE_MASS_XY], memory[INVERSE_MASS_YY] = inverse_mass(pin, law)


@compiled
def move_with_the_drive(p: Vector, segment: Vector, t: float, y: Vector) -> None:
    """Give the state y the rates with which the journal does not move against the bore."""
    drive = driven(segment, t)
    y[FIRST_RATE] = y[SECOND_RATE] = 0.0
    pin = pin_at(p, drive, y)
    y[FIRST_RATE], y[SECOND_RATE] = closing_rates(pin, pin.vx, pin.vy)


STAGES = 7
FREE = DAMPING_LOSS  # components before the energies lost, on which no rate depends

C2, C3, C4, C5 = 1 / 5, 3 / 10, 4 / 5, 8 / 9
A21 = 1 / 5
A31, A32 = 3 / 40, 9 / 40
A41, A42, A43 = 44 / 45, -56 / 15, 32 / 9
A51, A52, A53, A54 = 19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729
A61, A62, A63, A64, A65 = 9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656
B1, B3, B4, B5, B6 = 35 / 384, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84
# difference to the result of fourth order
E1, E3, E4, E5, E6, E7 = 71 / 57600, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40
# of the interpolation
D1, D3, D4 = -12715105075 / 11282082432, 87487479700 / 32700410799, -10690763975 / 1880347072
D5, D6, D7 = 701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423


@compiled
def advance(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    y: Vector,
    k: Matrix,
    end: Vector,
    contact: Vector,
    weights: Vector,
) -> float:
    """Try a step of h [s] from t with k[0] the rate there; its error in units of what is allowed.

    Writes the state at the end into `end`, its rate into k[6] and the contact there into `contact`.
    """
    for i in range(FREE):
        end[i] = y[i] + h * A21 * k[0, i]
    evaluate(p, segment, memory, t + C2 * h, end, k[1], contact)
    for i in range(FREE):
        end[i] = y[i] + h * (A31 * k[0, i] + A32 * k[1, i])
    evaluate(p, segment, memory, t + C3 * h, end, k[2], contact)
    for i in range(FREE):
        end[i] = y[i] + h * (A41 * k[0, i] + A42 * k[1, i] + A43 * k[2, i])
    evaluate(p, segment, memory, t + C4 * h, end, k[3], contact)
    for i in range(FREE):
        end[i] = y[i] + h * (A51 * k[0, i] + A52 * k[1, i] + A53 * k[2, i] + A54 * k[3, i])
    evaluate(p, segment, memory, t + C5 * h, end, k[4], contact)
    for i in range(FREE):
        end[i] = y[i] + h * (A61 * k[0, i] + A62 * k[1, i] + A63 * k[2, i] + A64 * k[3, i] + A65 * k[4, i])
    evaluate(p, segment, memory, t + h, end, k[5], contact)
    for i in range(STATES):
        end[i] = y[i] + h * (B1 * k[0, i] + B3 * k[2, i] + B4 * k[3, i] + B5 * k[4, i] + B6 * k[5, i])
    evaluate(p, segment, memory, t + h, end, k[6], contact)
    square = 0.0
    for i in range(WEIGHED):
        wrong = E1 * k[0, i] + E3 * k[2, i] + E4 * k[3, i] + E5 * k[4, i] + E6 * k[5, i] + E7 * k[6, i]
        part = h * wrong * weights[i]
        square += part * part
    return float((square / WEIGHED) ** 0.5)


@compiled
def fit(h: float, y: Vector, end: Vector, k: Matrix, path: Matrix) -> None:
    """Write the coefficients of the interpolation over a step of h [s] into `path`, shape (5, STATES)."""
    for i in range(STATES):
        change = end[i] - y[i]
        bend = h * k[0, i] - change
        path[0, i] = y[i]
        path[1, i] = change
        path[2, i] = bend
        path[3, i] = change - h * k[6, i] - bend
        path[4, i] = h * (
            D1 * k[0, i] + D3 * k[2, i] + D4 * k[3, i] + D5 * k[4, i] + D6 * k[5, i] + D7 * k[6, i]
        )


@compiled
def within(path: Matrix, x: float, out: Vector) -> None:
    """Write the state at a fraction x of the step, 0 to 1, into `out`."""
    z = 1.0 - x
    for i in range(STATES):
        out[i] = path[0, i] + x * (path[1, i] + z * (path[2, i] + x * (path[3, i] + z * path[4, i])))
