"""With what a run was made."""

from __future__ import annotations

import platform
from datetime import datetime, timezone
from functools import cache
from importlib.metadata import version

PACKAGES = ("support-exudyn", "exudyn", "numpy", "scipy", "matplotlib", "meshio", "h5py", "pydantic")


_version = cache(version)  # asking the packages' metadata takes longer than a short run


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that make the numbers."""
    return {"python": platform.python_version()} | {name: _version(name) for name in PACKAGES}


def provenance() -> dict[str, str]:
    """Versions, platform and time of now (UTC)."""
    now = datetime.now(timezone.utc).isoformat(timespec="seconds")
    return versions() | {"platform": platform.platform(), "made_at": now}
