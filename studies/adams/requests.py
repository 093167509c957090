"""What a run in ADAMS writes, and what our channels are called there."""

from collections.abc import Iterator, Mapping

from studies.adams.statements import Statements, functions, result_name

FUNCTIONS = ("F2", "F3", "F4", "F6", "F7", "F8")  # F1 and F5 are magnitudes
PLACES = 8
LENGTHS = ("x", "y", "length", "depth", "eccentricity_x", "eccentricity_y")


class Requests:
    """Requests of a dataset: groups of up to six expressions, by the names of channels."""

    def __init__(self) -> None:
        self._asked: dict[str, dict[str, str]] = {}

    def ask(self, stem: str, **expressions: str) -> None:
        """Ask for channels STEM.NAME, each with its expression."""
        self._asked.setdefault(stem, {}).update(expressions)

    def write(self, out: Statements) -> dict[str, str]:
        """Write all; returns what results call each channel."""
        columns: dict[str, str] = {}
        for stem, expressions in self._asked.items():
            for count, some in enumerate(_groups(expressions)):
                name = result_name(stem) + (f"_{count + 1}" if count else "")
                self._request(out, name, some)
                columns |= {f"{stem}.{one}": f"{name}.{one}" for one in some}
        return columns

    @staticmethod
    def _request(out: Statements, name: str, some: Mapping[str, str]) -> None:
        """A request, with the names and the kinds of unit of its components."""
        at = dict(zip(FUNCTIONS, some, strict=False))
        places = [at.get(f"F{n}", "") for n in range(1, PLACES + 1)]
        units = [_unit(one) for one in places]
        out.add(
            "REQUEST",
            name,
            f"CNAMES = {', '.join(_quoted(one) for one in places[:4])},",
            *(", ".join(_quoted(one) for one in places[4:]),),
            f"CUNITS = {', '.join(map(_quoted, units[:4]))},",
            *(", ".join(map(_quoted, units[4:])),),
            f"RESULTS_NAME = {name}",
            *functions(**{place: some[one] for place, one in at.items()}),
        )


def _groups(expressions: Mapping[str, str]) -> Iterator[dict[str, str]]:
    names = list(expressions)
    for start in range(0, len(names), len(FUNCTIONS)):
        yield {name: expressions[name] for name in names[start : start + len(FUNCTIONS)]}


def _unit(name: str) -> str:
    if name in LENGTHS:
        return "length"
    return "angle" if name == "angle" else "force" if "force" in name else "no_units"


def _quoted(word: str) -> str:
    return f'"{word}"'
