"""What is said of a process: wall times, the machine, memory, and what importing the package takes."""

import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions

IMPORT = """
import time, exudyn
t = time.perf_counter()
from support_exudyn import ClearancePin, Scenario, machine, simulate  # imported when asked for
print(time.perf_counter() - t)
"""
IMPORTS = 5  # timed, of which the fastest counts
GROW = """
import sys
from pathlib import Path
from dataclasses import replace
from studies.benchmarking.scenes import SCENES
from support_exudyn import SolverSettings, simulate
def peak():  # of this program alone; getrusage would tell that of the process which started it too
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) / 1024
scene = replace(SCENES["drop"].scenario, record_period=0.1, step=2e-3, formulation=sys.argv[1],
                solver=SolverSettings(impact_steps=64, tolerance=1e-5))
simulate(replace(scene, duration=2.0))
before = peak()
simulate(replace(scene, duration=float(sys.argv[2])))
print(before, peak())
"""


def timed(run: Callable[[], object]) -> float:
    """Wall time of a run [s]."""
    began = time.perf_counter()
    run()
    return time.perf_counter() - began


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


def memory() -> str:
    """Peak memory of a run and of one fifty times as long, with records every 0.1 s."""
    if not Path("/proc/self/status").exists():
        return "Peak memory: this system does not tell."
    said = []
    for formulation in ("redundant", "compiled"):
        command = [sys.executable, "-c", GROW, formulation, "100"]
        before, after = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
        said.append(f"{formulation} {float(before):.0f} MB after 2 s, {float(after):.0f} MB after 100 s")
    return f"Peak memory of a process, records every 0.1 s: {'; '.join(said)}."


def importing() -> str:
    """What importing what a run is made of takes beyond the engine's import."""
    times = [
        float(subprocess.run([sys.executable, "-c", IMPORT], capture_output=True, text=True, check=True).stdout)
        for _ in range(IMPORTS)
    ]
    took = f"{min(times):.2f} s beyond exudyn's import (of {IMPORTS}; asked: 0.5 s)"
    return f"Importing what a run is made of takes {took}."
