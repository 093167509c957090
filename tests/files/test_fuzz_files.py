"""Files of any content: read, or refused in a sentence that names the file."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import cylinders_and_rods, load_support
from tests import strategies as some
from tests.sound import sound, taken_or_refused

# --- machine data files ---

MACHINE = (resources.files("support_exudyn.files.machines") / "reference.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One for all examples."""
    return tmp_path_factory.mktemp("files")


def read_or_refused(path: Path) -> None:
    """A machine data file is read by both who read it, or refused by name."""
    machine = taken_or_refused(lambda: load_support(path), f"{path}: ")
    if machine is not None:
        sound(machine)
    actuators = taken_or_refused(lambda: cylinders_and_rods(path=path), f"{path}: ")
    for actuator in (actuators or {}).values():
        sound(actuator)


@given(text=some.mangled(st.just(MACHINE)))
@some.tried("machine text")
def test_a_machine_file_whose_text_was_changed_is_read_or_refused(folder: Path, text: str) -> None:
    path = folder / "machine.toml"
    path.write_text(text, encoding="utf-8", errors="surrogatepass")
    read_or_refused(path)


@given(tree=some.mutated(st.deferred(lambda: st.just(some.machine_tree()))))
@some.tried("machine tree")
def test_a_machine_file_whose_tree_was_changed_is_read_or_refused(folder: Path, tree: Any) -> None:
    path = folder / "machine.toml"
    path.write_text(some.toml(tree), encoding="utf-8", errors="surrogatepass")
    read_or_refused(path)
