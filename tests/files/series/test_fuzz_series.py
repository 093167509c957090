"""Files of every format, damaged in any way: read, or refused in one sentence that names the file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from support_exudyn.files.series.read import read_series
from tests.cases import series_cases as cases
from user_forces import InputError

EXAMPLES = 100
LONGEST = 900  # letters of a sentence

shares = st.floats(0.0, 1.0, exclude_max=True)
bytes_ = st.integers(0, 255) | st.sampled_from(b'\0\xff9-,;.\n<>" ')
damages = st.one_of(
    st.tuples(st.just("change"), st.lists(st.tuples(shares, bytes_), min_size=1, max_size=20)),
    st.tuples(st.just("cut"), shares),
    st.tuples(st.just("repeat"), st.tuples(shares, st.integers(1, 60), st.integers(1, 3))),
    st.tuples(st.just("leave out"), st.tuples(shares, st.integers(1, 60))),
)


def damaged(data: bytes, kind: str, how: object) -> bytes:
    """The bytes of a file after damage of a kind."""
    found = bytearray(data)
    match kind, how:
        case "change", list(changes):
            for share, byte in changes:
                found[int(share * len(found))] = byte
        case "cut", float(share):
            del found[int(share * len(found)) :]
        case "repeat", (share, count, times):
            place = int(share * len(found))
            found[place:place] = found[place : place + count] * times
        case "leave out", (share, count):
            place = int(share * len(found))
            del found[place : place + count]
    return bytes(found)


def check(path: Path, data: bytes) -> None:
    """It is read, or refused in a sentence."""
    path.write_bytes(data)
    try:
        found = read_series(path, units=cases.UNITS)
    except InputError as error:
        said = str(error)
        assert "\n" not in said
        assert path.name in said
        assert "allowed: " in said
        assert len(said) < LONGEST
        return
    for one in found.series.values():
        assert one.time.shape == one.values.shape
        assert np.isfinite(one.time).all()
        assert (np.diff(one.time) > 0.0).all()


def test_damaged_files_of_every_format_are_read_or_refused(tmp_path: Path) -> None:
    files = cases.files()

    @settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=[HealthCheck.too_slow], database=None)
    @given(name=st.sampled_from(sorted(files)), damage=damages)
    def holds(name: str, damage: tuple[str, object]) -> None:
        check(tmp_path / "damaged.bin", damaged(files[name], *damage))

    holds()
