"""What fuzzing has found, one test each."""

from __future__ import annotations

import dataclasses
import json
import re
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support_exudyn import ImpactStand, Linkage, Scenario, SolverSettings, load_support, reference_support
from support_exudyn.model.actuators import ActuatorModel, PartModel
from support_exudyn.model.linkage import Body, Part, bar
from support_exudyn.model.spatial_linkage import Bearing
from support_exudyn.simulation.evidence.table import EvidenceTable
from tests import strategies as some
from tests.cases.law_cases import BEARING, LENGTH, MODULUS
from tests.cases.machine_cases import PIVOTS_MM
from tests.sound import sound
from user_forces import Exact, Goldsmith, Hertz, InputError, Value
from user_forces.normal.part import PartOf

BALL = {"centre": (0.0, 0.0)}


def test_every_property_together_is_tried_a_thousand_times() -> None:
    assert sum(some.EXAMPLES.values()) >= 1000
    written = "".join(path.read_text("utf-8") for path in Path(__file__).parents[1].rglob("test_*.py"))
    assert sorted(set(re.findall(r'some\.tried\("([a-z ]+)"\)', written))) == sorted(some.EXAMPLES)


# --- numbers ---


@pytest.mark.parametrize(
    "wrong",
    [
        10**400,
        1e300,
        5e-324,
        Decimal("sNaN"),
        Decimal("1e400"),
        np.array([0.5]),
        np.bool_(True),
        np.complex64(1),
    ],
    ids=str,
)
def test_what_overflows_vanishes_or_only_looks_like_a_number_is_refused(wrong: object) -> None:
    with pytest.raises(InputError, match=r"^Part\.mass = .*Input should be .*number.*; allowed: > 0$"):
        Part(mass=wrong, **BALL)


@pytest.mark.parametrize("odd", [np.float64(0.5), np.float32(0.5), np.array(0.5), Decimal("0.5")], ids=repr)
def test_numbers_of_other_kinds_become_plain_ones(odd: object) -> None:
    assert type(Part(mass=odd, **BALL).mass) is float


@pytest.mark.parametrize("wrong", ["512", True, 512.5, 10**5000, 10**20], ids=range(5))
def test_what_is_no_whole_number_is_refused(wrong: object) -> None:
    with pytest.raises(InputError, match=r"^SolverSettings\.impact_steps = .*allowed: >= 16 and <= 10000$"):
        SolverSettings(impact_steps=wrong)


def test_a_bar_between_points_that_rounding_has_parted_can_be_made() -> None:
    assert bar(1.0, (0.0, 0.0), (1e-17, 0.0)).inertia > 0.0


def test_a_length_whose_square_is_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"Goldsmith\.reference_length = 1e-260"):
        Goldsmith(
            bearing=BEARING, length=LENGTH, effective_modulus=MODULUS, restitution=0.5, reference_length=1e-260
        )


def test_a_part_of_nothing_is_refused() -> None:
    law = Hertz(stiffness=1e9)
    with pytest.raises(InputError, match=r"PartOf\.share = 0\.0: .*allowed: > 0 and <= 1"):
        PartOf(law=law, share=0.0)


def test_restitution_that_has_no_reciprocal_is_refused() -> None:
    with pytest.raises(InputError, match=r"Exact\.restitution = 5e-324"):
        Exact(stiffness=1e9, restitution=5e-324)


@pytest.mark.parametrize("factor", ["2", None, True, 1e308, 1e-308, float("nan")])
def test_a_factor_by_which_nothing_can_be_refined_is_refused(factor: Any) -> None:
    scene = Scenario(machine=ImpactStand(bore_mass=1.0, journal_mass=1.0, speed=0.1), duration=0.1)
    with pytest.raises(InputError, match=r"^factor = .*allowed: > 0"):
        scene.refined(factor)


# --- data ---


def _nested(levels: int) -> dict[str, Any]:
    data: dict[str, Any] = Hertz(stiffness=1e9).to_data()
    for _ in range(levels):
        data = {"type": "PartOf", "law": data, "share": 0.5}
    return data


def test_data_that_are_nested_too_deep_are_refused() -> None:
    with pytest.raises(InputError, match="nested too deep; allowed: 32 levels"):
        Value.from_data(_nested(10_000))


def test_data_that_contain_themselves_are_refused() -> None:
    data: dict[str, Any] = {"type": "ClearancePin"}
    data["contact"] = data
    with pytest.raises(InputError, match="nested too deep"):
        Value.from_data(data)


def test_parts_of_parts_come_back_as_long_as_they_can_be_made() -> None:
    law = Value.from_data(_nested(4))
    sound(law)
    with pytest.raises(InputError, match=r"part of a part.*allowed: up to 4"):
        PartOf(law=law, share=0.5)


@pytest.mark.parametrize("name", [3, None, ("a", "b"), b"stroke"])
def test_names_that_are_no_text_are_refused(name: object) -> None:
    with pytest.raises(InputError, match=r"is no name; allowed: text"):
        Value.from_data({"type": "Held", name: 1.0})  # type: ignore[dict-item]


@pytest.mark.parametrize("name", ["self", "__dataclass_self__", "x" * 10_000])
def test_names_that_python_uses_itself_are_unknown_fields(name: str) -> None:
    with pytest.raises(InputError, match=r"unknown field") as caught:
        Value.from_data({"type": "Held", name: 1.0})
    assert len(str(caught.value)) < 300


