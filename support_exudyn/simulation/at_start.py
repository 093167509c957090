"""What a command of ours needs before anything else; it is imported first, and does nothing in other programs.

The libraries take seconds to import. An interruption meanwhile would be a traceback, or be taken by one of them
for an error of its own: so it ends the program at once, which has begun nothing. What is printed may hold
letters that the console has not: they are then written in others.
"""

import codecs
import io
import os
import signal
import sys
from pathlib import Path
from types import FrameType

COMMANDS = ("support_exudyn", "studies")  # of python -m
INSTALLED = "support-exudyn"
INTERRUPTED = "interrupted; nothing half-written is left"
EXIT_CODE = 130
PLAIN = dict(
    pair.split()
    for pair in (
        *("± +-", "² ^2", "³ ^3", "· *", "\u00d7 x", "\u2212 -", "\u2013 -", "… ...", "≤ <=", "≥ >=", "≈ ~"),
        *("Å A", "å a", "µ u", "° deg", "→ ->", "ä ae", "ö oe", "ü ue", "Ä Ae", "Ö Oe", "Ü Ue", "ß ss", "é e"),
        *("─ -", "━ -", "╌ -", "╍ -", "═ -", "╶ -", "╴ -", "╸ -", "╺ -", "│ |", "┃ |", "║ |"),
    )
)
DEGRADED = "support_exudyn.plain"  # name of the handler of errors


def plain(error: UnicodeError) -> tuple[str | bytes, int]:
    """Other letters for those that a console has not, as a handler of errors of `codecs`."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    letters = error.object[error.start : error.end]
    said = "".join(PLAIN.get(one) or one.encode("ascii", "backslashreplace").decode("ascii") for one in letters)
    return said, error.end


codecs.register_error(DEGRADED, plain)


def be_readable() -> None:
    """Let the console get all letters that it has, and others in place of those that it has not."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "backslashreplace"):
            stream.reconfigure(errors=DEGRADED)


def _end(number: int, frame: FrameType | None) -> None:
    del number, frame
    os.write(2, f"{INTERRUPTED}\n".encode())
    os._exit(EXIT_CODE)


def be_interruptible() -> None:
    """An interruption is a KeyboardInterrupt again from here on: there is work that has to be ended."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _is_command(words: list[str]) -> bool:
    """Whether a program that was started with these words is one of ours."""
    for n, word in enumerate(words[1:], 1):
        if words[n - 1] in ("-X", "-W"):  # it is of these
            continue
        if word.startswith("-m"):
            module = word[2:] or "".join(words[n + 1 : n + 2])
            return module.partition(".")[0] in COMMANDS
        if not word.startswith("-"):
            return Path(word).stem == INSTALLED
    return False


if Path(sys.argv[0]).stem == INSTALLED:  # which imports nothing from the working directory; nor do its workers
    os.environ.setdefault("PYTHONSAFEPATH", "1")
if _is_command(sys.orig_argv) and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, _end)
    be_readable()
