"""Plausible machines: a Latin hypercube over everything that the paper leaves open.

Each factor is a range or a list of choices with the reason for it, see factors.toml. A sample names a value of
every factor; machine, pin and drive follow from it.
"""

import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from studies.common import paper_machine
from studies.common.data import rows
from studies.contact_laws.catalogue import POWER_LAWS
from support_exudyn import ClearancePin, HydraulicSupport, OilColumn, Part, bore_area, reference_support
from user_forces import (
    Ambrosio,
    JournalBearing,
    JournalContact,
    NormalLaw,
)
from user_forces.values.value import InputError, Vector2

Choice = str | float
Sample = Mapping[str, Choice]  # a value of every factor, by name

REFERENCE_SCALE = 0.65  # of the support whose pivots the reference support has
# data that came to be varied last
NEW = ("contact", "backing", "stroke_time", "bulk_modulus", "line_volume", "line_drop")
COLUMNS = "columns"  # what a sample says besides its factors: whether it is asked on columns of oil, too
RIGID, ON_OIL = "rigid", "rigid and oil"
ON_OIL_EVERY = 3  # machine: a run on oil costs ten times one on rigid columns


@dataclass(frozen=True)
class Factor:
    """Something assumed: a range from low to high, evenly or in powers, or a list of choices.

    unit: of the range. phrase: a choice in a sentence.
    """

    name: str
    meaning: str
    reason: str
    low: float = 0.0
    high: float = 0.0
    powers: bool = False
    choices: Sequence[str] = ()
    unit: str = ""
    phrase: str = ""

    def at(self, share: float) -> Choice:
        """The value at a share from 0 to 1 of the range."""
        if self.choices:
            return self.choices[min(int(share * len(self.choices)), len(self.choices) - 1)]
        if self.powers:
            return float(self.low * (self.high / self.low) ** share)
        return float(self.low + (self.high - self.low) * share)

    @property
    def said(self) -> str:
        """Its name in words."""
        return SYMBOLS.get(self.name, self.name.replace("_", " "))

    def chosen(self, choice: str) -> str:
        """A choice in words."""
        return self.phrase.format(choice)

    def bound(self, side: str, value: float) -> str:
        """A bound in words; side: above or below."""
        return f"{self.said} {side} {value:.3g} {self.unit}".rstrip()

    @property
    def span(self) -> str:
        """The range or the choices, in words."""
        if self.choices:
            return ", ".join(self.choices)
        return f"{self.low:g} to {self.high:g}" + (", even in powers" if self.powers else "")


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

_ROWS = {row["name"]: row for row in rows("studies.claims", "factor")}
REFERENCE: dict[str, Choice] = {name: row.pop("reference") for name, row in _ROWS.items()}
REFERENCE |= {
    "restitution": paper_machine.RESTITUTION,
    "sliding_coefficient": paper_machine.SLIDING_COEFFICIENT,
    COLUMNS: RIGID,
}
FACTORS = tuple(Factor(**row) for row in _ROWS.values())


def samples(number: int, seed: int) -> list[dict[str, Choice]]:
    """So many samples of a Latin hypercube over all factors; the same for the same number and seed.

    One in ON_OIL_EVERY, the first among them, is asked on columns of oil, too.
    """
    if number < 1:
        raise InputError(f"machines = {number}: allowed: at least 1")
    from scipy.stats import qmc  # takes a second to import

    # what this version of scipy calls the argument
    name = "rng" if "rng" in inspect.signature(qmc.LatinHypercube).parameters else "seed"
    generator: dict[str, Any] = {name: np.random.default_rng(seed)}
    cube = qmc.LatinHypercube(len(FACTORS), **generator).random(number)
    return [
        {f.name: f.at(float(share)) for f, share in zip(FACTORS, row, strict=True)}
        | {COLUMNS: RIGID if n % ON_OIL_EVERY else ON_OIL}
        for n, row in enumerate(cube)
    ]


