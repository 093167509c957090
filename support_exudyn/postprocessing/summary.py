"""What a run was and what came out of it, as tables that a terminal, a notebook and a page show alike."""

import dataclasses
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from support_exudyn.files.own_modules import with_known_laws
from support_exudyn.formulations.registry import CHEAPEST_FIRST, formulation
from support_exudyn.machines.check.freedoms import shared
from support_exudyn.model.pins import ClearancePin, Pin
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.figures.units import amount, readable
from support_exudyn.postprocessing.joint_tables import (
    contact_lines,
    hardest_pressed,
    leg_table,
    pressure_table,
    stability_data,
    stability_table,
)
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.postprocessing.shown_numbers import (
    DIGITS,
    LARGEST,
    hardest_first,
    label,
    numbers,
    shown,
    with_error,
)
from support_exudyn.scenario.pin_stability import PinOutlook, pin_outlooks
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.scenario_data import LARGEST_GOAL
from support_exudyn.simulation.estimate import agreed
from support_exudyn.simulation.impulses import impulses_of
from support_exudyn.simulation.provenance import FORMULATION_ASKED
from support_exudyn.simulation.reported_numbers import FORCE
from support_exudyn.simulation.result import Result
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError, Value

Row = tuple[str, ...]
WHOLE = (0.0, math.inf)  # run [s]
IMPACTS = 3  # of every pin that are listed
VERSIONS = ("support-exudyn", "exudyn", "python", "numpy", "scipy", "numba")
ROUNDING = 1e-14  # share of a channel's largest value that is shown as zero

# --- tables of a run ---


def run_tables(result: Result, ends: tuple[float, float] = WHOLE, every: bool = False) -> Iterator[ResultTable]:
    """All tables of a run between two times [s]; every: of all channels, not only of the usual ones."""
    yield ResultTable("what was run", (), what_is_run(result.scenario))
    yield ResultTable("how", (), how(result))
    yield numbers_table(result, ends)
    yield leg_table(result, *ends)
    yield pressure_table("clearance pins under their largest force", hardest_pressed(result))
    yield stability_table(outlooks(result))
    more = any(len(onsets) > IMPACTS for onsets in result.onsets.values())
    title = "first impacts" + (" (all: show RUN --impacts)" if more else "")
    yield impacts_table(title, result)
    names = [name for name in result.channels if name != "time"] if every else telling(result)
    yield channels_table(result, names, ends, len(result.channels) - 1 - len(names))


def numbers_table(result: Result, ends: tuple[float, float] = WHOLE, only: Sequence[str] = ()) -> ResultTable:
    """Numbers of a run between two times [s], with their errors if they are known.

    only: names of those that are shown; without, those of `shown`, and which pin has the largest force.

    Raises InputError if no record lies between.
    """
    every = numbers(result, *ends)
    found = {name: every[name] for name in only} if only else shown([result], [every], *ends)[0]
    rows: list[Row] = [(label(name), *with_error(number)) for name, number in found.items()]
    known = (
        "± estimated numerical error" if result.coarser else "numerical errors not known: no accuracy was asked"
    )
    title = f"{'numbers' if only else 'what came out'}, {selection.window_text(result, *ends)} ({known})"
    return ResultTable(title, ("number", ">value", "unit"), rows)


def impacts_table(
    title: str, result: Result, most: int | None = IMPACTS, ends: tuple[float, float] = WHOLE
) -> ResultTable:
    """Impacts of every clearance pin and every corner in a guide with clearance that begin between two times.

    The force is the largest of the records between onset and separation, "" if none lies there.

    Arguments:
        title: of the table, without what its columns are.
        result: the run.
        most: how many of each pin; None: all.
        ends: the times [s].
    """
    rows: list[Row] = []
    for pin, onsets in result.onsets.items():
        inside = [(n, onset) for n, onset in enumerate(onsets) if ends[0] <= onset.time <= ends[1]]
        if not inside:
            rows.append((pin, "none", "", "", "", "", ""))
        for n, onset in inside[:most]:
            separated = math.isfinite(onset.separation_time)
            lasts = "to the next impact" if n + 1 < len(onsets) else "to the end"
            force = force_of_impact(result, pin, n)
            rows.append((
                pin, f"{n + 1} of {len(onsets)}", amount(onset.time, "s", 6),
                amount(onset.separation_time - onset.time, "s", 4) if separated else lasts,
                amount(onset.speed, "m/s", 5), amount(onset.separation_velocity, "m/s", 5) if separated else "",
                "" if force is None else amount(force, "N", 4),
            ))  # fmt: skip
    header = ("pin", "impact", ">time", ">lasts", ">approach", ">separation", ">force")
    return ResultTable(
        f"{title}, speeds of approach and separation, largest force at the records", header, rows
    )


