"""What a computer can do to a program, for tests: full disks, interruptions."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

posix_only = pytest.mark.skipif(os.name == "nt", reason="signals and limits of POSIX")
DISKS = ("full disk", "limit of size")


@contextmanager
def little_room(folder: Path, size: int, kind: str) -> Iterator[Path]:
    """A folder to which no more than so many bytes can be written: "full disk", or "limit of size" of a file."""
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
    """Interrupts this process once, so many seconds from now, as the console does."""

    def __init__(self, seconds: float) -> None:
        self.sent = 0.0
        self._timer = threading.Timer(seconds, self._send)

    def _send(self) -> None:
        self.sent = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)

    def __enter__(self) -> Interruption:
        self._timer.start()
        return self

    def __exit__(self, *unused: object) -> None:
        self._timer.cancel()
        self._timer.join()
