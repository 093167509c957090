from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from support_exudyn.files import remove_leftovers, whole_file


def names(folder: Path) -> list[str]:
    return sorted(item.name for item in folder.iterdir())


def test_what_was_written_is_there_afterwards(tmp_path: Path) -> None:
    with whole_file(tmp_path / "run.json") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "run.json").read_text() == "new"
    assert names(tmp_path) == ["run.json"]


def test_an_old_file_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "run.json").write_text("old")
    with whole_file(tmp_path / "run.json") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "run.json").read_text() == "new"


def test_the_old_file_stays_until_the_new_one_is_whole(tmp_path: Path) -> None:
    (tmp_path / "run.json").write_text("old")
    with whole_file(tmp_path / "run.json") as temporary:
        temporary.write_text("half")
        assert (tmp_path / "run.json").read_text() == "old"


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_an_error_leaves_the_old_file_and_nothing_else(tmp_path: Path, error: type[BaseException]) -> None:
    (tmp_path / "run.json").write_text("old")
    with pytest.raises(error), whole_file(tmp_path / "run.json") as temporary:  # noqa: PT012
        temporary.write_text("half")
        raise error
    assert (tmp_path / "run.json").read_text() == "old"
    assert names(tmp_path) == ["run.json"]


def test_an_error_makes_no_file_where_there_was_none(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), whole_file(tmp_path / "run.json") as temporary:  # noqa: PT012
        temporary.write_text("half")
        raise RuntimeError
    assert names(tmp_path) == []


def test_missing_folders_are_made(tmp_path: Path) -> None:
    with whole_file(tmp_path / "a" / "b" / "run.json") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "a" / "b" / "run.json").read_text() == "new"


def test_a_path_may_be_a_string(tmp_path: Path) -> None:
    with whole_file(str(tmp_path / "run.json")) as temporary:
        temporary.write_text("new")
    assert names(tmp_path) == ["run.json"]


def test_temporary_file_has_the_same_ending(tmp_path: Path) -> None:
    # writers of pictures choose the format by it
    with whole_file(tmp_path / "figure.png") as temporary:
        assert temporary.suffix == ".png"
        assert temporary.parent == tmp_path


@pytest.mark.skipif(os.name == "nt", reason="no file modes on Windows")
def test_file_may_be_read_like_any_other_new_file(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    with whole_file(tmp_path / "whole") as temporary:
        temporary.write_text("")
    assert (tmp_path / "whole").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.skipif(os.name == "nt", reason="other processes cannot be asked for on Windows")
def test_leftovers_of_dead_processes_are_removed_and_nothing_else(tmp_path: Path) -> None:
    gone = 2**22 + 1  # no process has such a number
    leftover = tmp_path / f".run-{gone}-ab_1cd.json"
    bare = tmp_path / f".whole-{gone}-abcd"
    kept = [tmp_path / "run.json", tmp_path / f".run-{os.getpid()}-ab1cd.json", tmp_path / ".gitignore"]
    for path in (leftover, bare, *kept):
        path.write_text("")
    remove_leftovers(tmp_path)
    assert names(tmp_path) == sorted(path.name for path in kept)


def test_a_leftover_can_be_told_by_its_name(tmp_path: Path) -> None:
    with whole_file(tmp_path / "a-run.json") as temporary:
        remove_leftovers(tmp_path)  # its process is this one
        assert f"-{os.getpid()}-" in temporary.name
        assert temporary.exists()


@pytest.mark.skipif(sys.platform != "linux", reason="asks /proc")
def test_what_a_process_left_behind_that_nobody_has_waited_for_is_removed(tmp_path: Path) -> None:
    ended = os.fork()
    if not ended:
        os._exit(0)
    left = tmp_path / f".row-{ended}-abc_1.json"
    left.write_text("half", encoding="utf-8")
    try:
        os.waitid(os.P_PID, ended, os.WEXITED | os.WNOWAIT)  # it has ended, and stays in the list of processes
        remove_leftovers(tmp_path)
        assert not left.exists()
    finally:
        os.waitpid(ended, 0)
