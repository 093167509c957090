"""What does each element of the model change, and what does it cost?

Clearance, friction, mass and oil of the columns, the tail beam, the start and space: each is added to the
plainest scene and taken from the fullest, and every number comes with its numerical error. From the table
follows which scene a question needs.
"""

from collections.abc import Mapping
from typing import ClassVar

from matplotlib.figure import Figure

from studies.common.study import Study
from studies.scene_detail import figures as tables
from studies.scene_detail import measures, scenes
from studies.scene_detail.figures import figures
from studies.scene_detail.measures import run_timed
from studies.scene_detail.scenes import APART, PLAINEST, UNEQUAL_FULLEST, DetailScene
from support_exudyn import recommend
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.recommend import QUESTIONS, STROKE, UNEQUAL

TABLE = "scene_table.json"
ORDER = ("unequal", "taken", "combined", "space", "added")  # the longest runs first
GROUPS = ("added", "taken", "combined", "space")


def families(chosen: Mapping[str, DetailScene]) -> dict[str, str]:
    """Machine and drive of the numbers, by family."""
    return {
        STROKE: f"reference support, {chosen[PLAINEST].drive}",
        UNEQUAL: f"reference support on oil columns, {chosen[UNEQUAL_FULLEST].drive}, front columns "
        f"{200 * APART:g} % apart, settled start",
    }


class SceneDetailStudy(Study):
    """What does each element of the model change, and what does it cost?"""

    name, seconds = "scene_detail", 110.0
    live: ClassVar = {"unequal_columns": (0, 1, 2, 3)}

    def work(self) -> None:
        """All scenes, what they change and cost, and the advice that follows.

        The table of the advice is kept as a file, as `support_exudyn/simulation/evidence` has it.
        """
        by_name = scenes.scenes()
        longest_first = sorted(by_name.values(), key=lambda scene: ORDER.index(scene.group))
        runs = run_timed({scene.name: scene.scenario for scene in longest_first}, self.chosen.workers)
        self.measured = measures.measure(by_name, runs)
        self.numbers = measures.listed(self.measured)
        self.tried = measures.table(self.measured, families(by_name))
        self.tried.save(self.chosen.out / TABLE)

    def figures(self) -> dict[str, Figure]:
        """All figures."""
        return figures(self.measured)

    def tables(self) -> dict[str, Sheet]:
        """All tables."""
        return {
            "table_advice": tables.advice_table(self.tried),
            "table_unequal": tables.unequal_table(self.measured),
            **{f"table_{group}": tables.change_table(self.measured, group) for group in GROUPS},
        }

    def words(self) -> dict[str, object]:
        """What is measured, and the advice."""
        of_space = [
            tables.changes(*pair)[tables.RELATIVE["mean_pin_force"]]
            for pair in tables.of_group(self.measured, "space")
        ]
        return {
            "measured": self.measured,
            "measures": measures,
            "scenes": scenes,
            "tables": tables,
            "questions": QUESTIONS,
            "plane_is_enough": all(abs(found.value) + found.error < 1.0 for found in of_space),
            "advised": {name: recommend(name, self.tried) for name in QUESTIONS},
        }
