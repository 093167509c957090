"""Legs and the pump as records of numbers, on which compiled functions work, and their states.

A leg with all elements has these states; what it does not have takes none, so that a plain column has none:

    oil of the piston side | of the rod side | in the tube, the tube's way and speed | of the line |
    poppet's s and its rate | integrals of flows and losses

Oil is counted as a pressure: state = (W - W at the start) / scale, scale = V at the start / B, so that it is of
the size of what it changes. W is the volume that the oil has without pressure.
"""

import numpy as np
import numpy.typing as npt

F, N = np.float64, np.int64
Records = npt.NDArray[np.void]
Matrix = npt.NDArray[np.float64]


LOG, LINEAR = range(2)  # laws of the oil
# integrals over time: what each element has taken [J], and the oil that has left through relief valves, and
# come in by the inlet [m^3]
(
    VALVE_LOSS,
    YIELD_LOSS,
    LINE_LOSS,
    SEAL_LOSS,
    STOP_LOSS,
    STAGE_LOSS,
    VISCOUS_LOSS,
    YIELDED,
    RELIEVED,
    LET_IN,
    INTEGRALS,
) = range(11)


def _record(whole: str, numbers: str, places: int = 0) -> np.dtype[np.void]:
    fields = [(name, N) for name in whole.split()] + [(name, F) for name in numbers.split()]
    return np.dtype([*fields, *([("integrals", N, (places,))] if places else [])])


# Whole: ends, course of inlet or drive; law of the oil; places of states in y, -1 for none; driven: a drive
# lets the oil in; check: a check valve is there; hysteresis of both relief valves.
# Then: what is known before the run, what relief valves remember, what is told and follows at an instant; last
# the places of the integrals, -1 for none
LEG = _record(
    "foot head course law state rod stage line poppet driven check jumps rod_jumps",
    # oil and chambers
    "length0 modulus vapour air air_exponent "
    "bore oil_length hose oil0 scale rod_area rod_length rod_hose rod_oil0 rod_scale "
    "bore2 oil_length2 oil02 scale2 rod_area2 rod_length2 "
    "tube_mass tube_damping foot_factor foot_smooth release "
    "line_volume line_oil0 line_scale line_resistance "
    # inlet, check valve, relief valves
    "supply tank flow_factor smooth pilot_ratio pilot_range cracking "
    "opens closes slope rod_opens rod_closes rod_slope poppet_rate poppet_decay "
    # seals and stops
    "damping coulomb static stribeck transition "
    "lowest highest stop stop_damping lowest2 highest2 stop2 stop_damping2 "
    # memory
    "open rod_open "
    # what is told at an instant: the actuator's length, extension let in by a drive, and their rates; the inlet
    "length rate inflow inflow_rate opening "
    # what follows
    "force work loss friction drawn pressure rod_pressure pressure2 line_pressure "
    "oil volume rod_oil rod_volume oil2 volume2 line_oil reference stopped kinetic "
    "flow rod_flow yield_flow relief_flow cavity rod_cavity cavity2 line_cavity "
    # direction from foot to head in the plane; what is put aside while gaps are differenced
    "ux uy kept_length kept_inflow",
    INTEGRALS,
)
# the pump, with the places of its line's oil and of what it has given
PUMP = _record("state", "flow pressure range volume modulus oil0 scale now given work")

# what passes zero where something happens
(
    CAVITY,
    ROD_CAVITY,
    CAVITY_2,
    LINE_CAVITY,
    YIELD,
    RELIEF,
    LOW,
    HIGH,
    LOW_2,
    HIGH_2,
    CHECK,
    GAPS,
) = range(12)
# what each is called, and begins where its gap becomes positive; a cavity is there while its gap is negative
GAP_NAMES = (
    "piston side filled",
    "rod side filled",
    "tube filled",
    "line filled",
    "yield valve open",
    "rod relief open",
    "lower stop met",
    "upper stop met",
    "lower stop of the tube met",
    "upper stop of the tube met",
    "check valve open",
)
