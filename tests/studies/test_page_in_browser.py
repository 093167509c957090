"""The report in a real browser: what fits a screen, what answers to the pointer, and that nothing is loaded.

Without Chromium and its driver the tests are skipped; with SUPPORT_EXUDYN_BROWSER set they fail.
"""

from __future__ import annotations

import json
import os
import shutil
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

from studies import report
from support_exudyn.postprocessing.page.live import LiveCurve, LiveFigure, LivePanel
from support_exudyn.postprocessing.page.pieces import Sheet
from tests.studies.test_report import chapter, put

pytestmark = pytest.mark.slow  # seconds of a browser

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
)  # fmt: skip
PATIENCE = 30.0  # seconds
TIMES = tuple(0.5 * n for n in range(11))
FORCES = tuple(51.25 + n for n in range(11))
SORTED = Sheet(
    "Key table", ("case", "force [N]"),
    (("b", "9.5 ± 0.1"), ("a", "-11"), ("c", "1e2"), ("d", ""), ("e", "none")), name="key",
)  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A report with claims, a live figure, and a table to sort."""
    out = tmp_path_factory.mktemp("results")
    put(out, chapter("claims"))
    folder = put(out, chapter("clearance_influence").model_copy(update={"sheets": (SORTED,)}))
    curve = LiveCurve("ideal", TIMES, FORCES, "#d55e00")
    LiveFigure("time [s]", (LivePanel("force [kN]", (curve,)),)).save(folder / "force one.live.json")
    report.rebuild(out)
    return out


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[webdriver.Chrome]:
    if CHROMIUM is None or DRIVER is None:
        missing = "no chromium and chromium-driver; apt-get install -y chromium chromium-driver"
        (pytest.fail if os.environ.get("SUPPORT_EXUDYN_BROWSER") else pytest.skip)(missing)
    options = Options()
    options.binary_location = CHROMIUM
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    try:
        yield driver
    finally:
        driver.quit()


@pytest.fixture
def opened(browser: webdriver.Chrome, made: Path) -> Callable[..., webdriver.Chrome]:
    def opened(name: str = "report.html") -> webdriver.Chrome:
        size = {"width": 1000, "height": 800, "deviceScaleFactor": 1, "mobile": False}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        for kind in ("browser", "performance"):
            browser.get_log(kind)
        browser.get((made / name).as_uri())
        until(lambda: browser.execute_script("return !window.Bokeh || Bokeh.documents.every(d => d.is_idle)"))
        return browser

    return opened


def until(true: Callable[[], Any]) -> Any:
    """What is at last true."""
    end = time.monotonic() + PATIENCE
    while not (found := true()):
        assert time.monotonic() < end
        time.sleep(0.05)
    return found


@pytest.mark.parametrize("name", ["report.html", "appendix.html"])
def test_no_complaint_and_nothing_is_loaded(
    opened: Callable[..., webdriver.Chrome], made: Path, name: str
) -> None:
    browser = opened(name)
    complaints = [entry for entry in browser.get_log("browser") if entry["level"] != "INFO"]
    assert complaints == []
    events = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = {e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"}
    assert (made / name).as_uri() in asked
    assert [url for url in asked if not url.startswith(("data:", "blob:", (made / name).as_uri()))] == []


def test_the_pointer_tells_the_value_that_the_file_holds(opened: Callable[..., webdriver.Chrome]) -> None:
    browser = opened()
    place = browser.execute_script("""
      const view = Object.values(Bokeh.index)[0], all = [];
      const walk = (v) => { all.push(v); for (const c of v.child_views || []) walk(c); };
      walk(view.roots ? view.roots[0] : view);
      const plot = all.find((v) => v.frame), frame = plot.frame;
      const box = plot.el.getBoundingClientRect(), inner = frame.bbox;
      return [box.left + inner.left + frame.x_scale.compute(2.0) - frame.x_scale.compute(0.0),
              box.top + inner.top + inner.height / 2];""")
    for shift in (-2, 0):
        event = {"type": "mouseMoved", "x": place[0] + shift, "y": place[1]}
        browser.execute_cdp_cmd("Input.dispatchMouseEvent", event)
    text = until(lambda: browser.execute_script("""
      const texts = [], walk = (node) => {
        const inside = node.shadowRoot || node;
        if (node.classList && node.classList.contains("bk-Tooltip")) texts.push(inside.textContent);
        const below = [...(node.children || []), ...(inside === node ? [] : inside.children)];
        for (const child of below) walk(child);
      };
      walk(document.body);
      return texts.join(" ");"""))  # fmt: skip
    assert str(FORCES[TIMES.index(2.0)]) in text


def test_claims_can_be_filtered_and_unfolded(opened: Callable[..., webdriver.Chrome]) -> None:
    browser = opened()

    def shown() -> list[str]:
        rows = browser.find_elements(By.CSS_SELECTOR, "#claims-list tbody tr")
        return [str(row.get_attribute("data-kind")) for row in rows if row.is_displayed()]

    assert len(shown()) == 5
    press(browser, '[data-show="holds"]')
    assert shown() == ["holds"]
    press(browser, '[data-show="open"]')
    assert shown() == ["open"]
    assert "Because of" not in browser.find_element(By.ID, "claims-list").text
    press(browser, "#claims-list tr:not([hidden]) summary")
    assert "Because of" in browser.find_element(By.ID, "claims-list").text
    press(browser, '[data-show=""]')
    assert len(shown()) == 5


def test_tables_sort_by_value(opened: Callable[..., webdriver.Chrome]) -> None:
    browser = opened()
    heading = "#clearance_influence-key th:nth-child(2) button"

    def order() -> Sequence[str]:
        return [one.text for one in browser.find_elements(By.CSS_SELECTOR, "#clearance_influence-key tbody th")]

    assert order() == ["b", "a", "c", "d", "e"]
    press(browser, heading)
    assert order() == ["a", "b", "c", "e", "d"]
    press(browser, heading)
    assert order() == ["c", "b", "a", "e", "d"]


def press(browser: webdriver.Chrome, selector: str) -> None:
    browser.execute_script("arguments[0].click()", browser.find_element(By.CSS_SELECTOR, selector))
