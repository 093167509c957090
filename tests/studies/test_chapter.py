"""Chapters and their tables: kept whole, read back as they were, and shown without taking text for markup."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from studies.common.chapter import Chapter, JudgedClaim, Picture, Tile, without_references
from studies.common.study import save_table
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces.values.value import InputError

HOSTILE = "<script>alert('x')</script> | [red]no[/red] *a* `b`\n_c_ [d](http://e) &lt; back\\slash"
SHEET = Sheet(
    title="Forces",
    header=("case", "force [N]", "[n]"),
    rows=(("ideal", "51290.66 ± 0.01", "1"), (HOSTILE, "-0.5", "")),
    caption="± is the change when all steps are halved.",
)
CHAPTER = Chapter(
    study="forces",
    title="Forces",
    question="What holds?",
    method=("One.", "Two."),
    findings=("Three.",),
    pictures=(Picture("force", "Force over time."),),
    sheets=(SHEET, replace(SHEET, left=2), replace(SHEET, wide=True)),
    answer="Three.",
    numbers=("three: 3 ± 1 N",),
    tiles=(Tile("force", "1 N", "2 N", "+100 %"),),
    claims=(JudgedClaim("1", "section 3", "It grows.", "holds", "By 100 %.", figure="forces/force"),),
)


def test_a_chapter_is_read_back_as_it_was(tmp_path: Path) -> None:
    assert CHAPTER.save(tmp_path) == tmp_path / "chapter.json"
    assert Chapter.load(tmp_path) == CHAPTER
    older = json.loads((tmp_path / "chapter.json").read_text(encoding="utf-8"))
    del older["claims"], older["sheets"][0]["wide"]
    (tmp_path / "chapter.json").write_text(json.dumps(older), encoding="utf-8")
    assert Chapter.load(tmp_path) == replace(CHAPTER, claims=())


def test_a_chapter_is_written_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    CHAPTER.save(tmp_path)

    def half(path: Path, text: str, **_: str) -> None:
        path.write_bytes(text[: len(text) // 2].encode())
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_text", half)
        with pytest.raises(KeyboardInterrupt):
            replace(CHAPTER, title="Other").save(tmp_path)
    assert Chapter.load(tmp_path) == CHAPTER
    assert [path.name for path in tmp_path.iterdir()] == ["chapter.json"]


def test_a_missing_chapter_names_the_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"forces[/\\]chapter\.json: no such file"):
        Chapter.load(tmp_path / "forces")


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"title": 3}, "title: Input should be a valid string"),
        ({"method": "One."}, "method: Input should be a valid"),
        ({"colour": "red"}, "colour: Unexpected keyword argument"),
        ({"pictures": [{"stem": "../x", "caption": ""}]}, "pictures.0: .*stem = '../x': allowed: a file name"),
        (
            {"sheets": [{"title": "", "header": ["a"], "rows": [["1", "2"]]}]},
            "sheets.0: .*row 0 has 2 cells; allowed: 1",
        ),
    ],
)
def test_a_wrong_chapter_says_file_and_place(tmp_path: Path, change: dict[str, object], complaint: str) -> None:
    path = CHAPTER.save(tmp_path)
    path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | change), encoding="utf-8")
    with pytest.raises(InputError, match=f"{re.escape(str(path))}: {complaint}"):
        Chapter.load(tmp_path)


def test_a_torn_chapter_says_so(tmp_path: Path) -> None:
    path = CHAPTER.save(tmp_path)
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(InputError, match=f"{re.escape(str(path))}: Invalid JSON"):
        Chapter.load(tmp_path)


def test_a_sheet_refuses_rows_of_other_lengths() -> None:
    with pytest.raises(ValueError, match="row 1 has 1 cells; allowed: 2"):
        Sheet("t", ("a", "b"), (("1", "2"), ("3",)))
    with pytest.raises(ValueError, match="header"):
        Sheet("t", (), ())


def test_the_terminal_shows_cells_as_they_are() -> None:
    console = Console(width=300)
    with console.capture() as shown:
        console.print(SHEET.rich())
    assert "<script>alert('x')</script> | [red]no[/red] *a* `b`" in shown.get()
    assert "[n]" in shown.get()  # not taken for a style


def test_a_terminal_is_told_names_of_files_in_place_of_links() -> None:
    assert (
        without_references("It grows [@force], see [@other/table.1] [@].")
        == "It grows force, see other/table.1 [@]."
    )


def test_the_files_of_a_table_have_names_of_files_in_place_of_links(tmp_path: Path) -> None:
    linked = Sheet("Title [@force]", ("case", "n"), (("a [@other/table.1]", "1"),), "See [@force].")
    save_table(tmp_path / "table", linked, 100)
    assert (tmp_path / "table.csv").read_text(encoding="utf-8").split() == ["case,n", "a", "other/table.1,1"]
    text = (tmp_path / "table.txt").read_text(encoding="utf-8")
    assert "[@" not in text
    for part in ("Title force", "a other/table.1", "See force."):
        assert part in text
