"""How much of the linkage's horizontal stiffness does slack in its pins take?

The reference support and a ZF18000 on trapped oil under three roof loads, pushed slowly to the front and to
the rear, with ideal pins and with 0.25 to 2 mm of clearance in all of them: slack of the canopy, stiffness
within it and beyond it, and what links and legs carry.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np
from matplotlib.figure import Figure

from studies.common.numbers import Found, Number, cell, measured
from studies.common.panels import finish, grid
from studies.common.rise import MeasuredRun, Series, between
from studies.common.runs import run_cases
from studies.common.study import Study
from studies.common.support_legs import PAIRS, legs_data, loose_pins, support, tight_pins
from studies.common.words import text_table
from support_exudyn import OilColumn, Pin, Result, Scenario
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.model.loads.applied import AppliedForce, TableCourse
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet
from user_forces.values.value import Vector2

MACHINES = ("reference", "zf18000")
CLEARANCES_MM = (0.0, 0.25, 0.5, 1.0, 1.5, 2.0)  # radial, in all five pins; 0: ideal
ROOF_SHARES = (0.1, 0.3, 0.6)  # of the rated force
FRICTION = 0.25  # in all pins, ideal or not
PUSH = 0.3  # of the roof load, either way; underground 0.20 to 0.35 of it were measured (Barczak 1984)
ROOF_IS_ON, BEGIN = 0.3, 0.5  # when all of the roof load is there, and when the push begins [s]
QUARTER = 1.0  # of a loop [s]
PERIOD = 2e-3  # between records [s]
MIDDLE = ROOF_SHARES[1]
ROOF_MOVES_MM = (5.0, 10.0, 20.0, 40.0)  # by how much a roof moves the canopy, either way


@dataclass(frozen=True)
class PushedSupport:
    """A support that is pushed.

    clearance_mm: of all pins. roof_share: roof load over the rated force. quarter: of a loop [s].
    """

    machine: str
    clearance_mm: float
    roof_share: float
    friction: float
    quarter: float = QUARTER

    @property
    def name(self) -> str:
        """The name of the case."""
        size = f"{self.clearance_mm:g} mm" if self.clearance_mm else "ideal"
        pins = f"{size}, mu_d = {self.friction:g}"
        slow = "" if self.quarter == QUARTER else ", half as fast"
        return f"{self.machine}, roof {self.roof_share:g}, {pins}{slow}"

    @property
    def roof_load(self) -> float:
        """Roof load [N]."""
        leg = legs_data().of(self.machine).cylinder
        assert leg.yield_valve is not None
        return self.roof_share * len(PAIRS) * leg.bore_area * leg.yield_valve.opening_pressure

    @property
    def push(self) -> float:
        """Largest horizontal force [N]."""
        return PUSH * self.roof_load

    @property
    def place(self) -> Vector2:
        """Where roof load and push act in the start posture [m]: on the canopy, between the legs' heads."""
        start = support(self.machine).start()
        front, rear = start.ends["front_head"], start.ends["rear_head"]
        return 0.5 * (front[0] + rear[0]), 0.5 * (front[1] + rear[1])

    def time(self, quarters: float) -> float:
        """The time at which so many quarters of a loop are over [s]."""
        return BEGIN + quarters * self.quarter

    def scenario(self) -> Scenario:
        """The run: roof load first, then the push from 0 to the front, to the rear and to the front."""
        leg = legs_data().of(self.machine).cylinder
        oil = OilColumn(bore_area=leg.bore_area, oil_length=leg.oil_length, bulk_modulus=leg.bulk_modulus)
        size, pins = self.clearance_mm, dict[str, Pin]()
        if size:
            pins |= loose_pins(self.machine, size, self.friction, PINS)
        elif self.friction:
            pins |= tight_pins(self.machine, self.friction, PINS)
        times = (0.0, *(self.time(n) for n in (0, 1, 3, 5)))
        course = TableCourse(times=times, shares=(0.0, 0.0, 1.0, -1.0, 1.0), between="linear")
        roof = AppliedForce(body="canopy", point=self.place, full_force=(0.0, -self.roof_load), end=ROOF_IS_ON)
        push = AppliedForce(body="canopy", point=self.place, full_force=(self.push, 0.0), course=course)
        return Scenario(
            machine=support(self.machine),
            actuators=dict.fromkeys(PAIRS, oil),
            pins=pins,
            loads={"roof": roof, "push": push},
            duration=self.time(5),
            record_period=PERIOD,
            formulation="compiled",
            accuracy="draft",
        )


