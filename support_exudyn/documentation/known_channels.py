"""The channels of the machines that come with the package, as a page."""

from support_exudyn.files.machines import SHIPPED, shipped
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.known_channels import ChannelTable, channels
from support_exudyn.scenario.scenario import Scenario

TOP = """# Channels

A channel is a quantity over time, in SI units and radians. `result["NAME"]` gives it in Python, and
`support-exudyn show RUN 'NAME'` in a terminal. In a scenario `channels = ["tip.*"]` records only some.
`support-exudyn channels FILE`, or `channels(scenario)`, lists those of a scenario or machine before a run.
"""


def channels_page() -> str:
    """A page of Markdown: of every shipped machine all channels, with ideal pins and with one clearance pin."""
    parts = [TOP]
    for name in SHIPPED:
        machine = shipped(name).machine
        ideal = channels(machine)
        parts += [f"## {name}", _table(ideal)]
        pin = next(iter(machine.linkage().pins))
        pins = {pin: ClearancePin.simple(clearance=0.001, bore_radius=0.05)}
        known = channels(Scenario(machine=machine, pins=pins, duration=1.0))
        more = {key: one for key, one in known.items() if key not in ideal}
        parts += [
            f"With clearance in a pin (here `{pin}`) there are also:",
            _table(ChannelTable(more, "channel")),
        ]
    return "\n\n".join(parts) + "\n"


def _table(found: ChannelTable) -> str:
    rows = [f"| `{name}` | {unit} | {meaning} |" for name, unit, meaning in found.rows()]
    return "\n".join(["| channel | unit | meaning |", "|---|---|---|", *rows])
