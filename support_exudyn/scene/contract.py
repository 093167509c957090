"""How a run fails."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Failure:
    """Why, when and where a run stopped.

    reason: what went wrong. advice: what to change. time [s]: when. state: named values at that time.
    finer: whether shorter steps may make the run possible.
    """

    reason: str
    advice: str
    time: float
    state: dict[str, float] = field(default_factory=dict)
    finer: bool = False

    def __str__(self) -> str:
        values = ", ".join(f"{name} = {value:.6g}" for name, value in self.state.items())
        return f"stopped at t = {self.time:.9g} s: {self.reason}. {self.advice}" + (
            f" State then: {values}." if values else ""
        )


class SimulationError(RuntimeError):
    """A run that could not be finished; `failure` says why, when and where."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(str(failure))
        self.failure = failure

    def __reduce__(self) -> tuple[type[SimulationError], tuple[Failure]]:
        return SimulationError, (self.failure,)  # so that it comes back whole from a worker process


def error_text(error: BaseException) -> str:
    """An error that nobody expected, in a line: its kind, its words, and where, if that is no file of ours."""
    frames = traceback.extract_tb(error.__traceback__)[-1:]
    ours = [frame for frame in frames if Path(frame.filename).is_relative_to(Path(__file__).parents[1])]
    place = "" if ours else "".join(f" ({Path(one.filename).name}, line {one.lineno})" for one in frames)
    try:
        said = " ".join(str(error).split())
    except Exception:  # of somebody's own class
        said = ""
    kind = "there is not enough memory" if isinstance(error, MemoryError) else type(error).__name__
    return f"{kind}{f': {said}' if said else ''}{place}"


Progress = Callable[[float], None]  # is told the share that is done, 0 to 1


def silent(share: float) -> None:
    """Tell nobody."""
    del share


UNSOLVABLE = (
    "the equations of a step could not be solved: the linkage may be at a dead centre, or constraints may hold "
    "the same twice"
)


ENGINE_ADVICE = (
    "Look whether the posture is at a dead centre, and if two pins, actuators or guides hold the same bodies "
    "in the same way; if not, try a smaller step."
)
PLACE = re.compile(r"\s*\[(Python )?file .*\]", re.IGNORECASE)  # in a source, which says nothing to a user


def first_line(error: BaseException) -> str:
    """The first line of an error that says something; its class if none does."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip(" =*-")]
    return lines[0] if lines else type(error).__name__


def explained(error: BaseException) -> str:
    """Why a run stopped that the engine has ended by an error of its own, which follows in brackets."""
    said = PLACE.sub("", first_line(error))
    reason = UNSOLVABLE if re.search("matrix|factori|solve", said, re.IGNORECASE) else "the engine gave up"
    return f"{reason} (engine: {said})"
