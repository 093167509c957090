"""Loads as the source of functions that are compiled, as laws of contacts are."""

from support_exudyn.model.loads.load import ActingLoad, Load, LoadedPoint
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from user_forces.compilation.flat import LAW_ARGUMENTS, UnwrittenLawError, function_source, lines


def load_source(load: ActingLoad) -> tuple[str, list[float]]:
    """A load as a function of the numbers of `LoadedPoint` or `TurnedBody`, with the signature of a law.

    It gives the force forward [N], or the moment [N m], and writes the power of what moves the load and what is
    lost [W], and of a force its part upwards [N].

    Raises UnwrittenLawError, with the name of the load, if there is no such source.
    """
    formulas, known = lines(LAW_ARGUMENTS)
    try:
        if isinstance(load, Load):
            at = LoadedPoint(*known[: len(LoadedPoint._fields)])
            given, up = load.force(at)
            written = [*load.powers(at), up]
        else:
            assert isinstance(load, MomentLoad)
            turned = TurnedBody(*known[: len(TurnedBody._fields)])
            given, written = load.moment(turned), [*load.powers(turned)]
    except TypeError as error:
        raise UnwrittenLawError(
            f"{type(load).__name__}, which cannot be written out as a formula ({error})"
        ) from error
    return function_source(LAW_ARGUMENTS, formulas, given, written)
