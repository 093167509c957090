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
from typing import Annotated

from matplotlib.figure import Figure
from PIL import Image

from studies.clearance import figures as influence_figures
from studies.clearance.run import ClearanceInfluence
from studies.common import paper_machine
from studies.common.options import Options
from studies.common.runs import run_cases
from studies.common.study import output_folder
from studies.extremes import figures as extremes_figures
from studies.extremes.judge import judge_all
from studies.extremes.scenes import STEP_STIFFNESS, mapped
from support_exudyn import Result
from support_exudyn.commands.command_line import among, carry_out, new_app, warn
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.orbit import orbit
from support_exudyn.postprocessing.figures.spectrum import force_spectrum
from support_exudyn.postprocessing.render import render, still

FOLDER = Path(__file__).parent / "pictures"
WORKERS = os.cpu_count() or 1
MIDDLE = 4.0  # of the rise [s]
RISE = (3.0, 5.0)  # [s]
PIN = paper_machine.CLEARANCE_PIN


@cache
def paper() -> Mapping[str, Result]:
    """The cases of `clearance_influence` at its steps, run when the first picture asks."""
    chosen = Options(Path(), WORKERS)
    return run_cases(ClearanceInfluence(chosen).cases(), chosen)


def with_clearance() -> Result:
    """The rise with 1.5 mm in the rear pin, with friction."""
    return paper()[influence_figures.DRY]


def machine(path: Path) -> None:
    """The support in mid-rise."""
    with whole_file(path) as temporary:
        Image.fromarray(still(with_clearance(), MIDDLE)).save(temporary, format="PNG", optimize=True)


def movie(path: Path) -> None:
    """The whole run as a movie, at twice its speed."""
    with TemporaryDirectory() as frames:
        out = Path(frames) / "frames"
        run = render(with_clearance(), out, frames_per_second=10.0, speed=2.0, size=(800, 450))
        shutil.move(str(run.movie), path)


def map_step_stiffness() -> Figure:
    """The map of `extremes` by step and stiffness: 169 of its scenes."""
    found = [case for case in mapped() if case.group == STEP_STIFFNESS]
    judged = list(zip(found, judge_all(found, WORKERS), strict=True))
    return extremes_figures.figures(judged)["map_step_stiffness"]


def drawn(figure: Callable[[], Figure]) -> Callable[[Path], object]:
    """The function that writes a figure of the runs."""
    return lambda path: style.save(figure(), path.parent, path.stem, pdf=False)


PICTURES: dict[str, Callable[[Path], object]] = {
    "machine.png": machine,
    "rise.gif": movie,
    "pin_force.png": drawn(lambda: influence_figures.influence_figures(paper())["fig5_pin_force"]),
    "journal_orbit.png": drawn(lambda: orbit(with_clearance(), PIN)),
    "spectrum.png": drawn(lambda: force_spectrum(with_clearance(), PIN, *RISE)),
    "map_step_stiffness.png": drawn(map_step_stiffness),
}


app = new_app("python -m studies.readme_pictures", (__doc__ or "").splitlines()[0], version_flags=())


@app.default
def draw(
    *names: Annotated[str, among(PICTURES, f"Which (all): {', '.join(PICTURES)}.")], out: Path = FOLDER
) -> None:
    """Make the pictures that were asked for.

    Args:
        out: Folder (studies/pictures).
    """
    with output_folder(out), style.look():
        for name in names or PICTURES:
            warn(str(out / name))
            PICTURES[name](out / name)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.readme_pictures`."""
    return carry_out(app, argv)


if __name__ == "__main__":
    sys.exit(main())
