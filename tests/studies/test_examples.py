"""The examples are short, say what they are, and each draws its picture."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from PIL import Image

from support_exudyn.documentation.gallery import run_example, scripts

EXAMPLES = Path(__file__).parents[2] / "studies" / "examples"
FOUND = scripts(EXAMPLES)


def test_there_are_some_and_the_page_tells_of_all() -> None:
    page = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    assert 8 <= len(FOUND) <= 13
    assert [path.name for path in FOUND if f"[{path.name}]({path.name})" not in page] == []


@pytest.mark.parametrize("script", [path for path in FOUND if path.suffix == ".py"], ids=lambda path: path.stem)
def test_a_script_is_short_and_has_a_title(script: Path) -> None:
    text = script.read_text(encoding="utf-8")
    assert 20 <= len([line for line in text.splitlines() if line.strip()]) <= 64
    title, blank, *rest = (ast.get_docstring(ast.parse(text)) or "").splitlines()
    assert (title[:1].isupper(), blank, bool(rest)) == (True, "", True)


@pytest.mark.parametrize(
    "script",
    [
        pytest.param(path, marks=[] if path.stem == "own_exudyn_model" else [pytest.mark.slow], id=path.stem)
        for path in FOUND
    ],
)
def test_an_example_draws_its_picture(script: Path, tmp_path: Path) -> None:
    if script.suffix == ".ipynb":
        pytest.importorskip("nbclient")
    run_example(script, tmp_path)
    with Image.open(tmp_path / f"{script.stem}.png") as picture:
        levels = picture.convert("L").getextrema()
        assert min(picture.size) >= 300
        assert levels[1] - levels[0] > 100  # something is drawn
