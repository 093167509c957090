"""Keys of runs, the store of a sweep and its table, without any run."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from support_exudyn import reference_support
from support_exudyn.files import read_scenario
from support_exudyn.model.drives.drive import CubicStep
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.sweeps import key as keys

STAND = """
duration_s = 0.02
record_period_s = 1e-3
machine = "reference"
[pins.rear_base]
clearance_mm = 1.0
"""


def scenario(folder: Path) -> Scenario:
    path = folder / "scenario.toml"
    path.write_text(STAND, encoding="utf-8")
    return read_scenario(path)


# --- keys ---

CHANGES: dict[str, Any] = {
    "duration": 0.03,
    "dimensions": 3,
    "start": "settled",
    "gravity": (0.0, -9.82),
    "accuracy": "draft",
    "formulation": "exudyn",
    "step": 4e-4,
    "record_period": 2e-3,
    "channels": ("tip.*",),
    "drive": CubicStep(),
    "pins": {},
}


def test_a_key_depends_on_every_input_and_on_how_it_is_run(tmp_path: Path) -> None:
    one = scenario(tmp_path)
    fields = one.to_data()
    longer = replace(one, solver=replace(one.solver, impact_steps=2 * one.solver.impact_steps))
    heavier = replace(one, machine=replace(reference_support(), start_hinge_height=2.0))
    assert fields.keys() - CHANGES.keys() <= {
        "type", "machine", "solver", "guides", "actuators", "pump", "parts", "drives", "loads"
    }  # fmt: skip
    others = [replace(one, **{name: item}) for name, item in CHANGES.items()]
    found = [keys.key(one), keys.key(one, errors=True), *map(keys.key, [longer, heavier, *others])]
    assert len(set(found)) == len(found)
    assert keys.key(scenario(tmp_path)) == found[0]


# --- a machine is read once ---


PACK = {
    "packed_laws/__init__.py": "",
    "packed_laws/law.py": "from user_forces import Flores, value\n"
    "from .near import NEAR\nfrom . import beside\nimport far_from_it.inner as inner\nimport numpy\n"
    "@value\nclass PackedLaw(Flores):\n    pass\n",
    "packed_laws/near.py": "NEAR = 1\n",
    "packed_laws/beside.py": "def late():\n    import once_more\n    return once_more\n",
    "packed_laws/strange.py": "",
    "far_from_it/__init__.py": "",
    "far_from_it/inner.py": "import packed_laws.law\n",  # in a circle
    "once_more.py": "",
    "stranger.py": "",
}
NEEDED = PACK.keys() - {"packed_laws/strange.py", "stranger.py"}


def test_a_key_depends_on_what_a_law_of_ones_own_imports(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for file, text in PACK.items():
        (tmp_path / file).parent.mkdir(exist_ok=True)
        (tmp_path / file).write_text(text, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    law = import_module("packed_laws.law").PackedLaw(stiffness=1e10, restitution=0.9).to_data()
    for name in ("packed_laws.strange", "stranger"):
        import_module(name)
    import_module("packed_laws.beside").late()

    def found() -> dict[str, str]:
        keys._source.cache_clear()
        return keys.own_sources(law)

    whole = found()
    assert whole.keys() == {"packed_laws.law"}
    for file, text in PACK.items():
        (tmp_path / file).write_text(f"{text}# changed\n", encoding="utf-8")
        assert (found() != whole) == (file in NEEDED), file
        (tmp_path / file).write_text("no Python (\n", encoding="utf-8")
        assert (found() != whole) == (file in NEEDED), file
        (tmp_path / file).write_text(text, encoding="utf-8")
    assert found() == whole
    keys._source.cache_clear()
