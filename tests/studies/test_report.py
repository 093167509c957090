"""The report: what stands where, links that lead somewhere, self-contained, safe from texts."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from PIL import Image

from studies import report
from studies.catalogue import STUDIES
from studies.common.numbers import NUMBERS
from studies.common.words import FILE, REFERENCE, Chapter, JudgedClaim, Picture
from support_exudyn.postprocessing.page.live import LiveCurve, LiveFigure, LivePanel
from support_exudyn.postprocessing.page.pieces import KeyNumber, Sheet
from support_exudyn.simulation.provenance import versions

HOSTILE = "<script>alert(1)</script> | \"quoted\" & '<img src=http://x.example/>'\n- new line"
VERDICTS = ("holds", "in part", "fails", "not measurable", "needs more machines")
LIVE = LiveFigure(
    "time [s]", (LivePanel("force [N]", (LiveCurve("ideal", (0.0, 1.0), (1.0, 2.0), "#d55e00"),)),)
)
LARGEST = 5e6  # bytes of report.html


def chapter(name: str, text: str = "A sentence.") -> Chapter:
    rows = tuple((f"{n} {text}", f"{n} ± 0.01", "1") for n in range(12))
    evidence = (f"{name}/force one", f"{name}/all")
    claims = [
        JudgedClaim(str(n), "section 3", f"Claim {n}. {text}", verdict, f"Because of {text}", *evidence)
        for n, verdict in enumerate(VERDICTS)
    ]
    tiles = (KeyNumber("peak", "443 ± 2 kN", "55 kN", "8 times"), KeyNumber(text, "2", "1", text))
    key = Sheet(f"Key of {name} {text}", ("quantity", text), (("a", "1.0"), (text, "-2.0")), text, name="key")
    return Chapter(
        study=name,
        title=f"Title of {name} {text}",
        question=f"Question of {name}? {text}",
        method=(f"Method of {name}, see [@all]. {text}",),
        findings=(f"Finding of {name}: 1.5 ± 0.1 mm [@other]. {text}",),
        pictures=tuple(
            Picture(stem, f"{stem} of {name}. {text}") for stem in ("machine", "force one", "other")
        ),
        sheets=(key, Sheet(f"All of {name}", ("quantity", "value", text), rows, name="all")),
        answer=f"Answer of {name} [@key]. Second sentence [@clearance_influence/all]. Third [@nowhere].",
        numbers=(f"number of {name}: 1.5 ± 0.1 mm",),
        tiles=tiles if name == "clearance_influence" else (),
        claims=tuple(claims) if name == "claims" else (),
        wall_s=12.345,
        versions=versions(),
    )


def put(out: Path, content: Chapter) -> Path:
    """The files that a study leaves."""
    folder = out / content.study
    (folder / "runs").mkdir(parents=True)
    (folder / "runs" / "a run.h5").touch()
    (folder / FILE).write_text(content.model_dump_json(), encoding="utf-8")
    for picture in content.pictures:
        Image.fromarray(np.full((60, 200, 3), 255, np.uint8)).save(folder / f"{picture.stem}.png")
        (folder / f"{picture.stem}.csv").touch()
    (folder / "force one.pdf").touch()
    (folder / "key.csv").touch()
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


def test_a_chapter_is_read_back_as_it_was(tmp_path: Path) -> None:
    whole = chapter("clearance_influence", HOSTILE).model_copy(update={"claims": chapter("claims").claims})
    (tmp_path / FILE).write_text(whole.model_dump_json(), encoding="utf-8")
    assert Chapter.load(tmp_path) == whole


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("results")
    for content in (
        chapter("claims"), chapter("drive_mode", HOSTILE), chapter("clearance_influence"), chapter("benchmark"),
    ):  # fmt: skip
        put(out, content)
    LIVE.save(out / "clearance_influence" / "force one.live.json")
    report.rebuild(out)
    return out


@pytest.fixture(scope="module")
def pages(made: Path) -> dict[str, Page]:
    return {name: Page((made / name).read_text(encoding="utf-8")) for name in ("report.html", "appendix.html")}


def test_every_link_leads_somewhere(made: Path, pages: dict[str, Page]) -> None:
    ids = {file: [a["id"] for _, a in one.tags if "id" in a] for file, one in pages.items()}
    for file, one in pages.items():
        assert len(ids[file]) == len(set(ids[file]))
        for link in one.all("a"):
            path, _, anchor = unquote(link["href"]).partition("#")
            assert anchor in ids[path or file] if anchor else (made / path).exists(), link
    links = {link["href"] for link in pages["report.html"].all("a")}
    assert {"clearance_influence/force%20one.pdf", "clearance_influence/runs/", "drive_mode/key.csv"} <= links


@pytest.mark.parametrize("study", STUDIES)
def test_templates_refer_to_figures_and_tables_that_they_name(study: str) -> None:
    folder = Path(report.__file__).parent

    def names(of: str) -> set[str]:
        text = (folder / STUDIES[of].template()).read_text(encoding="utf-8")
        figures = re.findall(r"^- ([\w.-]+): ", text[text.index("\n## Figures") :], re.MULTILINE)
        return {NUMBERS, *figures, *re.findall(r"^### ([\w.-]+)$", text, re.MULTILINE)}

    for reference in REFERENCE.findall((folder / STUDIES[study].template()).read_text(encoding="utf-8")):
        of, _, name = reference.rpartition("/")
        assert name in names(of or study), reference


def test_the_pages_need_nothing_from_elsewhere(made: Path, pages: dict[str, Page]) -> None:
    for one in pages.values():
        for _, attributes in one.tags:
            for name in ("src", "srcset", "action", "data", "poster", "background"):
                assert attributes.get(name, "data:").startswith("data:"), attributes
            assert not re.match(r"\w+:|//", attributes.get("href", ""))
            assert not [name for name in attributes if name.startswith("on")]
        assert not {"link", "iframe", "object"} & {tag for tag, _ in one.tags}
        assert not re.search(r"url\(|@import", " ".join(one.text("style")))
        (policy,) = [meta["content"] for meta in one.all("meta") if "http-equiv" in meta]
        assert policy.startswith(
            "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-"
        )
        assert "unsafe-eval" not in policy
    assert (made / "report.html").stat().st_size < LARGEST


def test_hostile_text_stays_text(pages: dict[str, Page]) -> None:
    for one in pages.values():
        assert not [a for tag, a in one.tags if tag == "img" and "x.example" in a.get("src", "")]
        assert len([text for _, text in one.texts if "<script>alert(1)</script>" in text]) >= 6
