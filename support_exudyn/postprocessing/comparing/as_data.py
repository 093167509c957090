"""A comparison as plain data, for scripts: everything in SI. The rating, which takes its time, is not in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from support_exudyn.postprocessing.comparing.bands import BandRms
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.comparing.sentences import sentences
from support_exudyn.postprocessing.comparing.told import faults
from support_exudyn.simulation.estimate import Estimate
from user_forces.contact_state import Onset

MOST_IMPACTS = 1000  # of a contact that are told one by one


def as_data(found: FilesCompared) -> dict[str, Any]:
    """The whole comparison: the verdict, and what came out for each file and each of its channels."""
    return {
        "reference": found.reference.path,
        "kind": found.reference.kind,
        "verdict": found.verdict,
        "files": {pair.other.name: _pair(pair) for pair in found.pairs},
    }


def _pair(pair: ComparedPair) -> dict[str, Any]:
    parting, shift = pair.parting, pair.shift
    return {
        "path": pair.other.path,
        "kind": pair.other.kind,
        "verdict": pair.verdict,
        "notes": list(sentences(pair)),
        "same_to_the_bit": pair.same > 0,
        "shift_s": pair.other.mapped.shift,
        "found_shift": None if shift is None else {"channel": shift.channel, **shift.found._asdict()},
        "parting": parting._asdict() if math.isfinite(parting.time) else None,
        "impacts": {
            contact: {
                "matched": [[_impact(one), _impact(other)] for one, other in one_contact.pairs[:MOST_IMPACTS]],
                "number_matched": len(one_contact.pairs),
                "only_reference": [_impact(one) for one in one_contact.only_first[:MOST_IMPACTS]],
                "only_other": [_impact(one) for one in one_contact.only_second[:MOST_IMPACTS]],
            }
            for contact, one_contact in pair.impacts.items()
        },
        "numbers": {name: {**one._asdict(), "times": one.times} for name, one in pair.numbers.items()},
        "left_out": list(pair.common.lacking),
        "not_alike": dict(pair.common.not_alike),
        "channels": {name: _channel(one) for name, one in pair.channels.items()},
    }


def _impact(one: Onset) -> dict[str, float]:
    return one._asdict()


def _number(one: Estimate) -> dict[str, float]:
    return {"value": one.value, "error": one.error}


def _channel(one: ComparedChannel) -> dict[str, Any]:
    measures = one.measures._asdict()
    peaks = {name: measures.pop(name)._asdict() for name in ("peak_reference", "peak_other")}
    return {
        "unit": one.unit,
        "verdict": one.verdict,
        "tolerance": None if one.tolerance is None else one.tolerance.text,
        "allowed": one.allowed,
        "faults": faults(one),
        "errors_of": list(one.with_errors),
        "reference": _number(one.reference),
        "other": _number(one.other),
        "mean": _number(one.mean),
        "largest": {
            **_number(one.largest),
            "signed": one.measures.largest,
            "time_s": one.measures.largest_time,
            "of_reference_there": one.largest_of_reference,
        },
        "beside_errors": {"within": one.beside_errors.within, "times": one.beside_errors.times},
        "judged": [{**item._asdict(), "verdict": item.verdict} for item in one.judged],
        "measures": {**measures, **peaks, "not_told": dict(one.measures.not_told)},
        "statistics": {
            name: _plain(item._asdict()) | {"equal": item.equal} for name, item in one.statistics.items()
        },
        "bands": None if one.bands is None else _bands(*one.bands),
        "interpolated": one.common.interpolated,
        "not_told": list(one.not_told),
    }


def _bands(first: BandRms, second: BandRms) -> dict[str, Any]:
    return {"edges_Hz": first.edges.tolist(), "reference": first.rms.tolist(), "other": second.rms.tolist()}


def _plain(item: Any) -> Any:
    """Named tuples and mappings as dictionaries."""
    if hasattr(item, "_asdict"):
        return {name: _plain(one) for name, one in item._asdict().items()}
    return {name: _plain(one) for name, one in item.items()} if isinstance(item, Mapping) else item
