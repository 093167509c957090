"""Faults are planted only if the long profile is asked for, see `test_planted`: they take a while."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings

from tests.often import OFTEN

HERE = Path(__file__).parent


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if settings().max_examples > OFTEN:
        return
    left = [item for item in items if item.path.parent == HERE and item.get_closest_marker("slow")]
    config.hook.pytest_deselected(items=left)
    items[:] = [item for item in items if item not in left]
