"""Chapters and their tables: kept whole, read back as they were, and shown without taking text for markup."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from studies.common.words import Chapter, JudgedClaim, Picture, Tile
from support_exudyn.postprocessing.page.pieces import Sheet

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
    assert Chapter.load(tmp_path) == CHAPTER.model_copy(update={"claims": ()})