FAST, SLOW = (PushedSupport("reference", 0.5, MIDDLE, FRICTION, QUARTER * n) for n in (1.0, 2.0))
UNDER_ROOF = tuple(product(MACHINES, ROOF_SHARES))
# without friction the ideal pins, and the reference support under the middle roof load
CASES = (
    *(PushedSupport(machine, size, share, FRICTION) for machine, share in UNDER_ROOF for size in CLEARANCES_MM),
    *(PushedSupport(MACHINES[0], size, MIDDLE, 0.0) for size in CLEARANCES_MM if size),
    *(PushedSupport(machine, 0.0, share, 0.0) for machine, share in UNDER_ROOF),
    SLOW,
)


def usual(machine: str, clearance_mm: float) -> str:
    """The name of the case of a machine under the middle roof load, with friction."""
    return PushedSupport(machine, clearance_mm, MIDDLE, FRICTION).name


# --- measures ---

OUTER = 0.7  # share of the push from which on a branch is fitted by a straight line


class Loop:
    """A run of a support as force over displacement: from the first turn in front, to the rear and back.

    force: the push [N], forward. shift: displacement of the pushed point since the start [m], forward.
    leg_force: what the legs push the canopy forward with [N]. All have the shape (n,).

    Arguments:
        case: that was run.
        run: its records.
    """

    def __init__(self, case: PushedSupport, run: MeasuredRun) -> None:
        self.case = case
        inside = between(run, case.time(1), case.time(5))
        self.force: Series = run["push.force_x"][inside]
        angle, x, y = (run[f"canopy.{name}"] for name in ("angle", "x", "y"))
        ox, oy = case.place[0] - x[0], case.place[1] - y[0]
        place = x + ox * np.cos(angle) - oy * np.sin(angle)
        self.shift: Series = (place - case.place[0])[inside]
        pairs = [run[f"{name}.force"] * np.cos(run[f"{name}.angle"]) for name in PAIRS]
        self.leg_force: Series = np.sum(pairs, axis=0)[inside]

    def outward(self, side: float) -> tuple[float, float]:
        """Slope [N/m] of the branch on which the push grows to a side, and its displacement at no push [m].

        side: 1 for the front, -1 for the rear.
        """
        rate = np.gradient(self.force)
        chosen = (side * self.force > OUTER * self.case.push) & (side * rate > 0.0)
        slope, place = np.polyfit(self.force[chosen], self.shift[chosen], 1)
        return float(1.0 / slope), float(place)

    def measures(self) -> dict[str, float]:
        """All numbers of the loop in the units of MEASURES.

        slack: how far apart the outward branches of both sides begin. beyond: tangent stiffness beyond it, of
        both sides in series, twice. whole: stiffness from turn to turn. within: that of the legs alone, what
        they push with over the displacement; < 0: they lean. leg_share: of the push, from turn to turn;
        negative: they push where it goes. loss: energy that a loop turns into heat, over the rectangle around
        it.
        """
        (front, begins), (rear, ends) = (self.outward(side) for side in (1.0, -1.0))
        force, shift = float(np.ptp(self.force)), float(np.ptp(self.shift))
        turns = self.leg_force[[np.argmin(self.force), np.argmax(self.force)]]
        return {
            "slack": 1e3 * (begins - ends),
            "beyond": 1e-6 * 2.0 / (1.0 / front + 1.0 / rear),
            "whole": 1e-6 * force / shift,
            "within": -1e-6 * float(np.polyfit(self.shift, self.leg_force, 1)[0]),
            "leg_share": float(turns[0] - turns[1]) / force,
            "loss": abs(float(np.trapezoid(self.force, self.shift))) / (force * shift),
        }


MEASURES = {  # units
    "slack": "mm", "beyond": "kN/mm", "whole": "kN/mm", "within": "kN/mm", "leg_share": "1", "loss": "1",
}  # fmt: skip
OF_IDEAL = ("whole", "leg_share")  # what a support without slack has


