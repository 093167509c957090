"""Input and message: whatever is wrong in a file is answered with file, key, value, and what is allowed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from jsonschema import Draft7Validator, Draft202012Validator

from support_exudyn import Drive, Part, Width, trusted
from support_exudyn.files import parsed, read_value, scenario_of, scenario_schema
from support_exudyn.files.machines import load_machine, machine_schema
from tests import strategies as some
from tests.files.test_data_files import Sheave
from tests.files.test_linkage_files import CRANK_ROCKER, DRIVEN_BY_FORCES, FREE, GEARED, ON_A_GUIDE
from tests.files.test_own_classes import LAWS
from tests.files.test_schemas import plain
from tests.files.test_support_files import COLUMN, FILE
from tests.machine_files import OURS
from user_forces import InputError, JournalBearing, JournalContact, LuGre

some.kinds()  # imports all modules: not while something is drawn
TOP = 'machine = "reference"\nduration_s = 5\n'
CRANK = 'machine = "slider_crank"\nduration_s = 1\n'
SCENARIOS = {
    "NOTHING": "",
    "TOP": TOP,
    "PIN": TOP + "[pins.rear_base]\nclearance_mm = 1.5\nbore_radius_mm = 65.5\n",
    "GUIDE": CRANK + "[guides.guide]\n",
    "CRANK": CRANK,
    "ROCKER": 'machine = "crank_rocker"\nduration_s = 1\n',
    "OIL": TOP + '[actuators.rear_column]\ntype = "OilColumn"\nbore_area_mm2 = 1e5\nbulk_modulus_MPa = 1960\n',
}
DRIVES = {  # by the number alone 10 degrees would be 175 mm
    "a.csv": "time_s,turn_deg,other_mm\n0,0,0\n1,10,10\n",
    "b.csv": "time_s,crank_mm\n0,0\n1,10\n",
    "c.csv": "time_s,front_column_mm\n0,0\n1,100\n",
}
MACHINES = {
    "SUPPORT": FILE + COLUMN,
    "OURS": OURS,
    "CRANK_ROCKER": CRANK_ROCKER,
    "ON_A_GUIDE": ON_A_GUIDE,
    "GEARED": GEARED,
    "LOADED": FREE + DRIVEN_BY_FORCES,
}
CLASSES = {cls.__name__: cls for cls in (JournalBearing, JournalContact, Drive, Part, Width, Sheave, LuGre)}
SCHEMAS = {
    kind: [draft(schema) for draft in (Draft202012Validator, Draft7Validator)]
    for kind, schema in (("scenario", scenario_schema()), ("machine", machine_schema()))
}
# After a name above: the text of a class, or added to a scenario, or changed in a machine (old => new); and the
# message; "; " ends a line, ".." stands for what is between. The schema for editors shows -> too, but not ~>.
TABLE = r"""
== NOTHING
# nothing -> machine: missing; allowed: a path that ends in .toml
machine = "reference" -> duration_s: missing; it has no default
machine = 3; duration_s = 1 -> machine = 3: allowed: a path that ends in .toml
machine = "no.toml"; duration_s = 1 ~> machine = 'no.toml': allowed: a file that can be read
machine = "zf1800"; duration_s = 1 ~> machine = 'zf1800': there is none .. did you mean 'zf18000'
duration_s = 1; [machine]; type = "Sup" -> machine.type = 'Sup'
kind = 'two_leg_shield'; stroke_mm = 3 -> is the file of a machine; allowed: a scenario
nme = "a"; machine = "reference"; duration_s = 5
    -> nme: unknown key; did you mean 'name'? allowed: name, description,
