"""How a run fails."""

from __future__ import annotations

import traceback
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


def told(error: BaseException) -> str:
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