def channels_table(
    result: Result, names: Iterable[str], ends: tuple[float, float] = WHOLE, rest: int = 0
) -> ResultTable:
    """Channels between two times [s]: unit, least, mean and greatest value with their signs, meaning.

    rest: how many channels more there are.

    Raises InputError if the run does not last between them.
    """
    rows: list[Row] = []
    for name in names:
        found = extent(result, name, *ends)
        values = [found[word] for word in ("min", "mean", "max")]
        size = max(map(abs, values))
        unit = readable(found["unit"], size)
        least, mean, greatest = (
            f"{unit.scale * (value if abs(value) > ROUNDING * size else 0.0):.{DIGITS}g}" for value in values
        )
        if impulses_of(result, name, *ends):
            least = greatest = "impulse"  # which has no finite peak
        rows.append((name, unit.name, least, mean, greatest, found["meaning"]))
    steps = (
        "every step" if result.statistics else f"records every {amount(result.scenario.recorded_every, 's')}"
    )
    more = f" ({rest} more: --all)" if rest else ""
    header = ("channel", "unit", ">min", ">mean", ">max", "meaning")
    return ResultTable(f"channels from {steps}, {selection.window_text(result, *ends)}{more}", header, rows)


def in_short(result: Result) -> list[Row]:
    """Mean, peak, fluctuation and impacts of the clearance joint with the largest force, as names and words.

    Without a clearance joint of the pin with the largest force.
    """
    every = numbers(result, *WHOLE)
    joints, others = hardest_first(every), ""
    forces = {name.removesuffix(".force.largest"): one for name, one in every.items()
              if name.startswith("pin.") and name.endswith(".force.largest")}  # fmt: skip
    if not joints and not forces:
        return [("forces", "none recorded")]
    own = joints[0] if joints else max(forces, key=lambda name: forces[name].value)
    peak = f"{own}{LARGEST}" if joints else f"{own}.force.largest"
    named = ("mean force", f"{own}.force.mean"), ("peak force", peak), ("fluctuation (RMS)", f"{own}.force.std")
    rows = []
    for what, name in named:
        value, unit = with_error(every[name]) if name in every else ("not recorded", "")
        rows.append((f"{own}: {what}", f"{value} {unit}".rstrip()))
    if len(joints) > 1:
        others = f"; smaller forces in {', '.join(joints[1:])}"
    onsets = next((some for pin, some in result.onsets.items() if result.scenario.contact_stem(pin) == own), ())
    impacts = f"{len(onsets)}{others}" if joints else "none, for there is no clearance joint"
    return [*rows, (f"{own}: impacts", impacts)]


# --- for scripts, in SI ---


def facts(result: Result, ends: tuple[float, float] = WHOLE) -> dict[str, Any]:
    """Accuracy, cost and numbers of a run between two times [s]."""
    return {
        "accuracy": {"asked": result.goal, "met": result.met if result.goal is not None else None},
        "counts": dataclasses.asdict(result.counts),
        "wall_time_s": result.wall_time,
        "warnings": list(result.warnings),
        "numbers": {name: number._asdict() for name, number in numbers(result, *ends).items()},
    }


def data(result: Result, channels: Sequence[str], ends: tuple[float, float]) -> dict[str, Any]:
    """All of a run between two times [s]: every number with its error, impacts, and these channels."""
    impacts = {
        pin: [
            {
                "time_s": onset.time,
                "speed_m_per_s": onset.speed,
                "parting_time_s": onset.separation_time,
                "force_at_records_N": force_of_impact(result, pin, n),
            }
            for n, onset in enumerate(onsets)
        ]
        for pin, onsets in result.onsets.items()
    }
    return {
        "scenario": result.scenario.to_data(),
        **facts(result, ends),
        "provenance": dict(result.provenance),
        "impacts": impacts,
        "oil_events": {name: [event._asdict() for event in found] for name, found in result.oil_events.items()},
        "pin_stability": stability_data(outlooks(result)),
        "channels": {name: extent(result, name, *ends) for name in channels},
    }


