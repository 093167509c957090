"""One step of Dormand and Prince's method of order 5(4), and the state within it.

Source: Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19-26; the interpolation of order 4 is that of
Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.6.
"""

from __future__ import annotations

from support_exudyn.formulations.compiled import compiled
from support_exudyn.formulations.reduced.drive import Matrix, Vector
from support_exudyn.formulations.reduced.equations import evaluate
from support_exudyn.formulations.reduced.layout import DAMPING_LOSS, STATES, WEIGHED

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
