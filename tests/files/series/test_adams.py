"""Files of ADAMS: a genuine one against free fall, and what is damaged, hostile or too large."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from tests.cases.series_cases import DATA, REQUESTS
from user_forces import InputError

SMALL = """<?xml version="1.0"?>
<Results xmlns="http://www.mscsoftware.com/:xrf10"><Analysis name="A"><StepMap name="m">
<Entity name="time"><Component name="TIME" unitsValue="sec" id="1" /></Entity>
<Entity name="P"><Component name="X" unitsValue="mm" id="3" /><Component name="Y" id="2" /></Entity>
<Entity name="R"><Component name="N" unitsValue="" plotLabel="(RPM)" id="4" />
<Component name="P" unitsValue="" plotLabel="Pressure (MPa)" id="5" /></Entity>
</StepMap><Data>
<Step type="dynamic">0.5 2 3
4 5</Step><Step type="dynamic">
1 12 13 14
15</Step></Data></Analysis></Results>"""


def written(folder: Path, text: str, name: str = "a.res") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_genuine_file_is_three_quarters_of_a_percent_off_free_fall_at_its_first_step() -> None:
    found = read_series(DATA / "free_fall.res")
    y = found.series["PART_2_XFORM.Y"]
    assert len(found.series) == 18
    assert y.unit == "inch"
    assert y.time[:3] == pytest.approx([0.0, 0.01, 0.02])
    assert y.values[1:3].tolist() == [-0.0194492123535125, -0.07736249975851248]
    fall = -0.5 * 9.80665 * y.time**2
    metres = converted(y, "m")
    assert metres[1] / fall[1] - 1.0 == pytest.approx(0.0075, abs=5e-5)
    assert metres[-1] == pytest.approx(fall[-1], rel=2e-4)
    assert converted(found.series["PART_2_XFORM.ACCY"], "m/s^2") == pytest.approx(-9.80665, rel=1e-9)
    assert found.series["PART_2_XFORM.PSI"].unit == "rad"


def test_numbers_are_in_the_order_of_the_ids_whatever_lines_they_are_on(tmp_path: Path) -> None:
    found = read_series(written(tmp_path, SMALL)).series
    read = {name: (one.unit and one.unit.lower(), one.values.tolist()) for name, one in found.items()}
    assert read == {
        "P.Y": (None, [2.0, 12.0]),
        "P.X": ("mm", [3.0, 13.0]),
        "R.N": ("rpm", [4.0, 14.0]),
        "R.P": ("mpa", [5.0, 15.0]),
    }
    assert found["P.X"].time.tolist() == [0.5, 1.0]


def test_of_several_analyses_one_is_taken_and_told(tmp_path: Path) -> None:
    start, _, rest = SMALL.partition("<Analysis")
    one = "<Analysis" + rest.partition("</Results>")[0]
    other = one.replace('name="A"', 'name="B"').replace("1 12 13", "1 12 99")
    path = written(tmp_path, start + one + other + "</Results>")
    found = read_series(path)
    assert found.series["P.X"].values[-1] == 13.0
    assert found.notes == ("Of 2 analyses the first is taken, A; others are B (analysis = of compare.toml).",)
    assert read_series(path, analysis="B").series["P.X"].values[-1] == 99.0
    with pytest.raises(InputError, match="has no analysis 'C'; allowed: one of its 2: 'A', 'B'"):
        read_series(path, analysis="C")
    twice = written(tmp_path, start + one + one + "</Results>")
    for analysis in (None, "A"):
        with pytest.raises(InputError, match="a second analysis 'A'; allowed: one of each name"):
            read_series(twice, analysis=analysis)


def test_requests_are_read_with_the_units_of_their_system(tmp_path: Path) -> None:
    found = read_series(written(tmp_path, REQUESTS, "a.req"))
    read = {name: (one.unit, one.values.tolist()) for name, one in found.series.items()}
    assert read["hinge_pin.X"] == ("N", [1.0, 1.5])
    assert read["hinge_pin.R1"] == ("N*mm", [4.0, 4.5])
    assert read["req7.Z"] == ("mm", [9.0, 9.5])
    assert read["req7.R3"] == ("rad", [12.0, 12.5])
    assert found.series["req7.Z"].time.tolist() == [0.0, 1e-3]
    assert len(read) == 12


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (SMALL.partition("15<")[0], "line 11, column 1: no element found; allowed: the whole"),
        (SMALL.replace("4 5</Step>", "4</Step>"), "step 1 has 4 numbers; allowed: 5, as the map has"),
        (
            SMALL.replace("<StepMap", "<Step>1</Step><StepMap"),
            "a step before the map of steps; allowed: the map first",
        ),
        (SMALL.replace("4 5</Step>", "4 x</Step>"), "step 1 has what is no number"),
        (SMALL.replace('id="4"', 'id="3"'), "id 3 of component 'R.N'; allowed: each number"),
        (SMALL.replace('"TIME"', '"TIMES"'), "0 components TIME; allowed: one"),
        (SMALL.replace('unitsValue="sec"', ""), "times, column 'time.TIME': have no unit"),
        (SMALL.partition("<Data>")[0] + "</Analysis></Results>", "has no steps; allowed: one or more"),
        ((DATA / "free_fall.req").read_text(), "has times and no request; allowed: one request or more"),
        (REQUESTS[:-30], "line 11: 7 numbers behind 1 steps of 13; allowed: the whole"),
        (REQUESTS.replace("10.5", "1O.5"), "line 12: '1O.5'; allowed: numbers such as 1.5E-03"),
        (REQUESTS.replace("    7    1", "    7    x"), "line 6: is no request, with five whole numbers"),
        (REQUESTS.partition("    2  ")[0], "none has the number of requests"),
    ],
)
def test_damage_is_refused_with_its_place(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_series(written(tmp_path, text))
