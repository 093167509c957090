"""The channels of the machines that come with the package, as a page."""

from typing import Any

from support_exudyn.files.machines import SHIPPED, shipped
from support_exudyn.model.guides import ClearanceGuide
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.known_channels import ChannelTable, channels
from support_exudyn.scenario.scenario import Scenario

TOP = """# Channels

A channel is a quantity over time, in SI units and radians. `result["NAME"]` gives it in Python, and
`support-exudyn show RUN 'NAME'` in a terminal. In a scenario `channels = ["tip.*"]` records only some.
`support-exudyn channels FILE`, or `channels(scenario)`, lists those of a scenario or machine before a run.
"""


def channels_page() -> str:
    """A page of Markdown: all channels of every shipped machine, ideal and with clearance in a pin or guide."""
    parts = [TOP]
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
            more = {key: one for key, one in channels(scenario).items() if key not in ideal}
            parts += [f"With clearance in {where} there are also:", _table(ChannelTable(more, "channel"))]
    return "\n\n".join(parts) + "\n"


def _table(found: ChannelTable) -> str:
    rows = [f"| `{name}` | {unit} | {meaning} |" for name, unit, meaning in found.rows()]
    return "\n".join(["| channel | unit | meaning |", "|---|---|---|", *rows])
