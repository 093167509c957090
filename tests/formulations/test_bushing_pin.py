"""A linear bushing as a third kind of pin: closed forms, energies, and what a new kind asks of the package."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    Body,
    BushingPin,
    Linkage,
    Machine,
    PinPlace,
    Scenario,
    Steady,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.timescales import timescales
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


def test_space_refuses_it() -> None:
    scene = Scenario(machine=reference_support(), pins={"rear_base": BUSHING}, duration=0.1)
    assert all(formulation(name).covers(scene) for name in ("exudyn", "compiled"))
    said = r"pins\.rear_base = BushingPin: is planar; allowed in space: IdealPin, ClearancePin"
    with pytest.raises(InputError, match=said):
        simulate(replace(scene, dimensions=3))
