"""`plot` over what others have written: which words are runs, which are curves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from support_exudyn.__main__ import main
from support_exudyn.commands.runs import files_and_channels, is_of_others
from support_exudyn.postprocessing.export.tables import to_hdf5
from tests import synthetic
from tests.cases.run_cases import loose_support

TIME = np.linspace(0.0, 1.0, 21)


@pytest.fixture
def run(tmp_path: Path) -> Path:
    made = synthetic.journal(loose_support(1.5), TIME, 0 * TIME, 0 * TIME, [], tip__x=(np.sin(TIME), "m"))
    to_hdf5(made, tmp_path / "exported.h5")
    columns = {"time_ms": 1e3 * TIME, "tip.x_mm": 1e3 * np.sin(TIME)}
    parquet.write_table(pa.table(columns), tmp_path / "measured.parquet")
    (tmp_path / "measured.csv").write_text("time_s;tip.x_mm\n0;1,5\n0,5;2\n", encoding="utf-8")
    return made.save(tmp_path / "run.h5")


def test_runs_are_told_from_curves_by_their_content(run: Path, tmp_path: Path) -> None:
    (tmp_path / "broken.h5").write_bytes(b"nothing")
    (tmp_path / "run.toml").write_text("a = 1\n", encoding="utf-8")
    names = ["run.h5", "broken.h5", "run.toml", "exported.h5", "measured.parquet", "measured.csv", "none.csv"]
    files, channels = files_and_channels([str(tmp_path / name) for name in [*names, "none.h5"]] + ["tip.*"])
    assert channels == ["tip.*"]
    assert [path.name for path in files if is_of_others(path)] == names[3:]


def test_any_readable_file_is_drawn_beside_a_run(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    others = [str(tmp_path / name) for name in ("measured.parquet", "measured.csv")]
    assert main(["plot", str(run), *others, "--out", str(tmp_path / "figures")]) == 0
    said = capsys.readouterr().out
    assert "run_and_measured.parquet_and_measured.csv_overview.png" in said
    assert len(list((tmp_path / "figures").glob("*.png"))) == 1
