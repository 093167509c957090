"""What a run was and what came out of it, in words and numbers with their units."""

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from support_exudyn.formulations.registry import CHEAPEST_FIRST, FORMULATIONS, Formulation, formulation
from support_exudyn.machines.check.freedoms import shared
from support_exudyn.model.pins import ClearancePin, Pin
from support_exudyn.postprocessing.figures.units import readable, said
from support_exudyn.postprocessing.joint_tables import contact_lines
from support_exudyn.postprocessing.shown_numbers import WHOLE_RUN, label, shown
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.scenario_data import LARGEST_GOAL
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.horizon import agreed
from support_exudyn.simulation.impulses import impulses_of
from support_exudyn.simulation.provenance import FORMULATION_ASKED
from support_exudyn.simulation.reported_numbers import FORCE, measures
from support_exudyn.simulation.result import Result
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError, Value

Row = tuple[str, ...]
IMPACTS = 3  # of every pin that are told one by one
VERSIONS = ("support-exudyn", "exudyn", "python", "numpy", "scipy", "numba")
ROUNDING = 1e-14  # share of a channel's largest value that is shown as zero
DIGITS = 6  # of numbers without known error


def what_was_run(result: Result) -> list[Row]:
    """Machine, pins, drives and settings of a result: name and words."""
    return what_is_run(result.scenario)


