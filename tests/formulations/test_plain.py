"""The same functions without a compiler: as they stand, on arrays, and where numba is not installed."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from support_exudyn import ClearancePin, CubicStep, Scenario, SimulationError, UniformSpeed
from support_exudyn.formulations import compiled as compiling
from support_exudyn.formulations.compiled import compiled, on_arrays, plain
from support_exudyn.formulations.reduced import layout, support_model
from support_exudyn.formulations.reduced.drive import Drive, driven
from support_exudyn.formulations.reduced.equations import law_at
from support_exudyn.formulations.reduced.parameters import parameters
from support_exudyn.formulations.reduced.support_posture import meeting_point
from tests.cases.machine_cases import contact, support
from tests.processes import environment
from tests.reduced import simulate_reduced
from user_forces import FrictionLaw, InputError, value
from user_forces.expressions.scalar import exp, magnitude, where

PIN = support_model.PIN


def scene(**changes: Any) -> Scenario:
    """A fall through the clearance with a jump of the columns' speed, or what changes say."""
    fields: dict[str, Any] = {
        "machine": support(),
        "duration": 0.04,
        "pins": {PIN: ClearancePin(contact=contact())},
        "drive": UniformSpeed(stroke=0.01, start=0.02, end=0.05),
    }
    return Scenario(**fields | changes)


# --- functions as they stand ---


@compiled
def half(x: float) -> float:
    return 0.5 * math.sqrt(x)


@compiled
def whole(x: float) -> float:
    return half(x) + half(x)


def test_a_plain_function_calls_plain_functions() -> None:
    assert plain(whole)(9.0) == 3.0
    assert plain(whole, half=lambda x: x)(9.0) == 18.0
    np.testing.assert_array_equal(on_arrays(whole)(np.array([4.0, 9.0])), [2.0, 3.0])


def test_what_stands_for_a_name_does_so_nowhere_else() -> None:
    plain(whole, half=lambda x: x)
    assert plain(whole)(9.0) == 3.0


def test_named_tuples_keep_their_fields() -> None:
    segment = [0.0] * layout.SEGMENT
    segment[layout.WIDTH], segment[layout.A1] = 2.0, 3.0
    found = plain(driven)(segment, 1.0)
    assert [getattr(found, name) for name in Drive._fields] == [1.5, 1.5, 0.0]


def test_circles_that_do_not_meet() -> None:
    # compiled code gives nan, plain Python an error; the runs expect both
    with pytest.raises(ValueError, match=r"math domain error|nonnegative"):
        plain(meeting_point)(0.0, 0.0, 1.0, 5.0, 0.0, 1.0, 1.0)


@pytest.mark.parametrize("bore", ["first", "second"])
def test_equations_of_motion_on_arrays_are_those_of_every_instant(bore: str) -> None:
    pin = ClearancePin(contact=contact(), bore=bore)
    p = parameters(scene(pins={PIN: pin}), support_model.parameters(support()), pin).tolist()
    rng = np.random.default_rng(2)
    count, start = 7, np.array(support_model.start(support()))
    y = np.zeros((layout.STATES, count))
    y[:2] = start[:, None] + 0.01 * rng.normal(size=(2, count))
    y[2:4] = rng.normal(size=(2, count))
    drive = Drive(*0.1 * rng.normal(size=(3, count)))
    pins, laws = on_arrays(law_at)(p, drive, y, 1.0)
    for n in range(count):
        at = Drive(*(item[n] for item in drive))
        pin_then, law_then = plain(law_at)(p, at, y[:, n].tolist(), 1.0)
        for many, one in ((pins, pin_then), (laws, law_then)):
            for name in one.__dataclass_fields__:
                got = np.broadcast_to(getattr(many, name), (count,))[n]
                # numpy's sines may differ in the last digit; sums of terms up to 1e5
                assert got == pytest.approx(getattr(one, name), rel=1e-10, abs=1e-9), name


