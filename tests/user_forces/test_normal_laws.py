"""All normal laws: force, energy and depths that belong together, what impacts deliver, published numbers."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from tests.analytic import adams_step
from tests.analytic import delivered_restitution as closed_form
from tests.cases.law_cases import (
    BEARING,
    CYLINDER_LAWS,
    FRICTION_LAWS,
    MODULUS,
    NORMAL_LAWS,
    POWER_LAWS,
    cylinder_law,
    kind_of,
    law_rebound,
    power_law,
)
from tests.often import often
from user_forces import (
    AdamsImpact,
    Anagnostopoulos,
    Exact,
    Hertz,
    InputError,
    Johnson,
    JournalContact,
    KelvinVoigt,
    LankaraniNikravesh,
    LoadError,
    NormalLaw,
    Pereira,
    PinInBore,
    SlipHistory,
    Value,
    delivered_restitution,
    exact_damping_factor,
    normal_law,
)
from user_forces.normal.dashpots import cut_dashpot_restitution
from user_forces.normal.hysteresis import REST_VELOCITY
from user_forces.normal.part import PartOf
from user_forces.normal.power_laws import DAMPING_FACTORS

ASKED = (0.1, 0.3, 0.5, 0.7, 0.9)


@normal_law
def hardening(depth: float, rate: float, impact_velocity: float, stiffness: float = 1e12) -> float:
    """A law of one's own, with a branch and with the energy that is integrated for it."""
    if depth < 1e-5:
        return stiffness * depth**2
    return stiffness * 1e-5 * (2.0 * depth - 1e-5)


LAWS: tuple[NormalLaw, ...] = (
    *NORMAL_LAWS,
    PinInBore(bearing=BEARING, length=0.7, effective_modulus=MODULUS, restitution=0.7, backing_stiffness=3e9),
    PartOf(law=cylinder_law(Johnson), share=0.3),
    hardening(),
)
every_law = pytest.mark.parametrize("law", LAWS, ids=kind_of)
shares = st.floats(-9.0, -0.1).map(lambda power: 10.0**power)  # of a law's range, or of 10 mm
speeds = st.floats(0.0, 2.0)
DASHPOT = {"stiffness": 1e9, "restitution": 0.7}
COMMON = AdamsImpact(stiffness=1e5 * 1000.0**1.5, full_damping=5e4, full_damping_depth=1e-4)


def reach(law: NormalLaw) -> float:
    """Depth [m] up to which a law is tried."""
    return min(law.largest_depth, 1e-2)


# --- what holds for all laws ---


@every_law
@settings(max_examples=often(40))
@given(share=shares, rate=st.floats(-2.0, 2.0), speed=speeds)
def test_force_energy_and_depths_belong_together(
    law: NormalLaw, share: float, rate: float, speed: float
) -> None:
    depth = share * reach(law)
    held, stored = law.elastic_force(depth), law.elastic_energy(depth)
    assert law(depth, 0.0, speed) == held > 0.0
    assert (law(depth, rate, speed) - held) * rate >= 0.0
    edge = math.sqrt(min(1.0, 1e-6 * BEARING.clearance / depth))  # where the law of a pin begins to be linear
    parts = ((0.0, edge), (edge, 1.0)) if isinstance(law, PinInBore) else ((0.0, 1.0),)
    work = sum(
        quad(lambda s: 2.0 * s * depth * law.elastic_force(s * s * depth), *ends, epsabs=0.0, epsrel=1e-10)[0]
        for ends in parts
    )
    # quadrature; a part of a polynomial, and a corner in the law of one's own
    assert stored == pytest.approx(work, rel=1e-4 if law is LAWS[-1] else 1e-8)
    assert law.resting_depth(held) == pytest.approx(depth, rel=1e-12)  # rounding
    assert law.turning_depth(stored) == pytest.approx(depth, rel=1e-11)  # Liu's series and Gauss's rule
    for near in (1.0 - 1e-9, 1.0 + 1e-9):
        size = held + abs(law(depth, rate, speed))
        assert law(near * depth, rate, speed) == pytest.approx(law(depth, rate, speed), abs=1e-8 * size)


