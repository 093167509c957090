"""Whether the engine can open a window here, asked without risk.

Where there is no display the engine ends the whole process, so another one tries first.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile

import exudyn

LONGEST = 120.0  # [s] that trying may take, of a slow machine or a distant display
TRY = """
try:
    import resource
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
except ImportError:
    pass
try:
    import tkinter
except ImportError as error:
    raise SystemExit(f"no tkinter: {error}; on Debian: apt-get install python3-tk")
try:
    root = tkinter.Tk()
    root.withdraw()
    root.destroy()
except tkinter.TclError as error:
    raise SystemExit(f"no display: {error}")
import exudyn
container = exudyn.SystemContainer()
container.visualizationSettings.view0.window.showWindow = False
container.visualizationSettings.view0.window.renderWindowSize = [64, 64]
container.renderer.Start()
active = container.renderer.IsActive()
container.renderer.Stop()
if not active:
    raise SystemExit("the engine's window did not open")
"""
INSTEAD = (
    "without a display, `python -m support_exudyn render RUN` writes pictures, and "
    "`xvfb-run -a python -m support_exudyn view RUN` opens the window on a display in memory"
)


class NoDisplayError(OSError):
    """No window can be opened here."""


def check_display() -> None:
    """Raise NoDisplayError, which says why and what to do, unless the engine can open its windows."""
    switches = exudyn.special.userInterface
    for name in ("suppressRenderer", "suppressSolutionViewer", "suppressDialogs"):
        if getattr(switches, name):
            raise NoDisplayError(
                f"no window: exudyn.special.userInterface.{name} is set, perhaps by the variable "
                "EXUDYN_SUPPRESS_UI_WINDOW_OPEN; allowed: windows where neither is"
            )
    if (reason := _reason()) is not None:
        raise NoDisplayError(
            f"no window can be opened here: {reason}. Allowed: a desktop with OpenGL; {INSTEAD}"
        )


def _reason() -> str | None:
    """Why no window opens; None if one does."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            tried = subprocess.run(
                [sys.executable, "-c", TRY],
                cwd=folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                errors="replace",
                timeout=LONGEST,
            )
        except subprocess.TimeoutExpired:
            return f"trying it took more than {LONGEST:g} s"
    if tried.returncode == 0:
        return None
    said = [line.strip() for line in (tried.stderr + "\n" + tried.stdout).splitlines()]
    telling = [line for line in said if line and not line.startswith(("terminate called", "Setup OpenGL"))]
    return telling[0] if telling else f"the engine's window ended with code {tried.returncode}"
