"""What is written for ADAMS, read back: parts, joints, expressions, and the equations that they state."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from studies.__main__ import main
from studies.adams.dataset import adams_dataset
from studies.adams.run import paper_rise, write
from studies.common.paper_machine import ideal_rise, oil_columns
from support_exudyn import (
    AppliedForce,
    ClearancePin,
    CubicStep,
    Result,
    Scenario,
    Steady,
    ravn_slider_crank,
    read_scenario,
    simulate,
)
from support_exudyn.__main__ import main as support_exudyn_main
from support_exudyn.model.linkage import GROUND
from tests.cases.adams_model import Dataset, Motion, PlanarModel, evaluated, read_dataset
from user_forces import Frictionless
from user_forces.values.value import InputError

PIN = "rear_base"
RISE = paper_rise()
MOVING = replace(RISE, drive=CubicStep(stroke=0.05, start=0.02, end=0.12), duration=0.12, record_period=1e-3)
FREEDOMS = {"REVOLUTE": 5, "TRANSLATIONAL": 5, "PLANAR": 3, "INLINE": 2}  # that a joint takes


def data_of(scenario: Scenario) -> Dataset:
    return read_dataset(adams_dataset(scenario, "model").text)


READ = data_of(RISE)


# --- what the statements say ---


def test_parts_are_the_bodies_of_the_scenario() -> None:
    model = PlanarModel(READ)
    named = dict(zip(RISE.linkage.bodies, model.parts, strict=False))
    for name, body in RISE.linkage.bodies.items():
        part = READ["PART", named[name]]
        assert float(part.arguments["MASS"]) == body.mass
        assert part.numbers("IP")[2] == body.inertia
        assert sum(part.numbers("IP")[:2]) == part.numbers("IP")[2]  # as of a flat body
        assert tuple(part.numbers("QG")) == (*body.centre, 0.0)
        centre = READ["MARKER", part.id("CM")]
        assert (centre.id("PART"), centre.numbers("QP")) == (named[name], [0.0, 0.0, 0.0])
    light = [READ["PART", part] for part in model.parts[len(named) :]]
    assert [float(one.arguments["MASS"]) for one in light] == [1e-4] * 4


def taken(data: Dataset) -> int:
    joints = [*data.of("JOINT").values(), *data.of("JPRIM").values()]
    return sum(FREEDOMS[next(iter(one.arguments))] for one in joints) + len(data.of("MOTION"))


@pytest.mark.parametrize(
    ("pins", "freedoms"), [((), 0), (("rear_base",), 2), (("rear_shield", "front_base", "shield_canopy"), 6)]
)
def test_the_degrees_of_freedom_are_those_of_the_machine(pins: tuple[str, ...], freedoms: int) -> None:
    scenario = replace(ideal_rise(1e-3), pins=dict.fromkeys(pins, RISE.pins[PIN]))
    data = data_of(scenario)
    model = PlanarModel(data)
    assert 6 * len(model.parts) - taken(data) == freedoms  # Gruebler
    rows, _, _ = model.constraints(model.start())
    assert np.linalg.matrix_rank(rows) == len(rows) == 3 * len(model.parts) - freedoms  # none repeats another


# --- the contact ---


SPEEDS = st.floats(-2.0, 2.0)


@cache
def loose(bore: str, friction: bool) -> tuple[ClearancePin, Dataset]:
    """The paper's pin, and the dataset with it."""
    pin = replace(RISE.pins[PIN], bore=bore)
    if not friction:
        pin = replace(pin, contact=replace(pin.contact, friction=Frictionless()))
    return pin, data_of(replace(RISE, pins={PIN: pin}))


