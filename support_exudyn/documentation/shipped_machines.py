"""The machines that come with the package, as a page: what each file says of itself, and a drawing."""

from itertools import takewhile
from pathlib import Path

from support_exudyn.files.machines import SHIPPED, shipped
from support_exudyn.files.machines import __file__ as shipped_files
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.scenario.scenario import Scenario

DPI = 110
TOP = """# Machines

These come with the package. `support-exudyn check NAME` tells what can be told of one before a run, and
`machine("NAME")` is it in Python. Scenarios say `machine = "NAME"`. Copy a file and change it to have your own.
"""


def machines_page(pictures: Path) -> str:
    """A page of Markdown: of every shipped machine its name, what its file says first, and a drawing.

    Arguments:
        pictures: folder for the drawings, beside the page.
    """
    pictures.mkdir(parents=True, exist_ok=True)
    return "\n\n".join([TOP, *(_told(name, pictures) for name in SHIPPED)]) + "\n"


def _told(name: str, pictures: Path) -> str:
    data = shipped(name)
    picture = f"machine_{name}.png"
    machine_drawing(Scenario(machine=data.machine, duration=1.0)).savefig(pictures / picture, dpi=DPI)
    sources = "\n".join(f"- {what.replace('_', ' ')}: {source}" for what, source in data.sources.items())
    return f"## {name}\n\n{_comment(name)}\n\n![{name}]({pictures.name}/{picture})\n\n{sources}"


def _comment(name: str) -> str:
    """The comment at the top of a machine's file: paragraphs and lists, and its sketch if it has one."""
    text = (Path(shipped_files).parent / f"{name}.toml").read_text(encoding="utf-8")
    lines = takewhile(lambda line: line.startswith("#"), text.splitlines())
    blocks = "\n".join(line.removeprefix("#").removeprefix(" ") for line in lines).split("\n\n")
    return "\n\n".join(f"```text\n{block}\n```" if _is_sketch(block) else _prose(block) for block in blocks)


def _is_sketch(block: str) -> bool:
    """Whether most lines of a block are set in, as those of a drawing in letters are."""
    lines = block.splitlines()
    return 2 * sum(line.startswith("  ") for line in lines) > len(lines)


def _prose(block: str) -> str:
    """A paragraph, with an empty line before and after its list if it has one."""
    found: list[str] = []
    for line in block.splitlines():
        listed = line.startswith(("- ", "  "))
        if found and listed != found[-1].startswith(("- ", "  ")):
            found.append("")
        found.append(line)
    return "\n".join(found)
