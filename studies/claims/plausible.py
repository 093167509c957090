"""Machines that could be the paper's, and machines as an engineer would build them: two hypercubes.

Both draw the data that the paper does not print, see factors.toml. Machines of the first have all that is
printed: the contact by Eq. 5, the rise of 500 mm in 2 s. The second repeats the first with the contact along
the pin's length, heavier bodies and other times. A sample gives a value to every datum; machine, pin and drive
follow.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from studies.common import paper_machine
from studies.common.data import tables
from studies.contact_laws.catalogue import POWER_LAWS
from support_exudyn import (
    ClearancePin,
    HydraulicSupport,
    IdealPin,
    OilColumn,
    Part,
    bore_area,
    reference_support,
)
from support_exudyn.machines.four_column_support import PIVOTS
from user_forces import Ambrosio, JournalContact
from user_forces.values.value import InputError, Vector2

Choice = str | float
Sample = Mapping[str, Any]  # a value of every datum, by name

REFERENCE_SCALE = 0.65  # of the support whose pivots the reference support has
CONTACT = "contact"  # the datum by which both hypercubes differ: as printed, along the length
LOT = 40  # machines that are drawn together: each range is cut into as many parts, with a machine in each


@dataclass(frozen=True)
class Factor:
    """A datum that is drawn: a range from low to high, evenly or in powers, or a list of choices.

    reference: of the reference support. unit: of the range. phrase: a choice in a sentence. second_only: drawn
    in the second hypercube only, for the paper prints it or does not need it. second_high: end of the range
    there.
    """

    name: str
    meaning: str
    reason: str
    reference: Choice
    low: float = 0.0
    high: float = 0.0
    powers: bool = False
    choices: Sequence[str] = ()
    unit: str = ""
    phrase: str = ""
    second_only: bool = False
    second_high: float = 0.0

    def at(self, share: float, *, second: bool = False) -> Choice:
        """The value at a share from 0 to 1 of the range in the first hypercube or in the second."""
        if self.second_only and not second:
            return self.reference
        if self.choices:
            return self.choices[min(int(share * len(self.choices)), len(self.choices) - 1)]
        high = self.second_high if second and self.second_high else self.high
        if self.powers:
            return float(self.low * (high / self.low) ** share)
        return float(self.low + (high - self.low) * share)

    @property
    def label(self) -> str:
        """The name in words."""
        return SYMBOLS.get(self.name, self.name.replace("_", " "))

    def span(self, *, second: bool) -> str:
        """The range or the choices in one of the hypercubes, in words."""
        if self.second_only and not second:
            return f"{self.reference} {self.unit}".rstrip()
        if self.choices:
            return ", ".join(self.choices)
        low, high = (f"{float(self.at(end, second=second)):g}" for end in (0.0, 1.0))
        return f"{low} to {high} {self.unit}".rstrip() + (", even in powers" if self.powers else "")


SYMBOLS = {"sliding_coefficient": "mu_d", "static_speed": "v_s", "dynamic_speed": "v_d"}
BODIES = {  # what a mass factor multiplies: body and which of its parts
    "rear_link": ("rear_link", (0,)),
    "front_link": ("front_link", (0,)),
    "shield_beam": ("shield", (0,)),
    "tail_beam": ("shield", (1,)),
    "canopy": ("canopy", (0, 1, 2)),
}
MEMBERS = {  # by whose direction a centre of mass is shifted
    "rear_link": ("rear_base", "rear_shield"),
    "front_link": ("front_base", "front_shield"),
    "shield": ("rear_shield", "hinge"),
    "canopy": ("hinge", "tip"),
}

_FROM_PAPER_MACHINE: dict[str, Choice] = {
    "restitution": paper_machine.RESTITUTION,
    "sliding_coefficient": paper_machine.SLIDING_COEFFICIENT,
}
FACTORS = tuple(
    Factor(**{**row, "name": name, "reference": _FROM_PAPER_MACHINE.get(name, row["reference"])})
    for row in tables("studies.claims", "factors.toml")["factor"]
    for name in row.pop("names", [row.get("name")])
)
REFERENCE: dict[str, Choice] = {factor.name: factor.reference for factor in FACTORS} | {
    CONTACT: paper_machine.PAPER
}


def samples(number: int, seed: int, *, second: bool = False) -> list[dict[str, Choice]]:
    """The first machines of a hypercube; a larger number begins with the same machines.

    They are drawn in lots, each a Latin hypercube over all data. Machines with the same number have the same
    data in both hypercubes where the ranges are the same.
    """
    if number < 1:
        raise InputError(f"machines = {number}: allowed: at least 1")
    from scipy.stats import qmc  # takes a second to import

    drawn: list[dict[str, Choice]] = []
    for lot in range(-(-number // LOT)):
        hypercube = qmc.LatinHypercube(len(FACTORS), seed=np.random.default_rng([seed, lot]))
        for shares in hypercube.random(LOT):
            sample = {f.name: f.at(float(x), second=second) for f, x in zip(FACTORS, shares, strict=True)}
            sample[CONTACT] = paper_machine.CYLINDERS if second else paper_machine.PAPER
            drawn.append(sample)
    return drawn[:number]


def machine(sample: Sample) -> HydraulicSupport:
    """The support of a sample: masses with the cube of its scale, the centres of a body's parts shifted alike.

    Raises InputError if its linkage cannot be closed at the start.
    """
    base = reference_support()
    scale = sample["scale"] / REFERENCE_SCALE
    pivots: dict[str, Any] = {name: _scaled(getattr(base, name), scale) for name in PIVOTS}
    heavier = {
        (body, place): sample[f"mass_{name}"] for name, (body, places) in BODIES.items() for place in places
    }
    shifts = {}
    for body, ends in MEMBERS.items():
        a, b = (np.array(getattr(base, pivot)) for pivot in ends)
        across = sample.get(f"centre_across_{body}", 0.0) * np.array([a[1] - b[1], b[0] - a[0]])
        shifts[body] = sample[f"centre_along_{body}"] * (b - a) + across

    def part(body: str, place: int, one: Part) -> Part:
        mass, inertia = (scale**power * heavier[body, place] for power in (3, 5))
        x, y = (float(c + shift) for c, shift in zip(one.centre, shifts[body], strict=True))
        xx, yy, xy = (inertia * moment for moment in one.moments or (0.0, 0.0, 0.0))
        return replace(
            one,
            mass=one.mass * mass,
            centre=_scaled((x, y), scale),
            inertia=one.inertia * inertia,
            moments=one.moments and (xx, yy, xy),
        )

    return replace(
        base,
        **pivots,
        parts={body: tuple(part(body, n, one) for n, one in enumerate(of)) for body, of in base.parts.items()},
        start_hinge_height=base.start_hinge_height * scale * sample["start_height"],
        width=base.width and base.width.scaled(scale),
    )


def _scaled(point: Vector2, scale: float) -> Vector2:
    return point[0] * scale, point[1] * scale


def pin(sample: Sample, clearance_mm: float, support: HydraulicSupport) -> ClearancePin:
    """The rear-link clearance pin of a sample and its machine; the pin's radius is the paper's."""
    bearing = paper_machine.bearing(clearance_mm)
    normal = paper_machine.normal_law(
        sample[CONTACT],
        bearing,
        support,
        POWER_LAWS[sample["law"]],
        sample["backing"],
        restitution=sample["restitution"],
        rest_velocity=sample["rest_velocity"],
    )
    contact = JournalContact(bearing=bearing, normal=normal, friction=_friction(sample))
    return ClearancePin(contact=contact, bore="first" if sample["bore"] == "base" else "second")


def ideal_pin(sample: Sample) -> IdealPin:
    """The rear-link pin of a sample without clearance, with the friction of that with clearance."""
    return IdealPin(friction=_friction(sample), radius=paper_machine.BORE_RADIUS)


def _friction(sample: Sample) -> Ambrosio:
    return Ambrosio(
        sliding_coefficient=sample["sliding_coefficient"],
        static_speed=sample["static_speed"],
        dynamic_speed=sample["dynamic_speed"],
    )


def oil_columns(sample: Sample) -> dict[str, OilColumn]:
    """Both pairs of columns of a sample on oil, as large as its machine."""
    scale = sample["scale"] / REFERENCE_SCALE
    oil = OilColumn(
        bore_area=bore_area(scale * paper_machine.OIL_BORE, 2),
        oil_length=scale * paper_machine.OIL_LENGTH,
        bulk_modulus=1e9 * sample["bulk_modulus"],
        line=replace(
            paper_machine.HOSES,
            volume=1e-3 * sample["line_volume"],
            nominal_drop=1e6 * sample["line_drop"],
        ),
    )
    return {"front_column": oil, "rear_column": oil}
