"""The closed forms of two machines: what they cover, how a run in them fails, and their parts."""

from __future__ import annotations

import importlib
import math
import multiprocessing
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numba
import numpy as np
import pytest

from support_exudyn import (
    AppliedForce,
    BushingPin,
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    IdealPin,
    ImpactStand,
    OilColumn,
    Scenario,
    SimulationError,
    Steady,
    UniformSpeed,
    ravn_slider_crank,
    simulate,
)
from support_exudyn.formulations.compilation import compiled_law, plain
from support_exudyn.formulations.compiled import closed_forms, recording
from support_exudyn.formulations.compiled.closed_forms import layout, support_model
from support_exudyn.formulations.compiled.closed_forms.contact import PinState, contact_force
from support_exudyn.formulations.compiled.closed_forms.layout import driven
from support_exudyn.formulations.compiled.closed_forms.records import peak
from support_exudyn.formulations.compiled.closed_forms.setup import parameters, segments
from support_exudyn.formulations.registry import formulation
from support_exudyn.formulations.time_grid import record_times
from support_exudyn.sweeps.precompile import precompile
from tests.cases.law_cases import LUGRE
from tests.cases.machine_cases import contact, support
from tests.closed_forms import simulate_compiled
from user_forces import (
    Ambrosio,
    CarvalhoMartins,
    Exact,
    Flores,
    FrictionLaw,
    Hertz,
    Impact,
    ImpactVelocity,
    IndentationVelocity,
    InputError,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
    value,
)
from user_forces.compilation.flat import law_source
from user_forces.expressions.scalar import power

PIN = support_model.PIN
FORCE = "pin.rear_base.force"


def scene(pin: ClearancePin | None = None, **changes: Any) -> Scenario:
    fields = {"machine": support(), "duration": 0.05, "pins": {PIN: pin or ClearancePin(contact=contact())}}
    return Scenario(**fields | changes)


def hertz(stiffness: float) -> ClearancePin:
    bearing = JournalBearing(bore_radius=0.0655, clearance=0.0015)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=Hertz(stiffness=stiffness)))


# --- what is covered ---


@value
class Softened(LankaraniNikravesh):
    """A law whose force is no longer that of its family."""

    def elastic_force(self, depth: float) -> float:
        return 0.5 * super().elastic_force(depth)

    def elastic_energy(self, depth: float) -> float:
        return 0.5 * super().elastic_energy(depth)


@value
class Branching(LankaraniNikravesh):
    """A law that branches on its arguments."""

    def __call__(self, depth: float, rate: float, impact: Impact) -> float:
        return super().__call__(depth, rate, impact) if rate > 0.0 else self.elastic_force(depth)


@value
class ByMath(LankaraniNikravesh):
    """A law whose elastic part takes floats alone."""

    def __call__(self, depth: float, rate: float, impact: Impact) -> float:
        return self.stiffness * power(depth, 1.5)

    def elastic_force(self, depth: float) -> float:
        return self.stiffness * math.pow(depth, 1.5)


@value
class BranchingFriction(FrictionLaw):
    """A friction law that branches on its arguments."""

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        return -0.1 * normal_force * slip if abs(slip) < 1.0 else 0.0


def crank(**changes: Any) -> Scenario:
    """The slider-crank with a clearance slider pin."""
    fields = {
        "machine": ravn_slider_crank(),
        "duration": 0.01,
        "pins": {"slider_pin": small()},
        "drive": Steady(rate=500.0),
    }
    return Scenario(**fields | changes)


def small() -> ClearancePin:
    """A pin of the slider-crank's size."""
    bearing = JournalBearing(bore_radius=0.01, clearance=0.0005)
    return ClearancePin(contact=JournalContact(bearing=bearing, normal=Hertz(stiffness=1e10)))


def stand() -> Scenario:
    """Two free bodies."""
    machine = ImpactStand(bore_mass=1.0, journal_mass=1.0, speed=0.1)
    return Scenario(machine=machine, pins={"pin": small()}, duration=0.01)