@given(
    depth=st.floats(-1e-3, 1e-3), angle=st.floats(-4.0, 4.0), vx=SPEEDS, vy=SPEEDS, spin=st.floats(-3.0, 3.0),
    remembered=st.floats(-1.0, 1.0), bore=st.sampled_from(["first", "second"]), friction=st.booleans(),
)  # fmt: skip
def test_the_force_is_that_of_our_laws(
    depth: float, angle: float, vx: float, vy: float, spin: float, remembered: float, bore: str, friction: bool
) -> None:
    pin, data = loose(bore, friction)
    model = PlanarModel(data)
    motion = model.start()
    part = model.parts[0]  # the rear link, whose pin in the ground it is
    size = pin.contact.bearing.clearance + depth
    sign = 1.0 if bore == "first" else -1.0  # the ground has the bore, or the journal
    x, y = size * math.cos(angle), size * math.sin(angle)
    force = next(iter(data.of("GFORCE").values()))
    link = (
        force.id("I") if bore == "first" else int(data["VARIABLE", 1].arguments["FUNCTION"][3:].split(",")[1])
    )
    motion.position[part][:2] += (sign * x, sign * y)
    arm = model.arm(link, motion)
    motion.velocity[part][:] = (sign * vx + spin * arm[1], sign * vy - spin * arm[0], spin)
    motion.remembered = {1: remembered}
    names = model.names(motion)
    spins = (0.0, spin) if bore == "first" else (spin, 0.0)
    here = (names["DX"](*pair(data)), names["DY"](*pair(data)))  # rounded as the markers are
    rate = (names["VX"](*pair(data)), names["VY"](*pair(data)))
    np.testing.assert_allclose([*here, *rate], [x, y, vx, vy], atol=1e-14)
    impact = max(remembered, 0.0)
    exact = pin.contact.force(*here, *rate, *spins, impact)
    found = [evaluated(force.arguments[one], names) for one in ("FX", "FY", "TZ")]
    wanted = [exact.force_x, exact.force_y, exact.journal_moment]
    np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-12 * (1.0 + exact.normal_force))
    slip = evaluated(data.named[f"{PIN}_slip_variable"].arguments["FUNCTION"], names)
    assert slip == pytest.approx(exact.slip, rel=1e-12, abs=1e-12)
    follows = evaluated(data["DIFF", 1].arguments["FUNCTION"], names)
    assert follows == (
        0.0 if exact.depth >= 0.0 else pytest.approx((exact.rate - remembered) / 1e-5, rel=1e-12)
    )


def pair(data: Dataset) -> list[int]:
    return [int(one) for one in data["VARIABLE", 1].arguments["FUNCTION"][3:-1].split(",")]


# --- the equations ---


def moving(model: PlanarModel, result: Result, n: int) -> Motion:
    """The parts as they are at a record of a run; those of columns as the columns' ends are."""
    linkage, motion = result.scenario.linkage, model.start()
    parts = dict(zip(linkage.bodies, model.parts, strict=False))
    for name, body in linkage.bodies.items():
        at, rate = motion.position[parts[name]], motion.velocity[parts[name]]
        at[:] = [result[f"{name}.x"][n], result[f"{name}.y"][n], result[f"{name}.angle"][n] - body.angle]
        rate[:] = [result[f"{name}.{one}"][n] for one in ("velocity_x", "velocity_y", "angular_velocity")]
    heads = [
        one.id("I") for one in model.data.of("JPRIM").values() if model.part_of(one.id("I")) in parts.values()
    ]
    pairs = zip(model.parts[len(parts) :: 2], model.parts[len(parts) + 1 :: 2], strict=True)
    columns = list(zip(linkage.actuators.items(), pairs, strict=True))
    for (_, actuator), (cylinder, rod) in columns:
        assert actuator.foot == GROUND
        head = next(one for one in heads if np.allclose(
            model.at(one, model.start()), actuator.head_point, atol=1e-12))  # fmt: skip
        way = model.at(head, motion) - actuator.foot_point
        turn = math.atan2(way[1], way[0]) - math.atan2(
            *np.subtract(actuator.head_point, actuator.foot_point)[::-1]
        )
        speed = model.speed(head, motion)
        spin = (way[0] * speed[1] - way[1] * speed[0]) / (way @ way)
        motion.position[cylinder][2] = turn
        motion.velocity[cylinder][2] = spin
        motion.position[rod][:] = [*model.at(head, motion), turn]
        motion.velocity[rod][:] = [*speed, spin]
    motion.time = float(result.time[n])
    motion.remembered = {
        one: float(result[f"pin.{name}.impact_velocity"][n])
        for one, name in enumerate(result.scenario.clearance_pins, 1)
    }
    return motion


