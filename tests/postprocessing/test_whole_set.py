"""Several files, all or none."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn.postprocessing.export.whole_set import whole_set
from tests.hostile import DISKS, left_behind, little_room, posix_only, with_own_files

FILES, INDEXES = ("a.bin", "b.bin"), ("all.index",)


def write(folder: Path, text: str, size: int = 1) -> None:
    with whole_set(folder, FILES, INDEXES) as temporary:
        for name in (*FILES, *INDEXES):
            (temporary / name).write_text(text * size, encoding="utf-8")


def texts(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


def test_all_files_are_there_and_nothing_else(tmp_path: Path) -> None:
    write(tmp_path / "deep" / "set", "old")
    write(tmp_path / "deep" / "set", "new")
    assert texts(tmp_path / "deep" / "set") == dict.fromkeys((*FILES, *INDEXES), "new")


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_after_an_interruption_all_is_as_it_was(tmp_path: Path, error: type[BaseException]) -> None:
    write(tmp_path / "there", "old")

    def broken(folder: Path) -> None:
        with whole_set(folder, FILES, INDEXES) as temporary:
            (temporary / FILES[0]).write_text("new", encoding="utf-8")
            raise error

    for folder in (tmp_path / "there", tmp_path / "missing"):
        with pytest.raises(error):
            broken(folder)
    assert texts(tmp_path / "there") == dict.fromkeys((*FILES, *INDEXES), "old")
    assert not (tmp_path / "missing").exists()


def test_there_is_no_index_while_files_are_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, "old")
    replace, context = Path.replace, []

    def watched(path: Path, target: Path) -> Path:
        context.append((path.name, (tmp_path / INDEXES[0]).exists()))
        return replace(path, target)

    monkeypatch.setattr(Path, "replace", watched)
    write(tmp_path, "new")
    assert context == [("a.bin", False), ("b.bin", False), ("all.index", False)]


def test_stale_files_go_and_others_stay(tmp_path: Path) -> None:
    for name in ("c.bin", "mine.txt"):
        (tmp_path / name).write_text("old", encoding="utf-8")
    with whole_set(tmp_path, FILES, INDEXES, stale={"a.bin", "c.bin"}) as temporary:
        for name in (*FILES, *INDEXES):
            (temporary / name).write_text("new", encoding="utf-8")
    assert sorted(texts(tmp_path)) == ["a.bin", "all.index", "b.bin", "mine.txt"]


@pytest.mark.parametrize("kind", DISKS)
def test_a_full_disk_leaves_the_old_files(tmp_path: Path, kind: str) -> None:
    with little_room(tmp_path, 65536, kind) as folder:
        write(folder, "old")
        with pytest.raises(OSError, match="it cannot be written"):
            write(folder, "new", 65536)
        assert texts(folder) == dict.fromkeys((*FILES, *INDEXES), "old")


@posix_only
def test_what_a_killed_process_has_left_is_removed_by_the_next(tmp_path: Path) -> None:
    left, own = left_behind(tmp_path), with_own_files(tmp_path)
    write(tmp_path, "new")
    assert not left.exists()
    assert all(path.exists() for path in own)