OIL = OilColumn(bore_area=0.1, oil_length=0.5, bulk_modulus=1.5e9)
# what is left to the equations of any linkage
GENERAL: dict[str, Callable[[], Scenario]] = {
    "machine": stand,
    "jump of the crank's speed": lambda: crank(drive=UniformSpeed(stroke=1.0, start=0.0, end=1.0)),
    "start": lambda: scene(start="settled"),
    "oil": lambda: scene(actuators={"rear_column": OIL}),
    "other pin": lambda: scene(pins={"front_base": hertz(1e10)}),
    "two pins": lambda: scene(pins={PIN: hertz(1e10), "front_base": hertz(1e10)}),
    "other pin of the crank": lambda: crank(pins={"crank_pin": small()}),
    "crank without a clearance pin": lambda: crank(pins={}),
    "bushing": lambda: scene(pins={PIN: BushingPin(stiffness=(1e8, 1e8))}),
    "friction with a state": lambda: scene(ClearancePin(contact=replace(contact(), friction=LUGRE))),
    "friction of an ideal pin": lambda: scene(
        pins={"front_base": IdealPin(friction=Ambrosio(sliding_coefficient=0.1), radius=0.06)}
    ),
    "two drives": lambda: scene(drives={"rear_column": CubicStep(stroke=0.01)}),
    "load": lambda: scene(
        loads={"press": AppliedForce(body="canopy", point=(0.5, 3.0), full_force=(0.0, -1e5))}
    ),
}
Case = tuple[Callable[[], Scenario], str, str]  # scenario, backend, what the message says
REFUSED: dict[str, Case] = {
    "symbolic": (scene, "symbolic", "solver.backend = 'symbolic'"),
    "python": (scene, "python", "solver.backend = 'python'.*'auto', 'compiled'"),
    "a law that branches": (
        lambda: scene(pin_with(Branching(stiffness=1e10, restitution=0.5))),
        "auto",
        "pins.rear_base.contact = Branching, which cannot be written out as a formula .*`where`",
    ),
    "an elastic part that needs floats": (
        lambda: scene(pin_with(ByMath(stiffness=1e10, restitution=0.5))),
        "compiled",
        "pins.rear_base.contact = ByMath, which cannot be written out",
    ),
    "a friction law that branches": (
        lambda: scene(ClearancePin(contact=replace(contact(), friction=BranchingFriction()))),
        "auto",
        "pins.rear_base.contact = BranchingFriction, which",
    ),
}


def pin_with(law: NormalLaw) -> ClearancePin:
    return ClearancePin(contact=replace(contact(), normal=law))


def test_closed_forms_cover_a_machine_with_its_clearance_pin() -> None:
    for covered in (scene(), scene(pins={}), crank()):
        assert closed_forms.covers(covered)


@pytest.mark.parametrize("case", GENERAL)
def test_everything_else_is_left_to_the_equations_of_any_linkage(case: str) -> None:
    scenario = GENERAL[case]()
    assert not closed_forms.covers(scenario)
    assert formulation("compiled").covers(scenario)


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_covered_is_refused(case: str) -> None:
    make, backend, what = REFUSED[case]
    with pytest.raises(InputError, match=what) as caught:
        simulate_compiled(make(), backend=backend)
    assert "allowed:" in str(caught.value)
    assert str(caught.value).endswith("formulation = 'redundant' covers it.")


def test_a_changed_law_is_not_taken_for_one_of_its_family() -> None:
    softened = simulate_compiled(scene(pin_with(Softened(stiffness=1e10, restitution=0.5))))
    original = simulate_compiled(scene(pin_with(LankaraniNikravesh(stiffness=1e10, restitution=0.5))))
    assert softened.counts.user_function_calls == original.counts.user_function_calls == 0
    assert softened.largest_force[PIN] < 0.9 * original.largest_force[PIN]


def test_laws_that_differ_in_numbers_alone_are_compiled_once() -> None:
    one, other = (
        law_source(pin_with(Softened(stiffness=stiffness, restitution=0.5)).contact)
        for stiffness in (1e10, 2e10)
    )
    assert one[0] == other[0]
    assert one[1] != other[1]
    assert compiled_law(one[0]) is compiled_law(other[0])


