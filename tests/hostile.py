"""What a computer can do to a program, for tests: full disks, interruptions."""

from __future__ import annotations

import math
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


# a user's own files and folders with names as of temporary ones, of this program or of earlier versions of it


class Interruption:
    """Interrupts this process once, soon after `now` is called for the first time.

    From another process, as the console does: threads of this one wait while the engine is at work.
    """

    _began = math.inf

    def __enter__(self) -> Interruption:
        command = ["sh", "-c", f"read begun; sleep 0.05; kill -INT {os.getpid()}"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE)
        return self

    def now(self, *unused: object) -> None:
        """The work has begun that is to be interrupted."""
        if self._began == math.inf:
            assert self._process.stdin is not None
            self._began = time.process_time()
            self._process.stdin.write(b"\n")
            self._process.stdin.flush()

    @property
    def work(self) -> float:
        """Processor time of this process since then [s], which others on the machine do not lengthen."""
        return time.process_time() - self._began

    def __exit__(self, *unused: object) -> None:
        self._process.kill()
        self._process.communicate()
