"""How much of the linkage's horizontal stiffness does slack in its pins take?

The reference support and a ZF18000 on trapped oil under three roof loads, pushed slowly to the front and to
the rear, with ideal pins and with 0.25 to 2 mm of clearance in all of them: slack of the canopy, stiffness
within it and beyond it, and what links and legs carry.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from matplotlib.figure import Figure

from studies.common.numbers import Number, cell, measured_all
from studies.common.panels import finish, grid
from studies.common.rise import Series, between
from studies.common.runs import run_with_errors
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

    def __init__(self, case: PushedSupport, run: Result) -> None:
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


def pin_shares(case: PushedSupport, run: Result) -> dict[str, float]:
    """Change of the force of each pin over that of the push, from turn to turn, all pins ideal.

    By virtual work slack is twice their sum times the clearance: each journal goes from one side of its bore to
    the other along its force.
    """
    front, rear = (int(np.argmin(np.abs(run.time - case.time(n)))) for n in (1, 3))
    shares = {}
    for pin in PINS:
        along, up = (run[f"pin.{pin}.force_{axis}"] for axis in "xy")
        shares[pin] = float(np.hypot(along[front] - along[rear], up[front] - up[rear]) / (2.0 * case.push))
    return shares


def participation(slack: float, displacement: float) -> float:
    """Share of its stiffness that the linkage has left where the roof moves the canopy so far either way [m].

    1 - s / (2 d),   at least 0
    """
    return max(0.0, 1.0 - slack / (2.0 * displacement))


# --- the study ---

DRAWN_MM = (0.0, 0.5, 1.0, 2.0)  # clearances whose loops are drawn


class SlackStiffness(Study):
    """How much of the linkage's horizontal stiffness does slack in its pins take?"""

    name, seconds = "slack_stiffness", 400.0

    def cases(self) -> dict[str, Scenario]:
        return {case.name: case.scenario() for case in CASES}

    @cached_property
    def shares(self) -> dict[tuple[str, float], dict[str, float]]:
        """Force of each ideal pin over the push, by machine and roof load."""
        cases = {how: PushedSupport(how[0], 0.0, how[1], 0.0) for how in UNDER_ROOF}
        return {how: pin_shares(case, self.runs[case.name]) for how, case in cases.items()}

    def factor(self, machine: str, share: float = MIDDLE) -> float:
        """Slack over the radial clearance, by virtual work."""
        return 2.0 * sum(self.shares[machine, share].values())

    def work(self) -> None:
        """All loops, and what follows by virtual work from ideal pins."""
        self.runs = run_with_errors(self.cases(), self.chosen)
        self.numbers = []
        for case in CASES:
            names = [name for name in MEASURES if case.clearance_mm or name in OF_IDEAL]
            measures = {
                name: (MEASURES[name], lambda run, case=case, name=name: Loop(case, run).measures()[name])
                for name in names
            }
            self.numbers += measured_all({case.name: self.runs[case.name]}, measures)
        factors = {machine: self.factor(machine) for machine in MACHINES}
        self.numbers += [Number("slack_over_clearance", name, one, "1", 0.0) for name, one in factors.items()]

    def of(self, name: str, machine: str, size: float, share: float = MIDDLE, mu: float = FRICTION) -> Number:
        """A number by machine, clearance [mm], roof load and friction."""
        return self.found[name, PushedSupport(machine, size, share, mu).name]

    def saved(self) -> dict[str, Result]:
        names = (PushedSupport(MACHINES[0], size, MIDDLE, FRICTION).name for size in (0.0, 1.0))
        return {name: self.runs[name] for name in names}

    def tables(self) -> dict[str, Sheet]:
        """Slack and stiffness under the middle roof load; what is left of the stiffness; forces of pins."""
        slack, left, sizes = [], [], CLEARANCES_MM[1:]
        for machine, size in product(MACHINES, sizes):
            names = ("slack", "within", "beyond", "whole")
            first, *stiffness = (cell(self.of(name, machine, size)) for name in names)
            slack.append((machine, f"{size:g}", first, f"{self.factor(machine) * size:.2f}", *stiffness))
        for size in sizes:
            number = self.of("slack", MACHINES[0], size)
            shares = (100.0 * participation(number.value, one) for one in ROOF_MOVES_MM)
            left.append((f"{size:g}", cell(number), *(f"{one:.0f} %" for one in shares)))
        of_pins = []
        for machine in MACHINES:
            shown = (f"{one:.3f}" for one in self.shares[machine, MIDDLE].values())
            of_pins.append((machine, *shown, f"{self.factor(machine):.2f}"))
        header = (
            "support", "clearance [mm]", "slack [mm]", "by virtual work [mm]", "within [kN/mm]",
            "beyond [kN/mm]", "turn to turn [kN/mm]",
        )  # fmt: skip
        moves = (f"roof moves ± {one:g} mm" for one in ROOF_MOVES_MM)
        pins = (name.replace("_", " ") for name in PINS)
        return {
            "slack": text_table(header, slack),
            "participation": text_table(("clearance [mm]", "slack [mm]", *moves), left),
            "pins": text_table(("support", *pins, "slack over clearance"), of_pins),
        }

    def figures(self) -> dict[str, Figure]:
        """Loops under the middle roof load; slack over clearance (a), and stiffness from turn to turn (b)."""
        loops, panels = grid(85, 1, 2)
        for axes, machine in zip(panels.flat, MACHINES, strict=True):
            for (colour, dashes), size in zip(reversed(style.CURVES[:4]), DRAWN_MM, strict=True):
                case = PushedSupport(machine, size, MIDDLE, FRICTION)
                loop, label = Loop(case, self.runs[case.name]), f"{size:g} mm" if size else "ideal pins"
                axes.plot(1e3 * loop.shift, 1e-3 * loop.force, color=colour, ls=dashes, label=label)
            axes.set(xlabel="displacement of the canopy [mm]", ylabel="horizontal force [kN]", title=machine)
        finish(loops, panels, 4)
        drawing, panels = grid(85, 1, 2)
        slack, whole = panels.flat
        markers = dict(zip(ROOF_SHARES, ("o", "s", "^"), strict=True))
        sizes, ends = CLEARANCES_MM[1:], np.array([0.0, CLEARANCES_MM[-1]])
        for machine, (colour, dashes) in zip(MACHINES, style.CURVES, strict=False):
            slack.plot(ends, self.factor(machine) * ends, color=colour, ls=dashes, lw=0.8)
            slack.plot([], [], color=colour, ls=dashes, label=machine)
            for share, marker in markers.items():
                for axes, measure, line in ((slack, "slack", "none"), (whole, "whole", dashes)):
                    values = [self.of(measure, machine, size, share).value for size in sizes]
                    axes.plot(sizes, values, marker, color=colour, ls=line, mfc="none", ms=4.5, lw=0.8)
        for share, marker in markers.items():
            slack.plot([], [], marker, color="black", mfc="none", label=f"roof load {100 * share:g} % of rated")
        slack.set_ylabel("slack of the canopy [mm]")
        whole.set(ylabel="stiffness from turn to turn [kN/mm]", ylim=(0, None))
        for axes in panels.flat:
            axes.set_xlabel("radial clearance of all pins [mm]")
        return {"loops": loops, "slack_and_stiffness": finish(drawing, panels, 3)}

    def words(self) -> dict[str, object]:
        loose = [case for case in CASES if case.clearance_mm and case.roof_share >= MIDDLE]
        known = [self.factor(case.machine, case.roof_share) * case.clearance_mm for case in loose]
        found = [self.found["slack", case.name].value for case in loose]
        return {
            "plan": sys.modules[__name__],
            "of": self.of,
            "slow": self.found["slack", SLOW.name],
            "fast": self.found["slack", FAST.name],
            "factors": {machine: self.factor(machine) for machine in MACHINES},
            "off": max(abs(one / other - 1.0) for one, other in zip(found, known, strict=True)),
            "left": participation,
            "middle": MIDDLE,
        }
