"""How each claim of the paper is judged; the claims themselves stand in claims.toml."""

from collections.abc import Callable
from dataclasses import dataclass

from studies.claims.evidence import Evidence, Verdict, every, opposite, rising, some, within
from studies.claims.plausible_runs import CLEARANCES, IDEAL, MODE_1, OIL, OIL_IDEAL
from studies.common import paper_machine, rise
from studies.common.data import tables

VISIBLE = 0.005  # of a curve's range over the rise: the width of a printed line
GREAT = 0.05  # of it
ALIKE = 0.99  # correlation of trends
LITTLE = 0.05  # of a number
SMALL = 0.02  # of the mean force
A_BLOW = 1.0  # [N s]
MIDDLE = CLEARANCES[2]  # 1.5 mm, the clearance of section 3
GREAT_AT = {0.05: 0.02}  # shown in place of half of it
LAST_DIGIT = 5.1e-4  # of a printed stiffness [N/mm^1.5]
SIDES = ("front", "rear")

Judge = Callable[[Evidence], Verdict]


@dataclass(frozen=True)
class Varied:
    """A judge by a threshold that others might put elsewhere.

    at: the judge by a threshold. used: the one that decides. shown: at which the shares are told besides.
    """

    at: Callable[[float], Judge]
    used: float
    shown: tuple[float, ...]

    def __call__(self, e: Evidence) -> Verdict:
        """Whether it holds on a machine."""
        return self.at(self.used)(e)


@dataclass(frozen=True)
class Stiffness:
    """The judge of stiffnesses by Eq. 5, which need no machine; sizes: clearances [mm]."""

    sizes: tuple[float, ...]

    @property
    def ours(self) -> list[float]:
        """Our stiffnesses [N/mm^1.5]."""
        return [paper_machine.stiffness(size) / 1e3**1.5 for size in self.sizes]

    def __call__(self, e: Evidence) -> Verdict:
        """Whether they are those that the paper prints, to the last digit."""
        printed = [paper_machine.STIFFNESS[size] for size in self.sizes]
        return all(abs(a - b) < LAST_DIGIT for a, b in zip(self.ours, printed, strict=True))

    def __str__(self) -> str:
        return ", ".join(f"{k:.3f}" for k in self.ours)


@dataclass(frozen=True)
class Claim:
    """One statement of the paper.

    where: abstract, section or conclusion. text: what is claimed. reading: what is measured, or why it is not
    measurable. paper: what it prints, if anything. judge: whether it holds on one machine, None if it is not
    measurable. name: of the judge, in a few words. follows_from: name of the judge of a statement that contains
    this one. figure, table: what shows it, as study/stem and study/name; without a table all numbers of the
    figure's study do.
    """

    where: str
    text: str
    reading: str
    judge: Judge | None = None
    name: str = ""
    paper: str = ""
    follows_from: str = ""
    figure: str = ""
    table: str = ""

    @property
    def closed_form(self) -> bool:
        """Whether it needs no machine."""
        return isinstance(self.judge, Stiffness)

    @property
    def shown_in(self) -> str:
        """The table that shows it."""
        return self.table or f"{self.figure.partition('/')[0]}/numbers"

    @property
    def is_message(self) -> bool:
        """Whether the abstract says it, and it can be judged: a main message of the paper."""
        return self.judge is not None and self.where.startswith("abstract")


# --- judges ---


def _share(used: float, at: Callable[[float], Judge]) -> Varied:
    """A judge by a share of a range or a number; shown at about half of it and at twice it, too."""
    return Varied(at, used, tuple(sorted({GREAT_AT.get(used, 0.5 * used), used, 2.0 * used})))


def _trends(at: Callable[[float], Judge]) -> Varied:
    """A judge by the correlation of trends."""
    return Varied(at, ALIKE, (0.98, ALIKE, 0.995))


def _fluctuates(quantity: str, used: float) -> Judge:
    def at(share: float) -> Judge:
        return lambda e: e[MIDDLE, f"rms_{quantity}"].above(e[IDEAL, f"range_{quantity}"].times(share))

    return _share(used, at)


def _alike(*quantities: str, cases: tuple[str, ...] = (MIDDLE,)) -> Judge:
    def at(least: float) -> Judge:
        return lambda e: every(e[c, f"likeness_{q}"].above(least) for q in quantities for c in cases)

    return _trends(at)


def _grow(*names: str) -> Judge:
    return lambda e: every(rising(e.row(name, CLEARANCES)) for name in names)


def _fall(*names: str, cases: tuple[str, ...] = CLEARANCES) -> Judge:
    return lambda e: every(rising([m.times(-1.0) for m in e.row(name, cases)]) for name in names)


def _falls_then_grows(e: Evidence) -> Verdict:
    first, *inner, last = e.row("std_force", CLEARANCES)
    return some(every([m.below(first), m.below(last)]) for m in inner)


