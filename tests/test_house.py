"""The house: no circle of modules, no long file, nothing loose at the root, a README in every room."""

from __future__ import annotations

import ast
from collections import defaultdict
from pathlib import Path

import pytest
from grimp import build_graph
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

ROOT = Path(__file__).parents[1]
PACKAGES = ("support_exudyn", "user_forces", "studies")
LONGEST = 420  # lines of a file
ALIKE = ("ClearanceGuide",)  # of a scenario, and of a user's own model of the engine
ABOVE = ("commands", "documentation", "postprocessing", "sweeps", "simulation", "files")
BELOW = ("formulations", "scene", "machines", "scenario", "mechanics", "model")
ROOMS = [*(ROOT / "support_exudyn" / name for name in ABOVE + BELOW), ROOT / "user_forces", ROOT / "studies"]


def test_no_modules_import_each_other_in_a_circle() -> None:
    # imports for types alone, and those inside functions, are arrows, too
    graph = build_graph(*PACKAGES, cache_dir=None)
    modules = sorted(graph.modules)
    place = {module: n for n, module in enumerate(modules)}
    arrows = [
        (place[module], place[other])
        for module in modules
        for other in graph.find_modules_directly_imported_by(module)
    ]
    start, end = zip(*arrows, strict=True)
    matrix = csr_array(([1] * len(arrows), (start, end)), shape=(len(modules), len(modules)))
    _, labels = connected_components(matrix, connection="strong")
    together = defaultdict(list)
    for module, label in zip(modules, labels, strict=True):
        together[label].append(module)
    assert [circle for circle in together.values() if len(circle) > 1] == []


def test_no_file_is_long() -> None:
    files = [path for package in PACKAGES for path in (ROOT / package).rglob("*.py")]
    lines = {path.relative_to(ROOT).as_posix(): len(path.read_text("utf-8").splitlines()) for path in files}
    assert {name: count for name, count in lines.items() if count > LONGEST} == {}


def test_no_two_classes_have_one_name() -> None:
    places = defaultdict(list)
    for package in PACKAGES:
        for path in (ROOT / package).rglob("*.py"):
            for item in ast.parse(path.read_text("utf-8")).body:
                if isinstance(item, ast.ClassDef) and item.name not in ALIKE:
                    places[item.name].append(path.relative_to(ROOT).as_posix())
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


def test_nothing_is_loose_at_the_root() -> None:
    assert {path.name for path in (ROOT / "support_exudyn").glob("*.py")} == {"__init__.py", "__main__.py"}
    folders = {path for path in (ROOT / "support_exudyn").iterdir() if any(path.glob("*.py"))}
    assert folders == {room for room in ROOMS if room.parent.name == "support_exudyn"}


@pytest.mark.parametrize("room", [ROOT / "support_exudyn", *ROOMS], ids=lambda room: room.name)
def test_every_room_says_what_lives_there(room: Path) -> None:
    assert 15 <= len((room / "README.md").read_text("utf-8").splitlines()) <= 60