Ran = Mapping[str, tuple[PushedSupport, Result]]
Shares = Mapping[tuple[str, float], Mapping[str, float]]  # of the push, by machine and roof load


def pin_shares(case: PushedSupport, run: Result) -> dict[str, float]:
    """Change of the force of each pin over that of the push, from turn to turn, all pins ideal."""
    front, rear = (int(np.argmin(np.abs(run.time - case.time(n)))) for n in (1, 3))
    shares = {}
    for pin in PINS:
        along, up = (run[f"pin.{pin}.force_{axis}"] for axis in "xy")
        shares[pin] = float(np.hypot(along[front] - along[rear], up[front] - up[rear]) / (2.0 * case.push))
    return shares


def kinematic_slack(case: PushedSupport, shares: Mapping[str, float]) -> float:
    """Slack [m] by virtual work: each journal goes from one side of its bore to the other along its force.

    s = 2 c sum f,   f: force of a pin over the push
    """
    return 2e-3 * case.clearance_mm * sum(shares.values())


def numbers(ran: Ran) -> list[Number]:
    """All numbers of the loops."""

    def measure(case: PushedSupport, run: Result, name: str) -> Number:
        return measured(name, case.name, MEASURES[name], run, lambda finer: Loop(case, finer).measures()[name])

    return [
        measure(case, run, name)
        for case, run in ran.values()
        for name in MEASURES
        if case.clearance_mm or name in OF_IDEAL
    ]


def participation(slack: float, displacement: float) -> float:
    """Share of its stiffness that the linkage has left where the roof moves the canopy so far either way [m].

    1 - s / (2 d),   at least 0
    """
    return max(0.0, 1.0 - slack / (2.0 * displacement))


# --- tables ---


def key_table(found: Found, shares: Shares) -> Sheet:
    """Slack and stiffness of every support under the middle roof load."""
    rows = []
    for machine in MACHINES:
        for size in CLEARANCES_MM[1:]:
            names = ("slack", "within", "beyond", "whole")
            slack, *stiffness = (cell(found[name, usual(machine, size)]) for name in names)
            rows.append((machine, f"{size:g}", slack, f"{factor(shares, machine) * size:.2f}", *stiffness))
    header = (
        "support", "clearance [mm]", "slack [mm]", "by virtual work [mm]", "within [kN/mm]", "beyond [kN/mm]",
        "turn to turn [kN/mm]",
    )  # fmt: skip
    return text_table(header, rows, left=1)


def participation_table(found: Found) -> Sheet:
    """What is left of the linkage's stiffness, by clearance and by how far the roof moves."""
    rows = []
    for size in CLEARANCES_MM[1:]:
        slack = found["slack", usual(MACHINES[0], size)]
        left = [100.0 * participation(slack.value, one) for one in ROOF_MOVES_MM]
        rows.append((f"{size:g}", cell(slack), *(f"{one:.0f} %" for one in left)))
    header = ("clearance [mm]", "slack [mm]", *(f"roof moves ± {one:g} mm" for one in ROOF_MOVES_MM))
    return text_table(header, rows)


def pin_table(shares: Shares) -> Sheet:
    """Force of each pin over the push, with ideal pins."""
    rows = [
        (machine, *(f"{one:.3f}" for one in shares[machine, MIDDLE].values()), f"{factor(shares, machine):.2f}")
        for machine in MACHINES
    ]
    pins = (name.replace("_", " ") for name in shares[MACHINES[0], MIDDLE])
    return text_table(("support", *pins, "slack over clearance"), rows)


def factor(shares: Shares, machine: str) -> float:
    """Slack over the radial clearance, by virtual work."""
    return 2.0 * sum(shares[machine, MIDDLE].values())


# --- figures ---

DRAWN_MM = (0.0, 0.5, 1.0, 2.0)  # clearances whose loops are drawn


