"""Loads as the source of functions that are compiled, as laws of contacts are."""

from collections.abc import Callable
from typing import Any

from user_forces.compilation.flat import (
    LAW_ARGUMENTS,
    Formulas,
    SourceLine,
    UnwrittenLawError,
    function_source,
    lines,
)

from support_exudyn.formulations.compiled.arrays import COURSES_OF_LOAD, FIRST_COURSE
from support_exudyn.model.loads.load import ActingLoad, Load, LoadedPoint
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from support_exudyn.model.loads.stretch_load import LoadedStretch, StretchLoad

TimeFunction = Callable[[float], float]


class _Time(SourceLine):
    """The time, which notes the functions of it that are no formulas: they are followed as courses."""

    __slots__ = ("functions",)

    def __init__(self, name: str, formulas: Formulas) -> None:
        super().__init__(name, formulas)
        self.functions: list[TimeFunction] = []

    def course(self, function: TimeFunction) -> SourceLine:
        """The value of a function of time, which stands among what a load is told when it is called."""
        if function not in self.functions:
            self.functions.append(function)
        place = self.functions.index(function)
        if place >= COURSES_OF_LOAD:
            raise TypeError(f"it has more than {COURSES_OF_LOAD} courses over time")
        return self.line(f"out[{FIRST_COURSE + place}]")


def load_source(load: ActingLoad) -> tuple[str, list[float], list[TimeFunction]]:
    """A load as a function of what it is told of the motion, with the signature of a law.

    It gives the force forward [N], the moment [N m], or of a stretch the force up at its first point [N], and
    writes the power of what moves the load and what is lost [W], and of a force its part upwards, of a stretch
    that at its second point [N]. The functions of time that it needs come last; their values stand in `out`
    when it is called.

    Raises UnwrittenLawError, with the name of the load, if there is no such source.
    """
    formulas, (_, *known) = lines(LAW_ARGUMENTS)
    time: Any = _Time(LAW_ARGUMENTS[0], formulas)
    try:
        if isinstance(load, Load):
            at = LoadedPoint(time, *known[:4])
            given, up = load.force(at)
            written = [*load.powers(at), up]
        elif isinstance(load, StretchLoad):
            stretch = LoadedStretch(time, *known[: len(LoadedStretch._fields) - 1])
            given, second = load.forces(stretch)
            written = [*load.powers(stretch), second]
        else:
            assert isinstance(load, MomentLoad)
            turned = TurnedBody(time, *known[: len(TurnedBody._fields) - 1])
            given, written = load.moment(turned), [*load.powers(turned)]
    except TypeError as error:
        raise UnwrittenLawError(
            f"{type(load).__name__}, which cannot be written out as a formula ({error})"
        ) from error
    return *function_source(LAW_ARGUMENTS, formulas, given, written), time.functions
