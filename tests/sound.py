"""What must hold of whatever was taken in, and of how the rest is refused."""

from __future__ import annotations

import contextlib
import json
import math
import sys
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from support_exudyn import Drive, Machine, Scenario
from user_forces import FrictionLaw, InputError, NormalLaw, Value

T = TypeVar("T")
LONGEST_LINE = 1500  # characters: some messages list 60 names; what was given is cut at 80


def sensible(error: Exception, start: str = "") -> None:
    """A message is some lines of text that do not repeat the input at length, and begins as it should."""
    said = str(error)
    assert said.startswith(start)
    assert said.strip()
    for line in said.splitlines():
        assert len(line) <= LONGEST_LINE, line[:200]
    for foreign in (
        "Traceback",
        "pydantic",
        "math domain",
        "division by zero",
        "different signs",
        "nan to nan",
    ):
        assert foreign not in said, said


def taken_or_refused(make: Callable[[], T], start: str = "") -> T | None:
    """What was made; None if it was refused in a sentence. Anything else is raised on."""
    try:
        return make()
    except InputError as error:
        sensible(error, start)
        return None


def sound(item: Any) -> None:
    """A value can be shown, compared, written, read back and used for what it is for."""
    assert repr(item)
    text = json.dumps(item.to_data(), allow_nan=False)
    with shallow():
        back = Value.from_data(json.loads(text))
    assert back == item
    assert back.to_data() == item.to_data()
    with contextlib.suppress(TypeError):
        hash(item)
    if isinstance(item, Scenario):
        sound_scenario(item)
    elif isinstance(item, Machine):
        sound_machine(item)
    elif isinstance(item, Drive):
        sound_drive(item)
    elif isinstance(item, NormalLaw):
        assert item.largest_depth > 0.0
    elif isinstance(item, FrictionLaw):
        assert item.has_state in (True, False)


@contextlib.contextmanager
def shallow() -> Iterator[None]:
    """Little room on the stack, as for who calls from deep within something else."""
    before, depth, frame = sys.getrecursionlimit(), 0, sys._getframe()
    while frame is not None:
        depth, frame = depth + 1, frame.f_back  # type: ignore[assignment]
    sys.setrecursionlimit(min(before, depth + 400))
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


def sound_machine(item: Machine) -> None:
    """It can be laid out, in space too if it knows its widths; or it says why not."""
    linkage = taken_or_refused(item.linkage)
    assert item.jacks is not None
    if linkage is not None:
        taken_or_refused(lambda: item.in_space(linkage))


def sound_drive(item: Drive) -> None:
    """It can be asked at any time, and says no nonsense."""
    times = (0.0, 1e-9, 0.5, 3.0, 1e6, *item.breaks)
    for t in times:
        assert math.isfinite(item.extension(t))
        assert math.isfinite(item.speed(t))
        assert math.isfinite(item.speed_jump(t))
    assert math.isfinite(item.initial_speed)
    for duration in (1e-6, 5.0, 1e6):
        low, high = item.span(duration)
        assert -math.inf < low <= 0.0 <= high < math.inf
        for t in times:
            if t <= duration:  # rounding of three products
                margin = 1e-14 * max(high, -low) + 1e-300
                assert low - margin <= item.extension(t) <= high + margin


def sound_scenario(item: Scenario) -> None:
    """All that a scenario is asked for before it runs."""
    assert item.linkage.bodies
    assert "time" in item.channel_definitions
    assert list(item.breaks) == sorted(set(item.breaks))
    assert item.drives_in_use
    assert item.jumps in (True, False)
    assert item.goal is None or 0.0 < item.goal < 1.0
    assert set(item.friction_pins).isdisjoint(item.clearance_pins)
    for name in item.driven:
        assert isinstance(item.drive_of(name), Drive)
    for factor in (2, 0.5, 1.7):
        finer = taken_or_refused(lambda factor=factor: item.refined(factor))  # type: ignore[misc]
        assert finer is None or finer.machine == item.machine
