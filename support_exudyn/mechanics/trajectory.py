"""What every formulation hands over of a run: motion and forces at the records, and what happened between."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.time_statistics import TimeStatistics
from user_forces.contact_state import Onset

Series = npt.NDArray[np.float64]


@dataclass(frozen=True)
class ContactSeries:
    """A clearance pin at the records, shape (n,) each, SI, ground's axes.

    force_x, force_y: of the bore on the journal [N]. eccentricity_x, eccentricity_y: journal's centre minus
    bore's [m]. impact_velocity: that the laws are told, 0 apart. stored: elastic energy [J]. deflection: state
    of the friction law [m], None if it has none. The others as in `user_forces.contact.ContactForce`.
    """

    force_x: Series
    force_y: Series
    normal_force: Series
    friction_force: Series
    depth: Series
    slip: Series
    impact_velocity: Series
    eccentricity_x: Series
    eccentricity_y: Series
    stored: Series
    deflection: Series | None = None


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
    """A hydraulic leg at the records: see `leg_channels` for what its values are.

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
class Trajectory:
    """A run at its records, for a linkage with b bodies.

    time (n,) [s]. position, velocity, acceleration (n, 3 b): x, y, turn of each body in the order of
    `Linkage.bodies`, positions from those at the start. ideal_pins: force of the first body on the second
    (n, 2) [N], by name. friction_moments: of ideal pins with friction, on the second body (n,) [N m].
    friction_forces: of ideal guides with friction, on the body along the guide (n,) [N].
    contacts: clearance pins by name. actuators: force (n,) [N] that pushes the ends apart.
    cranks: moment of the drive on the crank (n,) [N m]. slides: magnitude of force across and of moment (n, 2).
    oil_energy: stored in all actuators (n,) [J]. work: of the drive so far, damping_loss, friction_loss: so far
    (n,) [J]. loads: by name. legs: actuators on oil, by name. gears: on the second body (n,) [N m].
    """

    time: Series
    position: Series
    velocity: Series
    acceleration: Series
    ideal_pins: Mapping[str, Series]
    contacts: Mapping[str, ContactSeries]
    actuators: Mapping[str, Series]
    cranks: Mapping[str, Series]
    slides: Mapping[str, Series]
    oil_energy: Series
    work: Series
    damping_loss: Series
    friction_loss: Series
    friction_moments: Mapping[str, Series] = field(default_factory=dict)
    friction_forces: Mapping[str, Series] = field(default_factory=dict)
    loads: Mapping[str, LoadSeries] = field(default_factory=dict)
    legs: Mapping[str, LegSeries] = field(default_factory=dict)
    gears: Mapping[str, Series] = field(default_factory=dict)

    def contacts_of(self, pin: str) -> list[ContactSeries]:
        """Histories of the contacts of a clearance pin: in the plane one."""
        return [self.contacts[pin]]


class ObservedRun(Protocol):
    """A run that is known otherwise, such as one in space, from which its own recipes compute channels."""

    @property
    def time(self) -> Series:
        """Times of the records (n,) [s]."""
        ...

    def contacts_of(self, pin: str) -> list[ContactSeries]:
        """Histories of the contacts of a clearance pin, section by section."""
        ...


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


@dataclass(frozen=True)
class Outcome:
    """A finished run of a formulation.

    trajectory: at the records. onsets: for each clearance pin the beginnings of contact. largest_force: for
    each clearance pin the largest force [N] at any time. largest_force_time: when that is [s]; in the Exudyn
    formulation the end of the step that has it. impulses: where the speed of rigid actuators or cranks jumped.
    counts: what the solver did. oil_events: what happened in each hydraulic leg with elements. statistics: of
    all channels that the scenario asks for, from every step.
    """

    trajectory: Trajectory | ObservedRun
    onsets: Mapping[str, tuple[Onset, ...]]
    largest_force: Mapping[str, float]
    largest_force_time: Mapping[str, float]
    impulses: tuple[Impulse, ...]
    counts: Counts
    oil_events: Mapping[str, tuple[OilEvent, ...]] = field(default_factory=dict)
    statistics: TimeStatistics | None = None
