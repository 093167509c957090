"""Several files, all or none."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn.postprocessing.export.whole_set import whole_set

FILES = ("a.bin", "b.bin", "all.index")


def write(folder: Path, text: str, size: int = 1) -> None:
    with whole_set(folder, FILES) as temporary:
        for name in FILES:
            (temporary / name).write_text(text * size, encoding="utf-8")


def texts(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


def test_all_files_are_there_and_nothing_else(tmp_path: Path) -> None:
    write(tmp_path / "deep" / "set", "old")
    write(tmp_path / "deep" / "set", "new")
    assert texts(tmp_path / "deep" / "set") == dict.fromkeys(FILES, "new")


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_after_an_interruption_all_is_as_it_was(tmp_path: Path, error: type[BaseException]) -> None:
    write(tmp_path / "there", "old")

    def broken(folder: Path) -> None:
        with whole_set(folder, FILES) as temporary:
            (temporary / FILES[0]).write_text("new", encoding="utf-8")
            raise error

    for folder in (tmp_path / "there", tmp_path / "missing"):
        with pytest.raises(error):
            broken(folder)
    assert texts(tmp_path / "there") == dict.fromkeys(FILES, "old")
    assert not (tmp_path / "missing").exists()
