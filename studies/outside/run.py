"""Does the program agree with published cases and with foreign programs?

Every case has numbers of a source: independent solutions by minimal coordinates, Siconos's reference files,
published lengths. Each scene is run twice, at steps and at half of them, and its numbers stand beside the
source's with both errors and a verdict.
"""

import math
import sys
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from studies.common.panels import finish, grid
from studies.common.runs import run_cases
from studies.common.study import Study
from studies.common.words import text_table
from studies.outside.sources import SCENES, ComparedNumber, OutsideCase, cases, compared, hinge
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet

FINE = ", half the steps"
# angle of the crank [rad] at a time [s] by Newton's impacts, and by smooth contact with K = 1e9; of the source
LIMIT, SMOOTH, AT = 1.61452672389, 1.61445149524, 0.02
STIFFER = {1e9: "slider_crank", 1e11: "stiffer_slider_crank", 1e13: "stiffest_slider_crank"}
ORDER = 0.4  # of the distance to that: K to the power of minus it


def crank_at(run: Result) -> float:
    """Angle of the crank at the time of the limit [rad]."""
    return float(run["crank.angle"][round(AT / (run.time[1] - run.time[0]))])


def newton_rows(runs: Mapping[str, Result]) -> list[ComparedNumber]:
    """The distance from Newton's impacts at every stiffness, and the order between two of them."""
    case = cases()["newton_limit"]
    found, distances = [], []
    for stiffness, scene in STIFFER.items():
        fine, coarse = crank_at(runs[scene + FINE]), crank_at(runs[scene])
        distances.append(abs(fine - LIMIT))
        allowed = 2.0 * abs(SMOOTH - LIMIT) * (stiffness / 1e9) ** -ORDER
        what = f"crank.angle at {AT:g} s, K = {stiffness:.0e} N/m^1.5"
        found.append(ComparedNumber(case.name, what, "rad", LIMIT, 5e-12, fine, abs(fine - coarse), allowed))
    for n, (near, far) in enumerate(zip(distances[1:], distances, strict=False)):
        first, second = list(STIFFER)[n : n + 2]
        order = math.log(far / near) / math.log(second / first)
        error = found[n + 1].our_error / near / math.log(second / first)
        what = f"order between K = {first:.0e} and {second:.0e}"
        found.append(ComparedNumber(case.name, what, "1", ORDER, 0.05, order, error, case.allowed))
    return found


def velenje_rows(runs: Mapping[str, Result]) -> list[ComparedNumber]:
    """The largest distance of the hinge from where circles have it."""
    case = cases()["velenje"]

    def apart(run: Result) -> float:
        known = hinge(run["front_link.angle"])
        return float(np.hypot(run["hinge.x"] - known[0], run["hinge.y"] - known[1]).max())

    fine, coarse = apart(runs[case.scene + FINE]), apart(runs[case.scene])
    what = "largest distance of the hinge's path"
    return [ComparedNumber(case.name, what, "m", 0.0, 5e-6, fine, abs(fine - coarse), case.allowed)]


COMPUTED = {"newton_limit": newton_rows, "velenje": velenje_rows}  # numbers that no table has


class Outside(Study):
    """Does the program agree with published cases and with foreign programs?"""

    name, seconds = "outside", 100.0

    def work(self) -> None:
        """All cases, each beside its source."""
        scenes = {name: scene() for name, scene in SCENES.items()}
        # the longest first, so that no process is left alone with a long run at the end
        order = sorted(scenes, key=lambda name: name != "loose_crank_rocker")
        wanted = {name + FINE: scenes[name].refined() for name in order} | {
            name: scenes[name] for name in order
        }
        self.all_runs = run_cases(wanted, self.chosen)
        self.compared: list[tuple[OutsideCase, Sequence[ComparedNumber]]] = []
        for name, case in cases().items():
            if name in COMPUTED:
                self.compared.append((case, COMPUTED[name](self.all_runs)))
            else:
                fine, coarse = (self.all_runs[case.scene + end] for end in (FINE, ""))
                self.compared.append((case, compared(case, fine, coarse)))
        self.rows = [one for _, numbers in self.compared for one in numbers]
        self.numbers = [one.number() for one in self.rows]

    def figures(self) -> dict[str, Figure]:
        """The four-bar with loose pins by both programs, and how far stiff guides are from Newton's impacts."""
        drawing, ((four_bar, limit),) = grid(70, 1, 2)
        run = self.all_runs["three_loose_pins" + FINE]
        known = next(numbers for case, numbers in self.compared if case.name == "three_loose_pins_rate")
        four_bar.plot(run.time, run["crank.angular_velocity"], color=style.WITH_CLEARANCE, lw=1.0, label="here")
        times = [float(one.what.split(" at ")[1].removesuffix(" s")) for one in known]
        four_bar.plot(times, [one.theirs for one in known], "x", color=style.IDEAL, ms=5, label="Siconos")
        four_bar.set(xlabel="time [s]", ylabel="crank [rad/s]")
        four_bar.legend()
        distances = [abs(crank_at(self.all_runs[scene + FINE]) - LIMIT) for scene in STIFFER.values()]
        limit.loglog(list(STIFFER), distances, "o-", color=style.WITH_CLEARANCE, ms=4, lw=1.0, label="here")
        line = [abs(SMOOTH - LIMIT) * (stiffness / 1e9) ** -ORDER for stiffness in STIFFER]
        limit.loglog(
            list(STIFFER), line, "--", color=style.IDEAL, lw=1.0, label=f"K to the power of -{ORDER:g}"
        )
        limit.set(xlabel="stiffness K [N/m$^{1.5}$]", ylabel="distance from Newton [rad]")
        limit.legend()
        return {"outside": finish(drawing, [four_bar, limit])}

    def tables(self) -> dict[str, Sheet]:
        """A row a case: who computed it, how far off ours is at most, both errors, and the verdict."""
        rows = []
        for case, numbers in self.compared:
            worst = max(numbers, key=lambda one: one.off / one.allowed)
            relative = not case.absolute
            scale, unit = (1.0 / abs(worst.theirs), "") if relative else (1.0, f" {worst.unit}")
            shown = [f"{scale * error:.1g}{unit}" for error in (worst.their_error, worst.our_error, worst.off)]
            met = sum(one.met for one in numbers)
            verdict = "met" if met == len(numbers) else f"{met} of {len(numbers)} met"
            asked = f"{case.allowed:.0e}{unit if not relative else ''}"
            rows.append((case.title, case.program, case.source, *shown, asked, verdict))
        header = ("case", "program", "source", "error of the source", "our error", "off", "asked", "verdict")
        return {"table_cases": text_table(header, rows, left=3, wide=True)}

    def words(self) -> dict[str, object]:
        """Cases with their numbers."""
        return {
            "run": sys.modules[__name__],
            "cases": self.compared,
            "of": {case.name: compared_numbers for case, compared_numbers in self.compared},
            "rows": self.rows,
            "orders": [one.ours for one in self.rows if one.what.startswith("order")],
        }
