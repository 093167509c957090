"""A display in memory, and what tests do with windows on it: find them, look at them, close them (X11)."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from PIL import ImageGrab

SIZE = (1500, 1000)
CLIENT_MESSAGE = 33


def needed() -> None:
    """Skip a test where there is no Xvfb; where all is to be checked (CI=true) fail it.

    Unless WITHOUT_XVFB says that it is known, and that there was no way to install it.
    """
    if shutil.which("Xvfb") is None:
        reason = "needs Xvfb; on Debian: apt-get install xvfb libgl1 libgl1-mesa-dri"
        if os.environ.get("CI") and not os.environ.get("WITHOUT_XVFB"):
            pytest.fail(reason)
        pytest.skip(reason)


@contextmanager
def display(*options: str) -> Iterator[str]:
    """Name of a display that nobody else uses, while the block runs."""
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24", "-nolisten", "tcp"]
    server = subprocess.Popen(
        [*command, *options], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    os.close(write)
    try:
        with os.fdopen(read) as said:
            number = said.readline().strip()  # once it is ready; nothing if it ends
        assert number, f"Xvfb has ended with code {server.wait()}"
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


def picture(name: str) -> np.ndarray:
    """What is on a display: RGB (height, width, 3)."""
    return np.asarray(ImageGrab.grab(xdisplay=name).convert("RGB"))


@ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)
def _go_on(display: int, error: int) -> int:
    """In place of the library's own answer to errors, such as a window that has gone: to end the process."""
    del display, error
    return 0


class _Message(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("serial", ctypes.c_ulong),
        ("send_event", ctypes.c_int),
        ("display", ctypes.c_void_p),
        ("window", ctypes.c_ulong),
        ("message_type", ctypes.c_ulong),
        ("format", ctypes.c_int),
        ("data", ctypes.c_long * 5),
        ("rest", ctypes.c_long * 24),  # as large as any event
    )


class Screen:
    """A connection to a display, by the system's library for it."""

    def __init__(self, name: str) -> None:
        path = ctypes.util.find_library("X11")
        assert path is not None  # comes with tkinter
        self._x = ctypes.CDLL(path)
        self._x.XSetErrorHandler(_go_on)
        self._x.XOpenDisplay.restype = ctypes.c_void_p
        self._x.XDefaultRootWindow.restype = self._x.XInternAtom.restype = ctypes.c_ulong
        self._on = ctypes.c_void_p(self._x.XOpenDisplay(name.encode()))
        assert self._on.value, f"no display {name}"

    def close(self) -> None:
        """End the connection."""
        self._x.XCloseDisplay(self._on)

    def windows(self) -> dict[str, int]:
        """All that have a title, by it."""
        return dict(self._titled(self._x.XDefaultRootWindow(self._on)))

    def _titled(self, window: int) -> Iterator[tuple[str, int]]:
        title = ctypes.c_char_p()
        if self._x.XFetchName(self._on, ctypes.c_ulong(window), ctypes.byref(title)) and title.value:
            yield title.value.decode("utf-8", "replace"), window
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.POINTER(ctypes.c_ulong)()
        found = self._x.XQueryTree(
            self._on,
            ctypes.c_ulong(window),
            ctypes.byref(root),
            ctypes.byref(parent),
            ctypes.byref(children),
            ctypes.byref(count),
        )
        for n in range(count.value if found else 0):
            yield from self._titled(children[n])

    def ask_to_close(self, window: int) -> None:
        """What a window manager tells a window whose cross is pressed."""
        message = _Message(
            type=CLIENT_MESSAGE,
            send_event=1,
            window=window,
            message_type=self._atom("WM_PROTOCOLS"),
            format=32,
            data=(self._atom("WM_DELETE_WINDOW"), 0, 0, 0, 0),
        )
        self._x.XSendEvent(self._on, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(message))
        self._x.XFlush(self._on)

    def _atom(self, name: str) -> int:
        return int(self._x.XInternAtom(self._on, name.encode(), 0))


def environment_on(name: str, home: Path) -> dict[str, str]:
    """Of a program that opens windows there; what it keeps of them goes to a home of its own."""
    from tests.processes import environment

    suppressed = "EXUDYN_SUPPRESS_UI_WINDOW_OPEN"
    known = {key: value for key, value in environment().items() if key not in (suppressed, "WAYLAND_DISPLAY")}
    return known | {"DISPLAY": name, "HOME": str(home), "LIBGL_ALWAYS_SOFTWARE": "1"}
