"""Many files by one temporary folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn.files.temporary import PREFIX, workshop
from support_exudyn.files.whole_file import whole_file


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
