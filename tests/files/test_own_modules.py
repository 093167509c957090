"""Which module a class of one's own is of, and its import from where it was."""

from __future__ import annotations

import pickle
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import ClearancePin
from support_exudyn.files.own_modules import import_modules_of, modules_of
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.own_sources import _source
from tests.cases.run_cases import loose_support
from user_forces import InputError, PinInBore
from user_forces.values.value import Value, kinds_of

LAW = """
from user_forces.normal.hertz import Hertz
from user_forces.values.value import value

@value
class {name}(Hertz):
    pass
"""


LENT = """
from user_forces import PowerLaw
from user_forces.values.value import value

@value
class LentByMe(PowerLaw):
    def factor(self, restitution):
        return 1.0 - restitution
"""


def test_a_law_that_lends_its_damping_to_a_pin_along_its_length_is_noted_and_sent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    path = tmp_path / "lending_laws.py"
    path.write_text(LENT)
    place = {"LentByMe": {"module": "lending_laws", "path": str(path)}}
    import_modules_of(place)
    law = sys.modules["lending_laws"].LentByMe
    pin = ClearancePin.simple(clearance=1e-3, bore_radius=0.05, length=0.1, restitution=0.7, law=law)
    assert isinstance(pin.contact.normal, PinInBore)
    assert pin.contact.normal.damping_factor == pytest.approx(0.3)
    assert modules_of(pin.to_data()) == place
    assert b"lending_laws" in pickle.dumps(pin)  # by which another process knows what to import
    scenario = replace(loose_support(1.5, 0.25), pins={"rear_base": pin})
    before = key(scenario)
    path.write_text(LENT.replace("1.0", "1.1"))
    _source.cache_clear()
    assert key(scenario) != before
    _source.cache_clear()


def test_a_run_without_classes_of_ones_own_notes_nothing() -> None:
    assert modules_of(loose_support(1.5, 0.25).to_data()) == {}


@pytest.mark.parametrize(
    ("module", "file"),
    [
        ("lone_laws", "lone_laws.py"),
        ("laws_pack", "laws_pack/__init__.py"),
        ("deep_pack.laws", "deep_pack/laws.py"),
    ],
)
def test_a_module_and_one_in_a_package_are_imported(
    module: str, file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    name = f"Of{module.title().replace('_', '').replace('.', '')}"
    path = tmp_path / file
    path.parent.mkdir(exist_ok=True)
    path.write_text(LAW.format(name=name))
    place = {name: {"module": module, "path": str(path)}}
    import_modules_of(place)
    assert kinds_of(Value)[name].__module__ == module
    assert modules_of({"law": [{"type": name}]}) == place


@pytest.mark.parametrize(
    ("module", "text", "told"),
    [
        ("gone", None, "which was at .*gone.py: there is no such file now; allowed: .*--import gone"),
        ("broken", "1 / 0", "can be imported .ZeroDivisionError"),
        ("empty", "", "the file has no such class now"),
        ("__main__", "", "a script; allowed: its class in a module"),
    ],
)
def test_what_cannot_be_imported_is_said(
    module: str, text: str | None, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    path = tmp_path / f"{module}.py"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError, match=told):
        import_modules_of({"Nowhere": {"module": module, "path": str(path)}})
