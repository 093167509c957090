"""Laws of one's own as functions: in Python and in files, compiled or not, and their machine code."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support_exudyn import ClearancePin, ImpactStand, Result, Scenario, SolverSettings, simulate
from support_exudyn.__main__ import main
from support_exudyn.scene.compilation import address_of, contact_law
from tests.cases.law_cases import BEARING
from user_forces import (
    Ambrosio,
    FrictionLaw,
    InputError,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
    Value,
    friction_law,
    normal_law,
)
from user_forces.kernel import kernel, name_of
from user_forces.values.value import Fraction, Positive

UNITS = {"N": 1.0}


@normal_law
def textbook(
    depth: float,
    rate: float,
    impact_velocity: float,
    stiffness: Positive,
    restitution: Fraction = 0.9,
    rest_velocity: float = 0.01,
) -> float:
    """Lankarani and Nikravesh's law once more."""
    speed = impact_velocity
    if speed < rest_velocity:
        speed = rest_velocity
    factor = 0.75 * (1.0 - restitution**2)
    return stiffness * math.pow(depth, 1.5) * (1.0 + factor / speed * rate)


@normal_law
def uncompiled(depth: float, rate: float, impact_velocity: float, stiffness: float) -> float:
    return (
        UNITS["N"] * stiffness * depth**1.5 * (1.0 + 0.75 * (1.0 - 0.9**2) / max(impact_velocity, 0.01) * rate)
    )


@friction_law
def rounded(slip: float, normal_force: float, coefficient: float = 0.2, speed: float = 1e-2) -> float:
    if slip == 0.0:
        return 0.0
    return -math.copysign(coefficient, slip) * normal_force * math.tanh(abs(slip) / speed)


@friction_law
def caught(slip: float, normal_force: float) -> float:
    try:
        return -0.2 * normal_force * slip / (abs(slip) + 1e-2)
    except ZeroDivisionError:
        return 0.0


def struck(normal: NormalLaw, friction: FrictionLaw, formulation: str = "exudyn") -> Result:
    """A journal that hits the wall of its bore, and what is left of it."""
    contact = JournalContact(bearing=BEARING, normal=normal, friction=friction)
    return simulate(
        Scenario(
            machine=ImpactStand(bore_mass=3.0, journal_mass=2.0, speed=0.3, eccentricity=1.4e-3),
            pins={"pin": ClearancePin(contact=contact)},
            duration=4e-3,
            gravity=(0.0, -9.81),
            record_period=1e-4,
            formulation=formulation,
            solver=SolverSettings(impact_steps=128, tolerance=1e-9),
        )
    )


# --- classes from functions ---


def test_a_function_becomes_a_class_of_laws() -> None:
    law: Any = textbook(stiffness=1e9)
    known = LankaraniNikravesh(stiffness=1e9, restitution=0.9)
    assert (type(law).__name__, law.restitution, law.__doc__) == (
        "Textbook",
        0.9,
        "Lankarani and Nikravesh's law once more.",
    )
    for depth, rate, speed in ((1e-4, 0.3, 0.5), (1e-6, -0.2, 1e-3)):
        assert law(depth, rate, speed) == pytest.approx(known(depth, rate, speed), rel=1e-14)  # rounding
        # the force at no rate, and its integral by a rule of 24 nodes
        assert law.elastic_force(depth) == pytest.approx(known.elastic_force(depth), rel=1e-14)
        assert law.elastic_energy(depth) == pytest.approx(known.elastic_energy(depth), rel=1e-12)
    assert Value.from_data(json.loads(json.dumps(law.to_data()))) == law
    with pytest.raises(InputError, match=r"Textbook\.stiffness = -1\.0: .*allowed: > 0"):
        textbook(stiffness=-1.0)
    assert rounded()(0.5, 10.0) == -2.0
    assert "rounded" in (rounded.__doc__ or "")


