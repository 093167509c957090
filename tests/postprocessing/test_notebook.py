"""Results and scenarios in notebooks: tables, figures, completion, runs side by side, channels before a run."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Result, channels, compare, load_machine, simulate
from support_exudyn.__main__ import main
from tests.cases.run_cases import SLIDER_PIN, loose_slider_crank, slider_crank
from user_forces import InputError

FORCE = f"pin.{SLIDER_PIN}.force"
DURATION = 0.004


@pytest.fixture(scope="module")
def runs() -> Mapping[str, Result]:
    ideal = replace(slider_crank(DURATION), step=1e-5)
    loose = loose_slider_crank(DURATION, formulation="compiled")
    return {"ideal": simulate(ideal, errors=True), "loose": simulate(loose)}


def rows_of(page: str) -> dict[str, list[str]]:
    """The rows of the tables of a page, by their first cells."""
    rows = [re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row) for row in re.findall(r"<tr>(.*?)</tr>", page)]
    return {row[0]: row for row in rows}


# --- tables of others ---


def test_pandas_has_every_channel_over_time_with_its_unit(runs: Mapping[str, Result]) -> None:
    pytest.importorskip("pandas")
    run = runs["loose"]
    frame = run.to_pandas()
    assert frame.index.name == "time"
    assert [*frame.columns] == [name for name in run.channels if name != "time"]
    np.testing.assert_array_equal(frame.index.to_numpy(), run.time)
    np.testing.assert_array_equal(frame[FORCE].to_numpy(), run[FORCE])
    assert frame.attrs["units"][FORCE] == "N"
    assert frame.attrs["meanings"][FORCE] == run.channels[FORCE].meaning


def test_xarray_has_every_channel_with_unit_and_meaning(runs: Mapping[str, Result]) -> None:
    pytest.importorskip("xarray")
    run = runs["loose"]
    found = run.to_xarray()
    assert set(found.variables) == set(run.channels)
    np.testing.assert_array_equal(found[FORCE].sel(time=run.time[7]), run[FORCE][7])
    assert found[FORCE].attrs == {"units": "N", "long_name": run.channels[FORCE].meaning}
    assert found["time"].attrs["units"] == "s"
    assert found.attrs["machine"] == "SliderCrank"


# --- side by side ---


def test_numbers_stand_side_by_side_with_their_errors(runs: Mapping[str, Result]) -> None:
    both = compare(**runs)
    numbers = both.numbers[f"{FORCE}.mean"]
    assert numbers["ideal"] == runs["ideal"].numbers()[f"{FORCE}.mean"]
    assert numbers["loose"].value == pytest.approx(runs["loose"].window(FORCE).mean)
    assert math.isnan(numbers["loose"].error)
    assert [*both.numbers[f"pin.{SLIDER_PIN}.largest_force"]] == ["loose"]
    rows = rows_of(both._repr_html_())
    assert rows["number"] == ["number", "unit", "ideal", "loose"]
    assert rows[f"{FORCE}.mean"][1] == "kN"
    assert rows[f"pin.{SLIDER_PIN}.largest_force"][2] == ""
    assert str(both).startswith("errors of loose not known")
    assert f"{FORCE}.mean" in str(both)
    row, estimate = both.to_pandas().loc[f"{FORCE}.mean"], runs["ideal"].numbers()[f"{FORCE}.mean"]
    assert (row["unit"], row["ideal"], row["ideal error"]) == ("N", estimate.value, estimate.error)


def test_files_of_runs_are_compared_by_their_names(runs: Mapping[str, Result], tmp_path: Path) -> None:
    runs["loose"].save(tmp_path / "worn.h5")
    both = compare(tmp_path / "worn.h5", new=runs["ideal"])
    assert [*both.runs] == ["worn", "new"]
    with pytest.raises(InputError, match="worn: two runs have this name"):
        compare(tmp_path / "worn.h5", worn=runs["ideal"])
    with pytest.raises(InputError, match="runs: 1 given; allowed: 2 or more"):
        compare(runs["ideal"])
    with pytest.raises(InputError, match="run 2 = 3: allowed: results of `simulate`"):
        compare(runs["ideal"], 3)  # type: ignore[arg-type]
    with pytest.raises(FileNotFoundError, match=r"Result\.save has written; did you mean 'worn\.h5'"):
        compare(tmp_path / "wron.h5", new=runs["ideal"])


# --- channels before a run ---


def test_channels_before_a_run_are_those_after_it(runs: Mapping[str, Result]) -> None:
    run = runs["loose"]
    known = channels(run.scenario)
    assert {name: (one.unit, one.meaning) for name, one in run.channels.items()} == dict(known)
    assert [*channels(run.scenario, "slider.[xy]")] == ["slider.x", "slider.y"]
    assert rows_of(known._repr_html_())["slider.x"] == ["slider.x", "m", "position, forward"]
    assert [line.split()[:2] for line in str(known).splitlines()[:2]] == [["time", "s"], ["crank.x", "m"]]
    with pytest.raises(KeyError, match=r"no such channel; did you mean 'slider\.x'"):
        known["slider.xx"]


def test_channels_are_known_of_machines_and_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    of_machine = channels("slider_crank")
    assert (
        of_machine == channels(load_machine("slider_crank")) == channels(load_machine("slider_crank").machine)
    )
    file = tmp_path / "one.toml"
    file.write_text('machine = "slider_crank"\nduration_s = 1\npins.slider_pin.clearance_mm = 0.1\n')
    assert set(channels(file)) - set(of_machine) >= {"pin.slider_pin.depth"}
    assert main(["channels", str(file), "pin.slider_pin.*", "--json"]) in (0, None)
    told = json.loads(capsys.readouterr().out)
    assert told["pin.slider_pin.depth"]["unit"] == "m"
    assert main(["channels", "slider_crank"]) in (0, None)
    assert "41 channels" in capsys.readouterr().out
    with pytest.raises(FileNotFoundError, match="did you mean 'slider_crank'"):
        channels("slider_cranc")
    with pytest.raises(InputError, match="of = 3: allowed: a scenario, a machine"):
        channels(3)  # type: ignore[arg-type]
