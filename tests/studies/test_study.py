"""What studies share: numbers with errors in words, options, and runs with errors."""

from __future__ import annotations

import math
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from studies.common import rise
from studies.common import runs as runs_module
from studies.common.numbers import Number, against, error_of_records, measured_all, with_error
from studies.common.options import Options
from studies.common.rise import Series, Versus, WholeNumber
from studies.common.runs import halvings, run_cases, run_with_errors
from studies.common.subject import own_subject
from support_exudyn import CubicStep, IdealPin, Result, Scenario, Steady, ravn_slider_crank
from support_exudyn.files import save_scenario
from support_exudyn.postprocessing.shown_numbers import rounded
from tests.cases.run_cases import loose_support
from user_forces.values.value import InputError

MACHINES = Path(str(resources.files("support_exudyn.files.machines")))
sizes = st.floats(1e-9, 1e9)
values = sizes | sizes.map(lambda x: -x)
shares = st.floats(-12.0, 1.0).map(lambda x: 10.0**x)  # an error, of the number


# --- numbers with errors ---


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (51503.8323, 0.0088, "51503.8"),
        (51503.8323, 0.88, "51503.8 ± 0.9"),
        (7.0, 8.0, "7 ± 8"),
        (0.006566085, 2.5e-11, "0.00656609"),
        (0.0, 2.5e-11, "0 ± 2.5e-11"),
        (3.21e-9, 2.5e-11, "3.210e-09 ± 2.5e-11"),
        (1.8e7, 3.2e5, "18000000 ± 320000"),
        (51503.8323, 255.0, "51500 ± 260"),
        (0.015271, 0.000097, "0.015271 ± 0.000097"),
        (-3.690176, 0.0123, "-3.690 ± 0.012"),
        (857942.947, 0.0, "857942.947"),
        (1.0, math.inf, "1"),
        (1.0, math.nan, "1"),
        (12.0, 1.0, "12 ± 1"),
    ],
)
def test_a_number_is_rounded_to_the_digits_that_its_error_leaves(value: float, error: float, text: str) -> None:
    assert rounded(value, error) == text


@given(share=st.floats(1e-8, 3.0), change=st.floats(-0.9, 5.0))
@example(share=0.5, change=0.0625)
def test_a_change_in_per_cent_is_told_to_its_error(share: float, change: float) -> None:
    base = Number("n", "a", 100.0, "N", 0.5 * share)
    text = against(Number("n", "b", 100.0 * (1.0 + change), "N", 0.5 * share), base)
    error = 0.5 * share * (2.0 + change)  # [%]
    assert "e" not in text.replace("the same", "").replace("within", "")
    if text.startswith("the same"):
        assert abs(100.0 * change) <= error * (1.0 + 1e-9)
    else:
        number = text.removesuffix(" %")
        assert number.startswith(("+", "-"))
        digits = len(number.partition(".")[2])
        assert abs(float(number) - 100.0 * change) <= 0.501 * 10.0**-digits
        assert digits == 0 or 10.0**-digits >= 0.99 * min(error, 0.1 * abs(100.0 * change))


def test_the_error_of_records_covers_what_lies_between_them() -> None:
    # impacts: a force with corners, at least eight records each
    end, shares = 2.0, []
    fine = np.linspace(0.0, end, 200_001)
    for rate, phase in np.random.default_rng(7).uniform((3.0, 0.0), (60.0, 6.0), (40, 2)):

        def force(time: Series, rate: float = rate, phase: float = phase) -> Series:
            return np.maximum(0.0, np.sin(2.0 * np.pi * rate * time + phase))

        for period in (1e-3, 2e-3):
            time = np.arange(0.0, end + 0.5 * period, period)
            found = [rise.mean(time[::n], force(time[::n])) for n in range(1, 6)]
            off = abs(found[0] - rise.mean(fine, force(fine)))
            shares.append(off / error_of_records(lambda every, found=found: found[every - 1]))  # type: ignore[misc]
    assert np.mean(np.array(shares) <= 1.0) >= 0.95


# --- one's own machine ---


def test_a_scenario_of_ones_own_keeps_all_but_the_clearance_and_the_friction(tmp_path: Path) -> None:
    mine = loose_support(duration=2.0, drive=CubicStep(start=0.5, end=1.5, stroke=0.2))
    path = save_scenario(mine, tmp_path / "my_support.toml")
    subject = own_subject(path)
    (pin,) = mine.pins
    assert (subject.pin, subject.name, subject.is_paper) == (pin, "my support", False)
    assert (subject.watched.start, subject.watched.end) == (0.5, 1.5)
    assert subject.watched.force == f"pin.{pin}.force"
    assert subject.ideal().pins == {pin: IdealPin()}
    loose, tight = subject.with_clearance(0.7, 0.1), subject.ideal(0.1).pins[pin]
    contact = loose.pins[pin].contact  # type: ignore[attr-defined]
    given = mine.pins[pin].contact  # type: ignore[attr-defined]
    assert contact.bearing == replace(given.bearing, clearance=0.7e-3)
    assert contact.normal == given.normal
    assert contact.friction.sliding_coefficient == 0.1
    # the ideal pin that it is compared with has the same friction
    assert tight == IdealPin(friction=contact.friction, radius=contact.bearing.bore_radius)
    assert (loose.drive, loose.duration) == (mine.drive, mine.duration)