def machine(sample: Sample) -> HydraulicSupport:
    """The support of a sample.

    Raises InputError if its linkage cannot be closed at the start.
    """
    base = reference_support()
    scale = number(sample, "scale") / REFERENCE_SCALE
    pivots: dict[str, Any] = {
        name: _scaled(getattr(base, name), scale)
        for name in (
            "rear_base", "front_base", "rear_shield", "front_shield", "hinge", "front_foot", "front_head",
            "rear_foot", "rear_head", "tip", "tail_hinge", "tail_jack_foot", "tail_jack_head",
        )
    }  # fmt: skip
    parts = {name: _parts(name, base, sample, scale) for name in base.parts}
    height = base.start_hinge_height * scale * number(sample, "start_height")
    width = base.width and base.width.scaled(scale)
    return replace(base, **pivots, parts=parts, start_hinge_height=height, width=width)


def _parts(body: str, base: HydraulicSupport, sample: Sample, scale: float) -> tuple[Part, ...]:
    """Parts of a body: masses with the cube of the scale, all centres shifted alike."""
    factors = {
        place: number(sample, f"mass_{name}")
        for name, (of, places) in BODIES.items()
        if of == body
        for place in places
    }
    a, b = (np.array(getattr(base, pivot)) for pivot in MEMBERS[body])
    along, across = b - a, np.array([a[1] - b[1], b[0] - a[0]])
    shift = number(sample, f"centre_along_{body}") * along
    if f"centre_across_{body}" in sample:
        shift = shift + number(sample, f"centre_across_{body}") * across
    shifted = []
    for place, part in enumerate(base.parts[body]):
        mass = part.mass * scale**3 * factors[place]
        centre = (part.centre[0] + float(shift[0]), part.centre[1] + float(shift[1]))
        heavier = scale**5 * factors[place]
        moments = part.moments and (
            part.moments[0] * heavier,
            part.moments[1] * heavier,
            part.moments[2] * heavier,
        )
        shifted.append(
            replace(
                part, mass=mass, centre=_scaled(centre, scale), inertia=part.inertia * heavier, moments=moments
            )
        )
    return tuple(shifted)


def _scaled(point: Vector2, scale: float) -> Vector2:
    return point[0] * scale, point[1] * scale


def pin(sample: Sample, clearance_mm: float, support: HydraulicSupport) -> ClearancePin:
    """The rear-link clearance pin of a sample and its machine; the pin's radius is the paper's."""
    friction = Ambrosio(
        sliding_coefficient=number(sample, "sliding_coefficient"),
        static_speed=number(sample, "static_speed"),
        dynamic_speed=number(sample, "dynamic_speed"),
    )
    bearing = paper_machine.bearing(clearance_mm)
    contact = JournalContact(bearing=bearing, normal=_normal(sample, bearing, support), friction=friction)
    return ClearancePin(contact=contact, bore="first" if sample["bore"] == "base" else "second")


def _normal(sample: Sample, bearing: JournalBearing, support: HydraulicSupport) -> NormalLaw:
    return paper_machine.normal_law(
        str(sample["contact"]),
        bearing,
        support,
        POWER_LAWS[str(sample["law"])],
        number(sample, "backing"),
        restitution=number(sample, "restitution"),
        rest_velocity=number(sample, "rest_velocity"),
    )


def oil_columns(sample: Sample) -> dict[str, OilColumn]:
    """Both pairs of columns of a sample on oil, as large as its machine."""
    scale = number(sample, "scale") / REFERENCE_SCALE
    oil = OilColumn(
        bore_area=bore_area(scale * paper_machine.OIL_BORE, 2),
        oil_length=scale * paper_machine.OIL_LENGTH,
        bulk_modulus=1e9 * number(sample, "bulk_modulus"),
        line=replace(
            paper_machine.HOSES,
            volume=1e-3 * number(sample, "line_volume"),
            nominal_drop=1e6 * number(sample, "line_drop"),
        ),
    )
    return {"front_column": oil, "rear_column": oil}


def number(sample: Sample, name: str) -> float:
    """A factor that is a number."""
    value = sample[name]
    if isinstance(value, str):
        raise InputError(f"{name} = {value!r}: allowed: a number")
    return value
