"""How each claim of the paper is judged; the claims themselves stand in claims.toml."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from studies.claims.evidence import Evidence, Measured, Verdict, every, opposite, rising, some, within
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
Tell = Callable[[Evidence], str]


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


def _share(used: float, at: Callable[[float], Judge]) -> Varied:
    """A judge by a share of a range or a number; shown at about half of it and at twice it, too."""
    return Varied(at, used, tuple(sorted({GREAT_AT.get(used, 0.5 * used), used, 2.0 * used})))


def _trends(at: Callable[[float], Judge]) -> Varied:
    """A judge by the correlation of trends."""
    return Varied(at, ALIKE, (0.98, ALIKE, 0.995))


def _nothing(e: Evidence) -> str:
    return ""


@dataclass(frozen=True)
class Claim:
    """One statement of the paper.

    where: abstract, section or conclusion. text: what is claimed. reading: what is measured, or why it is not
    measurable. paper: what it prints, if anything. judge: whether it holds on one machine, None if it is not
    measurable. tell: our numbers on one machine. closed_form: needs no machine. follows_from: name of a
    statement that contains this one. name: in a few words. figure, table: what shows it, as study/stem and
    study/name; figure is empty if a table alone does.
    """

    where: str
    text: str
    reading: str
    judge: Judge | None = None
    tell: Tell = _nothing
    paper: str = ""
    closed_form: bool = False
    follows_from: str = ""
    name: str = ""
    figure: str = ""
    table: str = ""

    @property
    def is_message(self) -> bool:
        """Whether the abstract says it, and it can be judged: a main message of the paper."""
        return self.judge is not None and self.where.startswith("abstract")


def _range(e: Evidence, quantity: str) -> Measured:
    return e[IDEAL, f"range_{quantity}"]


def _growth(e: Evidence, quantity: str) -> float:
    """By how much a quantity grows from the smallest to the largest clearance [%]."""
    return 100.0 * (e[CLEARANCES[3], quantity].value / e[CLEARANCES[0], quantity].value - 1.0)


def _fluctuates(quantity: str, used: float, cases: tuple[str, ...] = (MIDDLE,)) -> Judge:
    def at(share: float) -> Judge:
        return lambda e: every(e[c, f"rms_{quantity}"].above(_range(e, quantity).times(share)) for c in cases)

    return _share(used, at)


def _fluctuation_said(quantity: str, unit: str, digits: int = 3) -> Tell:
    def tell(e: Evidence) -> str:
        share = 100.0 * e[MIDDLE, f"rms_{quantity}"].value / _range(e, quantity).value
        return f"RMS fluctuation {e[MIDDLE, f'rms_{quantity}'].said(digits)} {unit}, {share:.3g} % of the range"

    return tell


def _alike(quantity: str, cases: tuple[str, ...] = (MIDDLE,)) -> Judge:
    return _trends(_alike_at(quantity, cases))


def _alike_at(quantity: str, cases: tuple[str, ...] = (MIDDLE,)) -> Callable[[float], Judge]:
    return lambda least: lambda e: every(e[c, f"likeness_{quantity}"].above(least) for c in cases)


def _alike_said(quantity: str, cases: tuple[str, ...] = (MIDDLE,)) -> Tell:
    return lambda e: f"correlation of trends {min(e.row(f'likeness_{quantity}', cases), key=_value).value:.4f}"


def _row_said(name: str, unit: str, digits: int = 4, scale: float = 1.0) -> Tell:
    return lambda e: ", ".join(m.times(scale).said(digits) for m in e.row(name, CLEARANCES)) + f" {unit}"


def _value(measured: Measured) -> float:
    return measured.value


def _both_said(one: Tell, other: Tell) -> Tell:
    return lambda e: f"{one(e)}; {other(e)}"


def _all(*judges: Judge) -> Judge:
    return lambda e: every([judge(e) for judge in judges])


def _grows(name: str) -> Judge:
    return lambda e: rising(e.row(name, CLEARANCES))


def _falls(name: str, cases: tuple[str, ...] = CLEARANCES) -> Judge:
    return lambda e: rising([m.times(-1.0) for m in e.row(name, cases)])


def _falls_then_grows(e: Evidence) -> Verdict:
    first, *inner, last = e.row("std_force", CLEARANCES)
    return some(every([m.below(first), m.below(last)]) for m in inner)


def _jump_between_1_and_1p5(e: Evidence) -> Verdict:
    half, one, one_and_half, two = e.row("rms_acceleration", CLEARANCES)
    return every(big.above(small.times(1.5)) for big in (one_and_half, two) for small in (half, one))


def _stages_within(stages: tuple[str, ...]) -> Callable[[float], Judge]:
    return lambda share: lambda e: every(within(e.row(f"speed_{one}", CLEARANCES), share) for one in stages)


def _tilt_said(side: str, what: str) -> Tell:
    def tell(e: Evidence) -> str:
        change = e[MIDDLE, f"{side}_{what}"] - e[IDEAL, f"{side}_{what}"]
        return f"{change.value:+.3f} deg at 1.5 mm, from {e[IDEAL, f'{side}_{what}'].said(4)}"

    return tell


def _mode_saves(name: str) -> Judge:
    return lambda e: e[MIDDLE, name].below(e[MODE_1, name])


def _mode_said(name: str, unit: str, scale: float = 1.0) -> Tell:
    return lambda e: (
        f"{e[MODE_1, name].times(scale).said(4)} in mode 1, {e[MIDDLE, name].times(scale).said(4)} in mode 2 "
        f"{unit}"
    )


_STIFFNESSES = [paper_machine.stiffness(size) / 1e3**1.5 for size in paper_machine.SIZES_MM]
_PRINTED = list(paper_machine.STIFFNESS.values())

JUDGES: dict[str, tuple[Judge, Tell]] = {
    # section 3: with and without
    "stiffness of 1.5 mm": (
        lambda e: abs(_STIFFNESSES[2] - _PRINTED[2]) < LAST_DIGIT,
        lambda e: f"{_STIFFNESSES[2]:.3f}",
    ),
    "velocity alike": (_alike("speed"), _alike_said("speed")),
    "velocity fluctuates": (_fluctuates("speed", VISIBLE), _fluctuation_said("speed", "deg/s")),
    "velocity higher in the middle": (
        lambda e: e[MIDDLE, "speed_middle"].above(e[IDEAL, "speed_middle"]),
        lambda e: f"{e[MIDDLE, 'speed_middle'].said(6)} against {e[IDEAL, 'speed_middle'].said(6)} deg/s",
    ),
    "acceleration fluctuates": (
        _fluctuates("acceleration", GREAT), _fluctuation_said("acceleration", "deg/s²"),
    ),
    "acceleration alike": (_alike("acceleration"), _alike_said("acceleration")),
    "force fluctuates": (_fluctuates("force", GREAT), _fluctuation_said("force", "N")),
    "force alike": (_alike("force"), _alike_said("force")),
    "movement alike": (
        _trends(lambda least: _all(_alike_at("speed")(least), _alike_at("tip")(least))),
        lambda e: f"{_alike_said('speed')(e)} (velocity), {e[MIDDLE, 'likeness_tip'].value:.4f} (tip)",
    ),
    # section 4.1: motion over the clearance
    "stiffnesses": (
        lambda e: all(abs(a - b) < LAST_DIGIT for a, b in zip(_STIFFNESSES, _PRINTED, strict=True)),
        lambda e: ", ".join(f"{k:.3f}" for k in _STIFFNESSES),
    ),
    "velocity alike for all": (_alike("speed", CLEARANCES), _alike_said("speed", CLEARANCES)),
    "size matters little for the velocity": (
        _share(LITTLE, _stages_within(tuple(rise.STAGES))),
        _row_said("speed_middle", "deg/s in the middle", 6),
    ),
    "velocity alike early and late": (
        _share(0.01, _stages_within(("early", "late"))),
        _both_said(_row_said("speed_early", "deg/s early", 5), _row_said("speed_late", "late", 5)),
    ),
    "velocity RMS fluctuation grows early and late": (
        _all(_grows("rms_speed_early"), _grows("rms_speed_late")),
        _both_said(
            _row_said("rms_speed_early", "deg/s early", 2), _row_said("rms_speed_late", "late", 2)
        ),
    ),
    "velocity grows in the middle": (_grows("speed_middle"), _row_said("speed_middle", "deg/s", 6)),
    "velocity RMS fluctuation grows in the middle": (
        _grows("rms_speed_middle"), _row_said("rms_speed_middle", "deg/s", 3),
    ),
    "acceleration alike for all": (
        _alike("acceleration", CLEARANCES), _alike_said("acceleration", CLEARANCES),
    ),
    "acceleration jumps after 1 mm": (_jump_between_1_and_1p5, _row_said("rms_acceleration", "deg/s²", 3)),
    "mean acceleration falls": (_falls("mean_acceleration"), _row_said("mean_acceleration", "deg/s²", 3)),
    "mean acceleration alike": (
        _share(
            0.01,
            lambda part: lambda e: within(
                e.row("mean_acceleration", CLEARANCES), part, _range(e, "acceleration")
            ),
        ),
        _row_said("mean_acceleration", "deg/s²", 3),
    ),
    "movement RMS fluctuation grows": (
        _all(_grows("rms_speed"), _grows("rms_acceleration")),
        _both_said(_row_said("rms_speed", "deg/s", 3), _row_said("rms_acceleration", "deg/s²", 3)),
    ),
    # section 4.2: force over the clearance
    "force alike for all": (_alike("force", CLEARANCES), _alike_said("force", CLEARANCES)),
    "force RMS fluctuation differs": (
        _share(0.1, lambda part: lambda e: opposite(within(e.row("rms_force", CLEARANCES), part))),
        _row_said("rms_force", "N", 3),
    ),
    "mean force grows": (_grows("mean_force"), _row_said("mean_force", "kN", 5, 1e-3)),
    "mean force grows little": (
        _share(SMALL, lambda part: lambda e: within(e.row("mean_force", CLEARANCES), part)),
        lambda e: f"{_growth(e, 'mean_force'):+.2f} %",
    ),
    "spread falls and grows": (_falls_then_grows, _row_said("std_force", "N", 5)),
    "spread does not only grow": (lambda e: opposite(_grows("std_force")(e)), _row_said("std_force", "N", 5)),
    "size matters little for the force": (
        _share(
            LITTLE,
            lambda part: lambda e: every(
                within(e.row(name, CLEARANCES), part) for name in ("mean_force", "std_force")
            ),
        ),
        _row_said("std_force", "N", 5),
    ),
    # section 4.3: posture
    "tip to the rear": (
        lambda e: every(m.below(0.0) for m in e.row("mean_tip_shift", CLEARANCES)),
        _row_said("mean_tip_shift", "mm"),
    ),
    "tip shift grows": (_falls("mean_tip_shift"), _row_said("mean_tip_shift", "mm")),
    "tip range alike": (
        _share(0.1, lambda part: lambda e: within(e.row("tip_range", (IDEAL, *CLEARANCES)), part)),
        lambda e: f"{e[IDEAL, 'tip_range'].said(4)} mm ideal; {_row_said('tip_range', 'mm')(e)}",
    ),
    "columns tilt": (
        lambda e: every(e[MIDDLE, f"{side}_angle"].below(e[IDEAL, f"{side}_angle"]) for side in SIDES),
        lambda e: f"front {_tilt_said('front', 'angle')(e)}; rear {_tilt_said('rear', 'angle')(e)}",
    ),
    "angles fall with size": (
        _all(*(_falls(f"{side}_angle", (IDEAL, *CLEARANCES)) for side in SIDES)),
        lambda e: f"front {_row_said('front_angle', 'deg', 6)(e)}; rear {_row_said('rear_angle', 'deg', 6)(e)}",
    ),
    "front nearer to the vertical": (
        lambda e: e[MIDDLE, "front_lean"].below(e[IDEAL, "front_lean"]), _tilt_said("front", "lean"),
    ),
    "rear away from the vertical": (
        lambda e: e[MIDDLE, "rear_lean"].above(e[IDEAL, "rear_lean"]), _tilt_said("rear", "lean"),
    ),
    # section 5: drive modes
    "impact in mode 1": (
        lambda e: e[MODE_1, "impulse"].above(A_BLOW),
        lambda e: f"{e[MODE_1, 'impulse'].said(4)} N s, sum of magnitudes",
    ),
    "clearance worsens the impact": (
        lambda e: e[OIL, "largest_force"].above(e[OIL_IDEAL, "largest_force"]),
        lambda e: (
            f"{e[OIL, 'largest_force'].times(1e-3).said(4)} kN with clearance, "
            f"{e[OIL_IDEAL, 'largest_force'].times(1e-3).said(4)} kN ideal"
        ),
    ),
    "force RMS fluctuation in mode 1": (
        lambda e: e[OIL, "rms_from_start_force"].above(e[OIL_IDEAL, "rms_from_start_force"]),
        lambda e: (
            f"{e[OIL, 'rms_from_start_force'].times(1e-3).said(4)} kN with clearance, "
            f"{e[OIL_IDEAL, 'rms_from_start_force'].times(1e-3).said(4)} kN ideal"
        ),
    ),
    "modes differ": (
        _share(
            0.1,
            lambda part: lambda e: opposite(
                within([e[MODE_1, "rms_from_start_force"], e[MIDDLE, "rms_from_start_force"]], part)
            ),
        ),
        _mode_said("rms_from_start_force", "N"),
    ),
    "gentle force": (_mode_saves("rms_from_start_force"), _mode_said("rms_from_start_force", "N")),
    "gentle motion": (
        _all(_mode_saves("rms_from_start_speed"), _mode_saves("rms_from_start_acceleration")),
        _mode_said("rms_from_start_acceleration", "deg/s²"),
    ),
    "gentle peak": (_mode_saves("largest_force"), _mode_said("largest_force", "kN", 1e-3)),
}  # fmt: skip


def _claim(judge: str = "", **row: Any) -> Claim:
    """A claim of claims.toml; its judge's name says it in a few words."""
    decides, tells = JUDGES[judge] if judge else (None, _nothing)
    return Claim(judge=decides, tell=tells, name=judge, **row)


CLAIMS = tuple(_claim(**row) for row in tables("studies.claims", "claims.toml")["claim"])