def loop_figure(ran: Ran) -> Figure:
    """Push over displacement of the canopy, a panel for each machine, under the middle roof load."""
    drawing, panels = grid(85, 1, 2)
    for axes, machine in zip(panels.flat, MACHINES, strict=True):
        for (colour, dashes), size in zip(reversed(style.CURVES[:4]), DRAWN_MM, strict=True):
            loop = Loop(*ran[usual(machine, size)])
            label = f"{size:g} mm" if size else "ideal pins"
            axes.plot(1e3 * loop.shift, 1e-3 * loop.force, color=colour, ls=dashes, label=label)
        axes.set(xlabel="displacement of the canopy [mm]", ylabel="horizontal force [kN]", title=machine)
    return finish(drawing, panels, 4)


def slack_figure(found: Found, shares: Shares) -> Figure:
    """Slack over clearance with the line of virtual work (a), and stiffness from turn to turn (b)."""
    drawing, panels = grid(85, 1, 2)
    slack, whole = panels.flat
    markers = dict(zip(ROOF_SHARES, ("o", "s", "^"), strict=True))
    sizes, ends = CLEARANCES_MM[1:], np.array([0.0, CLEARANCES_MM[-1]])
    for machine, (colour, dashes) in zip(MACHINES, style.CURVES, strict=False):
        slack.plot(ends, factor(shares, machine) * ends, color=colour, ls=dashes, lw=0.8)
        slack.plot([], [], color=colour, ls=dashes, label=machine)
        for share, marker in markers.items():
            for axes, measure, line in ((slack, "slack", "none"), (whole, "whole", dashes)):
                names = [PushedSupport(machine, size, share, FRICTION).name for size in sizes]
                values = [found[measure, name].value for name in names]
                axes.plot(sizes, values, marker, color=colour, ls=line, mfc="none", ms=4.5, lw=0.8)
    for share, marker in markers.items():
        slack.plot([], [], marker, color="black", mfc="none", label=f"roof load {100 * share:g} % of rated")
    for axes, label in ((slack, "slack of the canopy [mm]"), (whole, "stiffness from turn to turn [kN/mm]")):
        axes.set(xlabel="radial clearance of all pins [mm]", ylabel=label)
    whole.set_ylim(0, None)
    return finish(drawing, panels, 3)


# --- the study ---


class SlackStiffness(Study):
    """How much of the linkage's horizontal stiffness does slack in its pins take?"""

    name, seconds = "slack_stiffness", 400.0

    def work(self) -> None:
        """All loops."""
        self.runs = run_cases({case.name: case.scenario() for case in CASES}, self.chosen)
        self.ran = {case.name: (case, self.runs[case.name]) for case in CASES}
        self.shares = {
            (machine, share): pin_shares(*self.ran[PushedSupport(machine, 0.0, share, 0.0).name])
            for machine, share in UNDER_ROOF
        }
        self.numbers = numbers(self.ran) + [
            Number("slack_over_clearance", one, factor(self.shares, one), "1", 0.0) for one in MACHINES
        ]

    def saved(self) -> dict[str, Result]:
        """Two loops of the reference support."""
        return {name: self.runs[name] for name in (usual(MACHINES[0], size) for size in (0.0, 1.0))}

    def figures(self) -> dict[str, Figure]:
        """All figures."""
        return {"loops": loop_figure(self.ran), "slack_and_stiffness": slack_figure(self.found, self.shares)}

    def tables(self) -> dict[str, Sheet]:
        """All tables."""
        return {
            "slack": key_table(self.found, self.shares),
            "participation": participation_table(self.found),
            "pins": pin_table(self.shares),
        }

    def words(self) -> dict[str, object]:
        """Numbers by machine and clearance, and how far virtual work is off."""
        found = self.found
        off = [  # slack against virtual work
            abs(found["slack", case.name].value / known - 1.0)
            for case in CASES
            if (known := 1e3 * kinematic_slack(case, self.shares[case.machine, case.roof_share]))
            and case.roof_share >= MIDDLE
        ]

        def number(name: str, machine: str, size: float, share: float = MIDDLE, mu: float = FRICTION) -> Number:
            return found[name, PushedSupport(machine, size, share, mu).name]

        return {
            "plan": sys.modules[__name__],
            "of": number,
            "slow": found["slack", SLOW.name],
            "fast": found["slack", FAST.name],
            "factors": {machine: factor(self.shares, machine) for machine in MACHINES},
            "off": max(off),
            "left": participation,
            "middle": MIDDLE,
        }
