"""Modules of the user's own: no file that is read imports one, and a run without its law has its numbers."""

from __future__ import annotations

import pickle
import sys
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import Result, read_scenario, simulate, trusted
from support_exudyn.__main__ import main
from support_exudyn.files.own_modules import modules_of
from support_exudyn.files.scenarios.scenario_file import read_machine_in
from support_exudyn.sweeps import read_sweep
from user_forces import InputError
from user_forces.values.value import Value, kinds_of

LAW = """
from user_forces.normal.power_laws import Hertz
from user_forces.values.value import value

@value
class {name}(Hertz):
    pass
"""


RAN = "ran.txt"  # which the foreign module writes when it is imported
FOREIGN = """
from pathlib import Path
from support_exudyn import CubicStep, FrictionLaw, ImpactStand
from user_forces import LankaraniNikravesh
from user_forces.values.value import value

Path(__file__).with_name("ran.txt").write_text("ran")

@value
class ForeignLaw(LankaraniNikravesh):
    pass

@value
class ForeignFriction(FrictionLaw):
    @staticmethod
    def force(slip, normal_force):
        return -1e-3 * normal_force * slip

@value
class ForeignStand(ImpactStand):
    pass
"""
SCENARIO = """
duration_s = 0.01
machine = {machine}
[pins.pin]
clearance_mm = 1
bore_radius_mm = 60
{pin}
"""
STAND = '{type = "ImpactStand", bore_mass_kg = 3, journal_mass_kg = 1, speed_m_per_s = 1}'
SCENES = {  # by the name of their file
    "law.toml": SCENARIO.format(machine=STAND, pin='law = "zlaw.py:ForeignLaw"'),
    "module.toml": SCENARIO.format(machine=STAND, pin='friction = {type = "zlaw:ForeignFriction"}'),
    "machine.toml": SCENARIO.format(machine=STAND.replace("ImpactStand", "zlaw.py:ForeignStand"), pin=""),
    "sweep.toml": 'scenario = "law.toml"\n[vary]\n"pins.pin.clearance_mm" = [1, 2]\n',
}
SHOWING = {  # what commands do with a run whose law is not imported: their exit codes
    "show {run}": 0,
    "show {run} --json": 0,
    "compare {run} {run}": 0,
    "report {run}": 0,
    "plot {run} --out figures": 0,
    "export {run} --out meshes": 0,
    "scenario {run}": 1,
}


@pytest.fixture
def foreign(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of somebody else's: scenarios, and the module that they name, which nobody has imported."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    for name, text in SCENES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "zlaw.py").write_text(FOREIGN, encoding="utf-8")
    yield tmp_path
    forget("zlaw")


def forget(module: str) -> None:
    sys.modules.pop(module, None)
    for name in [name for name, kind in Value._register.items() if kind.__module__ == module]:
        del Value._register[name]


def run_of(scenario: str, path: Path) -> Result:
    """The run of a scenario whose module is trusted while it runs."""
    trusted(path.parent / "zlaw.py")
    result = simulate(replace(read_scenario(path.parent / scenario), record_period=1e-3), accuracy="draft")
    result.save(path)
    forget("zlaw")
    (path.parent / RAN).unlink()
    return result


@pytest.mark.parametrize("scenario", ["law.toml", "module.toml"])
def test_a_run_has_its_numbers_without_the_module_of_its_law(
    foreign: Path, scenario: str, capsys: pytest.CaptureFixture[str]
) -> None:
    made = run_of(scenario, foreign / "run.h5")
    with pytest.warns(UserWarning, match="zlaw.py, which is not imported: .*--import .*trusted"):
        read = Result.load(foreign / "run.h5")
    assert read.numbers() == made.numbers()
    assert read.scenario.to_data() == made.scenario.to_data()
    assert pickle.loads(pickle.dumps(read.scenario)) == read.scenario
    assert "Foreign" in read._repr_html_()
    contact = read.scenario.clearance_pins["pin"].contact
    with pytest.raises(InputError, match="is not imported"):
        (contact.normal if scenario == "law.toml" else contact.friction)(1.0, 1.0, 1.0)
    with pytest.raises(InputError, match="is not imported"):
        simulate(read.scenario)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        for command, code in SHOWING.items():
            assert main(command.format(run=foreign / "run.h5").split()) == code, command
            said = capsys.readouterr()
            assert code == 0 or "zlaw.py, which is not imported" in said.err
    assert not (foreign / RAN).exists()
    trusted(foreign / "zlaw.py")
    assert Result.load(foreign / "run.h5").scenario.pins == read_scenario(foreign / scenario).pins


def test_a_run_of_a_machine_that_is_not_imported_is_refused(foreign: Path) -> None:
    run_of("machine.toml", foreign / "run.h5")
    with pytest.raises(InputError, match=r"'ForeignStand' is a class of .*zlaw.py, which is not imported"):
        Result.load(foreign / "run.h5")
    assert not (foreign / RAN).exists()


@pytest.mark.parametrize("name", SCENES)
def test_a_scenario_runs_no_python(foreign: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    sweeps = name == "sweep.toml"
    for command in ("sweep",) if sweeps else ("run", "check", "channels"):
        code = main([command, name])
        said = capsys.readouterr()
        assert "which is not imported: files run no Python by themselves" in said.err + said.out
        assert code == 1 or command == "check"  # of a pin's law: the machine can be looked at
    with pytest.raises(InputError, match="which is not imported"):
        read_sweep(foreign / name).scenario({"pins.pin.clearance_mm": 1}) if sweeps else read_scenario(
            foreign / name
        )
    if name == "machine.toml":
        with pytest.raises(InputError, match="which is not imported"):
            read_machine_in(foreign / name)
    assert not (foreign / RAN).exists()


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
    (path.parent / "__init__.py").write_text("") if path.parent != tmp_path else None
    path.write_text(LAW.format(name=name))
    trusted(path)
    assert kinds_of(Value)[name].__module__ == module
    assert modules_of({"law": [{"type": name}]}) == {name: {"module": module, "path": str(path)}}


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("gone.py", None, "there is no such file"),
        ("broken.py", "1 / 0", "ZeroDivisionError"),
        ("pytest.py", "", "pytest is the name of another module already; allowed: a file of another name"),
    ],
)
def test_what_cannot_be_imported_is_said(
    name: str, text: str | None, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    if text is not None:
        (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=told):
        trusted(tmp_path / name)