@pytest.mark.parametrize("law", [Branching, ByMath])
def test_a_law_that_cannot_be_compiled_is_left_to_the_redundant_formulation(
    law: type[LankaraniNikravesh],
) -> None:
    scenario = scene(pin_with(law(stiffness=1e10, restitution=0.5)), duration=0.01)
    result = simulate(scenario, accuracy="draft")
    assert result.scenario.formulation == "redundant"
    assert result.counts.user_function_calls > 0


@pytest.mark.parametrize("tolerance", [0.0, -1e-7, 0.1, float("nan")])
def test_a_tolerance_that_makes_no_sense_is_refused(tolerance: float) -> None:
    with pytest.raises(InputError, match="tolerance"):
        simulate_compiled(scene(), tolerance)


def test_a_pin_may_be_said_to_be_ideal() -> None:
    said = simulate_compiled(scene(pins={PIN: IdealPin()}))
    unsaid = simulate_compiled(scene(pins={}))
    np.testing.assert_array_equal(said[FORCE], unsaid[FORCE])
    assert said.onsets == {}
    assert said.largest_force == {}


def test_an_unknown_channel_is_named() -> None:
    with pytest.raises(KeyError, match="no such channel"):
        simulate_compiled(scene(pins={}))["pin.front_base.depth"]


# --- failures ---


def test_a_support_that_falls_through_its_pin_stops_at_a_dead_centre() -> None:
    with pytest.raises(SimulationError) as caught:
        simulate_compiled(scene(hertz(1e3), duration=5.0))
    failure = caught.value.failure
    assert "dead centre" in failure.reason
    assert 0.5 < failure.time < 2.0  # a fall of metres
    assert failure.state["first_coordinate"] > 0.5


def test_a_run_with_too_many_steps_is_given_up() -> None:
    with pytest.raises(SimulationError, match="more than 10 steps") as caught:
        simulate_compiled(scene(), most_steps=10)
    assert 0.0 < caught.value.failure.time < 0.05


def test_a_run_with_too_many_touches_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("run", "setup"):
        module = importlib.import_module(f"support_exudyn.formulations.compiled.closed_forms.{name}")
        monkeypatch.setattr(module, "MOST_IMPACTS", 1)
    with pytest.raises(SimulationError, match="more than 1 impacts"):
        simulate_compiled(scene(hertz(1e10), duration=0.3))