# --- laws that break ---


@value
class Breaking(FrictionLaw):
    """Has no force that is a number above a slip of 0.1 mm/s."""

    kind: str

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        speed = magnitude(slip)
        if self.kind == "nan":
            infinite = (1.0 + speed) * 1e308 * 1e2
            return where(speed < 1e-4, 0.0, infinite - infinite)
        if self.kind == "overflow":
            return 0.0 * exp(7.1e6 * speed)
        raise LookupError("a bug in the law")


def breaking(kind: str) -> Scenario:
    return scene(pins={PIN: ClearancePin(contact=replace(contact(), friction=Breaking(kind=kind)))})


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("nan", f"{PIN}: Breaking gives a force of nan N at a slip of "),
        ("overflow", "the linkage cannot close, or a value is no longer a finite number"),
    ],
)
def test_a_law_that_gives_no_number_stops_the_run(kind: str, reason: str) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_reduced(breaking(kind))
    assert 0.01 < caught.value.failure.time < 0.04
    assert caught.value.failure.reason.startswith(reason)


def test_a_bug_in_a_law_is_not_hidden() -> None:
    with pytest.raises(LookupError, match="a bug in the law"):
        simulate_reduced(breaking("bug"))


# --- without numba ---

SCRIPT = """
import json, sys
sys.modules["numba"] = None  # as if it were not installed: importing it fails
from support_exudyn import compiled
from support_exudyn.sweeps.precompile import warm_up
from support_exudyn import CubicStep
from tests.reduced import simulate_reduced
from tests.formulations.test_plain import scene
from user_forces import InputError

assert not compiled.is_compiling()
found = {}
for backend in ("auto", "python"):
    result = simulate_reduced(scene(), backend=backend)
    found[backend] = {name: channel.values.tolist() for name, channel in result.channels.items()}
    found[backend]["onsets"] = result.onsets["rear_base"]
ideal = simulate_reduced(scene(pins={}, drive=CubicStep(stroke=0.1, start=0.01, end=0.05)))
found["ideal"] = {name: channel.values.tolist() for name, channel in ideal.channels.items()}
try:
    simulate_reduced(scene(), backend="compiled")
except InputError as error:
    found["refused"] = str(error)
warm_up()  # has nothing to compile, and does no harm
print(json.dumps(found))
"""


@pytest.fixture(scope="module")
def without() -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", SCRIPT],
        capture_output=True,
        text=True,
        env=environment(),
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)  # type: ignore[no-any-return]


def test_without_numba_everything_runs_in_plain_python(without: dict[str, Any]) -> None:
    result = simulate_reduced(scene(), backend="python")
    for backend in ("auto", "python"):
        assert without[backend].pop("onsets") == [list(onset) for onset in result.onsets[PIN]]
        assert without[backend].keys() == result.channels.keys()
        for name, values in without[backend].items():
            # the same arithmetic, bit for bit
            np.testing.assert_array_equal(values, result[name], err_msg=name)


def test_without_numba_ideal_pins_are_those_of_the_compiled_run(without: dict[str, Any]) -> None:
    compiled_run = simulate_reduced(scene(pins={}, drive=CubicStep(stroke=0.1, start=0.01, end=0.05)))
    for name, values in without["ideal"].items():
        largest = np.abs(compiled_run[name]).max()
        # Newton's method to 1e-14 m
        np.testing.assert_allclose(values, compiled_run[name], rtol=0, atol=1e-9 * largest + 1e-9, err_msg=name)


def test_without_numba_compiled_is_refused_with_what_to_do(
    without: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert "numba is not installed" in without["refused"]
    assert "pip install 'support-exudyn[fast]'" in without["refused"]
    monkeypatch.setattr(compiling, "numba", None)
    with pytest.raises(InputError, match="numba is not installed; allowed: 'auto', 'python'"):
        simulate_reduced(scene(), backend="compiled")