@pytest.mark.parametrize(
    ("make", "function", "said"),
    [
        (normal_law, lambda depth, rate: depth, "are depth, rate; allowed: depth, rate, impact_velocity"),
        (normal_law, lambda: 1.0, "are none; allowed: depth, rate, impact_velocity"),
        (friction_law, lambda normal_force, slip: 0.0, "are normal_force, slip; allowed: slip, normal_force"),
    ],
)
def test_a_function_of_other_arguments_is_refused(make: Callable[..., Any], function: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        make(function)


# --- runs ---


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
def test_a_law_with_branches_runs_as_ours_does(formulation: str) -> None:
    own = struck(textbook(stiffness=1e9), rounded(coefficient=0.1), formulation)
    ours = struck(LankaraniNikravesh(stiffness=1e9, restitution=0.9), rounded(coefficient=0.1), formulation)
    assert len(own.onsets["pin"]) >= 1
    assert own["energy.friction_loss"][-1] >= 0.0
    for name in ("pin.pin.depth", "pin.pin.force", "journal.velocity_x", "energy.damping_loss"):
        scale = np.abs(ours[name]).max()
        # rounding of powers, magnified by an impact
        np.testing.assert_allclose(own[name], ours[name], rtol=0.0, atol=1e-8 * scale)


def test_a_law_that_numba_cannot_compile_runs_on_exudyn_alone() -> None:
    known = LankaraniNikravesh(stiffness=1e9, restitution=0.9)
    pairs = [(uncompiled(stiffness=1e9), Ambrosio(sliding_coefficient=0.2)), (known, caught())]
    for (normal, friction), reason in zip(pairs, ("global name 'UNITS'", "Exception matching"), strict=True):
        with pytest.raises(InputError, match=rf"pins\.pin\.contact = .*numba cannot compile it: .*{reason}"):
            struck(normal, friction, "compiled")
        with pytest.warns(UserWarning, match=f"computed in Python, since numba cannot compile it: .*{reason}"):
            found = struck(normal, friction)
        # without slip it is the same impact
        wanted = struck(known, Ambrosio(sliding_coefficient=0.2))
        assert found.onsets["pin"][0].speed == pytest.approx(wanted.onsets["pin"][0].speed, rel=1e-9)
        assert found.largest_force["pin"] == pytest.approx(wanted.largest_force["pin"], rel=1e-6)


OWN = """
import math
from user_forces import friction_law, normal_law

@normal_law
def of_a_file(depth, rate, impact_velocity, stiffness: float, exponent: float = 1.5):
    if depth <= 0.0:
        return 0.0
    return stiffness * depth**exponent

@friction_law
def creeping(slip, normal_force, coefficient: float):
    return -coefficient * normal_force * math.tanh(slip / 1e-2)
"""
SCENARIO = """
duration_s = 0.004
record_period_ms = 0.1
formulation = "compiled"

[machine]
type = "ImpactStand"
bore_mass_kg = 3
journal_mass_kg = 2
speed_m_per_s = 0.3
eccentricity_mm = 1.4

[pins.pin]
type = "ClearancePin"
[pins.pin.contact]
bearing = {type = "JournalBearing", bore_radius_mm = 65.5, clearance_mm = 1.5}
normal = {type = "own_of_a_file.py:OfAFile", stiffness = 1e9}
friction = {type = "own_of_a_file.py:Creeping", coefficient = 0.1}
"""


def test_a_scenario_file_names_laws_of_its_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "own_of_a_file.py").write_text(OWN, encoding="utf-8")
    (tmp_path / "a.toml").write_text(SCENARIO, encoding="utf-8")
    assert main(["run", str(tmp_path / "a.toml")]) == 1
    assert "--import" in capsys.readouterr().err
    command = ["--import", str(tmp_path / "own_of_a_file.py"), "run", str(tmp_path / "a.toml")]
    assert main([*command, "--out", str(tmp_path / "a")]) == 0
    result = Result.load(tmp_path / "a")
    assert result.scenario.clearance_pins["pin"].contact.normal.to_data() == {
        "type": "OfAFile",
        "stiffness": 1e9,
        "exponent": 1.5,
    }
    # it gives all speed back
    assert result.onsets["pin"][0].separation_velocity == pytest.approx(0.3, abs=1e-6)


# --- machine code ---


@kernel
def slope(x: float) -> float:
    return 2.0 * x


def made(factor: float, inner: Callable[[float], float] = slope) -> Callable[[float], float]:
    def scaled(x: float) -> float:
        return factor * inner(x)

    return scaled


def law_of(text: str, **names: Any) -> Callable[[float, float, float], float]:
    """A law from its text, as a file is imported anew."""
    space: dict[str, Any] = {"__name__": "own_file", **names}
    exec(f"def law(depth, rate, impact_velocity):\n    return {text}", space)
    return space["law"]  # type: ignore[no-any-return]


def test_the_name_of_machine_code_follows_from_all_code_that_is_reached() -> None:
    assert name_of(made(2.0)) == name_of(made(2.0))
    assert name_of(made(2.0)) != name_of(made(3.0))
    assert name_of(made(2.0)) != name_of(made(2.0, lambda x: 3.0 * x))
    others = (
        law_of("1e9 * depth"),
        law_of("2e9 * depth"),
        law_of("1e9 * depth + rate"),
        law_of("k * depth", k=1.0),
    )
    others = *others, law_of("k * depth", k=2.0), law_of("k(depth)", k=slope), law_of("k(depth)", k=made(1.0))
    assert len({name_of(law) for law in others}) == len(others)

    def kernel_of(text: str) -> Callable[..., Any]:
        law = normal_law(law_of(text))()
        return contact_law(JournalContact(bearing=BEARING, normal=law).law_kernel, 3)

    # of the whole contact, as the compiled formulation calls it
    assert name_of(kernel_of("1e9 * depth")) != name_of(kernel_of("2e9 * depth"))
    assert address_of(kernel_of("1e9 * depth")) != address_of(kernel_of("2e9 * depth"))
