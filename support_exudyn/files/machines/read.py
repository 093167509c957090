"""Machine data files are read into machines here, and have their JSON Schema.

A further kind of machine is a class of values with a method `data`, whose fields are what its files hold, and a
line in `FILES`. It is imported when a file of its kind is read.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from importlib import import_module, resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from support_exudyn.files.toml.reading import read_value
from support_exudyn.files.toml.schema import Schemas
from support_exudyn.files.toml.text import parsed, text_of
from support_exudyn.files.whole_file import missing_file
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.actuators import CylinderAndRod, OilColumn, RigidActuator
from support_exudyn.model.machine import Machine
from user_forces.values.names import meant, nearest
from user_forces.values.places import keep_classes
from user_forces.values.sourced import SourcedNumber
from user_forces.values.value import InputError, short

if TYPE_CHECKING:
    from support_exudyn.files.machines.linkage import LinkageFile
    from support_exudyn.files.machines.slider_crank import SliderCrankFile
    from support_exudyn.files.machines.supports import FourColumnSupportFile, TwoLegShieldFile
    from support_exudyn.machines.four_column_support import HydraulicSupport

    MachineFile = FourColumnSupportFile | TwoLegShieldFile | SliderCrankFile | LinkageFile

FILES: Mapping[str, tuple[str, str]] = {  # by kind: module and class
    "four_column_support": (".supports", "FourColumnSupportFile"),
    "two_leg_shield": (".supports", "TwoLegShieldFile"),
    "slider_crank": (".slider_crank", "SliderCrankFile"),
    "linkage": (".linkage", "LinkageFile"),
}
for _module, _name in FILES.values():
    keep_classes(__package__, {_module: (_name,)})
SHIPPED = (  # each a data file
    "reference",
    "zf18000",
    "two_leg_shield",
    "slider_crank",
    "crank_rocker",
    "watt_six_bar",
    "slider_crank_guide",
    "toggle_press",
    "excavator_bucket",
    "velenje_shield",
)
REMEMBERED = 8  # machines that are not read again as long as their text is the same


def read_machine(name: str, folder: Path | None = None) -> MachineData:
    """A machine from its data file.

    name: a path that ends in .toml, from `folder` on (the working directory); or the name of a machine that
    comes with the package, one of `SHIPPED`.

    Raises InputError that names file, key, value and what is allowed; OSError if there is no such file.
    """
    if not name.lower().endswith(".toml"):
        return shipped(name)
    return load_machine((folder or Path()) / name, named=folder is not None)


def machine(name: str | Path) -> Machine:
    """A machine by the name of one that comes with the package, or by the path of its data file.

    Arguments and errors as of `load_machine`, which also gives the radii of the bores.
    """
    return load_machine(name).machine


def load_machine(path: str | Path, named: bool = False) -> MachineData:
    """Read a machine data file of any kind into SI.

    Arguments:
        path: of the file; or the name of a machine that comes with the package, one of `SHIPPED`.
        named: by another file, see `load_toml`.

    Raises InputError, naming file, key, value and what is allowed, for anything that does not fit;
    FileNotFoundError if there is no file.
    """
    if str(path) in SHIPPED and not named:
        return shipped(str(path))
    path = Path(path)
    try:
        text = text_of(path)
    except FileNotFoundError as error:
        raise missing_file(path, f"a machine data file, or one of {', '.join(SHIPPED)}", SHIPPED) from error
    try:
        found = _of_text(text)
    except InputError as error:
        if str(error).startswith(": "):  # no TOML: the message of a text without a name says no line
            parsed(text, str(path), named)
        raise InputError("\n".join(f"{path}: {line}" for line in str(error).splitlines())) from None
    return found if found.name else replace(found, name=path.stem)


@lru_cache(maxsize=REMEMBERED)
def _of_text(text: str) -> MachineData:
    """The machine that a data file of this text describes.

    The same text gives the same value, which remembers what motions it was found to follow: the scenarios of a
    sweep ask for that again and again, and finding it takes longer than a short run.
    """
    data = parsed(text, "")
    sourced: dict[str, SourcedNumber] = {}
    file = read_value(_file_of(_kind(data)), data, sourced=sourced)
    named = {key: replace(one, source=file.sources.get(one.source, one.source)) for key, one in sourced.items()}
    return replace(file.data(), sourced=named)


def shipped(name: str) -> MachineData:
    """A machine that comes with the package, by its name in `SHIPPED`.

    Raises InputError if there is none of this name.
    """
    if name not in SHIPPED:
        raise InputError(
            f"machine = {short(name)}: there is none of this name; allowed: a file that ends in .toml, "
            f"or one of {', '.join(SHIPPED)}; {meant(name, SHIPPED)}"
        )
    with resources.as_file(resources.files(__package__) / f"{name}.toml") as path:
        return load_machine(path)


def reference_support() -> HydraulicSupport:
    """The reference support that comes with the package."""
    return cast("HydraulicSupport", shipped("reference").machine)


def cylinders_and_rods(
    drive: RigidActuator | OilColumn | None = None, path: str | Path | None = None
) -> dict[str, CylinderAndRod]:
    """Columns with mass, by name, for `Scenario.actuators`: cylinder and rod, uniform bars from their pins on.

    Arguments:
        drive: what holds their lengths; rigid if nothing is said.
        path: of the machine data file whose `[columns.NAME]` say masses and lengths, or the name of a machine
            that comes with the package; by default "reference".

    Raises as `load_machine` does.
    """
    columns = load_machine("reference" if path is None else path).actuators
    return dict(columns) if drive is None else {k: replace(item, drive=drive) for k, item in columns.items()}


def machine_schema() -> dict[str, Any]:
    """The JSON Schema (2020-12) of machine data files, which are told apart by their key `kind`."""
    schemas = Schemas()
    tables = []
    for kind in map(_file_of, FILES):
        schemas.defs[kind.__name__] = schemas.table(kind, typed=False)
        tables.append(schemas.value(kind))
    about = "Bodies, pivots and masses of one machine; mm, kg and degrees are usual."
    top = {"description": about, "type": "object", "required": ["kind"], "oneOf": tables}
    return schemas.whole("machine of support-exudyn", top)


def _file_of(kind: str) -> type[MachineFile]:
    """The class of the files of a kind of machine."""
    module, name = FILES[kind]
    return cast("type[MachineFile]", getattr(import_module(module, __package__), name))


def _kind(data: dict[str, Any]) -> str:
    allowed = f"allowed: {', '.join(map(repr, FILES))}"
    if "kind" not in data and "machine" in data:
        raise InputError(
            f"machine = {short(data['machine'])}: is a key of scenarios, which `run` takes; allowed: "
            "the file of a machine, which says its kind"
        )
    if "kind" not in data:
        raise InputError(f"kind: missing; it says what the machine is; {allowed}")
    kind = data["kind"]
    if not isinstance(kind, str) or kind not in FILES:
        raise InputError(f"kind = {short(kind)}: {nearest(str(kind), FILES)}")
    return kind
