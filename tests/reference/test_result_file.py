"""A result is saved to one file and read back whole."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Held, Result, UniformSpeed, simulate
from tests.reference.cases import SLIDER_PIN, loose_slider_crank, loose_support
from user_forces import InputError, LuGre


@pytest.fixture(scope="module")
def result() -> Result:
    return simulate(loose_support(1.5, 0.25, drive=Held(), duration=0.06))


@pytest.fixture(scope="module")
def crank() -> Result:
    """A crank, a slide, an impulse, and friction with a state."""
    scenario = loose_slider_crank(3e-4, drive=UniformSpeed(stroke=52.4, start=0.0, end=0.1))
    pin = scenario.clearance_pins[SLIDER_PIN]
    friction = LuGre(static_coefficient=0.1, sliding_coefficient=0.05)
    contact = dataclasses.replace(pin.contact, friction=friction)
    pins = {SLIDER_PIN: dataclasses.replace(pin, contact=contact)}
    return simulate(dataclasses.replace(scenario, pins=pins))


@pytest.mark.parametrize("kind", ["result", "crank"])
def test_it_reads_back_as_it_was(kind: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    result: Result = request.getfixturevalue(kind)
    back = Result.load(result.save(tmp_path / "deep" / "run.h5"))
    assert back.scenario == result.scenario
    assert back.onsets == result.onsets
    assert back.impulses == result.impulses
    assert back.counts == result.counts
    assert back.largest_force == result.largest_force
    assert back.wall_time == result.wall_time
    assert back.provenance == result.provenance
    assert set(back.channels) == set(result.channels)
    for name, channel in result.channels.items():
        np.testing.assert_array_equal(back[name], channel.values)
        assert back.unit(name) == channel.unit
        assert back.channels[name].meaning == channel.meaning


def test_the_saved_scenario_gives_the_same_run_again(result: Result, tmp_path: Path) -> None:
    again = simulate(Result.load(result.save(tmp_path / "run.h5")).scenario)
    for name in result.channels:
        np.testing.assert_array_equal(again[name], result[name])  # same machine, same versions: to the bit


def test_provenance_names_versions_and_settings(result: Result) -> None:
    assert {"python", "exudyn", "numpy", "support-exudyn", "platform", "made_at"} <= set(result.provenance)
    data = result.scenario.to_data()
    assert data["step"] == result.scenario.step
    assert data["solver"]["spectral_radius"] == 0.5


@pytest.mark.parametrize("damage", ["cut", "text", "empty"])
def test_a_damaged_file_is_refused(result: Result, tmp_path: Path, damage: str) -> None:
    path = result.save(tmp_path / "run.h5")
    whole = path.read_bytes()
    path.write_bytes({"cut": whole[: len(whole) // 2], "text": b"not a result", "empty": b""}[damage])
    with pytest.raises(InputError, match="damaged"):
        Result.load(path)


def test_a_missing_file_is_said_to_be_missing(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no such file"):
        Result.load(tmp_path / "nowhere.h5")


def test_an_unknown_channel_lists_those_there_are(result: Result) -> None:
    with pytest.raises(KeyError, match=r"tip\.x"):
        result["tip.z"]


@pytest.mark.parametrize("kind", ["result", "crank"])
def test_every_channel_has_a_unit_and_the_length_of_time(kind: str, request: pytest.FixtureRequest) -> None:
    result: Result = request.getfixturevalue(kind)
    for channel in result.channels.values():
        assert channel.values.shape == result.time.shape
        assert channel.unit in {"s", "m", "m/s", "rad", "rad/s", "rad/s^2", "N", "N m", "J"}
        assert channel.meaning


def test_cranks_slides_and_states_of_friction_have_channels(crank: Result) -> None:
    units = {name: channel.unit for name, channel in crank.channels.items()}
    new = {"crank.moment": "N m", "guide.force": "N", "guide.moment": "N m"}
    new[f"pin.{SLIDER_PIN}.deflection"] = "m"
    assert new.items() <= units.items()
    (impulse,) = crank.impulses
    assert set(impulse.cranks) == {"crank"}
    assert len(crank.onsets[SLIDER_PIN]) >= 1
    assert np.abs(crank[f"pin.{SLIDER_PIN}.deflection"]).max() > 0.0


def test_friction_without_a_state_has_no_channel_of_it(result: Result) -> None:
    assert "pin.rear_base.friction_force" in result.channels
    assert "pin.rear_base.deflection" not in result.channels


def test_a_failed_save_leaves_the_old_file(result: Result, tmp_path: Path) -> None:
    path = result.save(tmp_path / "run.h5")
    before = path.read_bytes()
    broken = dataclasses.replace(result, provenance={"versions": object()})  # type: ignore[dict-item]
    with pytest.raises(TypeError):
        broken.save(path)
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["run.h5"]