@every_law
@settings(max_examples=often(15))
@given(share=st.floats(1e-4, 0.9), speed=st.floats(1e-3, 2.0), swings=st.integers(1, 3))
def test_a_cycle_of_depth_never_gives_work(law: NormalLaw, share: float, speed: float, swings: int) -> None:
    phase = np.linspace(0.0, 1.0, 400 * swings + 1)[1:-1]
    envelope, change = np.sin(math.pi * phase), math.pi * np.cos(math.pi * phase)
    ripple = 1.0 + 0.3 * np.sin(2.0 * math.pi * swings * phase) ** 2
    rippling = 0.6 * math.pi * swings * np.sin(4.0 * math.pi * swings * phase)
    depth, rate = envelope * ripple, change * ripple + envelope * rippling
    deepest = share * reach(law) / 1.3
    time = deepest / speed
    forces = [max(0.0, law(deepest * x, deepest * v / time, speed)) for x, v in zip(depth, rate, strict=True)]
    work = float((np.array(forces) * rate * deepest).mean())
    # the rule's error, of the largest force times the depth
    assert work >= -2e-4 * max(forces) * deepest


CONTACTS = [
    *(JournalContact(bearing=BEARING, normal=law) for law in LAWS),
    *(JournalContact(bearing=BEARING, normal=power_law(Exact), friction=law) for law in FRICTION_LAWS),
]


@pytest.mark.parametrize("contact", CONTACTS, ids=lambda one: f"{kind_of(one.normal)}, {kind_of(one.friction)}")
def test_compiled_laws_give_the_same_to_the_bit(contact: JournalContact) -> None:
    random, law, count = np.random.default_rng(1), contact.normal, 200
    depth, angle = reach(law) * 10.0 ** random.uniform(-8.0, -1.5, count), random.uniform(-3.0, 3.0, count)
    far, slow = BEARING.clearance + depth, 10.0 ** random.uniform(-5.0, 0.0, count)  # laws bend at small slips
    motion = (far * np.cos(angle), far * np.sin(angle), *slow * random.uniform(-1.0, 1.0, (4, count)))
    bristles = random.uniform(-3e-6, 3e-6, count), random.uniform(-0.1, 0.1, count), random.random(count) * 1e-4
    rows = np.column_stack([*motion, random.random(count) < 0.9, random.random(count), *bristles])
    found = contact.forces(rows)
    stored = contact.energies(found.depth)
    for n, (*moving, closed, speed, deflection, slip, step) in enumerate(rows.tolist()):
        want = contact.force(*moving, speed if closed else None, SlipHistory(deflection, slip, step))
        assert tuple(column[n] for column in found) == want
        # of a law of one's own it is a sum of powers, which machine code rounds otherwise
        off = 1e-15 if law is LAWS[-1] else 0.0
        assert stored[n] == pytest.approx(law.elastic_energy(want.depth), rel=off, abs=0.0)


@every_law
def test_ends_of_the_range(law: NormalLaw) -> None:
    assert law.resting_depth(0.0) == law.turning_depth(0.0) == 0.0
    assert law.impact_time(0.0, 5.0) == math.inf
    for speed, mass in ((1e-3, 5e3), (0.3, 5.0), (2.0, 0.5)):  # an impact lasts as an elastic one, or shorter
        elastic = 2.94 * law.turning_depth(0.5 * mass * speed**2) / speed
        assert 0.0 < law.impact_time(speed, mass) <= elastic * (1.0 + 1e-15)
    for ask in (law.resting_depth, law.turning_depth):
        for wrong in (-1.0, math.nan):
            with pytest.raises(InputError, match=rf"{kind_of(law)}: .*{wrong}.*allowed: >= 0"):
                ask(wrong)
    limit = law.largest_depth
    if limit == math.inf:
        return
    largest = law.elastic_force(limit)
    assert law.resting_depth(largest) == law.turning_depth(2.0 * law.elastic_energy(limit)) == limit
    for deeper in (law.elastic_force, law.elastic_energy, lambda depth: law(depth, 0.1, 0.2)):
        with pytest.raises(LoadError, match=rf"{kind_of(law)}: depth = .* allowed: up to {limit:.6g} m"):
            deeper(1.01 * limit)
    with pytest.raises(LoadError, match=re.escape(f"allowed: up to {largest:.6g} N")):
        law.resting_depth(1.01 * largest)


