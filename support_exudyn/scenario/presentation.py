"""How scenarios and their results show themselves in notebooks: by rooms above, which they do not know.

The package says by `present_by` who does it; nothing of that is imported before it is asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Presenter(Protocol):
    """What shows scenarios and results."""

    def figure(self, result: Any, channels: Sequence[str], after: float, until: float) -> Figure:
        """Channels of a result over time."""

    def page_of_result(self, result: Any) -> str:
        """A result as HTML."""

    def page_of_scenario(self, scenario: Any) -> str:
        """A scenario as HTML."""


_loaders: list[Callable[[], Presenter]] = []


def present_by(load: Callable[[], Presenter]) -> None:
    """Let scenarios and results be shown by what `load` gives."""
    _loaders[:] = [load]


def presenter() -> Presenter:
    """What shows scenarios and results."""
    return _loaders[0]()
