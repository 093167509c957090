"""With what a run was made."""

import platform
from datetime import datetime, timezone
from functools import cache
from importlib.metadata import PackageNotFoundError, version

PACKAGES = ("support-exudyn", "exudyn", "numpy", "scipy", "matplotlib", "meshio", "h5py", "pydantic")
OPTIONAL = ("numba",)
WARNINGS = "warnings"  # key of what is to be known of a run that has passed its checks, a line each
FORMULATION_ASKED = "formulation_asked"  # key of a run for which another one was chosen


@cache  # asking the packages' metadata takes longer than a short run
def installed(name: str) -> str | None:
    """Version of a package; None if it is not installed."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that make the numbers; of optional ones if they are installed."""
    found = {name: installed(name) or "not installed" for name in PACKAGES}
    found |= {name: known for name in OPTIONAL if (known := installed(name))}
    return {"python": platform.python_version()} | found


def provenance() -> dict[str, str]:
    """Versions, platform and time of now (UTC)."""
    now = datetime.now(timezone.utc).isoformat(timespec="seconds")
    return versions() | {"platform": platform.platform(), "made_at": now}