@pytest.mark.parametrize(
    ("kind", "fields", "wrong", "allowed"),
    [
        *((kind, DASHPOT, {"restitution": wrong}, ">") for kind in POWER_LAWS for wrong in (-0.1, 1.1)),
        *((LankaraniNikravesh, DASHPOT, {"stiffness": wrong}, "> 0") for wrong in (0.0, -1.0)),
        *((LankaraniNikravesh, DASHPOT, {"exponent": wrong}, ">= 1 and <= 3") for wrong in (0.9, 3.1)),
        *((Exact, DASHPOT, {"rest_velocity": wrong}, "> 0") for wrong in (0.0, -1e-3)),
        (Anagnostopoulos, DASHPOT, {"restitution": 0.0}, "> 0 and <= 1"),
        (KelvinVoigt, {"stiffness": 1e8, "damping": 1e3}, {"damping": -1.0}, ">= 0"),
        (KelvinVoigt, {"stiffness": 1e8, "damping": 1e3}, {"exponent": 1.5}, ">= 1 and <= 1"),
        (AdamsImpact, vars(COMMON), {"full_damping": -1.0}, ">= 0"),
        (AdamsImpact, vars(COMMON), {"full_damping_depth": 0.0}, "> 0"),
    ],
)
def test_a_number_out_of_range_is_refused(
    kind: type[NormalLaw], fields: dict[str, Any], wrong: dict[str, float], allowed: str
) -> None:
    ((name, number),) = wrong.items()
    with pytest.raises(InputError, match=rf"{kind.__name__}\.{name} = {number}: .*allowed: {allowed}"):
        kind(**fields | wrong)


# --- the damping factor and the restitution that it delivers ---

EXACT = {
    0.1: 9.998159,
    0.2: 4.919167,
    0.3: 3.087082,
    0.5: 1.432751,
    0.7: 0.634828,
    0.9: 0.166482,
    0.95: 0.078927,
}


@given(chi=st.floats(-5.0, 3.0).map(lambda power: 10.0**power))
def test_delivered_restitution_is_the_closed_form(chi: float) -> None:
    e = delivered_restitution(chi)
    # Lambert's function loses half of its digits where its branches meet: the form itself is within 1e-16/chi^2
    assert e == pytest.approx(closed_form(chi), abs=1e-12 + 2e-15 / chi**2)
    if 1e-4 < chi < 5.0:
        # the impulse balances; cancellation leaves 1e-16/chi
        left = quad(lambda u: u / (1.0 + chi * u), -e, 1.0, epsabs=1e-13, epsrel=0.0)[0]
        assert left * (1.0 - chi * e) / e == pytest.approx(0.0, abs=1e-12 + 1e-15 / chi)
    assert delivered_restitution(1.01 * chi) < e


@pytest.mark.parametrize(
    ("e", "chi"),
    [*EXACT.items(), (1.0, 0.0), (0.021, 1 / 0.021), (1e-5, 1e5), (1 - 1e-3, 1.5015e-3), (1 - 1e-7, 1.5e-7)],
)
def test_the_exact_factor_is_the_published_one(e: float, chi: float) -> None:
    # half of the last printed digit; 1/e where exp(-1/e) is no number, and 3/2 d (1 + d) for d = 1 - e
    assert exact_damping_factor(e) == pytest.approx(chi, rel=3e-6, abs=5.1e-7 if e in EXACT else 0.0)


@pytest.mark.parametrize("kind", POWER_LAWS, ids=kind_of)
def test_a_power_law_is_its_published_formula(kind: type[Any]) -> None:
    law = power_law(kind, stiffness=4e10, restitution=0.6)
    printed = DAMPING_FACTORS[kind.__name__].formula if kind is not Exact else "exact(e)"
    written = re.sub(r"(?<=[\d)]) (?=[(\de])", " * ", printed).replace("^", "**")
    names = {"exp": math.exp, "exact": exact_damping_factor}
    for e in (0.2, *ASKED):
        # the formula in words, computed as it is printed
        chi = eval(written, names | {"e": e})
        assert power_law(kind, restitution=e).damping_factor == pytest.approx(chi, rel=1e-12)
    # 4e10 (1e-4)^1.5 (1 + chi/4) at a quarter of the impact velocity; rounding
    assert law(1e-4, 0.05, 0.2) == pytest.approx(4e4 * (1.0 + law.damping_factor / 4.0), rel=1e-13)
    # what would pull is left to the caller: 1 + chi rate / v0 < 0 on a contact that is torn open
    assert law(1e-4, -1.1 * 0.2 / law.damping_factor, 0.2) < 0.0
    stated = re.search(r"Delivers ([\d., ]+)\s+for e = ([\d., ]+)\.\s", kind.__doc__ or "")
    assert stated
    told, asked = ([float(number) for number in part.split(",")] for part in stated.groups())
    assert tuple(asked) == ASKED
    laws = [power_law(kind, restitution=e) for e in asked]
    assert told == [round(closed_form(one.damping_factor), 3) for one in laws]
    if kind is not Exact:
        assert tuple(told) == DAMPING_FACTORS[kind.__name__].delivers
    zero = kind is Exact or DAMPING_FACTORS[kind.__name__].divides
    if zero:
        with pytest.raises(InputError, match=rf"{kind.__name__}\.restitution = 0\.0: .*allowed: > 0 and <= 1"):
            power_law(kind, restitution=0.0)
    else:
        assert 0.7 < power_law(kind, restitution=0.0).damping_factor < 17.0


