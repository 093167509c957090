"""Roofs: closed forms, an independent integrator, statics of a settled start, and energies."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from support_exudyn import (
    BeddedRoof,
    Body,
    CubicStep,
    GroundReaction,
    Held,
    Linkage,
    Machine,
    Result,
    Scenario,
    SolverSettings,
    SpringDamper,
    simulate,
)
from support_exudyn.model.linkage import pinned
from tests.cases.run_cases import loose_support
from tests.compiled_runs import simulate_compiled
from tests.roof_cases import (
    DAMPED,
    GAP,
    GIVES_DAMPED,
    HARD,
    MASS,
    ON_OIL,
    OVER_THE_COLUMNS,
    STIFFNESS,
    TEN_MEGANEWTONS,
    TOP,
    Ram,
    over_the_canopy,
    pressed_support,
    thrown,
)
from user_forces import value

W = math.sqrt(STIFFNESS / MASS)
WITH_CLEARANCE = loose_support().pins
KINDS = {
    "rigid, ideal": {},
    "oil, ideal": {"actuators": DAMPED},
    "oil, clearance": {"actuators": DAMPED, "pins": WITH_CLEARANCE},
}
GIVES = {name: GIVES_DAMPED if "oil" in name else 0.0 for name in KINDS}


# --- a ram thrown at the roof ---


FORMULATIONS = pytest.mark.parametrize("formulation", ["exudyn", "compiled"])


def by(formulation: str, scene: Scenario) -> Result:
    solver = SolverSettings(tolerance=1e-9)
    return simulate(replace(scene, formulation=formulation, solver=solver))


@FORMULATIONS
def test_a_ram_thrown_at_the_roof_comes_back_after_half_a_period(formulation: str) -> None:
    result = by(formulation, replace(thrown(0.01, 1e-4), record_period=1e-3))
    t = result.time - 0.01  # it flies for 10 ms
    swing = np.sin(W * np.clip(t, 0.0, math.pi / W))
    # second order: (W h)^2 = 1e-5 of the largest; the landing of a step with error control is not met
    close = 1e-5 if formulation == "exudyn" else 1e-6
    np.testing.assert_allclose(result["roof.force"], STIFFNESS / W * swing, atol=10.0 * close * STIFFNESS / W)
    after = t > math.pi / W + 1e-3
    np.testing.assert_allclose(result["ram.velocity_y"][after], -1.0, atol=close)
    np.testing.assert_allclose(result["roof.gap"][after], (t - math.pi / W)[after], atol=close)
    # of 500 J; half of it is stored when the ram is half as deep as it gets times the root of two
    assert result.energy_error < 1e3 * close
    assert result["energy.elastic"].max() == pytest.approx(500.0, rel=1e-3)  # a record beside the peak
    assert result["energy.work"][-1] == result["energy.damping_loss"][-1] == 0.0


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_errors_over_the_corner_of_a_force_are_those_of_the_tolerance(tolerance: float) -> None:
    off = []
    for gap in np.linspace(0.011, 0.029, 19):
        result = simulate_compiled(thrown(float(gap), 1e-4), tolerance)
        way = result["ram.y"][-1] - result["ram.y"][0]
        off.append(abs(way - (2.0 * gap + math.pi / W - result.time[-1])))
    # shares of 1 mm, which stands for a clearance; ten times as much where the embedded error alone counts
    assert np.median(off) < 2e-3 * tolerance  # measured: 1.1
    assert max(off) < 2e-2 * tolerance  # measured: 9.1


@pytest.mark.parametrize("damping", [0.2, 0.5])
def test_a_damped_roof_gives_back_what_the_closed_form_says(damping: float) -> None:
    def turned(speed: float) -> float:
        # v dv / (1 + b v) = -(k/m) x dx, whose right side is the same at both ends of an impact
        return speed / damping - math.log(1.0 + damping * speed) / damping**2

    back = -float(brentq(lambda speed: turned(speed) - turned(1.0), -0.999 / damping, -1e-9))
    result = simulate(thrown(0.01, 1e-4, damping))
    # second order: 1e-5
    assert result["ram.velocity_y"][-1] == pytest.approx(-back, rel=1e-4)
    assert result["energy.damping_loss"][-1] == pytest.approx(0.5 * MASS * (1.0 - back**2), rel=1e-4)
    assert result.energy_error < 1e-2


# --- the support under 10 MN ---


def press(kind: str, damping: float = 0.0, duration: float = 0.3) -> Scenario:
    """The roof comes down within 0.1 s and stays."""
    lowered = over_the_canopy(GAP + TEN_MEGANEWTONS / HARD + GIVES[kind], damping=damping)
    return pressed_support(lowered, duration=duration, **KINDS[kind])


@cache
def pressed(kind: str, damping: float = 0.0, duration: float = 0.3) -> Result:
    return simulate(press(kind, damping, duration))


@pytest.mark.parametrize(
    ("kind", "damping"),
    [
        ("rigid, ideal", 0.0),
        ("rigid, ideal", 1.0),
        ("oil, ideal", 0.0),
        ("oil, ideal", 1.0),
        ("oil, clearance", 1.0),
    ],
)
def test_energy_adds_up_under_a_roof_that_never_pulls(kind: str, damping: float) -> None:
    result = pressed(kind, damping)
    work = result["energy.work"].max()
    assert work > 4.7e4
    # second order in the steps: 1.3e-5, a quarter of it with steps half as long
    assert result.energy_error < 3e-5 * work
    assert (np.diff(result["energy.damping_loss"]) > -1e-5 * work).all()
    lost = result["energy.damping_loss"][-1]
    assert lost > 100.0 if damping or "clearance" in kind else True
    assert (result["roof.force"] >= 0.0).all()
    apart = result["roof.gap"] > 0.0
    assert apart[0]
    assert not apart[-1]
    assert (result["roof.force"][apart] == 0.0).all()


@pytest.mark.parametrize("gap", [0.0, 1e-3])
def test_a_settled_start_takes_the_roof_as_it_is(gap: float) -> None:
    held = over_the_canopy(0.0, gap=gap, descent=Held())
    scene = pressed_support(held, actuators=ON_OIL, pins=WITH_CLEARANCE, start="settled", duration=0.05)
    result = simulate(scene)
    # a contact this stiff turns the Newton residual of 1e-8 into speeds of 1e-9 m/s
    assert np.abs(result["rear_link.angular_velocity"]).max() < 1e-8
    # as the journal goes to the edge of its bore the canopy rises by a part of a millimetre
    pressing = result["roof.force"][0]
    assert pressing > 1e4 if gap == 0.0 else pressing == 0.0
    np.testing.assert_allclose(result["roof.force"], pressing, rtol=1e-6)


# --- roofs over a stretch and by a reaction curve ---


EXACT = SolverSettings(tolerance=1e-9)


@value
class Plate(Machine):
    """A plate of 4 m and 1 t on a pivot in its middle, and nothing else."""

    spin: float = 0.0

    def linkage(self) -> Linkage:
        plate = Body(mass=1000.0, inertia=1500.0, centre=(0.0, 1.0), spin=self.spin)
        return Linkage(bodies={"plate": plate}, pins={"pivot": pinned("ground", "plate", (0.0, 1.0))})


def over_the_plate(**changes: object) -> BeddedRoof:
    fields: dict[str, object] = {
        "body": "plate", "points": ((-2.0, 1.0), (2.0, 1.0)), "bedding": 1e6, "gaps": (0.01, 0.002),
        "descent": CubicStep(stroke=0.012, start=0.0, end=0.2), "damping": 0.3,
    }  # fmt: skip
    return BeddedRoof(**fields | changes)


@cache
def tilted(damping: float) -> np.ndarray:
    """Angle and spin of the plate after 0.6 s, with the integral over 4000 points (the rule of midpoints)."""
    roof = over_the_plate(damping=damping)
    s = (np.arange(4000) + 0.5) / 4000
    x = -2.0 + 4.0 * s
    gaps = 0.01 + s * (0.002 - 0.01)

    def rates(t: float, state: np.ndarray) -> list[float]:
        angle, spin = state
        depth = roof.descent.extension(t) + x * math.sin(angle) - gaps
        rate = roof.descent.speed(t) + x * math.cos(angle) * spin
        spread = 1e6 * np.maximum(0.0, depth) * np.maximum(0.0, 1.0 + damping * rate)
        return [spin, -float((spread * x).mean()) * 4.0 * math.cos(angle) / 1500.0]

    found = solve_ivp(rates, (0.0, 0.6), [0.0, 0.0], "DOP853", rtol=1e-10, atol=1e-12, max_step=1e-3)
    return found.y[:, -1]


@pytest.mark.parametrize(("formulation", "share"), [("exudyn", 2e-4), ("compiled", 1e-6)])
@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_a_bedding_is_the_integral_over_its_stretch(formulation: str, share: float, damping: float) -> None:
    scene = Scenario(
        machine=Plate(), loads={"roof": over_the_plate(damping=damping)}, duration=0.6, step=1e-4,
        formulation=formulation, solver=EXACT,
    )  # fmt: skip
    result = simulate(scene)
    found = np.array([result["plate.angle"][-1], result["plate.angular_velocity"][-1]])
    size = [np.abs(result[f"plate.{what}"]).max() for what in ("angle", "angular_velocity")]
    # the reference's own points are good to 1e-7
    np.testing.assert_allclose(found / size, tilted(damping) / size, atol=share)
    turned = np.abs(result["energy.work"]).max()
    assert result.energy_error < 1e-4 * turned
    if damping > 0.0:
        assert result["energy.damping_loss"][-1] > 1e-3 * turned


# --- a reaction curve ---


def reaction(**changes: object) -> GroundReaction:
    fields: dict[str, object] = {
        "body": "ram", "point": TOP, "convergences": (0.0, 0.002, 0.005, 0.02),
        "forces": (4e5, 2.5e5, 1e5, 6e4), "between": "linear",
    }  # fmt: skip
    if changes.get("body") == "canopy":
        changes["point"] = OVER_THE_COLUMNS
    return GroundReaction(**fields | changes)


@pytest.mark.parametrize("between", ["linear", "smooth"])
# redundant: second order, four times less with half the steps
@pytest.mark.parametrize(("formulation", "share"), [("exudyn", 4e-4), ("compiled", 1e-7)])
def test_a_ram_under_a_reaction_curve_is_as_by_scipy(between: str, formulation: str, share: float) -> None:
    roof = reaction(between=between)
    hold = SpringDamper(body="ram", point=TOP, other_point=(0.0, 0.0), stiffness=3e7, free_length=1.0)
    scene = Scenario(
        machine=Ram(), loads={"roof": roof, "hold": hold}, duration=0.2, step=5e-5,
        formulation=formulation, solver=EXACT,
    )  # fmt: skip
    result = simulate(scene)

    def curve(down: float) -> float:
        if between == "linear":
            return float(np.interp(down, roof.convergences, roof.forces))
        from scipy.interpolate import PchipInterpolator

        first, *inner, last = roof.convergences
        table = PchipInterpolator([first - 1.0, first, *inner, last, last + 1.0], [4e5, *roof.forces, 6e4])
        return float(table(min(max(down, first - 0.5), last + 0.5)))

    def rates(t: float, state: np.ndarray) -> list[float]:
        up, speed = state
        return [speed, (-3e7 * up - curve(-up)) / MASS - 9.81]

    found = solve_ivp(rates, (0.0, 0.2), [0.0, 0.0], "DOP853", rtol=1e-11, atol=1e-13, max_step=2e-4)
    size = np.abs(result["ram.y"] - TOP[1]).max()
    assert size > 0.005  # past two of the curve's points
    assert result["ram.y"][-1] - TOP[1] == pytest.approx(found.y[0, -1], abs=share * size)
    assert result.energy_error < 1e-3 * np.abs(result["energy.work"]).max()
    expected = [curve(one) for one in result["roof.convergence"]]
    np.testing.assert_allclose(result["roof.force"], expected, rtol=1e-9)
