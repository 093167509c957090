"""Files where they cannot be written, on full disks, and by several processes at once."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.files.temporary import remove_leftovers
from support_exudyn.files.whole_file import LOCK, whole_file, writing_alone
from tests.hostile import DISKS, little_room, posix_only
from tests.processes import ROOT, environment


def names(folder: Path) -> list[str]:
    return sorted(item.name for item in folder.iterdir())


# --- places ---


def a_folder(path: Path) -> Path:
    (path / "there").mkdir()
    return path / "there"


def below_a_file(path: Path) -> Path:
    (path / "there").write_text("old", encoding="utf-8")
    return path / "there" / "run.json"


def a_loop_of_links(path: Path) -> Path:
    (path / "there").symlink_to(path / "back")
    (path / "back").symlink_to(path / "there")
    return path / "there"


def with_a_nul(path: Path) -> Path:
    return path / "a\0b"


def read_only(path: Path) -> Path:
    (path / "there").write_text("old", encoding="utf-8")
    (path / "there").chmod(0o444)
    if os.access(path / "there", os.W_OK):
        pytest.skip("this user may write everywhere")
    return path / "there"


PLACES = [a_folder, below_a_file, a_loop_of_links, with_a_nul, read_only]


@posix_only
@pytest.mark.parametrize("place", PLACES)
def test_what_cannot_be_written_is_said_before_the_work(tmp_path: Path, place: object) -> None:
    path = place(tmp_path)  # type: ignore[operator]
    before = names(tmp_path)
    with pytest.raises(OSError, match="it cannot be written") as caught, whole_file(path):
        pytest.fail("the work is begun")
    assert caught.value.filename == str(path)
    assert caught.value.errno
    assert names(tmp_path) == before


# --- disks ---


@pytest.mark.parametrize("kind", DISKS)
def test_a_full_disk_leaves_the_old_file_and_says_which_could_not_be_written(tmp_path: Path, kind: str) -> None:
    with little_room(tmp_path, 16384, kind) as folder:
        (folder / "run.json").write_text("old", encoding="utf-8")
        with (
            pytest.raises(OSError, match="it cannot be written") as caught,
            whole_file(folder / "run.json") as new,
        ):
            new.write_text("x" * 65536, encoding="utf-8")
        assert caught.value.errno == (errno.ENOSPC if kind == "full disk" else errno.EFBIG)
        assert caught.value.filename == str(folder / "run.json")
        assert (folder / "run.json").read_text(encoding="utf-8") == "old"
        assert names(folder) == ["run.json"]


# --- several processes ---

HOLD = """
import sys, time
from pathlib import Path
from support_exudyn.files.whole_file import whole_file, writing_alone
folder = Path(sys.argv[1])
with writing_alone(folder), whole_file(folder / "row.json") as temporary:
    print(temporary.parent.name, flush=True)
    time.sleep(120.0)
"""


@posix_only
def test_a_folder_has_one_writer_and_is_free_when_that_is_killed(tmp_path: Path) -> None:
    command = [sys.executable, "-c", HOLD, str(tmp_path)]
    with subprocess.Popen(command, cwd=ROOT, env=environment(), stdout=subprocess.PIPE, text=True) as other:
        try:
            assert other.stdout is not None
            temporary = other.stdout.readline().strip()
            with pytest.raises(OSError, match=rf"another process \({other.pid}\) is writing there"):  # noqa: SIM117
                with writing_alone(tmp_path):
                    pytest.fail("both write")
            remove_leftovers(tmp_path)  # not what is being written
            assert names(tmp_path) == sorted([LOCK, temporary])
        finally:
            other.send_signal(signal.SIGKILL)
    with writing_alone(tmp_path):
        remove_leftovers(tmp_path)
        assert names(tmp_path) == [LOCK]
    assert names(tmp_path) == []
