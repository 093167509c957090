"""Legs as records of numbers, on which compiled functions work: legs, chambers, valves, gaps, the pump.

A chamber, or a source of constant pressure, is a record of its own, and so is each valve between two of them.
The records of a leg follow each other, and so do its states in y. Oil is counted as a pressure:

    state = (W - W at the start) / scale,   scale = V at the start / B

so that it is of the size of what it changes. W is the volume that the oil has without pressure. Places of
states and of integrals over time are -1 for none.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

F, N = np.float64, np.int64
Records = npt.NDArray[np.void]
Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]

LOG, LINEAR, CONSTANT = range(3)  # laws of the oil; CONSTANT: of a source


def record_of(whole: str, numbers: str, pairs: str = "") -> np.dtype[np.void]:
    """A record of whole numbers, numbers, and pairs of numbers, by names with spaces between them."""
    fields = [(name, N) for name in whole.split()] + [(name, F) for name in numbers.split()]
    return np.dtype([*fields, *((name, F, (2,)) for name in pairs.split())])


# Ends, course of inlet or drive; driven: a drive lets the oil in. From which chamber, valve and state to which
# its own stand. stage: place of the tube's way, behind which its speed stands. Places of integrals.
# Known before the run | the actuator's length, extension let in by a drive, their rates, the opening of the
# inlet | what follows: travel of the outer stage and its rate; pilot: the pressure that the inlet has for the
# rod side; direction from foot to head | stops of both stages
LEG = record_of(
    "foot head course driven chamber chambers valve valves first states stage supply tank "
    "viscous_loss seal_loss stop_loss stage_loss",
    "bore length0 damping coulomb static stribeck transition tube_mass tube_damping "
    "length rate inflow inflow_rate opening "
    "travel travel_rate pilot force work loss friction stopped kinetic ux uy kept_length kept_inflow",
    "lowest highest stop stop_damping",
)
# law: of the oil. room: its volume at the start, that grows by travel of the outer stage and length of the leg.
# reference: V_ref of a linear law. fed, grown: growth of oil and of V_ref by what a drive lets in. weight,
# enthalpy: see `fill_chamber`; 1 and 0 of sources
CHAMBER = record_of(
    "law state source",
    "modulus vapour air air_exponent oil0 scale room by_travel by_length reference fed grown "
    "oil volume span pressure cavity weight enthalpy",
)
# chambers before it, the same while the opening of the inlet is negative, and behind it; its states; integrals
# of the oil that has passed and of losses; law: address of its action, with parameters from `constants` on.
# jumps: its flow depends on its memory. joins: both chambers have the same pressure at rest
VALVE = record_of("before back after state states passed loss constants jumps joins", "law memory flow")
# the pump; its line is a chamber. given: place of what it has given
PUMP = record_of("chamber given", "flow pressure range now work")
# what passes zero where something happens: of all chambers, of all valves, then four of the stops of each leg.
# valve: -1 of others. near: how near to zero it is met. rest: the side on which it is then at the start of a
# run. now, and before, at the start of the step; side: of zero on which it is, 0 for a gap that is not there;
# beyond: how far it has been on the other side within the step
GAP = record_of("leg valve", "near rest now before side beyond rate rate_before")
STOPS = 4
# first of all numbers is the room of the actions of valves: memory, then gap; states, then their rates; rest
MEMORY, STATES = 0, 1


class LegArrays(NamedTuple):
    """Hydraulic legs, and their pump if they have one; numbers: room of actions, and behind it parameters."""

    records: Records
    chambers: Records
    valves: Records
    pumps: Records
    gaps: Records
    numbers: Vector

    def copies(self) -> "LegArrays":
        """Return a copy in which a run may change all arrays."""
        parts: list[Any] = [part.copy() for part in self]
        return LegArrays(*parts)
