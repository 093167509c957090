"""The pictures of the README, from runs made for them.

`python -m studies.readme_pictures` writes them to studies/pictures; with names only those.
"""

import os
import shutil
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any

from matplotlib.figure import Figure
from PIL import Image

from studies.clearance import figures as influence_figures
from studies.clearance import run as clearance
from studies.common import paper_machine
from studies.common.options import Options
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


@cache
def paper(workers: int) -> Mapping[str, Result]:
    """The cases of `clearance_influence` at its steps, run when the first picture asks; workers: processes."""
    return run_cases(clearance.influence_cases(), Options(Path(), workers))


def with_clearance(workers: int) -> Result:
    """The rise with 1.5 mm in the rear pin, with friction."""
    return paper(workers)[influence_figures.DRY]


def machine(workers: int, path: Path) -> None:
    """The support in mid-rise."""
    with whole_file(path) as temporary:
        Image.fromarray(still(with_clearance(workers), MIDDLE)).save(temporary, format="PNG", optimize=True)


def movie(workers: int, path: Path) -> None:
    """The whole run as a movie."""
    how: dict[str, Any] = {"frames_per_second": MOVIE_RATE, "speed": MOVIE_SPEED, "size": MOVIE_SIZE}
    with TemporaryDirectory() as frames:
        shutil.move(str(render(with_clearance(workers), Path(frames) / "frames", **how).movie), path)


def map_step_stiffness(workers: int) -> Figure:
    """The map of `extremes` by step and stiffness: 169 of its scenes."""
    found = [case for case in mapped() if case.group == STEP_STIFFNESS]
    verdicts = judge_all(found, workers)
    return extremes_figures.figures(list(zip(found, verdicts, strict=True)))["map_step_stiffness"]


def drawn(figure: Callable[[int], Figure]) -> Callable[[int, Path], object]:
    """The function that writes a figure of the runs."""
    return lambda workers, path: style.save(figure(workers), path.parent, path.stem, pdf=False)


PICTURES: dict[str, Callable[[int, Path], object]] = {  # with how many processes, into which file
    "machine.png": machine,
    "rise.gif": movie,
    "pin_force.png": drawn(lambda n: influence_figures.influence_figures(paper(n))["fig5_pin_force"]),
    "journal_orbit.png": drawn(lambda n: orbit(with_clearance(n), paper_machine.CLEARANCE_PIN)),
    "spectrum.png": drawn(lambda n: force_spectrum(with_clearance(n), paper_machine.CLEARANCE_PIN, *RISE)),
    "map_step_stiffness.png": drawn(map_step_stiffness),
}


app = new_app("python -m studies.readme_pictures", (__doc__ or "").splitlines()[0], version_flags=())


@app.default
def draw(
    *names: Annotated[str, among(PICTURES, f"Which (all): {', '.join(PICTURES)}.")],
    out: Path = FOLDER,
    workers: Annotated[int, at_most(1024)] = os.cpu_count() or 1,
) -> None:
    """Make the pictures that were asked for.

    Args:
        out: Folder (studies/pictures).
        workers: Processes (all cores).
    """
    with output_folder(out), style.look():
        for name in names or PICTURES:
            warn(str(out / name))
            PICTURES[name](workers, out / name)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.readme_pictures`."""
    return carry_out(app, argv)


if __name__ == "__main__":
    sys.exit(main())
