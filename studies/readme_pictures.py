"""The pictures of the README, from runs made for them.

`python -m studies.readme_pictures` writes them to studies/pictures; with names only those.
"""

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

from matplotlib.figure import Figure
from PIL import Image

from studies.clearance import figures as influence_figures
from studies.clearance import run as clearance
from studies.common import paper_machine
from studies.common.options import MOST_WORKERS, Options
from studies.common.runs import run_cases
from studies.common.study import output_folder
from studies.extremes import figures as extremes_figures
from studies.extremes.judge import judge_all
from studies.extremes.scenes import STEP_STIFFNESS, mapped
from support_exudyn import Result
from support_exudyn.commands.command_line import among, at_most, carry_out, new_app, warn
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.orbit import orbit
from support_exudyn.postprocessing.figures.spectrum import force_spectrum
from support_exudyn.postprocessing.render import render, still

FOLDER = Path(__file__).parent / "pictures"
MIDDLE = 4.0  # of the rise [s]
RISE = (3.0, 5.0)  # [s]
MOVIE_SIZE = (800, 450)
MOVIE_RATE = 10.0  # frames a second
MOVIE_SPEED = 2.0  # so many times as fast as the run


@dataclass(frozen=True)
class Runs:
    """The runs that pictures are made of, made when the first one asks.

    workers: number of processes.
    """

    workers: int

    @cached_property
    def paper(self) -> Mapping[str, Result]:
        """The cases of `clearance_influence` at its steps."""
        return run_cases(clearance.influence_cases(), Options(Path(), self.workers))

    @property
    def with_clearance(self) -> Result:
        """The rise with 1.5 mm in the rear pin, with friction."""
        return self.paper[influence_figures.DRY]


def machine(runs: Runs, path: Path) -> None:
    """The support in mid-rise."""
    picture = Image.fromarray(still(runs.with_clearance, MIDDLE))
    with whole_file(path) as temporary:
        picture.save(temporary, format="PNG", optimize=True)


def movie(runs: Runs, path: Path) -> None:
    """The whole run as a movie."""
    with TemporaryDirectory() as frames:
        render(
            runs.with_clearance,
            Path(frames) / "frames",
            frames_per_second=MOVIE_RATE,
            speed=MOVIE_SPEED,
            size=MOVIE_SIZE,
            movie_path=path,
        )


def map_step_stiffness(runs: Runs) -> Figure:
    """The map of `extremes` by step and stiffness: 169 of its scenes."""
    found = [case for case in mapped() if case.group == STEP_STIFFNESS]
    verdicts = judge_all(found, runs.workers)
    return extremes_figures.figures(list(zip(found, verdicts, strict=True)))["map_step_stiffness"]


def drawn(figure: Callable[[Runs], Figure]) -> Callable[[Runs, Path], None]:
    """The function that writes a figure of the runs."""

    def write(runs: Runs, path: Path) -> None:
        style.save(figure(runs), path.parent, path.stem, pdf=False)

    return write


PICTURES: dict[str, Callable[[Runs, Path], None]] = {
    "machine.png": machine,
    "rise.gif": movie,
    "pin_force.png": drawn(lambda runs: influence_figures.influence_figures(runs.paper)["fig5_pin_force"]),
    "journal_orbit.png": drawn(lambda runs: orbit(runs.with_clearance, paper_machine.CLEARANCE_PIN)),
    "spectrum.png": drawn(lambda runs: force_spectrum(runs.with_clearance, paper_machine.CLEARANCE_PIN, *RISE)),
    "map_step_stiffness.png": drawn(map_step_stiffness),
}


app = new_app("python -m studies.readme_pictures", (__doc__ or "").splitlines()[0], version_flags=())


@app.default
def draw(
    *names: Annotated[str, among(PICTURES, f"Which (all): {', '.join(PICTURES)}.")],
    out: Path = FOLDER,
    workers: Annotated[int, at_most(MOST_WORKERS)] = os.cpu_count() or 1,
) -> None:
    """Make the pictures that were asked for.

    Args:
        out: Folder (studies/pictures).
        workers: Processes (all cores).
    """
    runs = Runs(workers)
    with output_folder(out), style.look():
        for name in names or PICTURES:
            warn(str(out / name))
            PICTURES[name](runs, out / name)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.readme_pictures`."""
    return carry_out(app, argv)


if __name__ == "__main__":
    sys.exit(main())
