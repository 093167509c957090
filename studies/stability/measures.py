"""Growth rate and frequency of a small motion from two runs; and whether they are as predicted."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from studies.common.numbers import Number
from studies.stability.cases import Prepared, run_name
from support_exudyn import Result

Array = npt.NDArray[np.float64]

DELAY = 8  # part of a run after which a motion is compared with itself
RESOLVED = 5e-3  # growth rate as a share of the angular frequency that counts at least: 3 % in a swing
ALIKE = 0.1  # of the growth rate, or of what counts at least


@dataclass(frozen=True)
class Growth:
    """Predicted and measured growth of a case.

    predicted, measured: growth rates [1/s]. halved: the measured one at half the steps. frequencies [Hz].
    painleve: whether the normal mobility is negative. moved: largest motion normal to the wall over the depth.
    """

    case: str
    pin: str
    stiffness: str
    friction: float
    predicted: float
    measured: float
    halved: float
    frequency_predicted: float
    frequency_measured: float
    painleve: bool
    moved: float

    @property
    def scale(self) -> float:
        """The size by which a difference of growth rates is judged [1/s]."""
        return max(abs(self.predicted), RESOLVED * 2.0 * math.pi * self.frequency_predicted)

    @property
    def off(self) -> float:
        """Distance of measured from predicted growth rate as a share of the scale [-]."""
        return abs(self.halved - self.predicted) / self.scale

    @property
    def by_steps(self) -> float:
        """What half the steps change, as a share of the scale [-]."""
        return abs(self.halved - self.measured) / self.scale


def roots(time: Array, motion: Array) -> npt.NDArray[np.complex128]:
    """Roots of a motion that is a sum of four exponentials, (4,) [1/s], the fastest growing first.

    Two coordinates now and a delay ago tell those a delay later, by a matrix that least squares find; the roots
    are the logarithms of its eigenvalues over the delay. Each time counts alike, however far the motion has
    grown.

    Arguments:
        time: evenly (n,) [s].
        motion: two coordinates (n, 2).

    Source: Hua and Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38 (1990) 814-824, the matrix pencil.
    """
    delay = len(time) // DELAY
    count = len(time) - 2 * delay
    before = np.hstack([motion[:count], motion[delay : delay + count]])
    after = np.hstack([motion[delay : delay + count], motion[2 * delay : 2 * delay + count]])
    weight = 1.0 / np.linalg.norm(before, axis=1)[:, None]
    forward = np.linalg.lstsq(before * weight, after * weight, rcond=None)[0]
    found = np.log(np.linalg.eigvals(forward).astype(complex)) / (delay * (time[1] - time[0]))
    ordered: npt.NDArray[np.complex128] = found[np.argsort(-found.real)]
    return ordered


def fastest(found: npt.NDArray[np.complex128]) -> complex:
    """Of the roots the vibration that grows fastest, or decays slowest."""
    return complex(next(root for root in found if abs(root.imag) > 0.0))


def growth(one: Prepared, runs: Mapping[str, Result]) -> Growth:
    """The growth of a case in its runs."""
    case = one.case
    measured = [fastest(_roots_of(one, runs, fine=fine)) for fine in (False, True)]
    depth = runs[run_name(case.name, 0, fine=True)][f"pin.{case.pin}.depth"]
    return Growth(
        case=case.name,
        pin=case.pin,
        stiffness=case.stiffness,
        friction=case.friction,
        predicted=one.predicted.growth,
        measured=measured[0].real,
        halved=measured[1].real,
        frequency_predicted=one.predicted.frequency,
        frequency_measured=abs(measured[1].imag) / (2.0 * math.pi),
        painleve=one.predicted.normal_mobility < 0.0,
        moved=float(np.ptp(depth)) / one.depth,
    )


def difference(one: Prepared, runs: Mapping[str, Result], *, fine: bool) -> tuple[Array, Array]:
    """Times (n,) [s] and the difference of both runs of a case (n, 2) [m]."""
    pin = one.case.pin
    both = [runs[run_name(one.case.name, side, fine=fine)] for side in (0, 1)]
    places = [
        np.column_stack([run[f"pin.{pin}.eccentricity_x"], run[f"pin.{pin}.eccentricity_y"]]) for run in both
    ]
    return both[0].time, places[0] - places[1]


def _roots_of(one: Prepared, runs: Mapping[str, Result], *, fine: bool) -> npt.NDArray[np.complex128]:
    return roots(*difference(one, runs, fine=fine))


def numbers(found: Sequence[Growth]) -> list[Number]:
    """All numbers of the study; what is predicted has the error of a closed form."""
    told = []
    for one in found:
        told += [
            Number("predicted_growth_rate", one.case, one.predicted, "1/s", 0.0),
            Number("growth_rate", one.case, one.halved, "1/s", abs(one.halved - one.measured)),
            Number("predicted_frequency", one.case, one.frequency_predicted, "Hz", 0.0),
            Number("frequency", one.case, one.frequency_measured, "Hz", 0.0),
        ]
    return told