name = 3; machine = "reference"; duration_s = 5 -> name = 3: allowed: a text
errors = 1; machine = "reference"; duration_s = 5 -> errors = 1: allowed: true, false
type = "Held"; machine = "reference"; duration_s = 5 -> type = 'Held': allowed: "Scenario", or to leave it out
== TOP
duration_ms = 1 -> duration_ms: is given twice, duration_s says the same; allowed: one
accuracy = "best" -> accuracy = 'best': allowed: 'draft', 'standard', 'reference', or
dimensions = 4 -> dimensions = 4: allowed: 2, 3
step_ms = 500 -> step_ms = 500: allowed: > 0 and <= 100
step_s = 0 -> step_s = 0: allowed: > 0 and <= 0.1
step = 1e-4 -> step: is written with its unit; allowed: step_s, step_ms
record_period_s = 6 ~> record_period = 6.0 s: allowed: at most the duration, 5.0 s
gravity_m_per_s2 = [0] -> gravity_m_per_s2 = [0]: allowed: a list of 2, each a number
solver = 3 -> solver = 3: allowed: a table of type SolverSettings
solver.impact_steps = 1 -> solver.impact_steps = 1: allowed: a whole number >=
solver.impact_steps = 16.5 -> solver.impact_steps = 16.5: allowed: a whole number >=
solver.audit = 1 -> solver.audit: unknown key
channels = 'tip.x' -> channels = 'tip.x': allowed: a list, each a text
channels = ['tip.z'] ~> channels = 'tip.z'
pins = 3 -> pins = 3: allowed: a table of names, each a table of type
pins.rear_base = 1.5 -> pins.rear_base = 1.5: allowed: a table of type
pins.rear_base.type = 'ClearancePin' -> pins.rear_base.contact: missing
pins.rear_base.type = 'Held' -> pins.rear_base.type = 'Held': allowed: BushingPin,
pins.rear_base.ideal = false -> pins.rear_base.ideal = false: allowed: true; a joint
[pins.rear_base]; bore_radius_mm = 60 -> pins.rear_base.clearance_mm: missing
pins.rear_bse.clearance_mm = 1 ~> pins.rear_bse: unknown pin 'rear_bse'; did you mean 'rear_base'
pins.rear_bse.ideal = true ~> pins.rear_bse: unknown pin 'rear_bse'; did you mean 'rear_base'
[pins.rear_base]; clearance_mm = -1; bore_radius_mm = 65.5 -> pins.rear_base.clearance_mm = -1: allowed: >= 0
[pins.rear_base]; clearance_mm = 70; bore_radius_mm = 65.5
    ~> pins.rear_base: clearance_mm = 70 .. bore_radius_mm = 65.5; allowed: > 0
drive.mode = 3 -> drive.mode = 3: allowed: 1, 2
[drive]; mode = 1; end_s = 1 ~> drive: end = 1.0 s: allowed: > start = 3.0 s
drive.stroke_mm = 3 -> drive: says no mode, table or type; allowed: mode = 1 or 2
drive = {type = 'CubicStep', stroke = 3} -> drive.stroke: is written with its unit
drive.mode = 2; drive.stroke_mm = 5000 ~> drives.front_column and drives.rear_column: .. cannot follow
drive.table = 3 -> drive.table = 3: allowed: a text
drives.table = 3 -> drives.table = 3: allowed: a table of type
drive = {table = "a.csv", column = "turn"} ~> a.csv: column turn: is in deg; linear actuators extend; allowed:
drives.rear_column = {table = "a.csv", column = "turn"} ~> a.csv: column turn: is in deg; linear actuators
[drives]; table = "c.csv"; front_column = {mode = 1} ~> drives.front_column: is a column of c.csv too; allowed
drive.table = 'no.csv' ~> drive.table = 'no.csv': allowed: a file that can be read
drive = {type = "Steady", rate_rpm = 60} ~> rate_rpm = 60: allowed: rate_mm_per_s, rate_m_per_s
drive = {type = "CubicStep", start_s = 0, end_s = 1, stroke_deg = 60}
    ~> stroke_deg = 60: allowed: stroke_mm, stroke_m
actuators.front_column = {type = 'CylinderAndRod', rod_mass = 3} -> front_column.rod_mass: is written
actuators.front_column.type = 'OilColumn' -> actuators.front_column.bore_area_mm2: missing
accuracy = {value = "draft"} -> accuracy.value = 'draft': allowed: a number
== PIN
clearance_m = 1e-3 -> pins.rear_base.clearance_m: is given twice
law = 'Hertzz' -> pins.rear_base.law = 'Hertzz': did you mean 'Hertz'? allowed:
law = 'Hertz'; restitution = 0.9 ~> pins.rear_base: restitution
law = 'Johnson' -> law takes laws of stiffness and restitution only .. ClearancePin
stiffness = 1e10 -> pins.rear_base.stiffness: a number needs its unit in the key; allowed: stiff
stiffness = {value = 1e10} -> pins.rear_base.stiffness: a number needs its unit in the key
stiffness_N_per_m_to_n = 1e10; bore_material = 'steel'
    ~> pins.rear_base: bore_material: would be left unused beside a stiffness; allowed: one of them