def extent(result: Result, name: str, after: float, until: float) -> dict[str, Any]:
    """Unit, meaning, and min, mean and max of a channel between two times [s], from every step.

    Raises InputError if the run does not last between them.
    """
    channel = result.channels[name]
    window = result.window(name, after, until)
    extreme = {"min": window.least[0], "mean": window.mean, "max": window.greatest[0]}
    return {"unit": channel.unit, "meaning": channel.meaning} | extreme


def force_of_impact(result: Result, pin: str, n: int) -> float | None:
    """Largest force of a clearance pin at the records of an impact [N], n from 0 on; None without records."""
    onsets, stem = result.onsets[pin], result.scenario.contact_stem(pin)
    name = next((name for name in (f"{stem}{FORCE}", f"{stem}.normal_force") if name in result.channels), "")
    end = onsets[n].separation_time
    if not math.isfinite(end):
        end = onsets[n + 1].time if n + 1 < len(onsets) else math.inf
    during = (result.time >= onsets[n].time) & (result.time <= end)
    return float(result[name][during].max()) if name and during.any() else None


def outlooks(result: Result) -> list[PinOutlook]:
    """Whether friction makes the clearance pins of a run vibrate, by their postures alone."""
    return pin_outlooks(result.scenario, pins=tuple(with_known_laws(result.scenario.clearance_pins)))


def telling(result: Result) -> list[str]:
    """Names of the usual channels: forces, depths, moments, traced points, energy."""
    points = {f"{point}.{axis}" for point in result.scenario.linkage.points for axis in "xyz"}
    ends = (".force", ".depth", ".gap_upper", ".gap_lower", ".moment", ".balance")
    return [name for name in result.channels if name.endswith(ends) or name in points]


# --- what was run, and how, in words ---


def what_is_run(scenario: Scenario) -> list[Row]:
    """Machine, pins, drives and settings: name and words."""
    space = "in the plane" if scenario.dimensions == 2 else "in space"
    rows: list[Row] = [
        ("machine", f"{type(scenario.machine).__name__}, {space}"),
        ("duration", f"{scenario.duration:g} s, recorded every {amount(scenario.recorded_every, 's')}"),
        ("start", f"{scenario.start}, gravity {scenario.gravity[0]:g}, {scenario.gravity[1]:g} m/s²"),
    ]
    others = [name for name in scenario.linkage.pins if name not in scenario.pins]
    rows += [(f"pin {name}", _pin(scenario, name, pin)) for name, pin in scenario.pins.items()]
    if others:
        rows.append(("ideal pins", ", ".join(others)))
    rows += [(f"guide {name}", words(guide)) for name, guide in scenario.guides.items()]
    parts = {**scenario.actuators, **scenario.parts, **scenario.acting_loads, **scenario.blocks}
    rows += [(name, words(part)) for name, part in parts.items()]
    rows += [("drive", words(scenario.drive))]
    rows += [(f"drive of {name}", words(drive)) for name, drive in scenario.drives.items()]
    return rows


