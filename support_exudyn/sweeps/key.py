"""The key of a run: the same for the same inputs and the same program, another for any others.

Modules of one's own with laws or machines are part of the program, with all that they import.
"""

import ast
import hashlib
import json
import site
import sys
import sysconfig
from collections.abc import Iterator
from functools import cache
from importlib import resources
from pathlib import Path
from types import ModuleType
from typing import Any

from support_exudyn.files.own_modules import OURS, classes_in
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.provenance import versions
from user_forces.values.value import Value

MAKES_NO_NUMBERS = ("matplotlib", "meshio", "h5py", "pydantic")  # a run's numbers do not depend on these
LOOKS = ("postprocessing", "commands", "sweeps")  # rooms of ours that compute no number of a run
LENGTH = 32  # hexadecimal digits: 128 bits, no two runs will ever share one
LIBRARIES = tuple(  # where what is installed lies: that has a version, and is not written from run to run
    {
        Path(path).resolve()
        for path in [
            *(sysconfig.get_path(kind) for kind in ("stdlib", "platstdlib", "purelib", "platlib")),
            *site.getsitepackages(),
            site.getusersitepackages(),
        ]
    }
)


@cache
def program() -> dict[str, str]:
    """What makes the numbers: versions of packages, and a digest of our own sources.

    By the digest a change of the program is seen before it has a new version.
    """
    found = {name: text for name, text in versions().items() if name not in MAKES_NO_NUMBERS}
    return found | {"sources": _sources()}


def key(scenario: Scenario, errors: bool = False) -> str:
    """The key of a run of this scenario with this program: hexadecimal digits of a SHA-256 digest.

    errors: whether it is made with estimated errors, see `simulate`.
    """
    data = scenario.plain
    text = json.dumps([data, errors, program(), own_sources(data)], sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:LENGTH]


def _sources() -> str:
    digest = hashlib.sha256()
    for package in OURS:
        root = Path(str(resources.files(package)))
        for path in sorted(root.rglob("*.py")):
            inside = path.relative_to(root)
            if inside.parts[0] not in LOOKS:
                digest.update(inside.as_posix().encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()[:LENGTH]


# --- modules of one's own ---


def own_sources(data: Any) -> dict[str, str]:
    """Digests of the modules of one's own whose classes these data are of, by the names of the modules.

    The digest of a module is of its file, and of those that it imports, and so on, as long as these are one's
    own: of the same package, or not installed. It is empty if there is no file, as of what is typed into a
    console.

    data: of a value, as `Value.to_data` gives it.
    """
    modules = {Value.of_name(kind).__module__ for kind in set(classes_in(data))}
    return {name: _source(name) for name in sorted(modules) if name.partition(".")[0] not in OURS}


@cache
def _source(module: str) -> str:
    digest = hashlib.sha256()
    files = _files(module)
    for path in files:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:LENGTH] if files else ""


def _files(module: str) -> list[Path]:
    """The file of a module, and of those of one's own that it needs, in the order of their names."""
    package, found, left = module.partition(".")[0], dict[str, Path](), [module]
    while left:
        name = left.pop()
        path = getattr(sys.modules.get(name), "__file__", None)
        if name in found or not path or name.partition(".")[0] in OURS:
            continue
        file = Path(path).resolve()
        if name.partition(".")[0] != package and any(folder in file.parents for folder in LIBRARIES):
            continue
        found[name] = file
        if file.suffix == ".py":
            left += _imported(sys.modules[name], file)
    return [found[name] for name in sorted(found)]


def _imported(module: ModuleType, file: Path) -> Iterator[str]:
    """Names of all modules that a module's file imports, and of the packages that these are in.

    An imported name may be that of a module or of anything else; what is no module is not found among them.
    """
    whole = module.__name__ if file.name == "__init__.py" else module.__name__.rpartition(".")[0]
    try:
        tree = ast.parse(file.read_bytes())
    except (SyntaxError, ValueError):  # it was changed since it was imported, and is no Python now
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [one.name for one in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = whole.split(".")[: len(whole.split(".")) - node.level + 1] if node.level else []
            start = ".".join([*above, *([node.module] if node.module else [])])
            names = [start, *(f"{start}.{one.name}" for one in node.names)]
        else:
            continue
        for name in names:
            yield from (name.rsplit(".", n)[0] for n in range(name.count(".") + 1))