def test_a_body_cannot_be_called_type_which_data_could_not_keep() -> None:
    with pytest.raises(InputError, match=r"^Linkage\.bodies: 'type': cannot be used as a name"):
        Linkage(bodies={"type": Body(mass=1.0, inertia=1.0, **BALL)})


@pytest.mark.parametrize("kind", [ActuatorModel, PartModel])
def test_of_a_class_that_only_groups_others_nothing_can_be_made(kind: type[Value]) -> None:
    with pytest.raises(InputError, match=rf"^{kind.__name__}: is a kind of values; allowed: "):
        kind()


def test_what_a_bearing_holds_comes_back() -> None:
    point = {"first_point": (0.0, 0.0, 0.0), "second_point": (0.0, 0.0, 0.0)}
    one = Bearing(first="ground", second="a", pin="pin", holds={"along", "tilt"}, **point)
    assert Value.from_data(json.loads(json.dumps(one.to_data()))) == one


class Silent:
    def __repr__(self) -> str:
        raise RuntimeError


@pytest.mark.parametrize("odd", [Silent(), 10**5000], ids=["without repr", "of 5000 digits"])
def test_what_cannot_be_shown_is_refused_by_its_kind(odd: object) -> None:
    with pytest.raises(InputError, match=rf"^Part\.mass = <{type(odd).__name__}>: "):
        Part(mass=odd, **BALL)


# --- machines ---


def test_a_four_bar_that_closes_nowhere_is_refused_in_a_sentence() -> None:
    # stretched along a line: it closes in this posture only, and there by rounding does not
    line = {
        "rear_base": (0.0, 0.0),
        "rear_shield": (0.2, 0.0),
        "front_shield": (0.7, 0.0),
        "front_base": (1.3, 0.0),
    }
    with pytest.raises(InputError, match=r"the four-bar does not close within 60 degrees.*allowed: "):
        dataclasses.replace(reference_support(), **line)


@pytest.mark.parametrize("name", ["front_base", "tail_hinge"])
def test_a_pivot_kilometres_away_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=rf"{name} = \(1e\+30, 0\.0\) m: allowed: from -1000 to 1000 m"):
        dataclasses.replace(reference_support(), **{name: (1e30, 0.0)})


# --- files ---

PLACES = "\n".join(
    f"{name} = [{x}, {y}]"
    for name, (x, y) in PIVOTS_MM.items()
    if name != "tip" and not name.startswith("tail")
)
MACHINE = (
    """
kind = "four_column_support"
start_hinge_height_mm = 1800
[pivots_mm]
"""
    + PLACES
    + """
{pivots}
[[parts.rear_link]]
mass_kg = 1
between = {between}
"""
)
TIP = "tip = [3219, 2417]"


@pytest.mark.parametrize(
    ("pivots", "between", "said"),
    [
        (f"{TIP}\nparts = [1, 2]", "['tip', 'hinge']", r"pivots_mm\.parts: unknown key"),
        (f"{TIP}\nwidth = [1, 2]", "['width', 'width']", r"pivots_mm\.width: unknown key"),
        (TIP, "[[1], 'tip']", r"parts\.rear_link\[0\]\.between\[0\] = \[1\]: allowed: a text"),
        (
            "tip = [1, 1e300]",
            "['tip', 'tip']",
            r"pivots_mm\.tip\[1\] = 1E\+300: allowed: a number up to",
        ),
        (
            f"tip = [1, 1{'0' * 400}]",
            "['tip', 'tip']",
            r"pivots_mm\.tip\[1\] = 1000.*allowed: a number up to",
        ),
    ],
)
def test_machine_files_that_were_a_traceback_are_refused(
    tmp_path: Path, pivots: str, between: str, said: str
) -> None:
    path = tmp_path / "machine.toml"
    path.write_text(MACHINE.format(pivots=pivots, between=between), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(f"{path}: ") + said):
        load_support(path)


SCENE = {"name": "a", "family": "f", "seconds": 1.0, "steps": 1, "fields": {}, "numbers": {}}
TABLE = {"format": "support_exudyn scene detail 2", "fullest": {"f": "a"}, "said": {}, "scenes": [SCENE]}


@pytest.mark.parametrize(
    "changes",
    [
        {"scenes": [SCENE | {"fields": []}]},
        {"scenes": [SCENE | {"steps": float("inf")}]},
        {"scenes": [SCENE | {"seconds": float("nan")}]},
        {"scenes": [SCENE | {"seconds": -1.0}]},
        {"scenes": [SCENE | {"name": ["a"]}]},
        {"scenes": [SCENE | {"fields": {"speed": 3}}]},
        {"scenes": [SCENE | {"numbers": {"x": [1.0, True, "m"]}}]},
        {"fullest": {}},
        {"fullest": {"f": "b"}},
        {"fullest": [1]},
        {"format": []},
    ],
    ids=str,
)
def test_a_table_that_could_not_be_asked_is_refused(tmp_path: Path, changes: Mapping[str, Any]) -> None:
    path = tmp_path / "table.json"
    path.write_text(json.dumps({**TABLE, **changes}), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(str(path)) + ".*not a table of tried scenes"):
        EvidenceTable.load(path)


@pytest.mark.parametrize("content", [b"\xff\xfe", b"[" * 100_000, b"", b"3", b"1" * 5000])
def test_a_file_that_is_no_table_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "table.json"
    path.write_bytes(content)
    with pytest.raises(InputError, match=re.escape(str(path))):
        EvidenceTable.load(path)