def how(result: Result) -> list[Row]:
    """Formulation, accuracy, counts, time taken and versions: name and words.

    If the program chose the formulation, those that do not cover the scene follow its name.
    """
    scenario = result.scenario
    accuracy, cost = "none was asked for: settings as they stand", ""
    if result.goal is not None:
        met = "met" if result.met else "NOT met"
        accuracy = f"{result.goal:g} asked for, {result.worst_error:.1g} estimated: {met}"
        cost = " (all runs of the accuracy)" if result.coarser else ""
    elif result.coarser is not None:
        accuracy = f"{result.worst_error:.1g} estimated, none was asked for: settings as they stand"
        cost = " (all runs of the error estimate)"
    steps = f"tolerance {scenario.solver.tolerance:g}"
    if not scenario.chooses_steps:
        steps = f"steps of {amount(scenario.step, 's')} and less, {scenario.solver.impact_steps} to an impact"
    counts = dataclasses.asdict(result.counts).items()
    versions = [f"{name} {result.provenance[name]}" for name in VERSIONS if name in result.provenance]
    undetermined = shared(scenario.held) if scenario.dimensions == 2 else ()
    rows = [
        ("contact", "\n".join(contact_lines(scenario))),
        ("warning", "\n".join(result.warnings)),
        ("formulation", f"{_formulation(result)}; {steps}"),
        ("accuracy", accuracy),
        *(("not determined", sentence) for sentence in undetermined),
        ("counts", ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in counts if count)),
        ("wall time", amount(result.wall_time, "s") + cost),
        ("made", f"{result.provenance.get('made_at', 'at a time unknown')} with {', '.join(versions)}"),
    ]
    return [row for row in rows if row[1] or row[0] == "counts"]


def unmet(result: Result) -> str:
    """What to change where the accuracy that was asked for was not met."""
    error, determined, changes = result.worst_error, "", []
    contacts = result.scenario.contact_places.values()
    if 1.1 * error <= LARGEST_GOAL:
        changes.append(f"ask for what was reached (accuracy = {1.1 * error:.1g})")
    if any(result.onsets.values()):
        changes.append("a shorter duration_s, for every impact multiplies the errors of those before")
    if any(not isinstance(place.contact.friction, Frictionless) for place in contacts):
        changes.append("a friction law with a less steep ramp (dynamic_speed)")
    changes.append("means in place of largest values, which settle first")
    if math.isfinite(result.horizon):
        determined = (
            f"Up to {amount(result.horizon, 's')}, {agreed(result)} impacts, runs with shorter steps agree; "
            "what comes later depends on the steps. "
        )
    return (
        f"accuracy {result.goal:g}: NOT met, {error:.1g} is estimated; shorter steps did not help. "
        f"{determined}What may: {'; '.join(changes)}"
    )


def _formulation(result: Result) -> str:
    """The formulation that ran; if the program chose it, also which preferred ones do not cover the scene.

    Without an accuracy Exudyn is preferred, to an accuracy the cheapest.
    """
    ran = formulation(result.scenario.formulation)
    if result.provenance.get(FORMULATION_ASKED, result.scenario.formulation) != "auto":
        return ran.name
    reasons = ["auto"]
    preferred = [one for one in CHEAPEST_FIRST if one.cost < ran.cost]
    if result.goal is None:
        preferred = [one for one in CHEAPEST_FIRST if one.cost > ran.cost]
    for other in preferred:
        try:
            other.check(dataclasses.replace(result.scenario, formulation="auto"))
        except InputError as error:  # noqa: PERF203
            reason = " ".join(str(error).split()).partition("; allowed")[0].partition(": not covered")[0]
            reasons.append(f"{other.name} does not cover {reason}")
    return f"{ran.name} ({'; '.join(reasons)})"


def words(item: Any) -> str:
    """A value as its name and its parameters, in SI; settings that are none are left out."""
    if isinstance(item, Value):
        fields = {f.name: getattr(item, f.name) for f in dataclasses.fields(item)}  # type: ignore[arg-type]
        parameters = ", ".join(
            f"{name.replace('_', ' ')} {words(v)}" for name, v in fields.items() if v is not None
        )
        return f"{type(item).__name__} ({parameters})" if parameters else type(item).__name__
    if isinstance(item, Mapping):
        return ", ".join(f"{name}: {words(v)}" for name, v in item.items()) or "none"
    if isinstance(item, tuple):
        return ", ".join(words(v) for v in item)
    return f"{item:g}" if isinstance(item, float) else str(item)


def _pin(scenario: Scenario, name: str, pin: Pin) -> str:
    if not isinstance(pin, ClearancePin):
        return words(pin)
    contact = pin.contact
    bearing = contact.bearing
    return (
        f"{1e3 * bearing.clearance:g} mm clearance in a bore of {1e3 * bearing.bore_radius:g} mm radius in "
        f"{getattr(scenario.linkage.pins[name], pin.bore)}, {words(contact.normal)}, "
        f"{words(contact.friction)}"
    )
