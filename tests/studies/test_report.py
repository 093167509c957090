"""The report: complete, self-contained, and safe from what stands in its texts."""

from __future__ import annotations

import base64
import json
from html.parser import HTMLParser
from pathlib import Path

import pytest

from studies import report
from studies.common.chapter import Chapter, Picture
from studies.reporting.content import verdict_class
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions
from user_forces.values.value import InputError

PNG = base64.b64decode(  # one white pixel
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mP8/x8AAwMCAO+ip1sAAAAASUVORK5CYII="
)
TITLE = "Clearance in the rear-link pin of a hydraulic support: the published results repeated"
HOSTILE = "<script>alert(1)</script> | \"quoted\" & '<img src=http://x.example/>'\n- new line"
VERDICTS = (
    "holds",
    "holds only for clearances above 1 mm",
    "not supported",
    "cannot be judged: no masses",
    "HOLDS",
)


def chapter(name: str, text: str = "A sentence.") -> Chapter:
    claims = tuple((f"{text} {n}", "0.25 ± 0.01", verdict) for n, verdict in enumerate(VERDICTS))
    return Chapter(
        study=name,
        title=f"Title of {name} {text}",
        question=f"Question of {name}? {text}",
        method=(f"Method of {name}. {text}",),
        findings=(f"Finding of {name}: 1.5 ± 0.1 mm. {text}",),
        pictures=(Picture("figure one", f"Caption of {name}. {text}"),),
        sheets=(
            Sheet(f"Sheet of {name} {text}", ("quantity", text), (("a", "1.0"), (text, "-2.0")), text),
            Sheet(f"Claims of {name}", ("claim", "here", "verdict"), claims, wide=True),
        ),
    )


def put(out: Path, content: Chapter) -> Path:
    """The files that a study leaves."""
    folder = out / content.study
    folder.mkdir(parents=True)
    content.save(folder)
    for picture in content.pictures:
        (folder / f"{picture.stem}.png").write_bytes(PNG)
    summary = {"study": content.study, "versions": versions(), "wall_s": 12.345, "numbers": []}
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    return folder


class Page(HTMLParser):
    """What stands in a page: tags with their attributes, and text by the tag around it."""

    EMPTY = ("meta", "img", "br", "link")

    def __init__(self, source: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str]]] = []
        self.texts: list[tuple[str, str]] = []
        self.open: list[str] = []
        self.feed(source)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, {name: value or "" for name, value in attrs}))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and data.strip():
            self.texts.append((self.open[-1], data.replace("\u00a0", " ")))

    def all(self, tag: str) -> list[dict[str, str]]:
        return [attributes for name, attributes in self.tags if name == tag]

    def text(self, tag: str) -> list[str]:
        return [text for name, text in self.texts if name == tag]


@pytest.fixture
def out(tmp_path: Path) -> Path:
    for content in (chapter("claims"), chapter("drive_mode", HOSTILE), chapter("clearance_influence")):
        put(tmp_path, content)
    assert report.main(["--out", str(tmp_path)]) == 0
    return tmp_path


@pytest.fixture
def page(out: Path) -> Page:
    return Page((out / "report.html").read_text(encoding="utf-8"))


def test_the_page_holds_everything(page: Page) -> None:
    assert page.open == []  # every tag is closed
    assert page.text("h1") == page.text("title") == [TITLE]
    headings = page.text("h2")
    assert headings[0] == "Contents"
    # the order of the studies, others after them; here drive_mode or claims may be either
    assert headings[1].startswith("1. Title of clearance_influence")
    assert headings[-2:] == ["4. Assumptions", "5. Versions and how to repeat"]
    body = " ".join(text for _, text in page.texts)
    for name in ("claims", "drive_mode", "clearance_influence"):
        for part in ("Question", "Method", "Finding", "Caption", "Sheet", "Claims"):
            assert f"{part} of {name}" in body
    assert "1.5 ± 0.1 mm" in body
    for name, version in versions().items():
        assert name in body
        assert version in body
    assert "python -m studies.report" in body
    assert page.text("td").count("12.3") == 3  # wall times [s]
    assert "37.0" in page.text("td")


def test_figures_and_tables_are_numbered_throughout(page: Page) -> None:
    captions = page.text("figcaption")
    assert [c for c in captions if c.startswith("Figure 3. ")]
    numbers = [int(c.split()[1][:-1]) for c in captions if c.startswith("Table ")]
    assert numbers == list(range(1, 12))  # six of the chapters, three of assumptions, two of versions


