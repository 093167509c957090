"""Result files that are cut, changed, or written to a full disk."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Held, Result, simulate
from support_exudyn.files.hdf5 import BLOCK
from support_exudyn.scenario.recorded_channels import Channel
from tests.cases.run_cases import loose_support
from tests.hostile import DISKS, little_room
from user_forces import InputError

FLIPS, CUTS = 60, 30


@pytest.fixture(scope="module")
def result() -> Result:
    return simulate(loose_support(1.5, 0.25, drive=Held(), duration=0.02))


@pytest.fixture(scope="module")
def whole(result: Result, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return result.save(tmp_path_factory.mktemp("whole") / "run.h5").read_bytes()


def is_refused(path: Path, data: bytes) -> bool:
    path.write_bytes(data)
    try:
        Result.load(path)
    except InputError as error:
        return str(error).startswith(f"{path}: not a result file of this program, or damaged (")
    return False


def test_a_changed_byte_is_found_wherever_it_is(whole: bytes, tmp_path: Path) -> None:
    chance = random.Random(1)
    places = [*range(0, BLOCK, 37), *chance.sample(range(BLOCK, len(whole)), FLIPS), len(whole) - 1]
    for place in places:
        data = bytearray(whole)
        data[place] ^= 1 << chance.randrange(8)
        assert is_refused(tmp_path / "run.h5", bytes(data)), place


def test_a_file_that_was_cut_off_is_refused_at_any_length(whole: bytes, tmp_path: Path) -> None:
    chance = random.Random(2)
    for length in [*range(4), BLOCK - 1, BLOCK, len(whole) - 1, *chance.sample(range(len(whole)), CUTS)]:
        assert is_refused(tmp_path / "run.h5", whole[:length]), length


@pytest.mark.parametrize("kind", DISKS)
def test_on_a_full_disk_the_old_result_stays(
    result: Result, tmp_path: Path, kind: str, capfd: pytest.CaptureFixture[str]
) -> None:
    more = {f"x{n}": Channel(np.random.default_rng(n).random(result.time.size), "m", "") for n in range(800)}
    result = replace(result, statistics=None)  # a small file
    large = replace(result, channels=dict(result.channels) | more)
    with little_room(tmp_path, 256 * 1024, kind) as folder:
        path = result.save(folder / "run.h5")
        for _ in range(2):
            with pytest.raises(OSError, match="it cannot be written") as caught:
                large.save(path)
            assert caught.value.filename == str(path)
        assert [item.name for item in folder.iterdir()] == ["run.h5"]
        np.testing.assert_array_equal(Result.load(path)["tip.x"], result["tip.x"])
    assert capfd.readouterr().err == ""  # HDF5 says nothing of its own
