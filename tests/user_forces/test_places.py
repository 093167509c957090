"""Classes of values that are imported when they are asked for: by name, all of them, and one's own."""

from __future__ import annotations

import subprocess
import sys

import pytest

import user_forces
from tests.processes import environment

ONE = """
import sys
import support_exudyn
from user_forces.values.value import Value

assert "support_exudyn.model.hydraulics.leg" not in sys.modules
inlet = Value.from_data({"type": "ClosedInlet"})
assert inlet is not None and type(inlet) is support_exudyn.ClosedInlet
assert "user_forces.normal.power_laws" not in sys.modules
assert Value.of_name("Hertz").__module__ == "user_forces.normal.power_laws"
assert "user_forces.normal.cylinders" not in sys.modules
assert Value.of_name("CoupledDrive") is not None  # which no package offers
"""
ALL = """
import importlib, pkgutil
import support_exudyn, user_forces
from user_forces.values.value import Value, kinds_of

known = dict(kinds_of(Value))
for package in (user_forces, support_exudyn):
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if not module.name.startswith(("support_exudyn.postprocessing", "support_exudyn.documentation")):
            importlib.import_module(module.name)
found = {name: kind for name, kind in kinds_of(Value).items() if "postprocessing" not in kind.__module__}
assert found == known
"""
OWN = """
import sys
from user_forces import PowerLaw, value
from user_forces.values.value import Value, kinds_of

@value
class Goldsmith(PowerLaw):
    def factor(self, restitution: float) -> float:
        return 1.0 - restitution

assert "user_forces.normal.cylinders" not in sys.modules
assert kinds_of(Value)["Goldsmith"] is Goldsmith
assert "user_forces.normal.cylinders" in sys.modules
assert type(Value.from_data({"type": "Goldsmith", "stiffness": 1e9, "restitution": 0.5})) is Goldsmith
"""


@pytest.mark.parametrize(
    "script",
    [
        pytest.param(ONE, id="a class is imported by its name, and no other"),
        pytest.param(ALL, id="no class is missed"),
        pytest.param(OWN, id="one's own of the same name stands, though it is imported first"),
    ],
)
def test_classes_are_found_in_a_program_that_has_not_imported_them(script: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment(), capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_a_name_of_a_package_that_there_is_not_is_told() -> None:
    with pytest.raises(
        AttributeError, match=r"module 'user_forces' has no attribute 'Herz'; did you mean 'Hertz'"
    ):
        user_forces.Herz  # type: ignore[attr-defined] # noqa: B018
    assert "Hertz" in dir(user_forces)
