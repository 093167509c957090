"""The page with a slider for every input of a sweep, in a real browser: it shows the nearest run."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

import pyarrow as pa
import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

from support_exudyn.postprocessing.sweep_runs import SweepRuns
from support_exudyn.postprocessing.sweep_sliders import write_sliders
from user_forces.values.value import InputError

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
PATIENCE = 30.0  # seconds
WIDGET = "[...Bokeh.documents[0]._all_models.values()].find((model) => model.title === arguments[0])"
TEXT = "return Bokeh.documents[0].get_model_by_name('nearest')?.text"


def runs(**columns: list[object]) -> SweepRuns:
    """A sweep of a size in mm and a law, with a force in N that has an error."""
    about = {"size_mm": ("", "varied"), "law": ("", "varied"), "force_N": ("N", ""), "force_N_error": ("N", "")}
    whole = {
        "size_mm": [1.0, 2.0, 3.0, 1.0, 2.0, 9.0],
        "law": ["a", "a", "a", "b", "b", "b"],
        "run": [f"run_{n}" for n in range(6)],
        "status": ["done"] * 5 + ["failed"],
        "wall_time_s": [0.1] * 6,
        "force_N": [11.0, 12.0, 13.0, 21.0, 22.0, None],
        "force_N_error": [0.1, 0.1, 0.1, 0.2, 0.2, None],
        **columns,
    }
    fields = [
        pa.field(
            name,
            pa.array(values).type,
            metadata=dict(zip(("unit", "meaning"), about.get(name, ("", "")), strict=True)),
        )
        for name, values in whole.items()
    ]
    return SweepRuns(pa.table([pa.array(values) for values in whole.values()], schema=pa.schema(fields)))


def test_a_sweep_without_runs_that_differ_has_no_page(tmp_path: Path) -> None:
    for columns in ({"status": ["failed"] * 6}, {"size_mm": [1.0] * 6, "law": ["a"] * 6}):
        with pytest.raises(InputError, match="--sliders: allowed: a sweep with two runs or more"):
            write_sliders(runs(**columns), ["force_N"], tmp_path / "page.html", "page")


@pytest.mark.slow  # seconds of a browser
@pytest.mark.skipif(not (CHROMIUM and DRIVER), reason="needs Chromium and its driver")
def test_sliders_show_the_nearest_run_without_a_network(tmp_path: Path) -> None:
    page = write_sliders(runs(), ["force_N"], tmp_path / "page.html", "sizes")
    assert "cdn.bokeh.org" not in page.read_text(encoding="utf-8").split("<body>")[0].split("<script")[1]
    options = Options()
    options.binary_location = str(CHROMIUM)
    for flag in ("--headless", "--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument(flag)
    browser = webdriver.Chrome(options=options, service=Service(str(DRIVER)))
    try:
        browser.get(page.as_uri())

        def shows(*words: str) -> bool:
            end = time.monotonic() + PATIENCE
            while time.monotonic() < end:
                text = browser.execute_script(TEXT) or ""
                if all(word in text for word in words):
                    return True
                time.sleep(0.1)
            return False

        assert shows("run_1", "12.000 &plusmn; 0.1")  # the middle of all sizes with the first law
        browser.execute_script(f"{WIDGET}.value = 2.8", "size [mm]")
        assert shows("run_2", "13.000")
        browser.execute_script(f"{WIDGET}.value = 'b'", "law")
        assert shows("run_4", "22.000 &plusmn; 0.2")
    finally:
        browser.quit()
