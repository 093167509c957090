"""How much memory is free."""

import os
from pathlib import Path

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
