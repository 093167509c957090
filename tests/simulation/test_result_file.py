"""A result is saved to one file and read back whole."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
import pytest

from support_exudyn import Held, Result, UniformSpeed, simulate
from support_exudyn.files.hdf5 import BLOCK, with_checksum
from support_exudyn.simulation.result import FORMAT
from tests.cases.run_cases import SLIDER_PIN, loose_slider_crank, loose_support
from user_forces import InputError, LuGre


@contextmanager
def changed(path: Path) -> Iterator[h5py.File]:
    """A file to change by hand; its digest is then made anew."""
    with h5py.File(path, "r+") as file:
        yield file
    path.write_bytes(with_checksum(path.read_bytes()[BLOCK:], FORMAT))


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


# --- runs by which errors are estimated ---


@pytest.fixture(scope="module")
def estimated() -> Result:
    return simulate(loose_support(1.5, 0.25, drive=Held(), duration=0.06), accuracy="draft")


def test_the_runs_by_which_errors_are_estimated_come_back(estimated: Result, tmp_path: Path) -> None:
    back = Result.load(estimated.save(tmp_path / "run.h5"))
    one, other, depth = estimated, back, 0
    while one.coarser is not None:
        assert other.coarser is not None
        assert (other.goal, other.scenario, other.onsets) == (one.goal, one.scenario, one.onsets)
        assert (other.counts, other.wall_time) == (one.counts, one.wall_time)
        one, other, depth = one.coarser, other.coarser, depth + 1
        for name in one.channels:
            np.testing.assert_array_equal(other[name], one[name])
    assert other.coarser is None
    assert depth == 2
    # what is made of them, to the bit
    assert back.numbers() == estimated.numbers()
    assert back.numbers(0.02, 0.05) == estimated.numbers(0.02, 0.05)
    assert (back.fall, back.worst_error, back.met) == (estimated.fall, estimated.worst_error, True)


def deleted(name: str) -> Callable[[h5py.Group], None]:
    def damage(group: h5py.Group) -> None:
        del group[name]

    return damage


def replaced(name: str, values: object) -> Callable[[h5py.Group], None]:
    def damage(group: h5py.Group) -> None:
        attributes = dict(group[name].attrs)
        del group[name]
        group.create_dataset(name, data=values).attrs.update(attributes)

    return damage


def turn_time_back(group: h5py.Group) -> None:
    group["channels/time"][3] = group["channels/time"][1]


DAMAGES = [
    deleted("channels"),
    lambda group: group.attrs.__delitem__("scenario"),
    lambda group: group.attrs.__setitem__("counts", '{"steps": 1, "leaps": 2}'),
    replaced("onsets/rear_base", np.zeros((2, 3))),
    turn_time_back,
    replaced("channels/tip.x", np.zeros(3)),
    replaced("channels/time", np.zeros(0)),
]


@pytest.mark.parametrize("group", ["/", "coarser", "coarser/coarser"])
@pytest.mark.parametrize("damage", DAMAGES)
def test_a_file_with_a_damaged_group_is_refused(
    estimated: Result, tmp_path: Path, group: str, damage: Callable[[h5py.Group], None]
) -> None:
    path = estimated.save(tmp_path / "run.h5")
    with changed(path) as file:
        damage(file[group])
    with pytest.raises(InputError, match=r"run\.h5: not a result file of this program, or damaged"):
        Result.load(path)


def test_a_file_that_is_cut_off_or_has_a_changed_byte_is_refused(result: Result, tmp_path: Path) -> None:
    path = result.save(tmp_path / "run.h5")
    whole, chance = path.read_bytes(), np.random.default_rng(1)
    lengths = [0, 3, BLOCK - 1, BLOCK, len(whole) - 1, *chance.integers(0, len(whole), 5)]
    places = [0, BLOCK - 1, BLOCK, len(whole) - 1, *chance.integers(0, len(whole), 10)]
    flipped = [whole[:place] + bytes([whole[place] ^ 4]) + whole[place + 1 :] for place in places]
    for damaged in (*(whole[:length] for length in lengths), *flipped):
        path.write_bytes(damaged)
        with pytest.raises(InputError, match=r"run\.h5: not a result file of this program, or damaged \("):
            Result.load(path)


@pytest.mark.parametrize("group", ["coarser", "coarser/coarser"])
def test_a_coarser_run_without_a_channel_is_refused(estimated: Result, tmp_path: Path, group: str) -> None:
    path = estimated.save(tmp_path / "run.h5")
    with changed(path) as file:
        for kind in ("channels", "statistics"):
            del file[f"{group}/{kind}/pin.rear_base.force"]
    with pytest.raises(
        InputError, match=r"run\.h5: .*damaged \(the coarser run lacks .*'pin\.rear_base\.force'"
    ):
        Result.load(path)


def test_a_file_of_another_version_says_so(result: Result, tmp_path: Path) -> None:
    path = result.save(tmp_path / "run.h5")
    image = path.read_bytes()[BLOCK:]
    path.write_bytes(with_checksum(image, "support_exudyn result 7"))
    with pytest.raises(InputError, match=r"format is '.* result 7', expected '.* result 6'"):
        Result.load(path)
    path.write_bytes(image)  # versions before had no digest
    with pytest.raises(InputError, match=r"an HDF5 file without a digest, as no version from '.* result 6' on"):
        Result.load(path)
