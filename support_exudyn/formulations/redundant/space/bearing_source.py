"""The force of all sections of a clearance bearing as one function of Python on both bodies' coordinates.

One connector a section costs the engine and Python several times as much: each is handed the motion in its own
frames, with matrices that nobody reads. Here the function is told the coordinates of both bodies and gives the
generalised forces on them. What all sections share, the motion of the middle and of the axis, is computed once;
a section's motion is that of the middle plus its place times that of the axis.

What changes from step to step are names of the function's module, one of each to a section, see `names`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    Relative,
    line_force,
    rough_force,
    with_friction,
)
from support_exudyn.formulations.redundant.space.section_motion import SectionEnd, SectionMover, Vector, dot
from user_forces.compilation.flat import Formulas, SourceLine, needed, text, traceable
from user_forces.contact import SMALLEST, Contact, JournalContact, SlipHistory
from user_forces.expressions.scalar import hypot, maximum, sqrt

# of every section, each followed by its number
MEMORY = ("speed", "deflection", "slip", "step")
LINE = ("offset", "slope")
PLACES = ("bore_place", "journal_place")  # from the middle, where sections slide [m]
PARTS = 6  # numbers of a section's motion: x, y, z and their rates
SUMS = ("fx", "fy", "fz", "mx", "my", "mz")  # of all sections, on the journal about its middle


class BearingGeometry(NamedTuple):
    """A clearance bearing.

    bore, journal: their middles, in the list of the coordinates of the bodies that move, bore first.
    at: what the force of a section acts on. places: of the sections from the middle [m]. slides: whether the
    journal may shift along.
    """

    bore: SectionEnd
    journal: SectionEnd
    at: Attachment
    places: Sequence[float]
    slides: bool


class Folded(SourceLine):
    """A quantity by the name of its line, where zeros and ones write no lines: axes have many."""

    __slots__ = ()

    def line(self, formula: str) -> Folded:
        """The quantity that has this formula."""
        return Folded(super().line(formula).name, self.formulas)

    def __add__(self, other: Any) -> Folded:
        return self if _is(other, 0.0) else self.line(f"{self.name} + {text(other)}")

    def __radd__(self, other: Any) -> Folded:
        return self if _is(other, 0.0) else self.line(f"{text(other)} + {self.name}")

    def __sub__(self, other: Any) -> Folded:
        return self if _is(other, 0.0) else self.line(f"{self.name} - {text(other)}")

    def __rsub__(self, other: Any) -> Folded:
        return -self if _is(other, 0.0) else self.line(f"{text(other)} - {self.name}")

    def __mul__(self, other: Any) -> Any:
        if _is(other, 0.0):
            return 0.0
        return self if _is(other, 1.0) else self.line(f"{self.name} * {text(other)}")

    def __rmul__(self, other: Any) -> Any:
        if _is(other, 0.0):
            return 0.0
        return self if _is(other, 1.0) else self.line(f"{text(other)} * {self.name}")

    def __neg__(self) -> Folded:
        return self.line(f"-{self.name}")


def _is(item: Any, number: float) -> bool:
    return isinstance(item, float) and item == number


class BearingMotion:
    """Lines of source that tell the motion of a bearing from the coordinates of both bodies.

    formulas: where all lines are collected. arguments: lines that name the coordinates.
    sections: motion of every section in the axes of its force, `PARTS` quantities. spins: of the bore along its
    axis, and of the journal against it about that of the force; the former only if the bore moves.
    """

    def __init__(self, bearing: BearingGeometry) -> None:
        self.formulas: Formulas = {}
        self._bearing = bearing
        ends = bearing.bore, bearing.journal
        moving = [end for end in ends if end.first is not None]
        size = 7 * len(moving)
        self._q, self._v = ([self.named(f"{letter}{n}") for n in range(size)] for letter in "qv")
        names = (", ".join(one.name for one in many) for many in (self._q, self._v))
        self.arguments = [f"{listed} = {many}" for listed, many in zip(names, ("q", "v"), strict=True)]
        mover = SectionMover(None, *ends, bearing.at)
        bore, journal = self._states = tuple(end.state(self._q, self._v) for end in ends)
        self._apart, rates = mover.apart(bore, journal)
        self.axes = axes = mover.axes(bore, journal)
        middle, moved = self._local(self._apart), self._local(rates)
        along = bore.turned(bearing.bore.along), journal.turned(bearing.journal.along)
        carried = [cross(state.spin, one) for state, one in zip(self._states, along, strict=True)]
        self.along = (0.0, 0.0, 1.0) if bearing.at is not Attachment.MIDDLE else self._local(along[0])
        self.own = self._local(along[1])
        turning = [self._local(one) for one in carried]
        self.sections = []
        for n in range(len(bearing.places)):
            at_bore, at_journal = self.places(n)
            self.sections.append(
                [
                    *(
                        m + at_journal * j - at_bore * b
                        for m, j, b in zip(middle, self.own, self.along, strict=True)
                    ),
                    *(
                        m + at_journal * j - at_bore * b
                        for m, j, b in zip(moved, turning[1], turning[0], strict=True)
                    ),
                ]
            )
        self.middle = middle[:2]
        spin = dot(bore.spin, along[0])
        self.spins = [spin, dot(journal.spin, axes[2]) - dot(bore.spin, axes[2])]

    def named(self, name: str) -> Any:
        """The quantity of a name."""
        return Folded(name, self.formulas)

    def places(self, n: int) -> tuple[Any, Any]:
        """Places of a section along bore and journal from their middles [m]."""
        place = self._bearing.places[n]
        if not self._bearing.slides:
            return place, place
        bore, journal = (self.named(f"{name}{n}") for name in PLACES)
        return bore, journal

    def _local(self, vector: Any) -> list[Any]:
        return [dot(axis, vector) for axis in self.axes]

    def generalised(self) -> list[Any]:
        """Generalised forces on all coordinates, from the sums over the sections."""
        sums = [self.named(name) for name in SUMS]
        force, moment = (self._global(part) for part in (sums[:3], sums[3:]))
        found: list[Any] = []
        for end, state in zip((self._bearing.bore, self._bearing.journal), self._states, strict=True):
            if end.first is None:
                continue
            arm: Any = state.turned(end.arm)
            if end is self._bearing.bore:  # it acts at the same place on the bore
                arm = [a + d for a, d in zip(arm, self._apart, strict=True)]
            sign = -1.0 if end is self._bearing.bore else 1.0
            about = [sign * (a + b) for a, b in zip(cross(arm, force), moment, strict=True)]
            a, *bcd = self._q[end.first + 3 : end.first + 7]
            found += [*(sign * part for part in force), *_on_parameters(1.0 + a, *bcd, *about)]
        return found

    def _global(self, local: Sequence[Any]) -> list[Any]:
        return [sum(axis[k] * part for axis, part in zip(self.axes, local, strict=True)) for k in range(3)]


def cross(a: Any, b: Any) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _on_parameters(a: Any, b: Any, c: Any, d: Any, x: Any, y: Any, z: Any) -> list[Any]:
    """Generalised forces of a moment on Euler parameters; for their spin see `BodyState.of`."""
    return [
        2.0 * (-b * x - c * y - d * z),
        2.0 * (a * x + d * y - c * z),
        2.0 * (-d * x + a * y + b * z),
        2.0 * (c * x - b * y + a * z),
    ]


def names(bearing: BearingGeometry) -> dict[str, Any]:
    """All that the function knows besides the coordinates, as before a run."""
    count = range(len(bearing.places))
    found: dict[str, Any] = {f"{name}{n}": 0.0 for name in (*MEMORY, *LINE) for n in count}
    found |= {f"{name}{n}": False for name in ("in_contact", "straight") for n in count}
    found |= {f"{name}{n}": bearing.places[n] for name in PLACES for n in count}
    return found | {"last": (), "calls": 0}


def force_source(bearing: BearingGeometry, contacts: Sequence[JournalContact]) -> list[str]:
    """Source of the function `force`: generalised forces of the contacts of all sections."""
    motion = BearingMotion(bearing)
    blocks = [_block(motion, bearing.at, n, contact) for n, contact in enumerate(contacts)]
    told = [part for section in motion.sections for part in section]
    told += [*motion.middle, *(motion.spins if bearing.at is not Attachment.LINE else ())]
    result = motion.generalised()
    first = needed(motion.formulas, map(text, told))
    done = set(first)
    lines = [*motion.arguments, *first, f"last = ({', '.join(map(text, told))})"]
    lines += [
        f"if not ({' or '.join(f'in_contact{n}' for n in range(len(contacts)))}): return {[0.0] * len(result)}"
    ]
    lines += [f"{' = '.join(SUMS)} = 0.0"]
    for n, (depth, limit, sums) in enumerate(blocks):
        apart = [line for line in needed(motion.formulas, [depth]) if line not in done]
        pressed = [line for line in needed(motion.formulas, sums) if line not in done and line not in apart]
        lines += [f"if in_contact{n}:", *(f"    {line}" for line in apart), f"    if {depth} > 0.0:"]
        # a law that branches is called; each section has its own
        lines += [f"        {line.replace('normal_law(', f'normal_law{n}(')}" for line in (*limit, *pressed)]
        lines += [
            f"        {name} += {value}" for name, value in zip(SUMS, sums, strict=True) if value != "(0.0)"
        ]
    return _function(motion, lines, result, done)


def spring_source(bearing: BearingGeometry) -> list[str]:
    """Source of the function `spring`: a spring across the axis instead at each section, `stiffness` given by
    number and distance.
    """
    motion = BearingMotion(bearing)
    result = motion.generalised()
    lines = [*motion.arguments, f"{' = '.join(SUMS)} = 0.0"]
    done: set[str] = set()
    for n, section in enumerate(motion.sections):
        x, y, z = section[:3]
        if bearing.at is not Attachment.LINE:
            z = 0.0
        distance = hypot(hypot(x, y), z)
        hold = motion.named(f"hold{n}")
        sums = list(map(text, _sums(motion, n, [-hold * x, -hold * y, -hold * z])))
        before = [line for line in needed(motion.formulas, [text(distance)]) if line not in done]
        done.update(before)
        lines += [*before, f"hold{n} = stiffness({n}, {text(distance)})"]
        after = [line for line in needed(motion.formulas, sums) if line not in done]
        done.update(after)
        lines += [*after, *(f"{name} += {value}" for name, value in zip(SUMS, sums, strict=True))]
    return _function(motion, lines, result, done, "spring")


def _function(
    motion: BearingMotion, lines: list[str], result: list[Any], done: set[str], name: str = "force"
) -> list[str]:
    texts = list(map(text, result))
    last = [line for line in needed(motion.formulas, texts) if line not in done]
    known = "global calls, last"
    body = [known, "calls += 1", *lines, *last, f"return [{', '.join(texts)}]"]
    return [f"def {name}(mbs, t, item, q, v):", *(f"    {line}" for line in body)]


def _block(
    motion: BearingMotion, at: Attachment, n: int, contact: JournalContact
) -> tuple[str, list[str], list[str]]:
    """The depth of a section, the line that checks it, and what it adds to the sums."""
    x, y, z, vx, vy, vz = motion.sections[n]
    speed, deflection, slip, step = (motion.named(f"{name}{n}") for name in MEMORY)
    formulas = traceable(contact)
    if at is Attachment.LINE:
        distance = sqrt(x * x + y * y + z * z)
        rate = (x * vx + y * vy + z * vz) / distance
        depth = formulas.bearing.depth(distance)
        share = line_force(formulas, depth, rate, speed) / distance
        force, arm = [-share * x, -share * y, -share * z], 0.0
        across: list[Any] = [0.0, 0.0]
    else:
        moving = Relative(x, y, vx, vy, motion.spins[1], motion.spins[0])
        history = SlipHistory(deflection, slip, step)
        found, _ = rough_force(_or_straight(formulas, motion, n), at, moving, speed, history)
        depth, force, arm = found.depth, [found.force_x, found.force_y, 0.0], found.journal_arm
        away = maximum(hypot(x, y), SMALLEST)
        across = [x / away, y / away]
    deepest = contact.normal.largest_depth
    limit = [f"if {text(depth)} > {deepest!r}: too_deep{n}({text(depth)})"] if deepest < math.inf else []
    return text(depth), limit, list(map(text, _sums(motion, n, force, [arm * one for one in across])))


def _sums(motion: BearingMotion, n: int, force: list[Any], beside: Sequence[Any] = (0.0, 0.0)) -> list[Any]:
    """Force and moment about the middle of a force on the journal beside its section's centre, in the axes."""
    place = motion.places(n)[1]
    lever = [place * one for one in motion.own]
    lever = [lever[0] + beside[0], lever[1] + beside[1], lever[2]]
    return [*force, *cross(lever, force)]


def _or_straight(contact: Contact, motion: BearingMotion, n: int) -> Contact:
    """The contact with a line in place of its law of friction where `straight` says so."""
    law = contact.friction
    if law.has_state:
        return contact
    offset, slope, straight = (motion.named(f"{name}{n}") for name in (*LINE, "straight"))

    def either(slip: Any, normal_force: Any, deflection: Any = 0.0) -> Any:
        return straight.choose(normal_force * (slip * slope + offset), law(slip, normal_force))

    return with_friction(contact, either)