@pytest.mark.parametrize("form", ["name", "file", "scenario", "scenario with the pin"])
def test_a_pin_of_ones_own_machine_has_the_bore_of_its_file(form: str, tmp_path: Path) -> None:
    path = Path(shutil.copy(MACHINES / "zf18000.toml", tmp_path / "mine.toml"))
    if form.startswith("scenario"):
        path = tmp_path / "run.toml"
        pin = "[pins.rear_base]\nclearance_mm = 1.5\n" if form.endswith("pin") else ""
        path.write_text('machine = "mine.toml"\nduration_s = 5\ndrive = { mode = 2 }\n' + pin, encoding="utf-8")
    subject = own_subject(Path("zf18000") if form == "name" else path, "rear_base")
    contact = subject.with_clearance(1.5, 0.25).pins["rear_base"].contact  # type: ignore[attr-defined]
    assert contact.bearing.bore_radius == subject.bore_radius == pytest.approx(0.1008)
    assert (contact.normal.length, contact.normal.bearing) == (1.077, contact.bearing)  # of its file, too
    assert "bore of 100.8 mm radius along its length of 1077 mm" in subject.contact_in_words


@pytest.mark.parametrize(
    ("pin", "left_out", "message"),
    [
        ("rear_base", r"\[bore_radius_mm\][^\[]*", "rear_base: the radius of its bore is missing; allowed: "),
        ("middle", "$^", "--pin 'middle': no such pin; allowed: .*rear_base"),
    ],
)
def test_a_pin_or_a_bore_that_is_missing_is_asked_for(
    pin: str, left_out: str, message: str, tmp_path: Path
) -> None:
    text = (MACHINES / "zf18000.toml").read_text(encoding="utf-8")
    (tmp_path / "mine.toml").write_text(re.sub(left_out, "", text), encoding="utf-8")
    with pytest.raises(InputError, match=rf"mine\.toml: {message}"):
        own_subject(tmp_path / "mine.toml", pin)


# --- kept runs ---


def test_a_run_that_is_kept_is_not_made_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = Scenario(machine=ravn_slider_crank(), drive=Steady(rate=100.0), duration=0.002, step=1e-3)
    chosen = Options(tmp_path, kept=tmp_path / "kept")
    (first,) = run_cases({"a": case}, chosen).values()
    (file,) = (tmp_path / "kept").iterdir()
    monkeypatch.setattr(runs_module, "run_all", lambda *_, **__: pytest.fail("made again"))
    (again,) = run_cases({"under another name": case}, chosen).values()
    assert again.channels.keys() == first.channels.keys()
    assert all(np.array_equal(again[name], first[name]) for name in first.channels)
    monkeypatch.undo()
    file.write_bytes(file.read_bytes()[:1000])  # damaged
    (new,) = run_cases({"a": case}, chosen).values()
    assert np.array_equal(new.time, first.time)
    assert Result.load(file).time.size == first.time.size


# --- runs with errors ---


@pytest.fixture(scope="module")
def runs() -> dict[str, Result]:
    stand = Scenario(machine=ravn_slider_crank(), drive=Steady(rate=100.0), duration=0.01, step=1e-3)
    cases = {"slow": stand, "fast": replace(stand, drive=Steady(rate=300.0))}
    return run_with_errors(
        {name: replace(case, record_period=1e-3) for name, case in cases.items()}, Options(Path())
    )


def moment(run: Result) -> float:
    return float(np.abs(run["crank.moment"]).max())


def thinned(measure: Callable[[Result], float], every: int, run: Result) -> float:
    """The measure of every so many records."""
    channels = {name: replace(one, values=one.values[::every]) for name, one in run.channels.items()}
    return measure(replace(run, channels=channels, coarser=None))


def test_a_number_has_the_errors_of_steps_and_of_records(runs: dict[str, Result]) -> None:
    run = runs["fast"]
    (found,) = measured_all({"fast": run}, {"moment": ("N m", moment)}, papers={("moment", "fast"): 2.0})
    assert (found.value, found.unit, found.paper) == (moment(run), "N m", 2.0)
    of_records = error_of_records(lambda n: thinned(moment, n, run))
    assert found.numerical_error == run.estimate(moment).error + of_records
    *_, before, last = map(moment, halvings(run))
    assert found.numerical_error > abs(last - before) / 3.0  # which is the error of second order itself
    first, _, last_steps = (one.counts.steps for one in halvings(run))
    assert with_error(WholeNumber(lambda run: run.counts.steps), run) == (last_steps, last_steps - first)


def test_errors_of_both_runs_add_up_in_a_comparison(runs: dict[str, Result]) -> None:
    fast, slow = runs["fast"], runs["slow"]
    more = Versus(lambda run, other: moment(run) - moment(other))
    value, error = with_error(more, fast, slow)
    assert value == moment(fast) - moment(slow)
    apart = fast.estimate(moment).error + slow.estimate(moment).error
    apart += error_of_records(lambda n: thinned(moment, n, fast) - thinned(moment, n, slow))
    assert error == pytest.approx(apart, rel=1e-2)  # but for shares of rounding
    assert with_error(more, fast, fast) == (0.0, 0.0)
