"""The page on the machines that come with the package: what their files say, and drawings."""

from itertools import takewhile
from pathlib import Path

from support_exudyn.files.machines import SHIPPED, shipped
from support_exudyn.files.machines import __file__ as shipped_files
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.scenario.scenario import Scenario

DPI = 110
MACHINES = """# Machines

These come with the package. `support-exudyn check NAME` reports what is known of a machine before a run,
`support-exudyn channels NAME` what a run can record, and
`machine("NAME")` is it in Python. Scenarios have `machine = "NAME"`. To have your own, copy a file
and change it.
"""


def machines_page(pictures: Path) -> str:
    """A page of Markdown: of every shipped machine its name, the comment of its file, and a drawing.

    Arguments:
        pictures: folder for the drawings, next to the page.
    """
    pictures.mkdir(parents=True, exist_ok=True)
    parts = [MACHINES]
    for name in SHIPPED:
        data, picture = shipped(name), f"machine_{name}.png"
        machine_drawing(Scenario(machine=data.machine, duration=1.0)).savefig(pictures / picture, dpi=DPI)
        sources = "\n".join(f"- {what.replace('_', ' ')}: {source}" for what, source in data.sources.items())
        parts += [f"## {name}", _comment(name), f"![{name}]({pictures.name}/{picture})", sources]
    return "\n\n".join(parts) + "\n"


def _comment(name: str) -> str:
    """The comment at the top of a machine's file, as it stands there."""
    text = (Path(shipped_files).parent / f"{name}.toml").read_text(encoding="utf-8")
    lines = takewhile(lambda line: line.startswith("#"), text.splitlines())
    return "\n".join(["```text", *(line.removeprefix("#").removeprefix(" ") for line in lines), "```"])
