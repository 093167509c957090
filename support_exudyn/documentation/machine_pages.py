"""Pages on the machines that come with the package: what their files say, drawings, and their channels."""

from itertools import takewhile
from pathlib import Path
from typing import Any

from support_exudyn.files.machines import SHIPPED, shipped
from support_exudyn.files.machines import __file__ as shipped_files
from support_exudyn.model.guides import ClearanceGuide
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.postprocessing.known_channels import ChannelTable, channels
from support_exudyn.scenario.scenario import Scenario

DPI = 110
MACHINES = """# Machines

These come with the package. `support-exudyn check NAME` reports what is known of a machine before a run, and
`machine("NAME")` is it in Python. Scenarios have `machine = "NAME"`. To have your own, copy a file
and change it.
"""
CHANNELS = """# Channels

A channel is a quantity over time, in SI units and radians. `result["NAME"]` gives it in Python, and
`support-exudyn show RUN 'NAME'` in a terminal. In a scenario `channels = ["tip.*"]` records only some.
`support-exudyn channels FILE`, or `channels(scenario)`, lists those of a scenario or machine before a run.
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


def channels_page() -> str:
    """A page of Markdown: all channels of every shipped machine, ideal and with clearance in a pin or guide."""
    parts = [CHANNELS]
    for name in SHIPPED:
        machine = shipped(name).machine
        linkage, ideal = machine.linkage(), channels(machine)
        parts += [f"## {name}", _table(ideal)]
        pin = next(iter(linkage.pins))
        pins = {pin: ClearancePin.simple(clearance=0.001, bore_radius=0.05)}
        loose = {f"a pin (here `{pin}`)": Scenario(machine=machine, pins=pins, duration=1.0)}
        for guide, slide in list(linkage.slides.items())[:1]:
            shape: dict[str, Any] = {"pin_radius": 0.02} if slide.turns else {"block": (0.1, 0.05)}
            guides = {guide: ClearanceGuide.simple(gaps=0.001, **shape)}
            loose[f"a guide (here `{guide}`)"] = Scenario(machine=machine, guides=guides, duration=1.0)
        for where, scenario in loose.items():
            more = {key: channel for key, channel in channels(scenario).items() if key not in ideal}
            parts += [f"With clearance in {where} there are also:", _table(ChannelTable(more, "channel"))]
    return "\n\n".join(parts) + "\n"


def _table(found: ChannelTable) -> str:
    rows = [f"| `{name}` | {unit} | {meaning} |" for name, unit, meaning in found.rows()]
    return "\n".join(["| channel | unit | meaning |", "|---|---|---|", *rows])