def dashpot(zeta: float, stiffness: float, mass: float) -> KelvinVoigt:
    return KelvinVoigt(stiffness=stiffness, damping=2.0 * zeta * math.sqrt(stiffness * mass))


IMPACTS: dict[str, NormalLaw] = {
    **{kind.__name__: power_law(kind, restitution=0.4) for kind in POWER_LAWS},
    **{kind.__name__: cylinder_law(kind, restitution=0.4) for kind in CYLINDER_LAWS},
    "PinInBore": LAWS[-3],
    "elastic, n = 1": Hertz(stiffness=1e9, exponent=1.0),
    "elastic, n = 3": Hertz(stiffness=1e9, exponent=3.0),
    "weak dashpot": dashpot(0.1, 1e8, 40.0),
    "strong dashpot": dashpot(3.0, 1e8, 40.0),
    "dashpot for a restitution": Anagnostopoulos(stiffness=1e9, restitution=0.3, mass=40.0),
}


@pytest.mark.parametrize("name", IMPACTS)
@settings(max_examples=often(4), deadline=None)
@given(speed=st.floats(0.02, 1.0))
def test_a_free_impact_delivers_what_the_law_states(name: str, speed: float) -> None:
    law: Any = IMPACTS[name]
    stated = 1.0 if isinstance(law, Hertz) else law.delivered_restitution
    stated = stated(40.0) if callable(stated) else stated
    if isinstance(law, (*CYLINDER_LAWS, PinInBore, Exact)) and not isinstance(law, Pereira):
        assert stated == pytest.approx(law.restitution, abs=1e-9)
    # the integrator's tolerance of 1e-10 a step, over some hundred steps
    assert law_rebound(law, 40.0, speed) == pytest.approx(stated, abs=2e-7)


# --- the rest velocity ---


@pytest.mark.parametrize("speed", [0.0, 1e-9, 4.9e-3])
def test_a_soft_impact_is_damped_as_at_the_rest_velocity(speed: float) -> None:
    law, lower = (power_law(Exact, rest_velocity=rest) for rest in (5e-3, 1e-6))
    assert law(1e-4, 0.1, speed) == law(1e-4, 0.1, 5e-3) != law(1e-4, 0.1, 6e-3)
    assert law(1e-4, 0.1, 0.2) == lower(1e-4, 0.1, 0.2)  # a faster one is not
    # damping is inverse to the impact velocity; rounding of the difference
    slow, fast = (law(1e-4, 0.1, v) - law.elastic_force(1e-4) for v in (0.2, 0.4))
    assert slow == pytest.approx(2.0 * fast, rel=1e-12)


def test_laws_of_earlier_versions_are_read() -> None:
    law = power_law(Exact)
    kept = {key: item for key, item in law.to_data().items() if key != "rest_velocity"}
    old = kept | {"damping_speed": {"type": "ImpactVelocity", "floor": 2e-3}}
    assert Value.from_data(old) == power_law(Exact, rest_velocity=2e-3)
    with pytest.warns(UserWarning, match="IndentationVelocity is no longer there; .* of 10 mm/s"):
        assert Value.from_data(kept | {"damping_speed": {"type": "IndentationVelocity"}}) == law
    assert law.rest_velocity == REST_VELOCITY == 0.01
    with pytest.raises(InputError, match=r"damping_speed = .*no such field any more; give rest_velocity"):
        power_law(Exact, damping_speed=1.0)


# --- dashpots ---

# damping ratio, and restitution with the tension cut
CUT = [(0.05, 0.858758), (0.2155, 0.550221), (0.5, 0.298436), (0.9, 0.155283), (1.5, 0.075588)]
# restitution asked for, damping ratio, and what is delivered with the tension cut
ANAGNOSTOPOULOS = [
    (0.1, 0.591155, 0.252729),
    (0.3, 0.357857, 0.397140),
    (0.5, 0.215454, 0.550283),
    (0.7, 0.112808, 0.718201),
    (0.9, 0.033518, 0.902026),
]


def test_dashpots_deliver_the_published_restitutions() -> None:
    for zeta, e in CUT:  # half of the last printed digit
        assert cut_dashpot_restitution(zeta) == pytest.approx(e, abs=5.1e-7)
    for e, zeta, delivered in ANAGNOSTOPOULOS:
        law = Anagnostopoulos(stiffness=1e9, restitution=e)
        assert law.damping_ratio == pytest.approx(zeta, abs=5.1e-7)
        assert law.delivered_restitution == pytest.approx(delivered, abs=5.1e-7)
        assert f"{delivered:.3f}" in (Anagnostopoulos.__doc__ or "")
    # the slope at critical damping is 2/3 exp(-2) or less
    for zeta in (1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.0 - 2e-9, 1.0 + 2e-9):
        assert cut_dashpot_restitution(zeta) == pytest.approx(math.exp(-2.0), rel=3e-7)


