"""Laws of one's own that a file names by where they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn import ClearancePin, trusted
from support_exudyn.files import read_scenario

LAWS = """
import math

from user_forces import FrictionLaw, value
from user_forces.kernel import kernel
from user_forces.normal.power_laws import ElasticPower
from user_forces.normal.law import NormalLaw
from user_forces.values.value import NonNegative, Positive


@value
class {0}Normal(ElasticPower):
    @staticmethod
    @kernel
    def force(depth, rate, impact_velocity, stiffness, exponent):
        return 2.0 * stiffness * depth**exponent


@value
class {0}Friction(FrictionLaw):
    mu: NonNegative

    @staticmethod
    @kernel
    def force(slip, normal_force, mu):
        return -mu * normal_force * math.tanh(slip / 1e-2)


@value
class {0}Rig(NormalLaw):
    stiffness: Positive = 1e8
    exponent: Positive = 1.2

    @staticmethod
    @kernel
    def force(depth, rate, impact_velocity, stiffness, exponent):
        return stiffness * depth**exponent


class {0}Plain:
    pass
"""
TOP = """
machine = "reference"
duration_s = 0.1
[pins.rear_base]
clearance_mm = 1.5
"""


def write(folder: Path, lines: str, module: str, prefix: str) -> Path:
    (folder / f"{module}.py").write_text(LAWS.format(prefix), encoding="utf-8")
    trusted(folder / f"{module}.py")
    (folder / "a.toml").write_text(TOP + lines, encoding="utf-8")
    return folder / "a.toml"


@pytest.mark.parametrize("place", ["own_laws_{}.py", "own_laws_{}"])
def test_a_law_is_named_by_its_file_or_module(tmp_path: Path, place: str) -> None:
    ending = "file" if place.endswith(".py") else "module"
    module, prefix = f"own_laws_{ending}", f"Of{ending.title()}"
    where = place.format(ending)
    lines = f'law = "{where}:{prefix}Normal"\nfriction_law = "{where}:{prefix}Friction"\nfriction = 0.2'
    pin = read_scenario(write(tmp_path, lines, module, prefix)).pins["rear_base"]
    assert isinstance(pin, ClearancePin)
    assert type(pin.contact.normal).__name__ == f"{prefix}Normal"
    assert pin.contact.friction.to_data() == {"type": f"{prefix}Friction", "mu": 0.2}
