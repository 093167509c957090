"""The machine in words, and tables for Markdown."""

import os
import platform
from pathlib import Path

from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions


def machine() -> str:
    """Processor, Python and versions."""
    name = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        models = [
            line.partition(":")[2].strip() for line in cpuinfo.read_text().splitlines() if "model name" in line
        ]
        name = models[0] if models else name
    packages = ", ".join(f"{package} {version}" for package, version in versions().items())
    return f"{name}, {os.cpu_count()} cores. {packages}."


def markdown(sheet: Sheet) -> str:
    """A table with pipes between its cells."""
    rows = [sheet.header, ["---"] * len(sheet.header), *sheet.rows]
    lines = [f"| {' | '.join(cell.replace('|', '/') for cell in row)} |" for row in rows]
    return "\n".join([f"**{sheet.title}**", "", *lines, "", sheet.caption]).rstrip()