@pytest.fixture(scope="module")
def run() -> Result:
    return simulate(MOVING)


def test_the_equations_are_those_of_our_runs(run: Result) -> None:
    dataset = adams_dataset(MOVING, "model")
    model = PlanarModel(read_dataset(dataset.text))
    entities = {one.arguments["RESULTS_NAME"]: one for one in model.data.of("REQUEST").values()}
    pressed = run[f"pin.{PIN}.depth"] > 0.0
    looked_at = [5, 30, 50, *np.flatnonzero(pressed)[::12], 100, 110]
    assert pressed[looked_at].any()
    assert not pressed[looked_at].all()
    for n in looked_at:
        motion = moving(model, run, n)
        accelerations, reactions = model.solved(motion)
        for name, part in zip(run.scenario.linkage.bodies, model.parts, strict=False):
            wanted = run[f"{name}.angular_acceleration"][n]
            assert accelerations[part][2] == pytest.approx(wanted, abs=2e-5, rel=2e-5), (name, n)
        names = model.names(motion, reactions)
        for channel, column in dataset.columns.items():
            entity, component = column.split(".")
            place = entities[entity].words("CNAMES").index(component) + 1
            found = evaluated(entities[entity].arguments[f"F{place}"], names)
            scale = np.abs(run[channel]).max()
            assert found == pytest.approx(run[channel][n], rel=1e-5, abs=2e-6 * scale), (channel, n)


@pytest.mark.slow
def test_solved_by_another_solver_it_falls_and_hits_as_our_run() -> None:
    model = PlanarModel(READ)
    size, start = 3 * len(model.parts), model.start()

    def motion_of(t: float, state: np.ndarray) -> Motion:
        at, rate = dict(start.position), dict(start.velocity)
        for part, n in model.place.items():
            at[part], rate[part] = state[n : n + 3], state[size + n : size + n + 3]
        return Motion(at, rate, t, {1: float(state[-1])})

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        motion = motion_of(t, state)
        accelerations, _ = model.solved(motion)
        follows = evaluated(READ["DIFF", 1].arguments["FUNCTION"], model.names(motion))
        return np.concatenate([state[size:-1], *(accelerations[part] for part in model.parts), [follows]])

    first = np.concatenate([*(start.position[part] for part in model.parts), np.zeros(size + 1)])
    held = simulate(replace(RISE, duration=0.05, accuracy="reference"))
    found = solve_ivp(
        rates, (0.0, 0.05), first, method="LSODA", rtol=1e-9, atol=1e-10, t_eval=held.time, max_step=1e-3
    )
    assert (held[f"pin.{PIN}.depth"] > 1e-4).any()
    for n, t in enumerate(held.time):
        names = model.names(motion_of(t, found.y[:, n]))
        for axis, value in (("x", "VARVAL(1)"), ("y", "VARVAL(2)")):
            assert evaluated(value, names) == pytest.approx(held[f"pin.{PIN}.eccentricity_{axis}"][n], abs=2e-7)
    forces = [
        evaluated("VARVAL(17)", model.names(motion_of(t, found.y[:, n]))) for n, t in enumerate(held.time)
    ]
    assert max(forces) == pytest.approx(held[f"pin.{PIN}.normal_force"].max(), rel=1e-3)


