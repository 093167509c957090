"""How often hypothesis tries a property whose examples cost more or less than the usual."""

from __future__ import annotations

from hypothesis import settings

OFTEN = 60  # examples of the profile of CI; see conftest


def often(number: int) -> int:
    """So many examples in CI, a third of them by hand, 50 times as many in the long profile; at least three."""
    return max(3, number * settings.default.max_examples // OFTEN)
