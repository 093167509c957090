"""Interruptions from the console."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def put_off() -> Iterator[None]:
    """Put off an interruption until the block has ended: what imports leave half done cannot be mended."""
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield
        return
    context: list[int] = []
    signal.signal(signal.SIGINT, lambda number, frame: context.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if context:
            before(context[0], None)


@contextmanager
def kept_from_children() -> Iterator[None]:
    """Processes that are started in the block are not interrupted.

    The console interrupts all processes at once, and each would say so. They end with the one that started
    them.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
