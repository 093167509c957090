"""What every formulation hands over: series of parts at the records, and what happened between."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from user_forces.contact import Contact

Series = npt.NDArray[np.float64]


@dataclass(frozen=True)
class ContactSeries:
    """A clearance pin at the records, shape (n,) each, SI, ground's axes.

    force_x, force_y: of the bore on the journal [N]. eccentricity_x, eccentricity_y: journal's centre minus
    bore's [m]. impact_velocity: used by the laws, 0 during separation. deflection: state of the friction law
    [m], None if it has none. The others as in `user_forces.contact.ContactForce`.
    """

    contact: Contact
    force_x: Series
    force_y: Series
    normal_force: Series
    friction_force: Series
    depth: Series
    slip: Series
    impact_velocity: Series
    eccentricity_x: Series
    eccentricity_y: Series
    deflection: Series | None = None

    @cached_property
    def stored(self) -> Series:
        """Elastic energy (n,) [J]."""
        return self.contact.energies(self.depth)


@dataclass(frozen=True)
class LoadSeries:
    """A load at the records.

    forces: as its action gives them (n, k) [N], [N m]. stored: energy (n,) [J]. observed: values of its
    channels (n,), by name.
    """

    forces: Series
    stored: Series
    observed: Mapping[str, Series]


@dataclass(frozen=True)
class LegSeries:
    """A hydraulic leg at the records: see `hydraulic_legs` for what its values are.

    force: that pushes the ends apart (n,) [N]. energy: stored (n,) [J]. values: (n,) each, by name.
    """

    force: Series
    energy: Series
    values: Mapping[str, Series]


class OilEvent(NamedTuple):
    """Something that happened in a leg: when [s], what, and whether it began or ended then."""

    time: float
    what: str
    begins: bool


@dataclass(frozen=True)
class Counts:
    """What the solver of a run did.

    steps: accepted; cut_steps: repeated shorter to land on an impact; newton_iterations, jacobians: of an
    implicit solver; evaluations: of the equations of motion by an explicit one; user_function_calls:
    evaluations of contact forces in Python; failed_newton: steps repeated because Newton's method did not
    converge; clamped_steps: steps at whose end a law asked for tension.
    """

    steps: int = 0
    cut_steps: int = 0
    newton_iterations: int = 0
    jacobians: int = 0
    evaluations: int = 0
    user_function_calls: int = 0
    failed_newton: int = 0
    clamped_steps: int = 0


@dataclass(frozen=True)
class Impulse:
    """A jump of velocities at an instant.

    time: [s]. actuators: impulse of each rigid actuator [N s], positive in compression. energy: given to the
    bodies by it [J]. cranks: angular impulse on each crank [N m s]. joints: magnitudes of the impulses of ideal
    pins and guides [N s], by what the name of their force begins with, such as pin.rear_base.
    """

    time: float
    actuators: dict[str, float]
    energy: float
    cranks: dict[str, float] = field(default_factory=dict)
    joints: dict[str, float] = field(default_factory=dict)
