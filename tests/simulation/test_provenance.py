"""Versions of what makes the numbers, also where a package is missing."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError

import pytest

from studies.claims import hypercube
from support_exudyn.simulation import provenance


@pytest.fixture
def without_numba(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    def version(name: str) -> str:
        if name == "numba":
            raise PackageNotFoundError(name)
        return "1.2"

    monkeypatch.setattr(provenance, "version", version)
    provenance.installed.cache_clear()
    hypercube._program.cache_clear()
    yield
    provenance.installed.cache_clear()
    hypercube._program.cache_clear()


def test_compiled_numbers_are_numbas_too() -> None:
    assert {"exudyn", "numpy", "scipy", "numba"} <= set(provenance.versions())
    assert set(provenance.versions()) < set(provenance.provenance())


@pytest.mark.usefixtures("without_numba")
def test_what_is_not_installed_is_no_error() -> None:
    found = provenance.versions()
    assert found["exudyn"] == "1.2"
    assert "numba" not in found
    # rows of plausible machines are kept under a digest of the versions
    assert hypercube._program().endswith("1.2 1.2 None")
