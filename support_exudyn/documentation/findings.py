"""What the studies found, as a page made of the chapters that a run of them has left."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

from user_forces.values.value import InputError

REFERENCE = re.compile(r" ?\(\[@[^)]*\)|\[@(\w+)\]")  # of a sentence to a figure or table
TOP = "# What the studies found"
NONE = """Run the studies, and build this site with their results:

    python -m studies
    python -m support_exudyn docs --results results

This page then has the question, the answer and the findings of each study, with the numbers of that run. The
report of the studies, `results/report.html`, has all figures and tables.
"""


def findings_page(results: Path | None, pictures: Path) -> str:
    """A page of Markdown with question, answer, findings and first picture of every study.

    Arguments:
        results: folder that `python -m studies` has written; None: the page says how to make it.
        pictures: folder for the pictures, beside the page.

    Raises InputError if no study has left its chapter there.
    """
    if results is None:
        return f"{TOP}\n\n{NONE}"
    chapters = sorted(results.glob("*/chapter.json"))
    if not chapters:
        raise InputError(
            f"{results}: no study has left a chapter there; allowed: the folder of python -m studies"
        )
    pictures.mkdir(parents=True, exist_ok=True)
    return "\n\n".join([TOP, *(part for path in chapters for part in _told(path, pictures))]) + "\n"


def _told(path: Path, pictures: Path) -> list[str]:
    chapter: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    parts = [f"## {chapter['title']}", f"*{chapter['question']}*", _plain(chapter["answer"])]
    parts.append("\n".join(f"- {_plain(text)}" for text in (*chapter["numbers"], *chapter["findings"])))
    name = path.parent.name
    for picture in [f"{one['stem']}.png" for one in chapter["pictures"][:1]]:
        if (path.parent / picture).is_file():
            shutil.copy(path.parent / picture, pictures / f"{name}_{picture}")
            parts.append(f"![{chapter['title']}]({pictures.name}/{name}_{picture})")
    return parts


def _plain(text: str) -> str:
    """A sentence without its references, whose tables stand in the report."""
    return REFERENCE.sub(lambda found: found.group(1) or "", text).replace("[", "\\[").replace("]", "\\]")
