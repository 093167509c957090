"""What `pip wheel` makes holds all that a user needs, and runs where there is no checkout."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from fnmatch import fnmatch
from pathlib import Path

import pytest

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[1]
PACKAGES = ("support_exudyn", "user_forces", "studies")
SHOWN_IN_THE_README = ROOT / "studies" / "pictures"  # and nowhere else


def sources(package: str) -> list[Path]:
    """All files of a package, but for what Python and numba leave beside them."""
    found = (path for path in (ROOT / package).rglob("*") if path.is_file())
    return [
        path for path in found if "__pycache__" not in path.parts and SHOWN_IN_THE_README not in path.parents
    ]


@pytest.mark.parametrize("package", PACKAGES)
def test_every_file_is_named_among_those_that_are_packed(package: str) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    patterns = project["tool"]["setuptools"]["package-data"]["*"]
    for path in sources(package):
        if path.suffix == ".py":
            assert (path.parent / "__init__.py").is_file(), path
            continue
        # patterns are relative to the nearest folder that is a package
        home = next(folder for folder in path.parents if (folder / "__init__.py").is_file())
        assert any(fnmatch(path.relative_to(home).as_posix(), pattern) for pattern in patterns), path


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder into which the wheel of a clean copy of the sources was installed."""
    folder = tmp_path_factory.mktemp("wheel")
    for name in PACKAGES:
        shutil.copytree(ROOT / name, folder / "sources" / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, folder / "sources" / name)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    subprocess.run([*pip, "wheel", str(folder / "sources"), "--no-deps", "-w", str(folder)], check=True)
    (wheel,) = folder.glob("*.whl")
    target = folder / "installed"
    subprocess.run(
        [*pip, "install", "--no-deps", "--no-index", "--target", str(target), str(wheel)], check=True
    )
    shutil.rmtree(folder / "sources")
    return target


def run(installed: Path, where: Path, *arguments: str) -> str:
    """What `python -m ...` prints in another folder, with the packages of the wheel."""
    here = dict(os.environ) | {"PYTHONPATH": str(installed)}
    done = subprocess.run(
        [sys.executable, *arguments], cwd=where, env=here, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow  # pip fetches the build's requirements
def test_every_file_is_in_the_wheel(installed: Path) -> None:
    lost = [
        path.relative_to(ROOT)
        for package in PACKAGES
        for path in sources(package)
        if not (installed / path.relative_to(ROOT)).is_file()
    ]
    assert lost == []


@pytest.mark.slow
def test_it_runs_outside_the_checkout(installed: Path, tmp_path: Path) -> None:
    where = "import support_exudyn as package; print(package.__file__)"
    assert Path(run(installed, tmp_path, "-c", where).strip()).is_relative_to(installed)
    examples = installed / "support_exudyn" / "files" / "examples"
    for name in ("columns_apart.toml", "columns_apart.csv"):
        shutil.copy(examples / name, tmp_path)
    run(installed, tmp_path, "-m", "support_exudyn", "run", "columns_apart.toml")
    assert (tmp_path / "columns_apart.h5").is_file()
    assert run(installed, tmp_path, "-m", "support_exudyn", "check", "zf18000")
    schema = run(installed, tmp_path, "-m", "support_exudyn", "schema", "machine")
    assert json.loads(schema)["$schema"]


@pytest.mark.slow
def test_a_study_and_the_report_run_outside_the_checkout(installed: Path, tmp_path: Path) -> None:
    assert "--machine" in run(installed, tmp_path, "-m", "studies", "--help")
    run(installed, tmp_path, "-m", "studies", "slider_crank")
    run(installed, tmp_path, "-m", "studies.report")
    assert (tmp_path / "results" / "report.html").is_file()


@pytest.mark.slow
def test_pytest_finds_the_plugin_by_itself(installed: Path, tmp_path: Path) -> None:
    # pytest rewrites the assertions of all modules of a package that brings a plugin: runs must not mind
    (tmp_path / "test_it.py").write_text(
        "from support_exudyn import simple_scenario\n"
        "from support_exudyn.postprocessing import pytest_plugin\n\n"
        "def test_it(simulate_cached, assert_close, pytestconfig):\n"
        f"    assert pytest_plugin.__file__.startswith({str(installed)!r})\n"
        "    assert pytestconfig.pluginmanager.hasplugin(pytest_plugin.__name__)\n"
        "    drives = {'crank': {'type': 'Steady', 'rate_rad_per_s': 60}}\n"
        "    scene = simple_scenario('crank_rocker', duration_s=0.01, accuracy='draft', drives=drives)\n"
        "    assert_close(simulate_cached(scene), simulate_cached(scene))\n",
        encoding="utf-8",
    )
    assert "1 passed" in run(installed, tmp_path, "-m", "pytest", "-q", "-W", "error", "--strict-markers")