def what_is_run(scenario: Scenario) -> list[Row]:
    """Machine, pins, drives and settings: name and words."""
    space = "in the plane" if scenario.dimensions == 2 else "in space"
    rows: list[Row] = [
        ("machine", f"{type(scenario.machine).__name__}, {space}"),
        ("duration", f"{scenario.duration:g} s, recorded every {said(scenario.recorded_every, 's')}"),
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

    Of a formulation that was left to the program it is said which ran and why.
    """
    scenario, counts = result.scenario, result.counts
    cost = ""
    if result.goal is None and result.coarser is None:
        accuracy = "none was asked for: settings as they stand"
    elif result.goal is None:
        accuracy = (
            f"errors were asked for, no accuracy: {result.worst_error:.1g} estimated, settings as they stand"
        )
        cost = " (all runs that the errors took)"
    else:
        cost = " (all runs of the accuracy)" if result.coarser else ""
        met = "met" if result.met else "NOT met"
        accuracy = f"{result.goal:g} asked for, {result.worst_error:.1g} estimated: {met}"
    made = dataclasses.asdict(counts).items()
    versions = [f"{name} {result.provenance[name]}" for name in VERSIONS if name in result.provenance]
    steps = f"tolerance {scenario.solver.tolerance:g}"
    if not scenario.chooses_steps:
        steps = f"steps of {said(scenario.step, 's')} and less, {scenario.solver.impact_steps} to an impact"
    contacts, warnings = contact_lines(scenario), result.warnings
    return [
        *([("contact", "\n".join(contacts))] if contacts else []),
        *([("warning", "\n".join(warnings))] if warnings else []),
        ("formulation", f"{_formulation(result)}; {steps}"),
        ("accuracy", accuracy),
        *(("not determined", sentence) for sentence in shared(scenario.held) if scenario.dimensions == 2),
        ("counts", ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in made if count)),
        ("wall time", said(result.wall_time, "s") + cost),
        ("made", f"{result.provenance.get('made_at', 'at a time unknown')} with {', '.join(versions)}"),
    ]


def unmet(result: Result) -> str:
    """What to change where the accuracy that was asked for was not met."""
    told = result.worst_error
    reached = f"{1.1 * told:.1g}" if math.isfinite(told) and 1.1 * told <= LARGEST_GOAL else ""
    changes = [
        f"ask for what was reached (accuracy = {reached})" if reached else "",
        "a shorter duration_s, for every impact multiplies the errors of those before"
        if any(result.onsets.values())
        else "",
        "a friction law with a less steep ramp (dynamic_speed)" if _has_friction(result) else "",
        "means in place of largest values, which settle first",
    ]
    return (
        f"accuracy {result.goal:g}: NOT met, {told:.1g} is estimated; shorter steps did not help. "
        f"{_determined(result)}What may: " + "; ".join(filter(None, changes))
    )


def _determined(result: Result) -> str:
    """Up to when the run is determined, as a sentence; empty where its impacts do not say."""
    if not math.isfinite(result.horizon):
        return ""
    return (
        f"Up to {said(result.horizon, 's')}, {agreed(result)} impacts, runs with shorter steps agree; what "
        "comes later depends on the steps. "
    )


def _has_friction(result: Result) -> bool:
    places = result.scenario.contact_places.values()
    return any(not isinstance(place.contact.friction, Frictionless) for place in places)


def _formulation(result: Result) -> str:
    """The formulation that ran, and if that was left to the program, why this one."""
    asked = result.provenance.get(FORMULATION_ASKED, result.scenario.formulation)
    ran = formulation(result.scenario.formulation).name
    if asked != "auto":
        return ran
    if result.goal is None and ran == "exudyn":
        return f"{ran} (auto: without an accuracy that is the one wherever it covers the scene)"
    if result.goal is None:
        return f"{ran} (auto: {_why_not(FORMULATIONS['exudyn'], result)})"
    cheaper = [one for one in CHEAPEST_FIRST if one.cost < FORMULATIONS[ran].cost]
    if not cheaper:
        return f"{ran} (auto: the cheapest, and it covers this scene)"
    return f"{ran} (auto: {'; '.join(_why_not(one, result) for one in cheaper)})"


def _why_not(cheaper: Formulation, result: Result) -> str:
    try:
        cheaper.check(dataclasses.replace(result.scenario, formulation="auto"))
    except InputError as error:
        reason = " ".join(str(error).split()).partition("; allowed")[0].partition(": not covered")[0]
        return f"{cheaper.name} does not cover {reason}"
    return f"{cheaper.name} would need too many steps for its friction"


def numbers(result: Result, after: float, until: float) -> dict[str, Estimate]:
    """Numbers of the forces and of the energy between two times [s], in SI; an error that is not known is NaN.

    Errors are known if an accuracy was asked for. Largest forces at any step and energies are of the whole run.

    Raises InputError if no record lies between.
    """
    result.check_window(after, until)
    found: dict[str, Estimate] = {}
    if result.coarser is not None:
        found |= result.numbers(after, until)
    else:
        found |= {
            name: Estimate(kind.measure(result), math.nan, kind.unit)
            for name, kind in measures(result, after, until).items()
            if f"{FORCE}." in name or name.endswith(WHOLE_RUN)
        }
    return found | {name: Estimate(value, math.nan, "J") for name, value in _energies(result).items()}


def printed(result: Result, after: float, until: float, only: Sequence[str] = ()) -> dict[str, Estimate]:
    """`numbers` that are printed, in their order, see `shown`; only: names of those that are asked for.

    Raises InputError if no record lies between.
    """
    every = numbers(result, after, until)
    return {name: every[name] for name in only} if only else shown([result], [every], after, until)[0]


def rows_of(found: Mapping[str, Estimate]) -> list[Row]:
    """Numbers in the units in which they are read best: name, value, error (empty if not known), unit."""
    return [(label(name), *with_error(number)) for name, number in found.items()]


def came_out(result: Result, after: float, until: float) -> list[Row]:
    """The rows of the numbers that are printed. Raises InputError if no record lies between."""
    return rows_of(printed(result, after, until))


def impacts(
    result: Result, most: int | None = IMPACTS, after: float = 0.0, until: float = math.inf
) -> list[Row]:
    """Impacts of every clearance pin, and of every corner in a guide with clearance.

    Each with pin, number, time, duration, speeds before and after, largest force. The force is that of the
    records between onset and separation, "" if none lies there or none was recorded.

    Arguments:
        most: how many of each pin; None: all.
        after, until: times between which they begin [s].
    """
    rows: list[Row] = []
    for pin, onsets in result.onsets.items():
        inside = [(n, one) for n, one in enumerate(onsets) if after <= one.time <= until]
        if not inside:
            rows.append((pin, "none", "", "", "", "", ""))
        for n, one in inside[:most]:
            lasted, separated = one.separation_time - one.time, math.isfinite(one.separation_time)
            ends = "to the next impact" if n + 1 < len(onsets) else "to the end"
            force = force_of_impact(result, pin, n)
            rows.append((
                pin, f"{n + 1} of {len(onsets)}", said(one.time, "s", 6),
                said(lasted, "s", 4) if separated else ends,
                said(one.speed, "m/s", 5), said(one.separation_velocity, "m/s", 5) if separated else "",
                "" if force is None else said(force, "N", 4),
            ))  # fmt: skip
    return rows


def force_of_impact(result: Result, pin: str, n: int) -> float | None:
    """Largest force of a clearance pin at the records of an impact [N], n from 0 on; None without records."""
    onsets, stem = result.onsets[pin], result.scenario.contact_stem(pin)
    name = next((one for one in (f"{stem}{FORCE}", f"{stem}.normal_force") if one in result.channels), "")
    end = onsets[n].separation_time
    if not math.isfinite(end):
        end = onsets[n + 1].time if n + 1 < len(onsets) else math.inf
    during = (result.time >= onsets[n].time) & (result.time <= end)
    if not name or not during.any():
        return None
    return float(result[name][during].max())


def of_channels(result: Result, names: Iterable[str], after: float, until: float) -> list[Row]:
    """Channels between two times [s]: name, unit, least, mean and greatest value with their signs, meaning.

    Raises InputError if the run does not last between them.
    """
    rows: list[Row] = []
    for name in names:
        found = extent(result, name, after, until)
        values = [found[word] for word in ("min", "mean", "max")]
        size = max(map(abs, values))
        unit = readable(found["unit"], size)
        least, mean, greatest = (
            f"{unit.scale * (value if abs(value) > ROUNDING * size else 0.0):.{DIGITS}g}" for value in values
        )
        if impulses_of(result, name, after, until):
            least = greatest = "impulse"  # which has no finite peak
        rows.append((name, unit.name, least, mean, greatest, found["meaning"]))
    return rows


def extent(result: Result, name: str, after: float, until: float) -> dict[str, Any]:
    """Unit, meaning, and min, mean and max in SI of a channel between two times [s], from every step.

    Raises InputError if the run does not last between them.
    """
    channel = result.channels[name]
    window = result.window(name, after, until)
    extreme = {"min": window.least[0], "mean": window.mean, "max": window.greatest[0]}
    return {"unit": channel.unit, "meaning": channel.meaning} | extreme


def telling(result: Result) -> list[str]:
    """Names of the channels that are looked at first: forces, depths, moments, traced points, energy."""
    points = {f"{point}.{axis}" for point in result.scenario.linkage.points for axis in "xyz"}
    ends = (".force", ".depth", ".gap_upper", ".gap_lower", ".moment", ".balance")
    return [name for name in result.channels if name.endswith(ends) or name in points]


def with_error(found: Estimate) -> Row:
    """A number, its error to its leading digits (empty if it is NaN), and the unit in which both are."""
    unit = readable(found.unit, abs(found.value))
    value, error = unit.scale * found.value, unit.scale * found.error
    if math.isnan(error):
        return f"{value:.{DIGITS}g}", "", unit.name
    if not (math.isfinite(error) and error > 0.0):
        return f"{value:.{DIGITS}g}", "not known" if error else "0", unit.name
    digits = min(max(0, 1 - math.floor(math.log10(error))), 9)
    return f"{value:.{digits}f}", f"{error:.1e}", unit.name


def side_by_side(found: Sequence[Estimate | None], most: int = DIGITS) -> Row:
    """Unit, and numbers of several runs in it with their errors, of at most so many digits; None: empty."""
    there = [one for one in found if one is not None]
    unit = readable(there[0].unit, max(abs(one.value) for one in there))
    return unit.name, *("" if one is None else to_error(one, unit.scale, most) for one in found)


def to_error(number: Estimate, scale: float, most: int = DIGITS) -> str:
    """A number to the first digit of its error, and the error, unless that is below the shown digits."""
    value, error = scale * number.value, scale * number.error
    size = math.floor(math.log10(abs(value))) if value else 0
    decimals = max(-math.floor(math.log10(error)), 0) if math.isfinite(error) and error > 0.0 else math.inf
    if decimals > most - 1 - size:
        return f"{value:.{most}g}"
    return f"{value:.{decimals}f} ± {error:.{decimals}f}"


def words(item: Any) -> str:
    """A value as its name and its parameters, in SI; settings that are none are left out."""
    if isinstance(item, Value):
        fields = {f.name: getattr(item, f.name) for f in dataclasses.fields(item)}  # type: ignore[arg-type]
        told = ", ".join(f"{name.replace('_', ' ')} {words(v)}" for name, v in fields.items() if v is not None)
        return f"{type(item).__name__} ({told})" if told else type(item).__name__
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


def _energies(result: Result) -> dict[str, float]:
    """Energies of the whole run [J], as far as they were recorded."""
    names = [f"energy.{name}" for name in ("work", "damping_loss", "friction_loss")]
    found = {f"{name} at the end": float(result[name][-1]) for name in names if name in result.channels}
    if "energy.balance" in result.channels:
        found["energy not accounted for, largest"] = result.energy_error
    return found
