"""The pytest plugin: runs that are kept between sessions, comparisons that say where, baselines.

Every pytest run of an environment with this package loads this file, whether it tests anything of it or not: so
nothing of the package is imported before a fixture is used.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from support_exudyn.scenario.scenario import Scenario
    from support_exudyn.scenario.scenario_data import Accuracy
    from support_exudyn.simulation.result import Result

SimulateCached = Callable[..., "Result"]  # types of the fixtures
AssertClose = Callable[..., None]
Baseline = Callable[..., None]
OPTION = "--baseline-update"
MARKS = {  # by the fixture that a test uses
    "simulate_cached": "simulation: simulates a scenario, or takes the run that is kept; set by the plugin",
    "baseline": "baseline: is compared with a baseline next to its file; set by the plugin",
}
WRITTEN = "baseline written"  # property of a test, by which workers report
CACHE = "support_exudyn"  # folder in pytest's cache


def pytest_addoption(parser: pytest.Parser) -> None:
    """Take the option by which baselines are written."""
    text = "write baselines of this name, or pattern; changes are listed at the end; repeatable"
    group = parser.getgroup("support-exudyn")
    group.addoption(OPTION, action="append", default=[], metavar="NAME", help=text)


def pytest_configure(config: pytest.Config) -> None:
    """Make the marks known."""
    for text in MARKS.values():
        config.addinivalue_line("markers", text)


@pytest.hookimpl(tryfirst=True)  # before `-m` chooses by the marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by the fixtures that they use."""
    for item in items:
        for fixture, text in MARKS.items():
            if fixture in getattr(item, "fixturenames", ()):
                item.add_marker(text.partition(":")[0])


@pytest.fixture(scope="session")
def simulate_cached(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> SimulateCached:
    """Simulate a scenario; a run of the same scenario with the same program is taken from the cache.

    `simulate_cached(scenario, accuracy=None, errors=False)` takes a Scenario or the path of its file; accuracy
    and errors are those of `simulate`. Results are read anew at each call: no test changes those of another.
    """
    folder = tmp_path_factory.getbasetemp()
    folder = (folder.parent if hasattr(pytestconfig, "workerinput") else folder) / CACHE
    cache: pytest.Cache | None = getattr(pytestconfig, "cache", None)
    if cache is not None:
        with suppress(OSError):  # a folder that nobody may write to
            folder = cache.mkdir(CACHE)

    def run(
        scenario: Scenario | str | Path, *, accuracy: Accuracy | None = None, errors: bool = False
    ) -> Result:
        from dataclasses import replace

        from support_exudyn.files.scenarios.scenario_file import read_scenario_file
        from support_exudyn.postprocessing.comparing.in_tests import cached_run
        from support_exudyn.scenario.scenario import Scenario
        from user_forces.values.value import InputError, short

        if isinstance(scenario, (str, Path)):
            file = read_scenario_file(scenario)
            scenario, errors = file.scenario, errors or file.errors
        elif not isinstance(scenario, Scenario):
            raise InputError(f"{short(scenario)}: cannot be run; allowed: a Scenario, or the path of its file")
        folder.mkdir(exist_ok=True)
        return cached_run(
            folder, scenario if accuracy is None else replace(scenario, accuracy=accuracy), errors
        )

    return run


@pytest.fixture(scope="session")
def assert_close() -> AssertClose:
    """Fail if a result, a curve or a number is farther from a reference than is allowed.

    `assert_close(result, reference, tolerance=None, channels=(), after=0, until=inf)`. Without a tolerance the
    errors of both are allowed. The failure states the worst number with its time.
    """

    def check(result: Any, reference: Any, tolerance: float | str | None = None, **part: Any) -> None:
        __tracebackhide__ = True
        from support_exudyn.postprocessing.comparing.in_tests import closeness

        close = closeness(result, reference, tolerance, **part)
        if lines := [line for channel in close for line in channel.faults]:
            raise AssertionError("\n".join(lines))

    return check


@pytest.fixture(scope="session")
def _used_baselines() -> set[Path]:
    return set()


@pytest.fixture
def baseline(request: pytest.FixtureRequest, _used_baselines: set[Path]) -> Baseline:
    """Fail if a result or number has changed by more than both errors from its baseline.

    `baseline(item, name="")` takes a Result with errors, an Estimate, or Estimates by names. The baseline is
    `baseline/MODULE.TEST.json` next to the test's file, or `baseline/MODULE.NAME.json`. It is written by
    `pytest --baseline-update MODULE.TEST`, and by nothing else.
    """

    def check(item: Any, name: str = "") -> None:
        __tracebackhide__ = True
        from support_exudyn.postprocessing.comparing.in_tests import against_baseline, baseline_path
        from user_forces.values.value import InputError

        path = baseline_path(request.path, f"{request.path.stem}.{name or request.node.name}")
        if path in _used_baselines:
            allowed = "a name of its own, baseline(it, 'NAME')"
            raise InputError(f"{path.stem}: is compared already; allowed: {allowed}")
        _used_baselines.add(path)
        report, written = against_baseline(item, path, request.config.getoption(OPTION))
        if written:
            request.node.user_properties.append((WRITTEN, report))
        elif report:
            raise AssertionError(report)

    return check


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Report which baselines were written, and patterns for which none was."""
    texts = {
        text: None
        for reports in terminalreporter.stats.values()
        for report in reports
        for key, text in getattr(report, "user_properties", ())
        if key == WRITTEN
    }
    patterns = terminalreporter.config.getoption(OPTION)
    if not (texts or patterns):
        return
    terminalreporter.section("baselines")
    for text in texts or [f"nothing was written: no test has a new or changed baseline {', '.join(patterns)}"]:
        terminalreporter.line(text)
