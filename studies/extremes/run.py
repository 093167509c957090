"""Where does the model break, and does it say so?

Clearance, stiffness, restitution, friction, steps, spectral radius, masses, postures, starts, loads and speeds
far beyond what is sensible, in grids and random corners; and runs of up to a thousand seconds. How a run is
judged stands in `studies.extremes.judge`.
"""

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from studies.common.numbers import Number
from studies.common.study import Study
from studies.common.words import text_table
from studies.extremes import long_runs
from studies.extremes.drawn import SPANS
from studies.extremes.figures import Judged, figures
from studies.extremes.judge import (
    BEFORE,
    FREE,
    GOOD,
    LEAK,
    MORE,
    PATIENCE,
    REFUSED,
    SILENT,
    Judgement,
    judge_all,
    run_long,
)
from studies.extremes.long_runs import LongRun
from studies.extremes.scenes import BOX, DRAWN, HYDRAULICS, MAPS, RANDOM, cases
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.scene.limits import DEEPEST
from support_exudyn.simulation.result_checks import OPEN

OUTCOMES = (GOOD, REFUSED, SILENT)
SENSIBLE = "physically sensible"
SURE = 0.95  # of intervals of what is drawn
Long = Mapping[str, LongRun | str]
KINDS = {  # the rows of the key table
    SENSIBLE: (BOX,),
    "pin, steps and start beyond": ("corners", "solver", "start"),
    "slider-crank": ("slider-crank", "hang-up", "dead centre"),
    "other machines and loads": (
        "mass ratio", "posture", "all pins", "no gravity", "roof", "columns", "free impact", "space",
    ),
    "on hydraulic legs": (HYDRAULICS,),
    "grids of the maps": MAPS,
    "all": (*MAPS, *RANDOM),
}  # fmt: skip


# --- shares of drawn scenes ---


class CountedShare(NamedTuple):
    """In how many drawn scenes something holds, and the interval of the share of all that could be drawn.

    held, number: of so many so many. interval: that of Clopper and Pearson, with a confidence of SURE.
    """

    held: int
    number: int
    interval: tuple[float, float]

    @property
    def in_words(self) -> str:
        """The share in per cent, with its interval."""
        value, low, high = (100.0 * share for share in (self.held / self.number, *self.interval))
        return f"{value:.3g} % ({low:.3g} to {high:.3g} %)"


def shares(judged: Judged) -> dict[tuple[str, str], CountedShare]:
    """What holds of the physically sensible scenes and of all that were drawn, by its name and theirs."""
    from scipy.stats import binomtest  # takes a second to import

    box, random = of_groups(judged, (BOX,)), of_groups(judged, RANDOM)
    held = {
        (GOOD, SENSIBLE): [one.outcome == GOOD for one in box],
        ("accuracy_met", SENSIBLE): [one.met for one in box],
        (SILENT, SENSIBLE): [one.outcome == SILENT for one in box],
        **{(outcome, "drawn"): [one.outcome == outcome for one in random] for outcome in OUTCOMES},
    }
    found = {}
    for name, each in held.items():
        low, high = binomtest(sum(each), len(each)).proportion_ci(SURE, "exact")
        found[name] = CountedShare(sum(each), len(each), (float(low), float(high)))
    return found


def largest(values: Sequence[float]) -> float:
    """The largest of those that are numbers; 0 if none is."""
    return max((value for value in values if math.isfinite(value)), default=0.0)


def of_groups(judged: Judged, groups: Collection[str]) -> list[Judgement]:
    """The verdicts on the cases of these groups."""
    return [verdict for case, verdict in judged if case.group in groups]


def ended(verdicts: Sequence[Judgement]) -> dict[str, int]:
    """How many runs ended how, by outcome."""
    return {outcome: sum(one.outcome == outcome for one in verdicts) for outcome in OUTCOMES}


def checked_twice(verdicts: Sequence[Judgement]) -> int:
    """How many runs another formulation checked, too."""
    return sum(math.isfinite(one.other) for one in verdicts)


def _kind(reason: str) -> str:
    """A reason without its numbers."""
    text = reason.partition(": ")[2] or reason
    words = ["#" if any(letter.isdigit() for letter in word) else word for word in text.split()]
    short = " ".join(words).split("; allowed")[0]
    return short[:110] + ("..." if len(short) > 110 else "")


def _long_row(name: str, run: LongRun | str) -> tuple[str, ...]:
    if isinstance(run, str):
        return name, run, *("",) * 6
    counts = (f"{run.simulated:g}", f"{run.wall:.0f}", f"{run.steps}", f"{run.impacts}")
    return name, *counts, f"{run.gap_first:.1e}", f"{run.gap_last:.1e}", f"{run.energy_share:.1e}"


# --- the study ---


