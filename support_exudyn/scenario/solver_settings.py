"""Settings of the time integration."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from user_forces.values.value import Fraction, Real, Value, Whole, value

ERROR_CONTROLLED = ("compiled",)  # formulations that choose their steps by a tolerance
SMALLEST_TOLERANCE = 1e-13  # rounding
MOST_IMPACT_STEPS = 10000
MOST_SECTIONS = 64
MOST_STEPS = 5_000_000  # some minutes of the Exudyn formulation
REFINED_TOLERANCE = 3  # power of the refinement by which the tolerance falls
# keys of earlier versions: the value that all runs have now, which needs no note, and why there is no other
REMOVED = {
    "backend": ("auto", "laws are compiled functions in both formulations"),
    "integrator": ("generalised_alpha", "the engine integrates by generalised alpha"),
    "constraint_index": (3, "constraints hold the positions"),
    "locate": (True, "steps always end at impacts and separations"),
}


@value
class SolverSettings(Value):
    """Settings of the time integration; all but `tolerance` are of the Exudyn formulation.

    Arguments:
        spectral_radius: rho at infinite frequency, from 0 (all high-frequency content damped out in a
            step) to 1 (none). At 0.5 the joint forces are quiet at small steps; at 0.9 rounding
            shows in them below a step of 0.2 ms.
        newton_tolerance: relative tolerance of Newton's residual, > 0.
        newton: "modified", which keeps a Jacobian as long as it serves, or "full", a new one each iteration.
        impact_steps: how many steps an impact takes at least, from the impact to the separation of an undamped
            one of the same speed; 16 to 10000. Steps are so short from the impact until the surfaces part, or
            until the depth swings little any more. Errors are of second order; 512 delivers any
            restitution within 1e-5.
        growth: by what factor steps may grow beyond `step`, from 1 to 64, while clearance pins are closed,
            nothing is in an impact and accelerations hardly change. Records that a step passes over are
            interpolated. 16 saves nine tenths of the steps with ideal pins, a third with one with clearance
            that comes to rest, few with one that vibrates; errors stay those of `step` where impacts decide.
            Under loads none grows.
        tolerance: of the compiled formulation, from 1e-13 to 1e-2: the error of a step, as a share of the
            smallest clearance for places, and of the speed of a fall through half of it for velocities; the
            root mean square over all of them. 1e-5 is enough for most.
        sections: in how many places along its axis the contact of a clearance pin is evaluated in space, 2 to
            64, the edges among them. Where a pin is not tilted any number gives the same; a tilted one on oil
            actuators driven unequally by 2 % is right to 2 % with 5 and to 4e-4 with 9.
        most_steps: after how many steps, repeated ones among them, a run is given up, from 1 to 1e12.
        result_checks: whether a run is refused whose energy does not add up by 5 % of what was turned over,
            whose joints come apart by 0.1 mm, or whose journals are deeper in their bores than a fifth of the
            radius; and one in which a law, load or drive gives no number, or gives energy where it should lose
            some. It looks at everything, whatever is recorded.
    """

    spectral_radius: Fraction = 0.5
    newton_tolerance: Annotated[Real, Field(gt=0, le=1e-3)] = 1e-8
    newton: Literal["modified", "full"] = "modified"
    impact_steps: Annotated[Whole, Field(ge=16, le=MOST_IMPACT_STEPS)] = 512
    growth: Annotated[Real, Field(ge=1, le=64)] = 1.0
    tolerance: Annotated[Real, Field(ge=1e-13, le=1e-2)] = 1e-7
    sections: Annotated[Whole, Field(ge=2, le=MOST_SECTIONS)] = 5
    most_steps: Annotated[Whole, Field(ge=1, le=10**12)] = MOST_STEPS
    result_checks: Annotated[bool, Field(strict=True)] = True

    @classmethod
    def of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        """The fields without those of earlier versions."""
        for key, (only, reason) in REMOVED.items():
            if given.get(key, only) != only:
                warnings.warn(f"solver.{key} = {given[key]!r} has no effect any more: {reason}", stacklevel=2)
        return {key: item for key, item in given.items() if key not in REMOVED}
