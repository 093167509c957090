"""Files are written whole or not at all, and what a killed process leaves behind is removed."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from support_exudyn.files.temporary import PREFIX, workshop
from support_exudyn.files.whole_file import whole_file


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
