"""By hand tests take less time than in CI: hypothesis tries a third as often, and figures are coarse.

By `--hypothesis-profile=long` it tries 50 times as often as in CI.
"""

import os
import signal

import pytest
from hypothesis import settings

# where the package is installed pytest finds it by itself, under the same name
pytest_plugins = ["support_exudyn.postprocessing.pytest_plugin"]

settings.register_profile("unit", parent=settings.default, deadline=None, max_examples=60)
settings.register_profile("long", parent=settings.get_profile("unit"), max_examples=50 * 60)
settings.register_profile("quick", parent=settings.get_profile("unit"), max_examples=20)
# pytest then loads the one that it is asked for
settings.load_profile("unit" if os.environ.get("CI") else "quick")

# a shell without job control has what it starts in the background ignore interruptions, and the tests of
# interruptions would wait for ever
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session", autouse=True)
def _coarse_figures() -> None:
    """Much of the time of a figure is that of its fonts and pixels; CI draws it as users get it."""
    if not os.environ.get("CI"):
        from support_exudyn.postprocessing.figures.style import STYLE

        STYLE.update({"pdf.fonttype": 3, "savefig.dpi": 80})
