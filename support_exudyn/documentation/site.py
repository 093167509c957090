"""The site: pages are laid out as they lie in the project, mkdocs makes HTML of them and checks links."""

import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from support_exudyn.documentation.gallery import gallery_page
from support_exudyn.documentation.keys import keys_page
from support_exudyn.documentation.machine_pages import machines_page
from support_exudyn.documentation.reference import reference_pages
from support_exudyn.files import scenario_schema
from support_exudyn.files.machines import machine_schema
from user_forces.values.value import InputError

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PAGE = re.compile(r"[\w./]+\.md\b")
LINK = re.compile(r"\]\(([^)\s#:]+)[)\s#]")
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
        settings = Path(work) / "mkdocs.yml"
        settings.write_text(_lay_out(Path(work) / "docs", commands), encoding="utf-8")
        words = ["build", "--config-file", str(settings), "--site-dir", str(out.resolve())]
        done = subprocess.run(
            [sys.executable, "-m", "mkdocs", *words], cwd=ROOT, capture_output=True, text=True, check=False
        )
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if line.startswith(("WARNING", "ERROR"))]
        raise InputError("\n".join(lines) or done.stderr)


def rooms() -> list[str]:
    """The READMEs of the rooms, and what contributors read."""
    found = [ROOT / "support_exudyn" / "README.md", *sorted((ROOT / "support_exudyn").glob("*/**/README.md"))]
    paths = [path.relative_to(ROOT).as_posix() for path in found if path.parent.name != "extending"]
    return [*paths, "user_forces/README.md", ".github/CONTRIBUTING.md"]


def _lay_out(pages: Path, commands: str) -> str:
    """Write all pages into a folder, with what they link to; returns the settings of mkdocs."""
    reference = pages / "reference"
    reference.mkdir(parents=True)
    shutil.copy(HERE / "site.css", reference)
    named = {f"names_{room}": text for room, text in reference_pages().items()}
    scenario, machine = "Keys of a scenario's file", "Keys of a machine's file"
    written = {
        "commands": ("What every command takes", commands),
        "scenario_keys": (scenario, keys_page(scenario, scenario_schema())),
        "machine_keys": (machine, keys_page(machine, machine_schema())),
        "machines": ("Machines that come with the package", machines_page(reference / "pictures")),
        "gallery": ("Examples", gallery_page(ROOT / "studies" / "examples", reference / "pictures")),
        **{name: (f"Names in Python: `{name.partition('_')[2]}`", text) for name, text in named.items()},
    }
    index = "".join(f"- [{title}]({name}.md)\n" for name, (title, _) in written.items())
    (reference / "index.md").write_text(f"# Reference\n\n{index}", encoding="utf-8")
    for name, (_, text) in written.items():
        (reference / f"{name}.md").write_text(text, encoding="utf-8")
    settings = (HERE / "mkdocs.yml").read_text(encoding="utf-8")
    for title, names in (
        ("Names in Python", [f"reference/{name}.md" for name in named]),
        ("How it is built", rooms()),
    ):
        settings = settings.replace(f"{title}: []", f"{title}: [{', '.join(names)}]")
    for name in PAGE.findall(settings):
        if not name.startswith("reference/"):
            _copy(ROOT / name, pages)
    return settings


def _copy(page: Path, pages: Path) -> None:
    """Copy a page, and the files that it links to and that are no pages."""
    linked = (page.parent / link for link in LINK.findall(page.read_text(encoding="utf-8")))
    for path in [page, *(file for file in linked if file.is_file() and file.suffix != ".md")]:
        place = pages / path.resolve().relative_to(ROOT)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, place)