def test_assumptions_are_marked(page: Page) -> None:
    cells = page.text("td")
    assert cells.count("assumed") > 20
    assert cells.count("paper") > 10
    rows = page.text("th")
    for part in (
        "B, rear link on base (the clearance pin)",
        "shield, whole",
        "restitution",
        "stroke of the columns",
    ):
        assert part in rows
    for value in ("65.5", "857942.947", "0.29", "0.9", "0.25", "1800", "2580"):
        assert any(value in text for _, text in page.texts)


def test_the_page_needs_nothing_from_elsewhere(page: Page, out: Path) -> None:
    for _, attributes in page.tags:
        for name in ("src", "href", "srcset", "action", "data", "poster", "background"):
            if name in attributes:
                assert attributes[name].startswith(("data:", "#")), attributes
        assert not [name for name in attributes if name.startswith("on")]
        assert "style" not in attributes
    assert not {"script", "link", "iframe", "object"} & {tag for tag, _ in page.tags}
    css = " ".join(page.text("style"))
    assert "url(" not in css
    assert "@import" not in css
    (policy,) = [meta["content"] for meta in page.all("meta") if "http-equiv" in meta]
    assert policy.startswith("default-src 'none'")
    assert (out / "report.html").stat().st_size < 12e6


def test_every_link_leads_somewhere(page: Page) -> None:
    places = {attributes["id"] for _, attributes in page.tags if "id" in attributes}
    links = [attributes["href"][1:] for attributes in page.all("a")]
    assert len(links) == 5
    assert set(links) <= places


def test_pictures_are_in_the_page_byte_for_byte(page: Page) -> None:
    pictures = page.all("img")
    assert len(pictures) == 3
    for picture in pictures:
        assert base64.b64decode(picture["src"].removeprefix("data:image/png;base64,")) == PNG
        assert "Caption of " in picture["alt"]
        assert picture["alt"].replace("\u00a0", " ") in page.text("figcaption")


def test_hostile_text_stays_text(page: Page) -> None:
    assert "img" not in {tag for tag, attributes in page.tags if "x.example" in str(attributes.get("src", ""))}
    shown = [text for _, text in page.texts if "<script>alert(1)</script>" in text]
    # title (contents, heading), question, method, finding, caption, three of the sheet and five claims
    assert len(shown) >= 10


def test_verdicts_have_a_class_and_are_counted(page: Page) -> None:
    classes = [a["class"].split()[-1] for a in page.all("td") if "verdict" in a["class"].split()]
    assert classes == ["holds", "partly", "unsupported", "open", "holds"] * 3
    counted = '2 "holds", 1 "holds only", 1 "not supported", 1 "cannot be judged"'
    assert f"Verdicts on 5 claims of the paper: {counted}." in page.text("p")
    assert verdict_class("it holds") == ""


def test_studies_come_in_order_and_others_after_them(tmp_path: Path) -> None:
    for name in ("a", "b", "z"):
        put(tmp_path, chapter(name))
    (tmp_path / "no chapter here").mkdir()
    found = report.sections(tmp_path, ["z", "missing", "b"])
    assert [section.chapter.study for section in found] == ["z", "b", "a"]


def test_nothing_is_written_if_a_picture_vanishes(out: Path) -> None:
    before = {path: path.read_bytes() for path in out.glob("report.*")}
    found = report.sections(out, [])
    (out / "claims" / "figure one.png").unlink()
    with pytest.raises(OSError, match="figure one"):
        report.write_report(out, found)
    assert {path: path.read_bytes() for path in out.glob("*report*")} == before
    with pytest.raises(InputError, match=r"figure one\.png: no such file"):
        report.sections(out, [])


def _torn(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:50])


@pytest.mark.parametrize("name", ["chapter.json", "summary.json"])
def test_a_torn_file_is_a_sentence_that_names_it(
    out: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (out / "report.html").read_bytes()
    _torn(out / "claims" / name)
    assert report.main(["--out", str(out)]) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: ")
    assert str(out / "claims" / name) in error
    assert error.count("\n") == 1
    assert (out / "report.html").read_bytes() == before


def test_a_missing_summary_and_an_empty_folder_are_sentences(
    out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (out / "claims" / "summary.json").unlink()
    assert report.main(["--out", str(out)]) == 1
    assert "summary.json: no such file" in capsys.readouterr().err
    empty = tmp_path / "empty"
    assert report.main(["--out", str(empty)]) == 1
    assert "run python -m studies first" in capsys.readouterr().err
