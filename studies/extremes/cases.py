"""All cases of the study: grids for the maps, the box, and random corners of every kind."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from studies.extremes import hydraulics, scenes
from studies.extremes.drawn_legs import Leg, drawn_drive, drawn_leg, drawn_pump
from studies.extremes.judge import Case
from studies.extremes.ranges import SPANS, Point, drawn
from support_exudyn import Held, HydraulicCylinder, Scenario
from support_exudyn.formulations.registry import FormulationName
from support_exudyn.scenario.scenario_data import Accuracy

SEED = 20261122
ACCURACIES: tuple[Accuracy, ...] = ("draft", "standard", "reference")
STEP_STIFFNESS, CLEARANCE_SPEED, FRICTION_STEP = (
    "step and stiffness",
    "clearance and speed",
    "friction and step",
)
MAPS = (STEP_STIFFNESS, CLEARANCE_SPEED, FRICTION_STEP)
BOX = "box"
HYDRAULICS = "hydraulics"
RECORDS = 500  # of a stroke
PACE = 0.5
STROKE = 0.05  # [m]
FORMULATIONS: tuple[FormulationName, ...] = ("compiled", "exudyn")
STARTS = ("concentric", "closed", "overlapping", "settled")
BODIES = ("rear_link", "front_link", "shield", "canopy")
GRIDS = {STEP_STIFFNESS: 13, CLEARANCE_SPEED: 12, FRICTION_STEP: 13}  # lines and columns
# in which proportions kinds are drawn: each gets its part of whatever number
RANDOM = {
    "corners": 560,
    BOX: 520,
    "slider-crank": 140,
    "free impact": 80,
    "start": 60,
    "solver": 60,
    "mass ratio": 50,
    "posture": 70,
    "dead centre": 30,
    "all pins": 30,
    "no gravity": 30,
    "hang-up": 30,
    "roof": 40,
    "columns": 20,
    "space": 16,
    HYDRAULICS: 1400,
}
DRAWN = 447  # by default, a seventh of these


def cases(number: int = DRAWN) -> list[Case]:
    """All of them: those of the maps, and about so many drawn ones, at least one of every kind.

    A larger number draws those of a smaller one and others: each scene has random numbers of its own.
    """
    share = number / sum(RANDOM.values())
    drawn_ones = (
        _random(group, i, np.random.default_rng([SEED, n, i]))
        for n, (group, part) in enumerate(RANDOM.items())
        for i in range(max(1, round(share * part)))
    )
    return [*mapped(), *drawn_ones]


def mapped() -> Iterator[Case]:
    """The scenes of the maps."""
    size = GRIDS[STEP_STIFFNESS]
    for step in _axis("step_s", size):
        for stiffness in _axis("stiffness", size):
            point = Point(step_s=step, stiffness=stiffness, pace=PACE)
            values = {"step_s": step, "stiffness": stiffness}
            yield _case(STEP_STIFFNESS, values, partial(scenes.fallen, point), False)
    size = GRIDS[CLEARANCE_SPEED]
    for clearance in _axis("clearance_m", size):
        for time in np.geomspace(0.05, 100.0, size).tolist():
            point = Point(clearance_m=clearance)
            values = {"clearance_m": clearance, "speed_m_s": STROKE / time}
            make = partial(scenes.stroke_of, point, time, STROKE, "standard", RECORDS)
            yield _case(CLEARANCE_SPEED, values, make, False)
    size = GRIDS[FRICTION_STEP]
    for static in np.geomspace(1e-7, 5e-2, size).tolist():
        for step in _axis("step_s", size):
            rubbing = {"static_speed_m_s": static, "dynamic_speed_m_s": 2.0 * static}
            point = Point(step_s=step, mu=0.25, pace=PACE, **rubbing)
            values = {"static_speed_m_s": static, "step_s": step}
            yield _case(FRICTION_STEP, values, partial(scenes.fallen, point), False)


def _axis(name: str, size: int) -> list[float]:
    span = SPANS[name]
    values: list[float] = np.geomspace(span.low, span.high, size).tolist()
    return values


def _case(group: str, values: Mapping[str, float | str], make: Callable[[], Scenario], box: bool) -> Case:
    said = ", ".join(
        f"{name} {value:.3g}" if isinstance(value, float) else str(value) for name, value in values.items()
    )
    return Case(f"{group}: {said}", group, box, make, values)


def _random(group: str, i: int, random: np.random.Generator) -> Case:
    """A random case of a group."""
    box = group == BOX
    point = replace(drawn(random, box), pace=PACE)
    if group != "corners":  # tiny steps are tried there and in the maps; they take long
        point = replace(point, step_s=max(point.step_s, 5e-5))
    values: dict[str, float | str] = {"number": float(i)}
    values |= {name: getattr(point, name) for name in SPANS if hasattr(point, name)}
    values |= {"law": point.law, "dynamic_speed_m_s": point.dynamic_speed_m_s, "bore": point.bore}
    more, make = _KINDS[group](point, i, random)
    return _case(group, values | more, make, box)


Made = tuple[dict[str, float | str], Callable[[], Scenario]]


def _corner(point: Point, i: int, random: np.random.Generator) -> Made:
    edge = i % 10
    if edge == 0:
        point = replace(point, static_speed_m_s=0.0)
    elif edge == 1:
        point = replace(point, mu=max(point.mu, 0.1), static_speed_m_s=point.dynamic_speed_m_s)  # v_s = v_d
    return {"static": point.static_speed_m_s}, partial(scenes.fallen, point)


def _boxed(point: Point, i: int, random: np.random.Generator) -> Made:
    accuracy = ACCURACIES[i % 3]
    drive = Held() if i % 2 else scenes.gentle(point)
    return {"accuracy": accuracy}, partial(scenes.boxed, point, accuracy, drive)


def _cranked(point: Point, i: int, random: np.random.Generator) -> Made:
    rpm = float(10.0 ** random.uniform(1.0, 4.0))
    accuracy = (*ACCURACIES, None)[i % 4]
    return {"rpm": rpm, "accuracy": str(accuracy)}, partial(scenes.cranked, point, rpm, accuracy)


def _colliding(point: Point, i: int, random: np.random.Generator) -> Made:
    ratio, speed = float(10.0 ** random.uniform(-4.0, 4.0)), float(10.0 ** random.uniform(-4.0, 1.0))
    point = replace(point, mu=0.0)
    return {"mu": 0.0, "mass_ratio": ratio, "speed": speed}, partial(scenes.colliding, point, ratio, speed)


def _started(point: Point, i: int, random: np.random.Generator) -> Made:
    start = STARTS[i % len(STARTS)]
    return {"start": start}, partial(scenes.started, point, start)


def _with_solver(point: Point, i: int, random: np.random.Generator) -> Made:
    point = replace(point, spectral_radius=(0.0, 0.5, 1.0, point.spectral_radius)[i % 4])
    settings: scenes.OtherSettings = {
        "newton": "full" if i % 2 else "modified",
        "growth": (1.0, 8.0, 64.0)[i % 3],
    }
    said: dict[str, float | str] = {name: str(value) for name, value in settings.items()}
    said["spectral_radius"] = point.spectral_radius
    make = scenes.on_oil if i % 2 else scenes.with_solver
    return said, partial(make, point, **settings)


def _of_masses(point: Point, i: int, random: np.random.Generator) -> Made:
    body, factor = BODIES[i % 4], float(10.0 ** random.uniform(-4.0, 4.0))
    return {"body": body, "factor": factor}, partial(scenes.of_masses, point, body, factor)


def _of_posture(point: Point, i: int, random: np.random.Generator) -> Made:
    height, stroke = float(random.uniform(1.0, 3.6)), float(random.uniform(-1.0, 1.5))
    with_clearance = bool(i % 2)
    more: dict[str, float | str] = {
        "height_m": height,
        "stroke_m": stroke,
        "with_clearance": str(with_clearance),
    }
    return more, partial(scenes.of_posture, point, height, stroke, with_clearance)


def _past_dead_centre(point: Point, i: int, random: np.random.Generator) -> Made:
    share = 1.0 - float(10.0 ** random.uniform(-6.0, -0.5))
    return {"share": share}, partial(scenes.past_dead_centre, point, share)


def _everywhere(point: Point, i: int, random: np.random.Generator) -> Made:
    return {"friction": str(bool(i % 2))}, partial(scenes.everywhere, point, bool(i % 2))


def _weightless(point: Point, i: int, random: np.random.Generator) -> Made:
    return {}, partial(scenes.weightless, point)


def _hung_up(point: Point, i: int, random: np.random.Generator) -> Made:
    angle = scenes.rest_angle(random)
    mu = max(point.mu, 0.5)
    return {"mu": mu, "angle": angle}, partial(scenes.hung_up, replace(point, mu=mu), angle)


def _under_roof(point: Point, i: int, random: np.random.Generator) -> Made:
    force, stiffness = float(10.0 ** random.uniform(4.0, 7.0)), float(10.0 ** random.uniform(7.0, 10.0))
    more: dict[str, float | str] = {"force_N": force, "roof_N_m": stiffness}
    return more, partial(scenes.under_roof, point, force, stiffness, bool(i % 2))


def _heavy(point: Point, i: int, random: np.random.Generator) -> Made:
    return {}, partial(scenes.heavy_columns, point)


def _in_space(point: Point, i: int, random: np.random.Generator) -> Made:
    return {}, partial(scenes.in_space, point)


def _on_legs(point: Point, i: int, random: np.random.Generator) -> Made:
    """Machines by turns, each on columns, on cylinders and on both, and by turns in both formulations."""
    name = [*hydraulics.MACHINES][i % len(hydraulics.MACHINES)]
    legs: dict[str, Leg] = {
        leg: drawn_leg(random, load, length) for leg, (load, length) in hydraulics.loads_of(name).items()
    }
    cylinders = [leg for leg in legs.values() if isinstance(leg, HydraulicCylinder)]
    pumped = bool(cylinders) and random.uniform() < 0.4
    pump = drawn_pump(random, cylinders[0].system_pressure) if pumped else None
    drive = drawn_drive(random) if len(cylinders) < len(legs) else Held()
    loose, formulation = random.uniform() < 0.4, FORMULATIONS[i // len(hydraulics.MACHINES) % 2]
    roof = float(10.0 ** random.uniform(-1.0, 1.5)) if random.uniform() < 0.5 else 0.0
    elements = "; ".join(f"{leg}: {', '.join(model.elements)}" for leg, model in legs.items())
    more: dict[str, float | str] = {"machine": name, "elements": elements, "pump": str(pumped), "roof": roof}
    make = partial(hydraulics.on_legs, point, name, legs, pump, drive, loose, roof, formulation)
    return more | {"formulation": formulation}, make


_KINDS: dict[str, Callable[[Point, int, np.random.Generator], Made]] = {
    "corners": _corner,
    BOX: _boxed,
    "slider-crank": _cranked,
    "free impact": _colliding,
    "start": _started,
    "solver": _with_solver,
    "mass ratio": _of_masses,
    "posture": _of_posture,
    "dead centre": _past_dead_centre,
    "all pins": _everywhere,
    "no gravity": _weightless,
    "hang-up": _hung_up,
    "roof": _under_roof,
    "columns": _heavy,
    "space": _in_space,
    HYDRAULICS: _on_legs,
}