def _jump_between_1_and_1p5(e: Evidence) -> Verdict:
    half, one, one_and_half, two = e.row("rms_acceleration", CLEARANCES)
    return every(big.above(small.times(1.5)) for big in (one_and_half, two) for small in (half, one))


def _near(used: float, *names: str, cases: tuple[str, ...] = CLEARANCES) -> Varied:
    """A judge of numbers that differ among cases by less than a share."""
    return _share(used, lambda share: lambda e: every(within(e.row(name, cases), share) for name in names))


def _below(name: str, case: str, other: str) -> Judge:
    return lambda e: e[case, name].below(e[other, name])


def _gentle(*names: str) -> Judge:
    return lambda e: every(_below(name, MIDDLE, MODE_1)(e) for name in names)


def _differ(judge: Varied) -> Judge:
    return Varied(lambda share: lambda e: opposite(judge.at(share)(e)), judge.used, judge.shown)


def _acceleration_alike(share: float) -> Judge:
    return lambda e: within(e.row("mean_acceleration", CLEARANCES), share, e[IDEAL, "range_acceleration"])


JUDGES: dict[str, Judge] = {
    # section 3: with and without
    "stiffness of 1.5 mm": Stiffness((1.5,)),
    "velocity alike": _alike("speed"),
    "velocity fluctuates": _fluctuates("speed", VISIBLE),
    "velocity higher in the middle": _below("speed_middle", IDEAL, MIDDLE),
    "acceleration fluctuates": _fluctuates("acceleration", GREAT),
    "acceleration alike": _alike("acceleration"),
    "force fluctuates": _fluctuates("force", GREAT),
    "force alike": _alike("force"),
    "movement alike": _alike("speed", "tip"),
    # section 4.1: motion over the clearance
    "stiffnesses": Stiffness(paper_machine.SIZES_MM),
    "velocity alike for all": _alike("speed", cases=CLEARANCES),
    "size matters little for the velocity": _near(LITTLE, *(f"speed_{stage}" for stage in rise.STAGES)),
    "velocity alike early and late": _near(0.01, "speed_early", "speed_late"),
    "velocity RMS fluctuation grows early and late": _grow("rms_speed_early", "rms_speed_late"),
    "velocity grows in the middle": _grow("speed_middle"),
    "velocity RMS fluctuation grows in the middle": _grow("rms_speed_middle"),
    "acceleration alike for all": _alike("acceleration", cases=CLEARANCES),
    "acceleration jumps after 1 mm": _jump_between_1_and_1p5,
    "mean acceleration falls": _fall("mean_acceleration"),
    "mean acceleration alike": _share(0.01, _acceleration_alike),
    "movement RMS fluctuation grows": _grow("rms_speed", "rms_acceleration"),
    # section 4.2: force over the clearance
    "force alike for all": _alike("force", cases=CLEARANCES),
    "force RMS fluctuation differs": _differ(_near(0.1, "rms_force")),
    "mean force grows": _grow("mean_force"),
    "mean force grows little": _near(SMALL, "mean_force"),
    "spread falls and grows": _falls_then_grows,
    "spread does not only grow": lambda e: opposite(_grow("std_force")(e)),
    "size matters little for the force": _near(LITTLE, "mean_force", "std_force"),
    # section 4.3: posture
    "tip to the rear": lambda e: every(m.below(0.0) for m in e.row("mean_tip_shift", CLEARANCES)),
    "tip shift grows": _fall("mean_tip_shift"),
    "tip range alike": _near(0.1, "tip_range", cases=(IDEAL, *CLEARANCES)),
    "columns tilt": lambda e: every(_below(f"{side}_angle", MIDDLE, IDEAL)(e) for side in SIDES),
    "angles fall with size": _fall(*(f"{side}_angle" for side in SIDES), cases=(IDEAL, *CLEARANCES)),
    "front nearer to the vertical": _below("front_lean", MIDDLE, IDEAL),
    "rear away from the vertical": _below("rear_lean", IDEAL, MIDDLE),
    # section 5: drive modes
    "impact in mode 1": lambda e: e[MODE_1, "impulse"].above(A_BLOW),
    "clearance worsens the impact": _below("largest_force", OIL_IDEAL, OIL),
    "force RMS fluctuation in mode 1": _below("rms_from_start_force", OIL_IDEAL, OIL),
    "modes differ": _differ(_near(0.1, "rms_from_start_force", cases=(MODE_1, MIDDLE))),
    "gentle force": _gentle("rms_from_start_force"),
    "gentle motion": _gentle("rms_from_start_speed", "rms_from_start_acceleration"),
    "gentle peak": _gentle("largest_force"),
}

CLAIMS = tuple(
    Claim(judge=JUDGES[row["name"]] if "name" in row else None, **row)
    for row in tables("studies.claims", "claims.toml")["claim"]
)
