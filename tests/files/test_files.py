"""Files are written whole or not at all, and what a killed process leaves behind is removed."""

from __future__ import annotations

import os
import threading
from pathlib import Path

import pytest

from support_exudyn.files.temporary import OWNER, PREFIX, remove_leftovers, workshop
from support_exudyn.files.whole_file import whole_file
from tests.hostile import left_behind, posix_only, with_own_files


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


@posix_only
def test_what_nobody_holds_and_says_that_it_is_ours_is_removed_and_nothing_else(tmp_path: Path) -> None:
    own = with_own_files(tmp_path) + with_own_files(tmp_path / "deeper")
    left = [left_behind(tmp_path), left_behind(tmp_path / "deeper")]
    remove_leftovers(tmp_path)
    assert [path.exists() for path in left] == [False, True]
    remove_leftovers(tmp_path, below=True)
    assert not left[1].exists()
    assert all(path.read_text(encoding="utf-8") == "of the user" for path in own)


@posix_only
@pytest.mark.parametrize("inside", [(), (OWNER,)])
def test_what_a_process_leaves_that_is_killed_while_it_makes_or_removes_the_folder_is_removed(
    tmp_path: Path, inside: tuple[str, ...]
) -> None:
    left = tmp_path / f"{PREFIX}abc"
    left.mkdir()
    for name in inside:
        (left / name).write_bytes(b"")
    (tmp_path / f"{PREFIX}full").mkdir()
    (tmp_path / f"{PREFIX}full" / OWNER).write_bytes(b"")
    (tmp_path / f"{PREFIX}full" / "a.txt").write_text("of the user", encoding="utf-8")
    remove_leftovers(tmp_path)
    assert names(tmp_path) == [f"{PREFIX}full"]


@posix_only
def test_files_are_written_while_another_process_removes_what_was_left(tmp_path: Path) -> None:
    ended = threading.Event()

    def remove() -> None:
        while not ended.is_set():
            remove_leftovers(tmp_path)

    other = threading.Thread(target=remove)
    other.start()
    try:
        for n in range(300):
            with whole_file(tmp_path / f"{n}.txt", lasting=False) as temporary:
                temporary.write_text(str(n), encoding="utf-8")
    finally:
        ended.set()
        other.join()
    assert sorted(names(tmp_path)) == sorted(f"{n}.txt" for n in range(300))


@posix_only
def test_a_link_with_the_name_of_a_leftover_leads_nowhere(tmp_path: Path) -> None:
    left = left_behind(tmp_path / "elsewhere")
    (tmp_path / f"{PREFIX}link").symlink_to(left)
    inside = tmp_path / f"{PREFIX}inside"
    inside.mkdir()
    (inside / OWNER).symlink_to(left / OWNER)
    remove_leftovers(tmp_path)
    assert left.exists()
    assert inside.exists()


def leave_half_done(path: Path, within: Path) -> None:
    """Fail in the middle of writing."""
    with whole_file(path, within, lasting=False) as temporary:
        temporary.write_text("half", encoding="utf-8")
        raise LookupError


def test_files_are_written_one_after_the_other_also_after_one_that_was_not_finished(tmp_path: Path) -> None:
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
