"""A linear bushing as a third kind of pin: closed forms, energies, and what a new kind asks of the package."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import support_exudyn
from support_exudyn import (
    Body,
    BushingPin,
    IdealPin,
    Linkage,
    Machine,
    PinPlace,
    Scenario,
    SolverSettings,
    Steady,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.files.scenarios.scenario_file import read_scenario
from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.timescales import timescales
from tests.cases.run_cases import support
from tests.linkage_cases import LENGTHS, MASSES, CrankRocker, closed, rates
from user_forces.values.value import InputError, Vector2, value

MASS, INERTIA, ARM = 3.0, 0.2, 0.25
BUSHING = BushingPin(
    stiffness=(2e4, 5e4), damping=(40.0, 25.0), rotational_stiffness=300.0, rotational_damping=0.8
)


@value
class Block(Machine):
    """One body on one pin at the ground, an arm from its centre of mass, with velocities at the start."""

    arm: float = 0.0
    velocity: Vector2 = (0.0, 0.0)
    spin: float = 0.0

    def linkage(self) -> Linkage:
        """The block at the start."""
        body = Body(mass=MASS, inertia=INERTIA, centre=(self.arm, 0.0), velocity=self.velocity, spin=self.spin)
        place = PinPlace(first="ground", second="block", first_point=(0.0, 0.0), second_point=(0.0, 0.0))
        return Linkage(bodies={"block": body}, pins={"mount": place})


def on_bushing(machine: Block, **given: object) -> Scenario:
    """A block on the bushing."""
    usual = {"duration": 0.2, "step": 1e-4, "record_period": 1e-3, "gravity": (0.0, 0.0)}
    return Scenario(machine=machine, pins={"mount": BUSHING}, **(usual | given))  # type: ignore[arg-type]


def decay(start: float, mass: float, stiffness: float, damping: float, t: np.ndarray) -> np.ndarray:
    """The damped vibration that begins in the middle at a speed."""
    fast, slow = np.sqrt(stiffness / mass), 0.5 * damping / mass
    damped = np.sqrt(fast**2 - slow**2)
    return np.asarray(start / damped * np.exp(-slow * t) * np.sin(damped * t))


def test_at_rest_it_gives_way_by_the_weight_over_the_stiffness() -> None:
    result = simulate(on_bushing(Block(arm=ARM), start="settled", gravity=(2.0, -9.81), duration=0.01))
    fx, fy = 2.0 * MASS, -9.81 * MASS
    angle = result["pin.mount.angle"][0]
    # the arm has turned, by which the weights have a moment about the pin
    assert 300.0 * angle == pytest.approx(ARM * (np.cos(angle) * fy - np.sin(angle) * fx), rel=1e-9)
    assert result["pin.mount.deflection_x"][0] == pytest.approx(fx / 2e4, rel=1e-9)
    assert result["pin.mount.deflection_y"][0] == pytest.approx(fy / 5e4, rel=1e-9)
    for name, size in {"force_x": -fx, "force_y": -fy, "force": np.hypot(fx, fy)}.items():
        assert result[f"pin.mount.{name}"] == pytest.approx(size, rel=1e-6)  # and it stays there
    assert result["pin.mount.moment"][0] == pytest.approx(-300.0 * angle, rel=1e-9)
    assert result["pin.mount.deflection"][0] == pytest.approx(np.hypot(fx / 2e4, fy / 5e4), rel=1e-9)


@pytest.mark.parametrize(
    ("machine", "channel", "closed"),
    [
        (Block(velocity=(0.3, 0.0)), "deflection_x", (0.3, MASS, 2e4, 40.0)),
        (Block(velocity=(0.0, 0.3)), "deflection_y", (0.3, MASS, 5e4, 25.0)),
        (Block(spin=2.0), "angle", (2.0, INERTIA, 300.0, 0.8)),
    ],
)
def test_it_swings_at_its_frequency_and_dies_away(
    machine: Block, channel: str, closed: tuple[float, float, float, float]
) -> None:
    result = simulate(on_bushing(machine))
    wanted = decay(*closed, result.time)
    assert result[f"pin.mount.{channel}"] == pytest.approx(wanted, abs=4e-4 * np.abs(wanted).max())
    _, mass, stiffness, _ = closed
    # what steps have to follow
    assert timescales(on_bushing(Block())).resting == pytest.approx(
        min(np.sqrt(MASS / 5e4), np.sqrt(INERTIA / 300.0)), rel=1e-9
    )
    assert timescales(on_bushing(machine)).resting <= np.sqrt(mass / stiffness) * (1.0 + 1e-9)


def test_energies_add_up() -> None:
    machine = Block(arm=ARM, velocity=(0.4, -0.7), spin=5.0)
    result = simulate(on_bushing(machine, gravity=(0.0, -9.81)))
    lost, most = result["energy.damping_loss"], result["energy.kinetic"][0]
    assert np.all(np.diff(lost) > 0.0)
    assert lost[-1] > 0.5 * most
    assert np.abs(result["energy.balance"]).max() < 1e-4 * most
    stored = 0.5 * (2e4 * result["pin.mount.deflection_x"] ** 2 + 5e4 * result["pin.mount.deflection_y"] ** 2)
    stored += 0.5 * 300.0 * result["pin.mount.angle"] ** 2
    assert result["energy.elastic"] == pytest.approx(stored, rel=1e-12, abs=1e-12)


def test_the_force_moves_the_block() -> None:
    result = simulate(on_bushing(Block(arm=ARM, velocity=(0.4, -0.7), spin=5.0)))
    h = result.time[1] - result.time[0]
    for axis in "xy":
        slope = np.gradient(result[f"block.velocity_{axis}"], h)[1:-1]
        assert MASS * slope == pytest.approx(result[f"pin.mount.force_{axis}"][1:-1], abs=4.0)
    assert np.isfinite(result["block.angular_acceleration"]).all()


def test_a_stiff_one_tends_to_the_ideal_pin() -> None:
    scene = support(duration=0.2)
    (pin,) = [name for name in scene.linkage.pins if name == "rear_base"]
    ideal = simulate(replace(scene, pins={}))[f"pin.{pin}.force"]
    off = []
    for stiffness in (1e9, 1e10):
        bushing = BushingPin(stiffness=(stiffness, stiffness), damping=(1e-3 * stiffness, 1e-3 * stiffness))
        settings = SolverSettings(growth=1.0)
        found = simulate(replace(scene, pins={pin: bushing}, start="settled", solver=settings))
        off.append(np.abs(found[f"pin.{pin}.force"] - ideal)[-1] / ideal[-1])
    assert off[0] < 1e-2
    assert off[1] < 0.2 * off[0] or off[1] < 1e-5


def test_both_bodies_may_move() -> None:
    crank = ravn_slider_crank()
    pins = crank.linkage().pins.items()
    name = next(name for name, place in pins if "ground" not in (place.first, place.second))
    scene = Scenario(
        machine=crank,
        pins={name: BushingPin(stiffness=(1e8, 1e8), damping=(2e3, 2e3))},
        drive=Steady(rate=20.0),
        duration=0.1,
        step=2e-5,
        record_period=1e-3,
        gravity=(0.0, 0.0),
    )
    found, ideal = simulate(scene), simulate(replace(scene, pins={}))
    late = found.time > 0.05
    for pin in crank.linkage().pins:  # those beside it follow from the forces that it has on both bodies
        force, wanted = found[f"pin.{pin}.force"][late], ideal[f"pin.{pin}.force"][late]
        assert force == pytest.approx(wanted, abs=0.02 * wanted.max()), pin
    assert np.abs(found["energy.balance"]).max() < 1e-3 * np.abs(found["energy.kinetic"]).max()


def test_a_file_says_it(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(
        'machine = "reference"\nduration_s = 1.0\n[pins.rear_base]\ntype = "BushingPin"\n'
        "stiffness_kN_per_mm = [50.0, 80.0]\ndamping_N_s_per_m = [1e4, 2e4]\n"
        "rotational_stiffness_N_m_per_rad = 9.0\n"
    )
    pin = read_scenario(file).pins["rear_base"]
    assert pin == BushingPin(stiffness=(5e7, 8e7), damping=(1e4, 2e4), rotational_stiffness=9.0)


def test_space_refuses_it() -> None:
    scene = Scenario(machine=reference_support(), pins={"rear_base": BUSHING}, duration=0.1)
    assert all(formulation(name).covers(scene) for name in ("exudyn", "compiled"))
    said = r"pins\.rear_base = BushingPin: is planar; allowed in space: IdealPin, ClearancePin"
    with pytest.raises(InputError, match=said):
        simulate(replace(scene, dimensions=3))


def test_a_stiffness_is_positive() -> None:
    with pytest.raises(InputError, match="stiffness"):
        BushingPin(stiffness=(1e6, 0.0))


def test_no_stage_asks_which_kind_a_pin_is() -> None:
    # but for the list of those that have contacts, and of those that rub; and of the bushings among the records
    root = Path(support_exudyn.__file__).parent
    asks = [file for file in root.rglob("*.py") if "isinstance(pin, " in file.read_text()]
    assert {file.relative_to(root).as_posix() for file in asks} <= {
        "scenario/scenario_data.py",
        "postprocessing/summary.py",
        "formulations/compiled/setup.py",
        "formulations/compiled/outcome.py",
    }
    assert IdealPin().holds


def test_a_crank_rocker_with_a_bushing_moves_as_its_equations() -> None:
    # the crank is driven; the coupler hangs on it, the rocker on the ground, the bushing joins both
    a, b, c, d = LENGTHS
    _, coupler_mass, rocker_mass = MASSES
    speed, stiffness, damping, turning, twisting = 30.0, 2e5, 150.0, 40.0, 0.5
    pin = BushingPin(
        stiffness=(stiffness, 2.0 * stiffness),
        damping=(damping, damping),
        rotational_stiffness=turning,
        rotational_damping=twisting,
    )
    machine = CrankRocker(angle=0.4, driven=True)
    scene = Scenario(
        machine=machine, pins={"B": pin}, drive=Steady(rate=speed), duration=0.1, step=1e-5, record_period=1e-3
    )
    first = np.array(closed(0.4))

    def slope(t: float, state: np.ndarray) -> np.ndarray:
        (one, two), (spin, other) = state[:2], state[2:]
        crank = 0.4 + speed * t
        out = [np.array([np.cos(angle), np.sin(angle)]) for angle in (crank, one, two)]
        across = [np.array([-along[1], along[0]]) for along in out]
        apart = np.array([d, 0.0]) + c * out[2] - a * out[0] - b * out[1]
        rate = c * other * across[2] - a * speed * across[0] - b * spin * across[1]
        force = -np.array(pin.stiffness) * apart - np.array(pin.damping) * rate  # on the rocker
        moment = -turning * ((two - first[1]) - (one - first[0])) - twisting * (other - spin)
        down = np.array([0.0, -9.81])
        pull = coupler_mass * (down + a * speed**2 * out[0])  # seen from the crank's end
        coupler = 0.5 * b * across[1] @ pull - b * across[1] @ force - moment
        rocker = 0.5 * c * across[2] @ down * rocker_mass + c * across[2] @ force + moment
        return np.array([spin, other, 3 * coupler / (coupler_mass * b**2), 3 * rocker / (rocker_mass * c**2)])

    start = [*first, *(speed * rate for rate in rates(0.4))]
    times = np.arange(101) * 1e-3
    known = solve_ivp(slope, (0.0, 0.1), start, method="DOP853", rtol=1e-11, atol=1e-12, t_eval=times).y
    result = simulate(scene)
    assert result["coupler.angle"] == pytest.approx(known[0], abs=2e-7)
    assert result["rocker.angle"] == pytest.approx(known[1], abs=2e-7)
    assert result["pin.B.deflection"].max() > 1e-4  # it does give way