def test_dashpots_by_hand() -> None:
    law = KelvinVoigt(stiffness=2e8, damping=3e4)
    assert law(1e-4, 0.1, 0.2) == pytest.approx(2.3e4, rel=1e-15)  # 2e4 N and 3e3 N
    assert law(1e-4, -1.0, 0.2) == pytest.approx(-1e4, rel=1e-14)  # tension, for the caller to cut
    # zeta = 0.112808 of 0.7, and 2 zeta sqrt(K m) by hand
    other = Anagnostopoulos(**DASHPOT, mass=10.0)
    assert other(1e-4, 0.1, 0.2) == pytest.approx(1e5 + 0.2 * 0.112808 * 1e5, rel=1e-6)
    with pytest.raises(InputError, match=r"Anagnostopoulos\.mass: missing"):
        Anagnostopoulos(**DASHPOT)(1e-4, 0.1, 0.2)
    # a dashpot alone stops a mass m as exp(-c t/m), three of which are taken: the spring adds 1e-9 of its own
    strong, weak = (KelvinVoigt(stiffness=1e6, damping=c) for c in (1e5, 10.0))
    assert strong.impact_time(0.3, 1.0) == pytest.approx(3.0 / 1e5, rel=1e-9)
    assert weak.impact_time(0.3, 1.0) == pytest.approx(2.94e-3, rel=1e-13)


@given(depth=st.floats(1e-9, 3e-4), rate=st.floats(-2.0, 2.0), speed=speeds)
def test_the_impact_function_is_that_of_adams(depth: float, rate: float, speed: float) -> None:
    # MSC Adams: k (x1 - x)^e - STEP(x, x1 - d, cmax, x1, 0) x', for a distance x below x1
    published = 1e5 * 1000.0**1.5 * depth**1.5 + adams_step(-depth, -1e-4, 5e4, 0.0, 0.0) * rate
    assert COMMON(depth, rate, speed) == pytest.approx(published, rel=1e-12, abs=1e-12 * 5e4 * abs(rate))


# the tension is cut and may come back as pressure
@pytest.mark.parametrize(
    ("mass", "speed", "e"),
    [(1.0, 0.01, 0.952), (1.0, 0.1, 0.483), (1.0, 1.0, 0.057), (500.0, 0.01, 0.880), (500.0, 1.0, 0.736)],
)
def test_restitution_of_the_common_set_of_adams(mass: float, speed: float, e: float) -> None:
    assert law_rebound(COMMON, mass, speed) == pytest.approx(e, abs=5.1e-4)  # half of the last printed digit


@settings(max_examples=often(10), deadline=None)
@given(depth=st.floats(1e-6, 1e-3), n=st.floats(1.0, 3.0), mass=st.floats(0.5, 5e3), ratio=st.floats(0.02, 0.3))
def test_small_vibrations_of_a_loaded_contact_decay_as_the_docstring_has_it(
    depth: float, n: float, mass: float, ratio: float
) -> None:
    """Two following largest depths have the ratio exp(2 pi zeta / sqrt(1 - zeta^2)), by scipy."""
    law = power_law(Exact, exponent=n)
    load = law.elastic_force(depth)
    frequency = math.sqrt(n * load / depth / mass)
    rest = law.damping_factor * frequency * depth / (2.0 * n * ratio)
    law, amplitude = power_law(Exact, exponent=n, rest_velocity=rest), 1e-5 * depth

    def motion(_: float, y: np.ndarray) -> list[float]:
        force = law(depth + amplitude * y[0], amplitude * y[1] * frequency, 0.0)
        return [y[1], (load - force) / (mass * amplitude * frequency**2)]

    def turning(_: float, y: np.ndarray) -> float:
        return float(y[1])

    turning.direction = -1.0  # type: ignore[attr-defined]
    found = solve_ivp(motion, (0.0, 20.0), [0.0, 1.0], "DOP853", events=turning, rtol=1e-9, atol=1e-11)
    first, second = (float(y[0]) for y in found.y_events[0][:2])
    decrement = math.log(first / second)
    # swings of 1e-5 of the depth are unequal by about as much, against a logarithm of 0.1 or more
    assert decrement / math.hypot(2.0 * math.pi, decrement) == pytest.approx(ratio, rel=1e-3)
