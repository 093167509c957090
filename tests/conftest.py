"""How often hypothesis tries: by hand a third as often as in CI; by `--hypothesis-profile=long` 50 times."""

import os
import signal

from hypothesis import settings

settings.register_profile("unit", parent=settings.default, deadline=None, max_examples=60)
settings.register_profile("long", parent=settings.get_profile("unit"), max_examples=50 * 60)
settings.register_profile("quick", parent=settings.get_profile("unit"), max_examples=20)
# pytest then loads the one that it is asked for
settings.load_profile("unit" if os.environ.get("CI") else "quick")

# a shell without job control has what it starts in the background ignore interruptions, and the tests of
# interruptions would wait for ever
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
