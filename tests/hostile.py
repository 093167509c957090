"""What a computer can do to a program, for tests: full disks, interruptions."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

posix_only = pytest.mark.skipif(os.name == "nt", reason="signals and limits of POSIX")
DISKS = ("full disk", "limit of size")


@contextmanager
def little_room(folder: Path, size: int, kind: str) -> Iterator[Path]:
    """A folder that takes no more than so many bytes ("full disk"), or no longer files ("limit of size")."""
    if kind == "full disk":
        place = folder / "disk"
        place.mkdir()
        command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(place)]
        if sys.platform != "linux" or subprocess.run(command, capture_output=True, check=False).returncode:
            pytest.skip("a small disk cannot be mounted here")
        try:
            yield place
        finally:
            subprocess.run(["umount", "-l", str(place)], capture_output=True, check=True)
        return
    if os.name == "nt":
        pytest.skip("no such limit on Windows")
    import resource

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield folder
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


class Interruption:
    """Interrupts this process once, so many seconds from now.

    From another process, as the console does: threads of this one wait while the engine is at work.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds

    def __enter__(self) -> Interruption:
        self.sent = time.perf_counter() + self._seconds  # it starts to wait after that, so never sooner
        self._process = subprocess.Popen(["sh", "-c", f"sleep {self._seconds}; kill -INT {os.getpid()}"])
        return self

    def __exit__(self, *unused: object) -> None:
        self._process.kill()
        self._process.wait()
