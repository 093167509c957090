"""Files are written whole or not at all; a folder has a single writer; leftovers are removed."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from support_exudyn.files.whole_file import (
    LOCK,
    PREFIX,
    contents,
    remove_leftovers,
    whole_file,
    workshop,
    writing_alone,
)
from tests.hostile import DISKS, little_room, posix_only
from tests.processes import ROOT, environment
from user_forces import InputError


def names(folder: Path) -> list[str]:
    return sorted(item.name for item in folder.iterdir())


def test_an_old_file_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "run.json").write_text("old")
    with whole_file(tmp_path / "run.json") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "run.json").read_text() == "new"


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_an_error_leaves_the_old_file_and_nothing_else(tmp_path: Path, error: type[BaseException]) -> None:
    (tmp_path / "run.json").write_text("old")
    with pytest.raises(error), whole_file(tmp_path / "run.json") as temporary:  # noqa: PT012
        temporary.write_text("half")
        raise error
    assert (tmp_path / "run.json").read_text() == "old"
    assert names(tmp_path) == ["run.json"]


@pytest.mark.skipif(os.name == "nt", reason="no file modes on Windows")
def test_file_may_be_read_like_any_other_new_file(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    with whole_file(tmp_path / "whole") as temporary:
        temporary.write_text("")
    assert (tmp_path / "whole").stat().st_mode == (tmp_path / "plain").stat().st_mode


def leave_half_done(path: Path, within: Path) -> None:
    """Fail in the middle of writing."""
    with whole_file(path, within, lasting=False) as temporary:
        temporary.write_text("half", encoding="utf-8")
        raise LookupError


def test_files_are_written_one_after_the_other_also_after_an_unfinished_file(tmp_path: Path) -> None:
    with workshop(tmp_path) as within:
        for name in "ab":
            with whole_file(tmp_path / "runs" / f"{name}.txt", within) as temporary:
                assert temporary.parent == within
                temporary.write_text(name, encoding="utf-8")
            with pytest.raises(LookupError):
                leave_half_done(tmp_path / "c.txt", within)
    texts = {path.name: path.read_text(encoding="utf-8") for path in (tmp_path / "runs").iterdir()}
    assert texts == {"a.txt": "a", "b.txt": "b"}
    assert not (tmp_path / "c.txt").exists()
    assert not list(tmp_path.rglob(f"{PREFIX}*"))


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


def read_only(path: Path) -> Path:
    (path / "there").write_text("old", encoding="utf-8")
    (path / "there").chmod(0o444)
    if os.access(path / "there", os.W_OK):
        pytest.skip("this user may write everywhere")
    return path / "there"


@posix_only
@pytest.mark.parametrize("place", [a_folder, below_a_file, a_loop_of_links, read_only])
def test_a_path_that_cannot_be_written_is_refused_before_the_work(tmp_path: Path, place: object) -> None:
    path = place(tmp_path)  # type: ignore[operator]
    before = names(tmp_path)
    with pytest.raises(OSError, match="it cannot be written") as caught, whole_file(path):
        pytest.fail("the work is begun")
    assert caught.value.filename == str(path)
    assert caught.value.errno
    assert names(tmp_path) == before


@pytest.mark.parametrize("kind", DISKS)
def test_a_full_disk_leaves_the_old_file_and_names_it(tmp_path: Path, kind: str) -> None:
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


@posix_only
def test_pipes_and_files_larger_than_allowed_are_refused_unread(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with (tmp_path / "large").open("wb") as file:
        file.truncate(10**12)
    for name, reason in (("pipe", "no regular file"), ("large", "has more than 100 bytes")):
        with pytest.raises(InputError, match=f"{name}: .*{reason}"):
            contents(tmp_path / name, 100)


# --- several processes ---

HOLD = """
import sys, time
from pathlib import Path
from support_exudyn.files.whole_file import whole_file, writing_alone
folder = Path(sys.argv[1])
with writing_alone(folder), whole_file(folder / "row.json") as temporary:
    print(temporary.name, flush=True)
    time.sleep(120.0)
"""


@posix_only
def test_a_folder_has_one_writer_and_is_free_after_that_is_killed(tmp_path: Path) -> None:
    command = [sys.executable, "-c", HOLD, str(tmp_path)]
    with subprocess.Popen(command, cwd=ROOT, env=environment(), stdout=subprocess.PIPE, text=True) as other:
        try:
            assert other.stdout is not None
            temporary = other.stdout.readline().strip()
            with pytest.raises(OSError, match="another process is writing there"):  # noqa: SIM117
                with writing_alone(tmp_path):
                    pytest.fail("both write")
            remove_leftovers(tmp_path)  # a folder of today may still be written to
            assert names(tmp_path) == sorted([LOCK, temporary])
        finally:
            other.send_signal(signal.SIGKILL)
    with writing_alone(tmp_path):
        remove_leftovers(tmp_path, older=0.0)
        assert names(tmp_path) == [LOCK]
    assert names(tmp_path) == []
