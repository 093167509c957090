"""A contact's force as flat source: one function of numbers, several times faster than the law objects.

The laws are called once, with `SourceLine`s in place of numbers. What comes back is their formulas as lines of
source, each computed once, in which nothing is called but functions of `math`. `flat_force` lets Python compile
them, `law_source` is for a compiler of machine code.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from types import SimpleNamespace
from typing import Any, cast

from user_forces.contact import Contact, ContactForce, SlipHistory
from user_forces.expressions.scalar import Expression, maximum
from user_forces.friction.law import FrictionLaw
from user_forces.lawful import look
from user_forces.normal.law import NormalLaw

NAMES = {
    name: getattr(math, name) for name in ("sqrt", "exp", "log", "tanh", "cos", "sin", "hypot", "inf", "nan")
}  # that lines of source may use
CONSTANT = re.compile(r"\((-?(?:\d[^()]*|inf|nan))\)")  # a number as `text` writes it
TEMPORARY = re.compile(r"\b_\d+\b")  # the name of a line
DEEPEST = 40  # brackets of a formula that stands in another; Python takes some 200
Formulas = dict[str, str]  # formula: the name of the line that has it
# x, y, vx, vy, bore_spin, journal_spin, in_contact, speed, deflection, slip, step
FlatForce = Callable[..., ContactForce]


class SourceLine(Expression):
    """A quantity by the name of the line of source that computes it."""

    __slots__ = ("formulas", "name")

    def __init__(self, name: str, formulas: Formulas) -> None:
        self.name = name
        self.formulas = formulas

    def line(self, formula: str) -> SourceLine:
        """The quantity that has this formula."""
        name = self.formulas.setdefault(formula, f"_{len(self.formulas)}")
        return SourceLine(name, self.formulas)

    def function(self, name: str) -> SourceLine:
        """sqrt, exp, log, tanh, cos, sin, abs or sign of it."""
        if name == "sign":
            return self.line(f"1.0 if {self.name} > 0.0 else -1.0 if {self.name} < 0.0 else 0.0")
        return self.line(f"{name}({self.name})")

    def hypotenuse(self, other: Expression | float) -> SourceLine:
        """Square root of the sum of both squares."""
        return self.line(f"hypot({self.name}, {text(other)})")

    def choose(self, yes: Expression | float, no: Expression | float) -> SourceLine:
        """`yes` where this condition holds, else `no`; both have been computed."""
        return self.line(f"{text(yes)} if {self.name} else {text(no)}")

    def larger(self, other: Expression | float) -> SourceLine:
        """The larger of both, see `scalar.maximum`."""
        a, o = self.name, text(other)
        return self.line(f"{a} if {a} > {o} or {a} != {a} else {o}")

    def smaller(self, other: Expression | float) -> SourceLine:
        """The smaller of both, see `scalar.minimum`."""
        a, o = self.name, text(other)
        return self.line(f"{a} if {a} < {o} or {a} != {a} else {o}")

    def __add__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} + {text(other)}")

    def __radd__(self, other: Any) -> SourceLine:
        return self.line(f"{text(other)} + {self.name}")

    def __sub__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} - {text(other)}")

    def __rsub__(self, other: Any) -> SourceLine:
        return self.line(f"{text(other)} - {self.name}")

    def __mul__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} * {text(other)}")

    def __rmul__(self, other: Any) -> SourceLine:
        return self.line(f"{text(other)} * {self.name}")

    def __truediv__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} / {text(other)}")

    def __rtruediv__(self, other: Any) -> SourceLine:
        return self.line(f"{text(other)} / {self.name}")

    def __pow__(self, exponent: float) -> SourceLine:
        return self.line(f"{self.name} ** {exponent!r}")

    def __neg__(self) -> SourceLine:
        return self.line(f"-{self.name}")

    def __lt__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} < {text(other)}")

    def __le__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} <= {text(other)}")

    def __gt__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} > {text(other)}")

    def __ge__(self, other: Any) -> SourceLine:
        return self.line(f"{self.name} >= {text(other)}")


ARGUMENTS = (
    *("x", "y", "vx", "vy", "bore_spin", "journal_spin"),
    *("in_contact", "speed", "deflection", "slip", "step"),
)


def lines(names: Iterable[str]) -> tuple[Formulas, list[Any]]:
    """Where formulas will be collected, and quantities of these names to write them with."""
    formulas: Formulas = {}
    return formulas, [SourceLine(name, formulas) for name in names]


def flat_force(contact: Contact) -> FlatForce:
    """`contact.force` as a flat function of floats, bit for bit the same, that raises LawError if it is none.

    Its arguments, all floats: x, y, vx, vy, bore_spin, journal_spin as of `Contact.force`; in_contact:
    whether the surfaces touch; speed: of their impact; deflection, slip and step of SlipHistory.
    """
    formulas, (x, y, vx, vy, bore_spin, journal_spin, _, speed, deflection, slip, step) = lines(ARGUMENTS)
    history = SlipHistory(deflection, slip, step)
    found = traceable(contact).force(x, y, vx, vy, bore_spin, journal_spin, speed, history)
    free = "depth", "rate", "slip", "journal_arm"  # which do not depend on a contact
    texts = {name: text(value) for name, value in found._asdict().items()}
    apart = needed(formulas, (texts[name] for name in free))
    pressed = [line for line in needed(formulas, texts.values()) if line not in apart]
    rate = f"{_outwards(contact)} if x == 0.0 == y else {texts['rate']}"
    zeros = dict.fromkeys(ContactForce._fields, "0.0") | {name: texts[name] for name in free}
    without = _tuple(zeros | {"rate": rate, "clamped": "False"})
    source = [
        f"def force({', '.join(ARGUMENTS)}):",
        *(f"    {line}" for line in apart),
        f"    if not in_contact or {texts['depth']} <= 0.0:",
        f"        return {without}",
        *depth_check(contact, texts["depth"]),
        *(f"    {line}" for line in pressed),
        f"    if not -inf < {texts['normal_force']} + {texts['friction_force']} < inf:",
        f"        not_finite({', '.join(texts[name] for name in ContactForce._fields[:5])})",
        f"    return {_tuple(texts)}",
    ]
    return cast(FlatForce, compiled(source, contact)["force"])


def flat_function(function: Callable[[float], float]) -> Callable[[float], float]:
    """A function of a law, such as its elastic force, flat and bit for bit the same; itself if it branches.

    It checks nothing: it is for depths at which the law has been asked for its force.
    """
    formulas, (x,) = lines(("x",))
    try:
        found = text(function(x))
    except TypeError:
        return function
    source = ["def flat(x):", *(f"    {line}" for line in needed(formulas, [found])), f"    return {found}"]
    space: dict[str, Any] = dict(NAMES)
    exec(compile("\n".join(nested(source)), "<law>", "exec"), space)
    return cast(Callable[[float], float], space["flat"])


def _outwards(contact: Contact) -> str:
    """Formula of the rate of a journal in the middle, from where every way leads outwards."""
    formulas, (vx, vy) = lines(("vx", "vy"))
    found = contact.bearing.speed_outwards(vx, vy)
    return next(iter(formulas), text(found))


class UnwrittenLawError(TypeError):
    """A law that cannot be written out as a formula: it branches on its arguments, or needs them as floats."""


LAW_ARGUMENTS = ("depth", "rate", "slip", "speed", "deflection")


def law_source(contact: Contact) -> tuple[str, list[float]]:
    """Both laws of a contact as the source of one function `law` of floats, and the constants that it goes by.

        law(depth, rate, slip, speed, deflection, constants, out)

    gives the normal force [N] that the normal law asks for, negative if it asks for tension, and writes the
    friction force [N] and the elastic force [N] into out[0] and out[1], of a friction law with a state also the
    rate of its deflection [m/s] into out[2]. It gives nan beyond the depth for which the law is valid. speed
    is the impact velocity [m/s]; constants and out are arrays.

    Raises UnwrittenLawError, with the name of the law, if there is no such source.
    """
    formulas, (depth, rate, slip, speed, deflection) = lines(LAW_ARGUMENTS)
    law: NormalLaw | FrictionLaw = contact.normal
    try:
        asked = contact.normal(depth, rate, speed)
        elastic = contact.normal.elastic_force(depth)
        law = contact.friction
        friction = contact.friction(slip, maximum(asked, 0.0), deflection)
        rest = [contact.friction.deflection_rate(deflection, slip)] if contact.friction.has_state else []
    except TypeError as error:
        raise UnwrittenLawError(_unwritten(law, error)) from error
    limit = contact.normal.largest_depth
    guard = [f"if depth > {text(limit)}: return nan"] if limit < math.inf else []
    return function_source(LAW_ARGUMENTS, formulas, asked, [friction, elastic, *rest], guard)


def _unwritten(law: object, error: TypeError) -> str:
    return f"{type(law).__name__}, which cannot be written out as a formula ({error})"


def friction_source(friction: FrictionLaw) -> tuple[str, list[float]]:
    """A friction law as such a function: `depth` is the normal force [N], the others are those of the law.

    It gives the friction force [N], and writes the rate of a law's state [m/s] into out[0].

    Raises UnwrittenLawError, with the name of the law, if there is no such source.
    """
    formulas, (normal, _, slip, _, deflection) = lines(LAW_ARGUMENTS)
    try:
        force = friction(slip, normal, deflection)
        rest = [friction.deflection_rate(deflection, slip)] if friction.has_state else []
    except TypeError as error:
        raise UnwrittenLawError(_unwritten(friction, error)) from error
    return function_source(LAW_ARGUMENTS, formulas, force, rest)


def function_source(
    arguments: Iterable[str], formulas: Formulas, given: Any, written: Sequence[Any], guard: Sequence[str] = ()
) -> tuple[str, list[float]]:
    """The source of a function `law` of floats, and the constants that it goes by.

    Functions that differ in their numbers alone have the same source, so that it is compiled once for all.

    Arguments:
        arguments: names of its numbers; `constants` and `out`, two arrays, follow.
        formulas: that have been collected, see `lines`.
        given: what it returns. written: what it writes into `out`.
        guard: lines that come first.
    """
    found = [text(one) for one in (given, *written)]
    body = [
        *guard,
        *needed(formulas, found),
        *(f"out[{n}] = {name}" for n, name in enumerate(found[1:])),
        f"return {found[0]}",
    ]
    places: dict[str, int] = {}

    def lifted(match: re.Match[str]) -> str:
        return f"constants[{places.setdefault(match[1], len(places))}]"

    head = f"def law({', '.join(arguments)}, constants, out):"
    source = "\n    ".join([head, *body])
    return CONSTANT.sub(lifted, source), [float(number) for number in places]


class _Called:
    """A law whose formula cannot be written out, as a call of it."""

    largest_depth = math.inf  # the law says so itself if it is pressed too deep

    def __init__(self, name: str) -> None:
        self._name = name

    def __call__(self, first: SourceLine, *others: Any) -> SourceLine:
        return first.line(f"{self._name}({', '.join(map(text, (first, *others)))})")


class _CalledFriction(_Called):
    """A friction law that is called by its name, as `_Called` is; it may have a state."""

    def __init__(self, name: str, has_state: bool) -> None:
        super().__init__(name)
        self.has_state = has_state
        self.next_deflection = _Called(f"{name}.next_deflection")


def traceable(contact: Contact) -> Contact:
    """A contact that takes `SourceLine`s, whatever its laws: one that branches becomes a call."""
    _, (one, two, three) = lines(["one", "two", "three"])
    normal: Any = contact.normal
    friction: Any = contact.friction
    try:
        normal(one, two, three)
    except TypeError:
        normal = _Called("normal_law")
    try:
        friction.next_deflection(one, two, three)
        friction(one, two, three)
    except TypeError:
        friction = _CalledFriction("friction_law", friction.has_state)
    if normal is contact.normal and friction is contact.friction:
        return contact
    found: Any = SimpleNamespace(bearing=contact.bearing, normal=normal, friction=friction)
    found.force = partial(Contact.force, found)
    return cast(Contact, found)


def depth_check(contact: Contact, depth: str) -> list[str]:
    """The line that raises LoadError beyond the depth for which the law is valid; none if it always is."""
    limit = contact.normal.largest_depth
    return [f"    if {depth} > {limit!r}: too_deep({depth})"] if limit < math.inf else []


def compiled(source: Iterable[str], contact: Contact, **known: object) -> dict[str, Any]:
    """The names that lines of source define, and those that they may use: functions of math, what is known."""
    space: dict[str, Any] = {
        **NAMES,
        "make": tuple.__new__,
        "ContactForce": ContactForce,
        "too_deep": contact.normal.elastic_force,  # which says so
        "normal_law": contact.normal,
        "friction_law": contact.friction,
        "not_finite": partial(look, contact),
        **known,
    }
    exec(compile("\n".join(nested(source)), f"<{type(contact.normal).__name__}>", "exec"), space)
    return space


def nested(source: Iterable[str]) -> list[str]:
    """Lines of source, in which a formula whose name is used once stands where it is used.

    What is computed is the same, in fewer writings and readings of names.
    """
    kept = list(source)
    uses = Counter(name for line in kept for name in TEMPORARY.findall(line))
    found: list[str] = []
    waiting: dict[str, str] = {}
    for line in kept:
        whole = TEMPORARY.sub(lambda name: waiting.pop(name[0], name[0]), line)
        name, assigned, formula = whole.partition(" = ")
        if (
            assigned
            and uses[name.strip()] == 2
            and TEMPORARY.fullmatch(name.strip())
            and whole.count("(") < DEEPEST
        ):
            waiting[name.strip()] = f"({formula})"
        else:
            found.append(whole)
    return found


def _tuple(texts: Mapping[str, str]) -> str:
    return f"make(ContactForce, ({', '.join(texts[name] for name in ContactForce._fields)}))"


def text(item: Any) -> str:
    """The name of a quantity, or a number as source."""
    return item.name if isinstance(item, SourceLine) else f"({float(item)!r})"


def needed(formulas: Formulas, wanted: Iterable[str]) -> list[str]:
    """Those lines on which what is wanted depends, in order."""
    names = set(re.findall(r"\b_\d+\b", " ".join(wanted)))
    kept = []
    for formula, name in reversed(formulas.items()):
        if name in names:
            kept.append(f"{name} = {formula}")
            names.update(re.findall(r"\b_\d+\b", formula))
    return kept[::-1]