def test_progress_rises_to_one() -> None:
    told: list[float] = []
    simulate_compiled(scene(), progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert all(0.0 < share <= 1.0 for share in told)


# --- parts ---


@numba.njit(error_model="numpy")
def _contact(p: Any, memory: Any, pin: PinState, out: Any) -> None:
    contact_force(p, memory, pin, out)


_plain_contact = plain(contact_force)

LAWS: list[NormalLaw] = [
    kind(stiffness=10**rng, exponent=n, restitution=e, damping_speed=speed)
    for kind in (LankaraniNikravesh, Exact, Flores, CarvalhoMartins)
    for rng, n, e, speed in (
        (10.4, 1.5, 0.9, ImpactVelocity(floor=1e-3)),
        (8.5, 1.0, 0.3, IndentationVelocity()),
        (12.0, 2.2, 0.6, IndentationVelocity()),
    )
]
LAWS.append(Hertz(stiffness=1e10))


@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{type(law).__name__}-{law.exponent}")
def test_the_force_is_that_of_the_law(law: NormalLaw) -> None:
    bearing = JournalBearing(bore_radius=0.0655, clearance=0.0015)
    friction = Ambrosio(sliding_coefficient=0.25)
    laws = JournalContact(bearing=bearing, normal=law, friction=friction)
    scenario = scene(ClearancePin(contact=laws))
    p = parameters(scenario, support_model.parameters(support()), scenario.clearance_pins[PIN])
    rng = np.random.default_rng(1)
    out, plainly = np.zeros(layout.CONTACT), np.zeros(layout.CONTACT)
    for _ in range(20):
        angle, depth = rng.uniform(0, 7), 10 ** rng.uniform(-7, -3.5)
        x, y = (bearing.clearance + depth) * np.cos(angle), (bearing.clearance + depth) * np.sin(angle)
        vx, vy = rng.normal(size=2) * 10 ** rng.uniform(-4, -1)
        spins = rng.normal(size=2) * 0.1
        speed, turn = 10 ** rng.uniform(-4, 0), rng.uniform(0, 7)
        # 700 kg along the axes of the bore, which are turned, and 1400 across
        along, across = math.cos(turn), math.sin(turn)
        mass = 1.0 / ((math.cos(angle - turn) ** 2 + 0.5 * math.sin(angle - turn) ** 2) / 700.0)
        pin = PinState(x, y, vx, vy, *spins, along, across, *np.zeros(8))
        memory = np.array([1.0, speed, 1 / 700.0, 0.0, 1 / 1400.0])
        _contact(p, memory, pin, out)
        _plain_contact(p, memory, pin, plainly)
        np.testing.assert_allclose(out, plainly, rtol=1e-13, atol=1e-18)  # rounding: compilers contract sums
        expected = laws.force(x, y, vx, vy, *spins, Impact(speed, mass))
        got = out[[layout.DEPTH, layout.RATE, layout.SLIP, layout.NORMAL, layout.FRICTION]]
        # the same formula in another order; the depth is a difference of numbers 1e-3, right to 1e-12 at least
        np.testing.assert_allclose(got, expected[:5], rtol=1e-8, atol=1e-12)
        force = [expected.force_x, expected.force_y]
        np.testing.assert_allclose(out[[layout.FORCE_X, layout.FORCE_Y]], force, rtol=1e-8, atol=1e-9)
        assert out[layout.JOURNAL_ARM] == pytest.approx(expected.journal_arm, rel=1e-8)
        lost = (expected.normal_force - law.elastic_force(expected.depth)) * expected.rate
        assert out[layout.DAMPING] == pytest.approx(lost, rel=1e-6, abs=1e-9)
        assert out[layout.STORED] == pytest.approx(law.elastic_energy(expected.depth), rel=1e-8)


@numba.njit(error_model="numpy")
def _driven(segment: Any, t: float) -> tuple[float, float, float]:
    got = driven(segment, t)
    return got.extension, got.speed, got.acceleration


@pytest.mark.parametrize(
    "drive",
    [
        Held(),
        Steady(rate=-0.3),
        CubicStep(stroke=-0.3, start=0.0, end=1.5),
        CubicStep(stroke=0.3, start=0.5, end=3.0),
        UniformSpeed(stroke=0.3, start=0.5, end=1.0),
        UniformSpeed(stroke=0.3, start=3.0, end=4.0),
    ],
    ids=str,
)
def test_segments_are_the_drive(drive: Drive) -> None:
    rows = segments(drive, 2.0)
    assert rows[0, layout.BEGIN] == 0.0
    assert rows[-1, layout.END] == 2.0
    np.testing.assert_array_equal(rows[1:, layout.BEGIN], rows[:-1, layout.END])
    for row in rows:
        assert row[layout.JUMP] == drive.speed_jump(row[layout.BEGIN])
        for t in np.linspace(row[layout.BEGIN], row[layout.END], 7)[1:]:  # a break belongs to what is before
            extension, speed, acceleration = _driven(row, t)
            # rounding; the speed's central difference over 2e-6 s is right to 1e-9
            assert extension == pytest.approx(drive.extension(t), abs=1e-15)
            assert speed == pytest.approx(drive.speed(t), abs=1e-14)
            if t < row[layout.END]:
                slope = (drive.speed(t + 1e-6) - drive.speed(t - 1e-6)) / 2e-6
                assert acceleration == pytest.approx(slope, abs=1e-8)


def test_records_are_multiples_of_the_period_and_the_end() -> None:
    np.testing.assert_array_equal(record_times(1.0, 0.25), [0.0, 0.25, 0.5, 0.75, 1.0])
    np.testing.assert_allclose(record_times(1.0, 0.3), [0.0, 0.3, 0.6, 0.9, 1.0], rtol=1e-15)
    assert record_times(0.3, 0.1)[-1] == 0.3
    assert record_times(5.0, 1e-3).size == 5001


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("law", [Hertz(stiffness=2.7e10), Exact(stiffness=2.7e10, restitution=0.6)], ids=str)
@pytest.mark.parametrize(
    "drive",
    [Held(), CubicStep(stroke=0.05, start=0.05, end=0.25), UniformSpeed(stroke=0.02, start=0.05, end=0.2)],
    ids=lambda drive: type(drive).__name__,
)
def test_energy_adds_up(law: Hertz | Exact, bore: str, drive: Drive) -> None:
    pin = ClearancePin(contact=replace(contact(), normal=law), bore=bore)
    result = simulate_compiled(scene(pin, duration=0.3, gravity=(2.0, -9.0), drive=drive), 1e-10)
    # measured 3e-7 at this tolerance, in proportion to it; friction's kinks leave the most
    assert result.dissipated > 1.0
    assert result.energy_error < 1e-6 * result.dissipated
    assert (np.abs(result["energy.work"]).max() > 100.0) == (not isinstance(drive, Held))


# --- the largest force ---


def bend(top: float, x: float) -> float:
    """A force that is largest, 1 N, at a share of a step."""
    return 1.0 - (x - top) ** 2


def peak_in_closed_forms(top: float, largest: float) -> tuple[float, float]:
    def look(p: Any, segment: Any, memory: Any, t: float, y: Any, out: Any) -> None:
        out[layout.NORMAL], out[layout.FRICTION] = bend(top, t), 0.0

    def nothing(path: Any, x: float, out: Any) -> None:
        pass

    ends, none = (bend(top, 0.0), bend(top, 1.0)), [0.0] * layout.CONTACT
    found: tuple[float, float] = plain(peak, observe=look, within=nothing)(
        None, None, None, 0.0, 1.0, None, largest, *ends, none, none
    )
    return found


def peak_in_general(top: float, largest: float) -> tuple[float, float]:
    contact = SimpleNamespace(largest=largest, normal=0.0, friction=0.0)
    scene = SimpleNamespace(contacts=[contact])

    def look(scene: Any, n: int, x: float, path: Any, y: Any, slope: Any, forced: bool) -> None:
        contact.normal = bend(top, x)

    found: tuple[float, float] = plain(recording.peak, look=look)(scene, 0, None, bend(top, 1.0), None, None)
    return found


@pytest.mark.parametrize("found", [peak_in_closed_forms, peak_in_general])
@pytest.mark.parametrize("top", [0.01, 0.06, 0.0625, 0.07, 0.5, 0.93, 0.9375, 0.99])
def test_the_largest_force_is_found_wherever_it_lies_in_a_step(
    top: float, found: Callable[[float, float], tuple[float, float]]
) -> None:
    largest, at = found(top, 0.0)
    assert largest == pytest.approx(1.0, rel=1e-12)  # flat on top: off by the square of what the place is
    assert at == pytest.approx(top, abs=1e-6)
    # far below what has been before nothing is looked for
    assert found(top, 10.0)[0] in (10.0, pytest.approx(1.0, abs=4e-3))


# --- the same numbers everywhere ---


def _bytes() -> bytes:
    result = simulate_compiled(scene(duration=0.2))
    return b"".join(channel.values.tobytes() for channel in result.channels.values())


def test_runs_are_the_same_bit_for_bit_also_in_another_process() -> None:
    precompile()
    here = _bytes()
    assert _bytes() == here
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(_bytes).result() == here


def test_records_do_not_change_the_run() -> None:
    coarse = simulate_compiled(scene(duration=0.2, record_period=0.1))
    fine = simulate_compiled(scene(duration=0.2, record_period=1e-4))
    assert coarse.onsets == fine.onsets
    assert coarse[FORCE][-1] == fine[FORCE][-1]
