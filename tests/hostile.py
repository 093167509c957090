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

from support_exudyn.files.temporary import MARK, OWNER, PREFIX

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


def left_behind(folder: Path, name: str = "abc") -> Path:
    """A temporary folder as a killed process leaves it."""
    left = folder / f"{PREFIX}{name}"
    left.mkdir(parents=True)
    (left / OWNER).write_bytes(MARK)
    (left / "x.json").write_text("half", encoding="utf-8")
    return left


# a user's own files and folders with names as of temporary ones, of this program or of earlier versions of it
OWN_FILES = (
    *(".backup-2023-notes.txt", ".table-99999999-abc.parquet", ".a-1-b", f"{PREFIX}notes.txt"),
    *(
        ".export_2019_letters/a.txt",
        ".frames_2019_holiday/a.png",
        f"{PREFIX}mine/a.txt",
        f"{PREFIX}like/{OWNER}",
    ),
)


def with_own_files(folder: Path) -> list[Path]:
    """Such files of a user's in a folder."""
    made = [folder / name for name in OWN_FILES]
    for path in made:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("of the user", encoding="utf-8")
    return made


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