class Extremes(Study):
    """Where does the model break, and does it say so?"""

    name, seconds = "extremes", 660.0

    def work(self) -> None:
        """All scenes and long runs, judged."""
        drawn = cases(self.chosen.runs or DRAWN)
        self.long = run_long(long_runs.DURATIONS, self.chosen.workers)
        self.judged = list(zip(drawn, judge_all(drawn, self.chosen.workers), strict=True))
        self.numbers = self.measured()

    def measured(self) -> list[Number]:
        """Shares with their counting errors, extremes of this very set of runs, and what long runs came to."""
        from scipy.stats import quantile_test  # takes a second to import

        made = []
        for (name, case), share in shares(self.judged).items():
            value, (low, high) = share.held / share.number, share.interval
            made.append(Number(name, case, value, "1", max(value - low, high - value)))
        errors = [one.error for one in of_groups(self.judged, RANDOM) if one.outcome == GOOD]
        middle = low = high = math.nan
        if errors:
            middle = float(np.median(errors))
            low, high = np.array(quantile_test(errors, p=0.5).confidence_interval(SURE))
        if (of_error := max(middle - low, high - middle)) >= 0.0:  # none of too few
            made.append(Number("median_reported_error", "drawn, good", middle, "1", float(of_error)))
        good = [verdict for _, verdict in self.judged if verdict.outcome == GOOD]
        of_these = f"the {len(good)} good of {len(self.judged)} runs"  # others have other extremes
        extremes = {
            "largest_energy_open": [one.energy for one in good],
            "largest_oil_open": [one.oil for one in good],
            "largest_depth": [one.depth for one in good],
            "largest_restitution_over_law": [one.restitution for one in good],
            "largest_half_over_reported": [one.half / one.error for one in good if one.error],
        }
        made += [Number(name, of_these, largest(values), "1", 0.0) for name, values in extremes.items()]
        for name, run in self.long.items():
            if isinstance(run, LongRun):
                case = f"{name}, {run.simulated:g} s"
                made += [
                    Number("largest_gap", case, run.gap_last, "m", 0.0),
                    Number("gap_slope", case, run.gap_slope, "m/s", 0.0),
                    Number("energy_open", case, run.energy_share, "1", 0.0),
                ]
        return made

    def figures(self) -> dict[str, Figure]:
        """All maps, and where each solver holds."""
        return figures(self.judged)

    def tables(self) -> dict[str, Sheet]:
        """How the runs ended, why some were refused and what is wrong with others; and the long runs."""
        kinds = []
        for kind, groups in KINDS.items():
            here = of_groups(self.judged, groups)
            kinds.append((kind, *map(str, (len(here), *ended(here).values(), checked_twice(here)))))
        refused = Counter(_kind(verdict.reason) for _, verdict in self.judged if verdict.outcome == REFUSED)
        silent = [(case.name, verdict.reason) for case, verdict in self.judged if verdict.outcome == SILENT]
        of_kinds = ("scenes", "runs", "good", "refused", "silently wrong", "checked by another formulation")
        of_long = (
            "scene", "time [s]", "took [s]", "steps", "impacts", "gap, first tenth [m]", "gap, last tenth [m]",
            "energy open / turned over",
        )  # fmt: skip
        reasons = [(str(number), reason) for reason, number in refused.most_common()]
        return {
            "table_kinds": text_table(of_kinds, kinds),
            "table_reasons": text_table(("runs", "reason"), reasons, wide=True),
            "table_silent": text_table(("run", "what is wrong"), silent or [("none", "")], wide=True),
            "table_long": text_table(of_long, [_long_row(name, run) for name, run in self.long.items()]),
        }

    def counts(self) -> dict[str, int]:
        """How many runs ended how."""
        found = ended([verdict for _, verdict in self.judged])
        return {f"runs_{outcome}": number for outcome, number in found.items()}

    def words(self) -> dict[str, object]:
        """What the sentences are filled with."""
        every = [verdict for _, verdict in self.judged]
        shared = shares(self.judged)
        lasting = [run for run in self.long.values() if isinstance(run, LongRun)]
        return {
            "counts": self.counts(),
            "runs": len(self.judged),
            "kinds": len(RANDOM),
            "spans": SPANS,
            "limits": SimpleNamespace(OPEN=OPEN, DEEPEST=DEEPEST, FREE=FREE, LEAK=LEAK, MORE=MORE),
            "patience": PATIENCE,
            "sure": SURE,
            "silent": shared[SILENT, "drawn"],
            "good_in_box": shared[GOOD, SENSIBLE],
            "met_in_box": shared["accuracy_met", SENSIBLE],
            "no_scene": sum(verdict.reason.startswith(BEFORE) for verdict in every),
            "checked": checked_twice(every),
            "maps": {group: _of_map(of_groups(self.judged, (group,))) for group in MAPS},
            "energy_open": largest([one.energy for one in every if one.outcome == GOOD]),
            "lasting": lasting,
            "lost": {name: why for name, why in self.long.items() if isinstance(why, str)},
            "gap": largest([run.gap_last for run in lasting]),
            "long_energy": largest([run.energy_share for run in lasting]),
        }


def _of_map(here: Sequence[Judgement]) -> dict[str, float]:
    """How the runs of a map ended, and the errors of its good ones."""
    errors = [verdict.error for verdict in here if verdict.outcome == GOOD]
    return {**ended(here), "runs": len(here), "median": float(np.median(errors)), "worst": largest(errors)}
