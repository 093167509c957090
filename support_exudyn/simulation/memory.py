"""How much memory is free."""

import os
from pathlib import Path

from support_exudyn.mechanics.channels import chosen
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

UNKNOWN = 2**36  # bytes, where the system does not tell how much there is
ASKED = Path("/proc/meminfo")
OF_GROUP = (Path("/sys/fs/cgroup/memory.max"), Path("/sys/fs/cgroup/memory.current"))


def available() -> int:
    """Memory that is free for this process [bytes], as far as the system tells."""
    return min(_of_machine(), _of_group())


def _of_machine() -> int:
    try:
        lines = ASKED.read_text(encoding="ascii", errors="replace").splitlines()
        return next(int(line.split()[1]) * 1024 for line in lines if line.startswith("MemAvailable:"))
    except (OSError, ValueError, LookupError, StopIteration):
        pass
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):  # Windows
        return UNKNOWN


def _of_group() -> int:
    """What a container leaves."""
    try:
        most, taken = (int(path.read_text(encoding="ascii")) for path in OF_GROUP)
    except (OSError, ValueError):  # there is none, or it has no limit
        return UNKNOWN
    return max(0, most - taken)


NUMBER = 2 * 8  # bytes of a number at a record, and of the states that it follows from; 2.9 * 8 were measured
GIGA = 1e9


def check_room(scenario: Scenario) -> None:
    """Raise InputError if the records of a run do not fit into memory, with what does.

    What is asked for is the least that it takes.
    """
    records = scenario.duration / scenario.record_period + 1.0
    count = len(chosen(scenario.channel_definitions, scenario.channels))
    needed, there = records * count * NUMBER, available()
    if needed > there:
        period = scenario.record_period * needed / there
        raise InputError(
            f"duration = {scenario.duration:g} s, record_period = {scenario.record_period:g} s: {records:.3g} "
            f"records of {count} channels take {needed / GIGA:.3g} GB and more, {there / GIGA:.3g} GB are "
            f"free; allowed: a shorter duration, fewer channels, or records at least {_up(period):g} s apart"
        )


def _up(number: float) -> float:
    """In two digits, not below it."""
    return float(f"{1.05 * number:.2g}")
