"""The report: what stands where, links that lead somewhere, self-contained, safe from texts."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from PIL import Image

from studies import report
from studies.catalogue import DEFAULT, STUDIES
from studies.common.chapter import REFERENCE, Chapter, JudgedClaim, Picture, Tile
from studies.common.words import TEMPLATE
from support_exudyn.postprocessing.page.live import LiveCurve, LiveFigure, LivePanel
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import versions
from user_forces.values.value import InputError

TITLE = "Clearance in one pin of a hydraulic support"
HOSTILE = "<script>alert(1)</script> | \"quoted\" & '<img src=http://x.example/>'\n- new line"
VERDICTS = ("holds", "in part", "fails", "not measurable", "needs more machines")
LIVE = LiveFigure(
    "time [s]", (LivePanel("force [N]", (LiveCurve("ideal", (0.0, 1.0), (1.0, 2.0), "#d55e00"),)),)
)
LARGEST = 5e6  # bytes of report.html


def chapter(name: str, text: str = "A sentence.") -> Chapter:
    rows = tuple((f"{n} {text}", f"{n} ± 0.01", "1") for n in range(12))
    claims = tuple(
        JudgedClaim(
            str(n),
            "section 3",
            f"Claim {n}. {text}",
            verdict,
            f"Because of {text}",
            f"{name}/force one",
            f"{name}/all",
        )
        for n, verdict in enumerate(VERDICTS)
    )
    leads = name == "clearance_influence"
    return Chapter(
        study=name,
        title=f"Title of {name} {text}",
        question=f"Question of {name}? {text}",
        method=(f"Method of {name}, see [@all]. {text}",),
        findings=(f"Finding of {name}: 1.5 ± 0.1 mm [@other]. {text}",),
        pictures=(
            Picture("machine", f"Machine of {name}. {text}"),
            Picture("force one", f"Caption of {name}. {text}"),
            Picture("other", f"Other of {name}. {text}"),
        ),
        sheets=(
            Sheet(
                f"Key of {name} {text}", ("quantity", text), (("a", "1.0"), (text, "-2.0")), text, name="key"
            ),
            Sheet(f"All of {name}", ("quantity", "value", text), rows, name="all"),
        ),
        answer=f"Answer of {name} [@key]. Second sentence [@clearance_influence/all]. Third [@nowhere].",
        numbers=(f"number of {name}: 1.5 ± 0.1 mm",),
        tiles=(Tile("peak", "55 kN", "443 ± 2 kN", "8 times"), Tile(text, "1", "2", text)) if leads else (),
        claims=claims if name == "claims" else (),
    )


def put(out: Path, content: Chapter) -> Path:
    """The files that a study leaves."""
    folder = out / content.study
    (folder / "runs").mkdir(parents=True)
    (folder / "runs" / "a run.h5").touch()
    content.save(folder)
    for picture in content.pictures:
        Image.fromarray(np.full((60, 200, 3), 255, np.uint8)).save(folder / f"{picture.stem}.png")
        (folder / f"{picture.stem}.csv").touch()
    (folder / "force one.pdf").touch()
    (folder / "key.csv").touch()
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


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("results")
    for content in (
        chapter("claims"), chapter("drive_mode", HOSTILE), chapter("clearance_influence"), chapter("benchmark"),
    ):  # fmt: skip
        put(out, content)
    LIVE.save(out / "clearance_influence" / "force one.live.json")
    assert report.main(["--out", str(out)]) == 0
    return out


@pytest.fixture(scope="module")
def page(made: Path) -> Page:
    return Page((made / "report.html").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def appendix(made: Path) -> Page:
    return Page((made / "appendix.html").read_text(encoding="utf-8"))


@pytest.fixture
def out(tmp_path: Path) -> Path:
    put(tmp_path, chapter("claims"))
    assert report.main(["--out", str(tmp_path)]) == 0
    return tmp_path


def said(page: Page) -> str:
    return " ".join(text for tag, text in page.texts if tag not in ("script", "style"))


def test_the_first_screen_holds_the_answer(page: Page) -> None:
    assert page.open == []  # every tag is closed
    assert page.text("h1") == page.text("title") == [TITLE]
    text = said(page)
    first = text[: text.index("The paper's claims all")] if "The paper's claims all" in text else text
    for part in (
        "443",
        "± 2 kN",
        "55 kN",
        "8 times",
        "Machine of clearance_influence",
        "Caption of clearance_influence",
    ):
        assert part in first
    sentences = [
        part
        for part in ("Answer of clearance_influence", "Second sentence", "Answer of claims")
        if part in text
    ]
    assert len(sentences) == 3
    assert first.index("Answer of claims") > first.index("Second sentence")


def test_the_page_has_answers_and_the_appendix_the_rest(page: Page, appendix: Page) -> None:
    for name in ("claims", "drive_mode", "clearance_influence"):
        for part in ("Question", "Answer", "Key", "number"):
            assert f"{part} of {name}" in said(page)
        for part in ("Method", "Finding"):
            assert f"{part} of {name}" not in said(page)
            assert f"{part} of {name}" in said(appendix)
        assert f"All of {name}" in said(appendix)
        assert f"Key of {name}" not in said(appendix)  # it is whole on the page
    assert "Title of benchmark" not in said(page)
    assert "Answer of benchmark" in said(appendix)
    for name, version in versions().items():
        assert name in said(appendix)
        assert version in said(appendix)
    assert "python -m studies.report" in said(appendix)
    assert "49.4" in appendix.text("td")  # wall times [s], together


def test_what_has_not_run_is_said(page: Page) -> None:
    (band,) = [text for text in page.text("p") if "not complete" in text]
    there = ("claims", "drive_mode", "clearance_influence")
    missing = [name for name in DEFAULT if name not in there]
    assert all(name in band for name in missing)
    others = [name for name in STUDIES if name not in (*DEFAULT, *there)]
    assert [code.rpartition(" ")[2] for code in page.text("code")] == others


def test_figures_and_tables_are_numbered_throughout(page: Page, appendix: Page) -> None:
    labels = page.text("b") + appendix.text("b")
    for kind, count in (("Fig.", 12), ("Table", 8)):
        found = [text for text in labels if re.fullmatch(kind + r" \d+\.", text)]
        assert found == [f"{kind} {n}." for n in range(1, count + 1)]


def test_every_link_leads_somewhere(made: Path, page: Page, appendix: Page) -> None:
    places = {
        file: {attributes["id"] for _, attributes in one.tags if "id" in attributes}
        for file, one in (("report.html", page), ("appendix.html", appendix))
    }
    for file, one in (("report.html", page), ("appendix.html", appendix)):
        ids = [attributes["id"] for _, attributes in one.tags if "id" in attributes]
        assert len(ids) == len(set(ids))
        for link in one.all("a"):
            path, _, anchor = unquote(link["href"]).partition("#")
            assert anchor in places[path or file] if anchor else (made / path).exists(), link
    links = {link["href"] for link in page.all("a")}
    assert {"clearance_influence/force%20one.pdf", "clearance_influence/runs/", "drive_mode/key.csv"} <= links


def test_sentences_link_to_what_they_speak_of(page: Page, appendix: Page) -> None:
    links = {(link["href"], text) for link, text in zip(page.all("a"), page.text("a"), strict=True)}
    assert ("#clearance_influence-key", "Table 1") in links
    assert ("appendix.html#clearance_influence-all", "Table 4") in links
    assert ("#claims-force-one", "Fig. 5") not in links  # the claims' machine is their key figure
    assert "#benchmark-all" in {link["href"] for link in appendix.all("a")}
    for one in (page, appendix):
        assert "[@" not in said(one)
        assert "nowhere" in said(one)


@pytest.mark.parametrize("study", STUDIES)
def test_templates_refer_to_figures_and_tables_that_they_name(study: str) -> None:
    folder = Path(report.__file__).parent

    def names(of: str) -> set[str]:
        text = (folder / of / TEMPLATE).read_text(encoding="utf-8")
        figures = re.findall(r"^- ([\w.-]+): ", text[text.index("\n## Figures") :], re.MULTILINE)
        return {*figures, *re.findall(r"^### ([\w.-]+)$", text, re.MULTILINE)}

    for reference in REFERENCE.findall((folder / study / TEMPLATE).read_text(encoding="utf-8")):
        of, _, name = reference.rpartition("/")
        assert name in names(of or study), reference


def test_assumptions_are_marked(appendix: Page) -> None:
    cells = appendix.text("td")
    assert cells.count("assumed") > 20
    assert cells.count("paper") > 10
    rows = appendix.text("th")
    for part in (
        "B, rear link on base (the clearance pin)",
        "shield, whole",
        "restitution",
        "stroke of the columns",
    ):
        assert part in rows
    for value in ("65.5", "857942.947", "0.29", "0.9", "0.25", "1800", "2580"):
        assert any(value in text for _, text in appendix.texts)


def test_the_pages_need_nothing_from_elsewhere(made: Path, page: Page, appendix: Page) -> None:
    for one in (page, appendix):
        for _, attributes in one.tags:
            for name in ("src", "srcset", "action", "data", "poster", "background"):
                assert attributes.get(name, "data:").startswith("data:"), attributes
            assert not re.match(r"\w+:|//", attributes.get("href", ""))
            assert not [name for name in attributes if name.startswith("on")]
        assert not {"link", "iframe", "object"} & {tag for tag, _ in one.tags}
        css = " ".join(one.text("style"))
        assert "url(" not in css
        assert "@import" not in css
        (policy,) = [meta["content"] for meta in one.all("meta") if "http-equiv" in meta]
        assert policy.startswith(
            "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-"
        )
        assert "unsafe-eval" not in policy
    assert (made / "report.html").stat().st_size < LARGEST


def test_hostile_text_stays_text(page: Page, appendix: Page) -> None:
    for one in (page, appendix):
        assert not [a for tag, a in one.tags if tag == "img" and "x.example" in a.get("src", "")]
        shown = [text for _, text in one.texts if "<script>alert(1)</script>" in text]
        assert len(shown) >= 6


def test_claims_are_listed_with_verdict_reason_and_links(page: Page) -> None:
    assert [row["data-kind"] for row in page.all("tr") if "data-kind" in row] == [
        "holds", "partly", "unsupported", "open", "few",
    ]  # fmt: skip
    assert [text for text in page.text("summary") if text.startswith("Claim ")] == [
        f"Claim {n}. A sentence." for n in range(5)
    ]
    buttons = [attributes["data-show"] for attributes in page.all("button")]
    assert buttons == ["", "holds", "partly", "unsupported", "few", "open"]
    text = said(page)
    for part in (
        "✓ holds",
        "◐ holds in part",
        "✗ fails",
        "+ needs more",
        "? not measurable",
    ):
        assert part in text
    assert text.count("Because of A sentence.") == 5


def test_a_long_key_table_is_cut_and_whole_in_the_appendix(tmp_path: Path) -> None:
    long = chapter("claims")
    put(tmp_path, replace(long, sheets=long.sheets[::-1]))
    assert report.main(["--out", str(tmp_path)]) == 0
    page, appendix = (
        Page((tmp_path / name).read_text(encoding="utf-8")) for name in ("report.html", "appendix.html")
    )
    assert "7 A sentence." in page.text("th")
    assert "8 A sentence." not in page.text("th")
    assert "All 12 rows." in page.text("a")
    assert "11 A sentence." in appendix.text("th")


def test_a_report_on_ones_own_machine_leaves_the_paper_out(tmp_path: Path) -> None:
    put(tmp_path, replace(chapter("clearance_size"), machine="my crane"))
    assert report.main(["--out", str(tmp_path)]) == 0
    page, appendix = (
        Page((tmp_path / name).read_text(encoding="utf-8")) for name in ("report.html", "appendix.html")
    )
    assert page.text("h1") == ["Clearance in one pin: my crane"]
    assert "paper" not in said(page).lower()
    assert "Pivots" not in said(appendix)
    assert not [text for text in page.text("code") if text.endswith("extremes")]  # takes no machine


def test_studies_come_in_order_and_others_after_them(tmp_path: Path) -> None:
    for name in ("a", "b", "z"):
        put(tmp_path, chapter(name))
    (tmp_path / "no chapter here").mkdir()
    found = report.sections(tmp_path, ["z", "missing", "b"])
    assert [section.chapter.study for section in found] == ["z", "b", "a"]


def test_nothing_is_written_if_a_picture_vanishes(out: Path) -> None:
    before = {path: path.read_bytes() for path in out.glob("*.html")}
    found = report.sections(out, [])
    (out / "claims" / "force one.png").unlink()
    with pytest.raises(OSError, match="force one"):
        report.write_report(out, found)
    assert {path: path.read_bytes() for path in out.glob("*.html")} == before
    with pytest.raises(InputError, match=r"force one\.png: no such file"):
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
