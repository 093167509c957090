"""Statements of an ADAMS/Solver dataset (`.adm`), in the form that public manuals and files show.

    !                             adams_view_name='canopy'
    PART/3
    , QG = 1.5, 2.25, 0
    , MASS = 5200

A statement has a name, a slash, an identifier, and arguments, each on a line that begins with a comma. What
begins with `!` is a comment. Function expressions that are not the last argument end in a backslash. Lines
but comments are shorter than 80 characters, and no expression is continued.

Sources, public copies of the manuals of Adams Solver (Hexagon, formerly MSC Software), read in 2026:
adams.thisaray.com/adams_solver/ with b10state_define_mode.html (form of statements), state_part.html,
state_jprim.html, fstate_motion.html, func_motion.html, state_diff.html, fstate_variable.html, cfunc_if.html,
com_gforce.html, fstate_request.html, fstate_integrator.html, com_simulate.html; and what other public programs
write: FAST of NREL, FAST2ADAMS (title, comments, markers, floating markers, translational joints, parts without
mass as 1e-4 kg and kg m^2, OUTPUT, END).
"""

from collections import Counter
from collections.abc import Iterable

from user_forces.values.value import InputError

LONGEST = 79  # characters of a line
NAMED_BY = 30  # column in which names stand
FUNCTIONS = ("F2", "F3", "F4", "F6", "F7", "F8")  # of a request; F1 and F5 are magnitudes
PLACES = 8
LENGTHS = ("x", "y", "length", "depth", "eccentricity_x", "eccentricity_y")


class Statements:
    """The statements of a dataset, numbered by their kinds.

    Markers, joints, variables and others have identifiers of their own kind, from 1 on.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._count: Counter[str] = Counter()
        self._asked: dict[str, dict[str, str]] = {}

    def heading(self, text: str) -> None:
        """Begin a group of statements."""
        self.lines.append(f"!{f' {text} ':-^{LONGEST - 1}}")

    def add(self, kind: str, name: str, *arguments: str) -> int:
        """Write a numbered statement; returns its identifier.

        name: what it is called, in a comment; with its kind, for no two things have one name.
        """
        self._count[kind] += 1
        number = self._count[kind]
        named = result_name(name) if kind == "PART" else result_name(f"{name}_{kind.lower()}")
        self._write([f"!{'':{NAMED_BY - 2}} adams_view_name='{named}'", f"{kind}/{number}"], arguments)
        return number

    def following(self, kind: str) -> int:
        """The identifier that the next statement of a kind will have."""
        return self._count[kind] + 1

    def plain(self, kind: str, *arguments: str) -> None:
        """Write a statement that has no number."""
        self._write([f"{kind}/"], arguments)

    def ask(self, stem: str, **expressions: str) -> None:
        """Ask for channels STEM.NAME, each with its expression; `requests` writes them."""
        self._asked.setdefault(stem, {}).update(expressions)

    def requests(self) -> dict[str, str]:
        """Write the requests, of up to six expressions; returns each channel's column in the results."""
        columns: dict[str, str] = {}
        for stem, expressions in self._asked.items():
            names = list(expressions)
            for count, start in enumerate(range(0, len(names), len(FUNCTIONS))):
                at = dict(zip(FUNCTIONS, names[start : start + len(FUNCTIONS)], strict=False))
                name = result_name(stem) + (f"_{count + 1}" if count else "")
                places = [at.get(f"F{n}", "") for n in range(1, PLACES + 1)]
                lists = (*_quoted("CNAMES", places), *_quoted("CUNITS", map(_unit, places)))
                formulas = functions(**{place: expressions[one] for place, one in at.items()})
                self.add("REQUEST", name, *lists, f"RESULTS_NAME = {name}", *formulas)
                columns |= {f"{stem}.{one}": f"{name}.{one}" for one in at.values()}
        return columns

    def _write(self, head: Iterable[str], arguments: Iterable[str]) -> None:
        lines = [*head, *(f", {argument}" for argument in arguments)]
        for line in lines:
            if len(line) > LONGEST and not line.startswith("!"):
                raise InputError(
                    f"{line[:40]}...: takes {len(line)} characters; allowed: lines of {LONGEST}, shorter names"
                )
        self.lines += lines


def number(value: float) -> str:
    """A number that reads back as the same bits, in the form 1.0E-05."""
    mantissa, _, exponent = repr(float(value) + 0.0).partition("e")
    whole = mantissa if "." in mantissa else f"{mantissa}.0"
    return f"{whole}E{exponent}" if exponent else whole


def numbers(*values: float) -> str:
    """Several numbers."""
    return ", ".join(map(number, values))


def functions(**expressions: str) -> list[str]:
    """Arguments that are function expressions: all but the last end in a backslash."""
    written = [f"{name} = {expression}" for name, expression in expressions.items()]
    return [*(f"{one}\\" for one in written[:-1]), written[-1]]


def result_name(name: str) -> str:
    """A name of results: letters, digits and underscores."""
    return "".join(letter if letter.isalnum() and letter.isascii() else "_" for letter in name)


def _unit(name: str) -> str:
    """The kind of unit of a component."""
    if name in LENGTHS:
        return "length"
    return "angle" if name == "angle" else "force" if "force" in name else "no_units"


def _quoted(keyword: str, words: Iterable[str]) -> tuple[str, str]:
    """An argument that lists words of all places, in two lines."""
    quoted = [f'"{word}"' for word in words]
    return f"{keyword} = {', '.join(quoted[:4])},", ", ".join(quoted[4:])