def res_of(run: Result, columns: dict[str, str], data: Dataset, factor: float) -> str:
    """A run as ADAMS writes it, by the names and kinds of unit that the requests give, in mm and kN.

    factor: of all forces.
    """
    channels = {column: run[channel] for channel, column in columns.items()}
    units = {"length": ("mm", 1e3), "force": ("knewton", 1e-3 * factor), "angle": ("deg", 180.0 / math.pi)}
    entities, values = (
        ['<Entity name="time"><Component name="TIME" unitsValue="ms" id="1"/></Entity>'],
        [1e3 * run.time],
    )
    for request in data.of("REQUEST").values():
        name, components = request.arguments["RESULTS_NAME"], ""
        for component, kind in zip(request.words("CNAMES"), request.words("CUNITS"), strict=True):
            if component:
                unit, scale = units[kind]
                values.append(scale * channels[f"{name}.{component}"])
                components += f'<Component name="{component}" unitsValue="{unit}" id="{len(values)}"/>'
        entities.append(f'<Entity name="{name}">{components}</Entity>')
    steps = "".join(
        f'<Step type="dynamic">{" ".join(map(repr, row.tolist()))}</Step>' for row in np.array(values).T
    )
    inside = f"<StepMap>{''.join(entities)}</StepMap><Data>{steps}</Data>"
    return f'<Results><Analysis name="a">{inside}</Analysis></Results>'


@pytest.mark.parametrize(("factor", "code"), [(1.0, 0), (1.05, 1)])
def test_results_as_adams_writes_them_are_compared_by_the_mapping(
    factor: float, code: int, run: Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(MOVING, "rise", tmp_path)
    run.save(tmp_path / "rise.h5")
    columns = dict(adams_dataset(MOVING, "rise").columns)
    (tmp_path / "rise.res").write_text(res_of(run, columns, data_of(MOVING), factor), "utf-8")
    files = [str(tmp_path / "rise.h5"), str(tmp_path / "rise.res")]
    words = ["--map", str(tmp_path / "compare.toml"), "--tolerance", "*=1%", "--json"]
    with pytest.raises(SystemExit) as ended:
        raise SystemExit(support_exudyn_main(["compare", *files, *words]) or 0)
    assert ended.value.code == code
    told = capsys.readouterr().out
    assert all(f'"{channel}"' in told for channel in columns)


# --- the command, and what is refused ---


def test_the_command_writes_files_that_both_programs_take(tmp_path: Path) -> None:
    assert main(["adams", "--out", str(tmp_path)]) == 0
    assert {path.name for path in tmp_path.iterdir()} >= {"rise.adm", "rise.acf", "rise.toml", "compare.toml"}
    assert read_dataset((tmp_path / "rise.adm").read_text()) == READ
    assert read_scenario(tmp_path / "rise.toml") == RISE
    assert "NOT RUN" in (tmp_path / "rise.adm").read_text()
    ours = tmp_path / "ours" / "rise.toml"
    ours.parent.mkdir()
    text = f"# ours\n{(tmp_path / 'rise.toml').read_text()}"
    ours.write_text(text)
    assert main(["adams", str(ours), "--out", str(ours.parent)]) == 0
    assert (ours.parent / "rise.adm").read_text() == (tmp_path / "rise.adm").read_text()
    assert ours.read_text() == text


LOAD = AppliedForce(body="canopy", point=(1.0, 2.0), full_force=(0.0, -1e3))


@pytest.mark.parametrize(
    ("scenario", "said"),
    [
        (replace(RISE, actuators=oil_columns()), "actuators.front_column = OilColumn: allowed: RigidActuator"),
        (replace(RISE, loads={"weight": LOAD}), "loads.weight: allowed: none"),
        (replace(RISE, start="settled"), "start = 'settled'"),
        (replace(RISE, dimensions=3), "dimensions = 3: allowed: 2"),
        (replace(RISE, drive=Steady(rate=0.01)), "drives.front_column = Steady: allowed: CubicStep"),
        (Scenario(machine=ravn_slider_crank(), duration=1.0), "cranks.crank: allowed"),
        (
            replace(RISE, pins={PIN: ClearancePin.simple(clearance=1e-3, bore_radius=0.06, length=0.5)}),
            "contact.normal = PinInBore: allowed: LankaraniNikravesh",
        ),
    ],
)  # fmt: skip
def test_what_has_no_statements_is_refused(scenario: Scenario, said: str) -> None:
    with pytest.raises(InputError, match=said.replace("(", r"\(")):
        adams_dataset(scenario, "model")
