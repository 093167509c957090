"""The site: pages are laid out as they lie in the project, mkdocs makes HTML of them and checks links."""

import logging
import re
import shutil
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from support_exudyn.documentation.gallery import gallery_page
from support_exudyn.documentation.keys import keys_page
from support_exudyn.documentation.known_channels import channels_page
from support_exudyn.documentation.reference import reference_pages
from support_exudyn.documentation.shipped_machines import machines_page
from support_exudyn.files import scenario_schema
from support_exudyn.files.machines import machine_schema
from user_forces.values.value import InputError

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
LINK = re.compile(r"\]\(([^)\s#]+)")
NEEDED = ("mkdocs", "material", "mkdocstrings", "mkdocstrings_handlers")


def build_site(out: Path, commands: str) -> None:
    """Build the site.

    Arguments:
        out: folder of the site; what is in it is replaced.
        commands: the page on commands, Markdown.

    Raises InputError if the extra [docs] or the sources are missing, if an example fails, and at every warning
    of mkdocs, such as that on a link that leads nowhere.
    """
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise InputError(
            f"{missing[0]}: is not installed; allowed: the extra [docs], python -m pip install -e '.[docs]'"
        )
    if not (ROOT / "studies" / "examples").is_dir() or not (ROOT / "README.md").is_file():
        raise InputError(f"{ROOT}: has no README.md and studies/examples; allowed: a checkout of the project")
    with TemporaryDirectory() as work:
        pages = Path(work) / "pages"
        nav = _lay_out(pages, commands)
        _make(Path(work), pages, nav, out)


def rooms() -> list[str]:
    """The READMEs of the rooms, and what contributors read."""
    found = [ROOT / "support_exudyn" / "README.md", *sorted((ROOT / "support_exudyn").glob("*/**/README.md"))]
    found = [path for path in found if path.parent.name != "extending"]
    return [
        *(path.relative_to(ROOT).as_posix() for path in found),
        "user_forces/README.md",
        ".github/CONTRIBUTING.md",
    ]


# --- pages ---


def _lay_out(pages: Path, commands: str) -> list[Any]:
    """Write all pages into a folder, with what they link to; returns their order."""
    import yaml

    nav: list[Any] = yaml.safe_load((HERE / "mkdocs.yml").read_text(encoding="utf-8"))["nav"]
    reference = pages / "reference"
    reference.mkdir(parents=True)
    named = reference_pages()
    shutil.copy(HERE / "site.css", reference)
    written = {
        "index": _reference_index(named),
        "commands": commands,
        "scenario_keys": keys_page("Keys of a scenario's file", scenario_schema()),
        "machine_keys": keys_page("Keys of a machine's file", machine_schema()),
        "channels": channels_page(),
        "machines": machines_page(reference / "pictures"),
        "gallery": gallery_page(ROOT / "studies" / "examples", reference / "pictures"),
        **{f"names_{room}": text for room, text in named.items()},
    }
    for name, text in written.items():
        (reference / f"{name}.md").write_text(text, encoding="utf-8")
    _fill(nav, "Names in Python", [f"reference/names_{room}.md" for room in named])
    _fill(nav, "How it is built", rooms())
    for name in _leaves(nav):
        if not name.startswith("reference/"):
            _copy(ROOT / name, pages)
    return nav


def _reference_index(rooms_of_names: Iterable[str]) -> str:
    """The first page of the reference, which links to all others, Markdown."""
    pages = {
        "commands": "what every command takes",
        "scenario_keys": "keys of a scenario's file",
        "machine_keys": "keys of a machine's file",
        "channels": "what a run records",
        "machines": "machines that come with the package",
        **{f"names_{room}": f"names in Python: `{room}`" for room in rooms_of_names},
    }
    return "# Reference\n\n" + "".join(f"- [{said}]({name}.md)\n" for name, said in pages.items())


def _copy(page: Path, pages: Path) -> None:
    """Copy a page, and the files that it links to and that are no pages."""
    text = page.read_text(encoding="utf-8")
    linked = (page.parent / link for link in LINK.findall(text) if not re.match(r"\w+:", link))
    for path in [page, *(one for one in linked if one.is_file() and one.suffix != ".md")]:
        place = pages / path.resolve().relative_to(ROOT)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, place)


def _fill(nav: list[Any], title: str, names: list[str]) -> None:
    for item in nav:
        if isinstance(item, dict):
            for key, inside in item.items():
                if key == title:
                    item[key] = names
                elif isinstance(inside, list):
                    _fill(inside, title, names)


def _leaves(nav: list[Any]) -> Iterator[str]:
    for item in nav:
        if isinstance(item, str):
            yield item
        else:
            for inside in item.values():
                yield from _leaves(inside) if isinstance(inside, list) else [inside]


# --- HTML ---


class _Kept(logging.Handler):
    """Warnings, kept to be told."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a warning."""
        self.lines.append(record.getMessage())


def _make(work: Path, pages: Path, nav: list[Any], out: Path) -> None:
    """Let mkdocs make the site; its warnings are an InputError."""
    from mkdocs.commands.build import build
    from mkdocs.config import load_config
    from mkdocs.exceptions import MkDocsException

    settings = work / "mkdocs.yml"
    shutil.copy(HERE / "mkdocs.yml", settings)
    kept = _Kept()
    log = logging.getLogger("mkdocs")
    log.addHandler(kept)
    try:
        config = load_config(str(settings), docs_dir=str(pages), site_dir=str(out.resolve()), nav=nav)
        config.plugins.on_startup(command="build", dirty=False)
        build(config)
    except MkDocsException as error:
        raise InputError("\n".join(kept.lines or [str(error)])) from error
    finally:
        log.removeHandler(kept)
    if kept.lines:
        raise InputError("\n".join(kept.lines))
