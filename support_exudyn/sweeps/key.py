"""The key of a run: the same for the same inputs and the same program, another for any others."""

import hashlib
import json
from functools import cache
from importlib import resources
from pathlib import Path

from support_exudyn.files.own_modules import OURS
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.provenance import versions
from support_exudyn.sweeps.own_sources import own_sources

MAKES_NO_NUMBERS = ("matplotlib", "meshio", "h5py", "pydantic")  # a run's numbers do not depend on these
LOOKS = ("postprocessing", "commands", "sweeps")  # rooms of ours that compute no number of a run
LENGTH = 32  # hexadecimal digits: 128 bits, no two runs will ever share one


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