friction = 'wet' -> pins.rear_base.friction = 'wet': allowed: >= 0 and <= 5, or a table of type
friction_law = "Frictionless"; friction = 0.1 ~> Frictionless has no coefficient
friction_law = "Ambrosio"; friction = {type = "Ambrosio", sliding_coefficient = 0.1}
    ~> friction_law: and a law as friction are two; allowed: one of them
restitution = 1.5 -> pins.rear_base.restitution = 1.5: allowed: > 0 and <= 1
law = "no_laws.py:A" ~> law = 'no_laws.py:A': allowed: a file that is there
friction_law = "laws.py:BadPlain" ~> made with @value
law = "laws.py:BadFriction" ~> law = 'BadFriction': .. allowed: .. BadNormal
law = "laws.py:BadRig" ~> law = 'BadRig': .. [pins.NAME.contact], .. normal = {
== GUIDE
clearance_mm = 0.1 ~> guides.guide: block_mm: missing, and the machine's file says none
clearance_mm = 1; block_mm = [40, 20]; corner_radius_mm = 1; stiffness_N_per_m_to_n = 1e9
    ~> allowed: one of them
clearance_mm = 1; block_mm = [40, 20]; law = "Johnson" -> "ClearanceGuide" and in it, normal = {
clearance_mm = 1; block_mm = [40, 20]; law = "Hertz"; restitution = 0.5 ~> guides.guide: restitution
clearance_mm = 1; pin_radius_mm = 5 ~> has a pin_radius; allowed: block
== CRANK
drive = {table = "a.csv", column = "other"} ~> a.csv: column other: is in mm; cranks turn
[drives]; table = "b.csv" ~> b.csv: column crank: is in mm; cranks turn
[drive]; mode = 2; stroke_mm = 1 ~> drive.mode = 2: allowed: none of cranks
== ROCKER
drive = {type = "CubicStep", start_s = 0, end_s = 1, stroke_mm = 500}
    ~> drive.stroke_mm = 500: allowed: stroke_deg, stroke_rad
drive = {type = "CubicStep", start_s = 0, end_s = 1}
    ~> drive.stroke_deg: missing; allowed: stroke_deg, stroke_rad, for cranks turn
drive = {type = "Steady", rate_m_per_s = 1} ~> allowed: rate_deg_per_s, rate_rad_per_s
drive = {type = "TableDrive", times_s = [0, 1], extensions_mm = [0, 1]} ~> extensions_deg
== OIL
oil_length_mm = {value = 500, from = -1, to = 800} -> oil_length_mm.from = -1: allowed: > 0
oil_length_mm = {value = 900, from = 300, to = 800} ~> oil_length_mm.value = 900: allowed: from 300
damping_time_s = 1e-3 -> damping_time_s: there is no such key any more; allowed: a line
oil_length_mm = {valeu = 1} -> oil_length_mm.valeu: unknown key; did you mean 'value'?
== SUPPORT
start_hinge_height_mm = 1800 => start_hinge_height_mm = 5000 ~> start_hinge_height = 5.0 m:
mass_kg = 400 => mas_kg = 400 -> parts.front_link[0].mas_kg: unknown key; did you mean 'mass_kg'
centre_mm = [899, 2252] => ~> parts.canopy[1]: centre_mm or between: missing
"front_base", "front_sh => "front_base", "now ~> parts.front_link[0].between =
[595, 619] => [595] -> pivots_mm.front_base = [595]: allowed: a list of 2, each a number
[595, 619] => [595, 1e34] ~> pivots_mm.front_base[1] = 1E+34: allowed: a number up to 1e+30, in SI
[pivots_mm] => [pivots_mm ~> line 6: '[pivots_mm':
rod_mass_kg = 200 => -> columns.front_column.rod_mass_kg: missing
[columns.front_column] => [[columns]] -> columns =
== OURS
[0, 380] => [0] -> pivots_mm.rear_base = [0]: allowed: a list of 2
rear_shield = => rear_sheild = -> pivots_mm.rear_sheild: unknown key; did you mean 'rear_shield'
tip = [3900, 2650] => -> pivots_mm.tip: missing; it has no default: foremost point
canopy = 5200 => canopy = -5200 -> masses_kg.canopy = -5200: allowed: > 0
kind = "four_column_support" => -> kind: missing; it says what the machine is
"a support of ours" => 3 -> name = 3: allowed: a text
stroke_mm = 600 => stroke_mm = 600; stroke_m = 1 -> stroke_m: is given twice, stroke_mm says
= 900 => = {value = 900, from = 950, to = 1200} ~> rear_link.value = 900: allowed: from 950 to 1200
= 900 => = {value = 900, from = 1200, to = 800} ~> rear_link.from = 1200: allowed: <= to = 800
= 900 => = {value = 900, source = " "} -> rear_link.source = ' ': allowed: a text that is not empty
= 900 => = {value = 900, from = 800} -> rear_link.to: missing; a range has from and to
= 900 => = {from = 800, to = 1000, source = "a"} -> masses_kg.rear_link.value: missing
== CRANK_ROCKER
bar = ["O", "A"] => bar = ["O", "Q"] ~> bodies.crank.bar = 'Q': drawing_mm has no such point
bar = ["O", "A"]; length_mm = 100 => ~> bodies.crank.centre_mm: missing
bar = ["O", "A"] => ~> bodies.crank.length_mm: is of a bar
mass_kg = 3 => mass_kg = 3; centre_mm = [200, 0] ~> bodies.coupler.inertia_kg_m2: missing
["ground", "crank"] => ["floor", "crank"] ~> pins.O = 'floor': there is no such body
["ground", "crank"] => ["crank", "crank"] ~> two different bodies
["ground", "crank"] => ["ground"] -> pins.O = ['ground']: allowed: a list of 2, each a text
at = "B" => at = "C" ~> pins.B.at = 'C': bodies.coupler, which has a frame of its own,
motor = "crank" => motor = "crank"; b = "rocker" ~> cranks.motor, cranks.b: too many drives, 2
tip = [ => crank = [ ~> traced_points.crank: bodies.crank has this
{ crank = 0 } => { krank = 0 } ~> start.angle_deg = 'krank': there is no such body; did you mean 'crank'?
length_mm = 400 => length_mm = 40 ~> does not close
== ON_A_GUIDE
body = "slider" => body = "slider"; on = "slider" ~> guides.guide.on = 'slider': is what slides
"A"; block => "Z"; block ~> guides.guide.through = 'Z': drawing_mm has no such point
block_mm => along = ["A", "C"]; block_mm ~> guides.guide.along and guides.guide.through
angle_deg = { crank = 30 } => angle_deg = { crank = 30 }; angular_velocity_rad_per_s = { crank = 150, rod = 7 }
    ~> crank = 150 rad/s, rod = 7 rad/s: the joints do not allow them
== GEARED
{ wheel = 10 } => { wheel = 10, pinion = 10 } ~> wheel .. pinion
== LOADED
"coupler"]; at = ["O => "cupler"]; at = ["O ~> no such body; did you mean 'coupler'?
at = ["O", "M"] => at = ["Z", "M"] ~> springs.between.at[0] = 'Z'
"rocker"]; stiff => "rock"]; stiff ~> twist.bodies = 'rock': there is no such body
body = "rocker"; torque => body = "rock"; torque ~> torques.pull.body = 'rock': there is no such body
[torques.pull] => [torques.push] ~> forces.push: torques.push has this name
== JournalBearing
bore_radius_mm = 60; clearance_mm = -1 ~> clearance_mm = -1: allowed: > 0
bore_radius_mm = 60; clearance = 1 ~> clearance: is written with its unit
bore_radius_mm = 60 ~> clearance_mm: missing; it has no default
bore_radius_mm = 60; clearance_mm = 1; clearance_m = 1e-3
    ~> clearance_m: is given twice, clearance_mm says the same; allowed: one of them
bore_radius_mm = 60; clearence_mm = 1 ~> clearence_mm: unknown key
bore_radius_mm = 60; clearance_mm = true ~> clearance_mm = true
bore_radius_mm = 60; clearance_mm = 60 ~> clearance = 0.06 m
== JournalContact
normal = {type = "Hertz", stiffness_N_per_m_to_n = 1e10}; bearing = {bore_radius_mm = 60, clearance_mm = 60}
    ~> bearing: clearance = 0.06 m: leaves no journal
normal = {type = "LankaraniNikravesh", restitution = 1.5} ~> normal.restitution = 1.5: allowed: >= 0 and <= 1
== Drive
stroke_mm = 1 ~> type: missing; allowed: .. CubicStep
type = "CubicStp" ~> type = 'CubicStp': did you mean 'CubicStep'? allowed:
== Part
mass_kg = 1; centre_mm = [1, inf] ~> centre_mm[1] = Infinity: allowed: a number
mass_kg = 1; centre_mm = 3 ~> centre_mm = 3: allowed: a list of 2, each a number
mass_kg = 1; centre_mm = [1, 1]; name = 1 ~> name = 1: allowed: a text
== Width
lengths_mm = {pin = 0} ~> lengths_mm.pin = 0: allowed: > 0
== Sheave
radius_m = 1; force = 3 ~> force: a number needs its unit in the key
radius_m = 1; whole = 1 ~> whole = 1: allowed: true, false
radius_m = 1; grooves = [1, 1.5] ~> grooves[1] = 1.5: allowed: a whole number
radius_m = 1e-31 ~> radius_m = 1E-31: Input should be a number not so near to zero
== LuGre
static_coefficient = 0.1; sliding_coefficient = 0.2 ~> static_coefficient = 0.1
"""


def rows() -> Iterator[tuple[str, str, str, str]]:
    """Name of the file, input, arrow, message."""
    name = ""
    for line in TABLE.strip().replace("\n    ", " ").splitlines():
        if line.startswith("== "):
            name = line[3:]
        else:
            arrow = "~>" if " ~> " in line else "->"
            given, _, message = line.partition(f" {arrow} ")
            yield name, given.replace("; ", "\n"), arrow, message


@pytest.mark.parametrize(("name", "given", "arrow", "message"), list(rows()))
def test_a_mistake_is_answered(tmp_path: Path, name: str, given: str, arrow: str, message: str) -> None:
    path = tmp_path / "file.toml"
    for drive, columns in DRIVES.items():
        (tmp_path / drive).write_text(columns, encoding="utf-8")
    if name in SCENARIOS:
        text = SCENARIOS[name] + given
        if "laws.py:Bad" in text:
            module = f"own_laws_{abs(hash(text))}.py"  # of which a process knows one by each name
            (tmp_path / module).write_text(LAWS.format("Bad"), encoding="utf-8")
            trusted(tmp_path / module)
            text = text.replace("laws.py", module)
        with pytest.raises(InputError) as caught:
            scenario_of(parsed(text, str(path)), str(path), tmp_path)
    elif name in CLASSES:
        with pytest.raises(InputError) as caught:
            read_value(CLASSES[name], parsed(given, str(path)), str(path))
    else:
        old, new = (part.strip() for part in f"{given} ".split(" => "))
        assert old in MACHINES[name]
        text = MACHINES[name].replace(old, new, 1)
        path.write_text(text, encoding="utf-8")
        with pytest.raises(InputError) as caught:
            load_machine(path)
    named = tmp_path / message.partition(":")[0] if message.startswith(tuple(DRIVES)) else path
    assert str(caught.value).startswith(f"{named}: ")
    for fragment in message.split(" .. "):
        assert fragment in str(caught.value)
    if name not in CLASSES and not message.startswith("line "):
        table = plain(parsed(text, "a"))
        validators = SCHEMAS["scenario" if name in SCENARIOS else "machine"]
        assert [validator.is_valid(table) for validator in validators] == [arrow == "~>"] * 2


def test_several_mistakes_are_reported_at_once() -> None:
    text = (
        SCENARIOS["PIN"].replace("1.5", "-1") + "frction = 0.1\n[drive]\nmode = 3\n[solver]\nimpact_steps = 1\n"
    )
    with pytest.raises(InputError) as caught:
        scenario_of(parsed(text, "a.toml"), "a.toml", Path())
    keys = {line.split(": ")[1].split(" = ")[0] for line in str(caught.value).splitlines()}
    pin = {"pins.rear_base.clearance_mm", "pins.rear_base.frction"}
    assert keys == {*pin, "drive.mode", "solver.impact_steps"}
