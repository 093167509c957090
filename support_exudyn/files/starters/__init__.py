"""Sets of files to start from: a machine, scenarios and a sweep, which run as they are.

The files lie here as KIND.NAME, modules of Python as KIND.NAME.txt; those of machines that come with the
package are copied from there.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from support_exudyn.files.whole_file import whole_file
from user_forces.values.value import InputError, short

HERE = Path(__file__).parent
MACHINES = HERE.parent / "machines"
# by kind: what it is, and where machine.toml comes from if it is one of the package
KINDS: Mapping[str, tuple[str, Path | None]] = MappingProxyType(
    {
        "four_column_support": ("a hydraulic support with front and rear columns", None),
        "two_leg_shield": ("a shield with two legs and a ram", MACHINES / "two_leg_shield.toml"),
        "slider_crank": ("a slider-crank whose slider pin has clearance", MACHINES / "slider_crank.toml"),
        "linkage": ("any planar linkage: a crank-rocker to change", MACHINES / "crank_rocker.toml"),
        "own_law": ("a contact law and a friction law of your own, in Python", None),
        "own_machine": ("a machine of your own, in Python: a four-bar crank-rocker", None),
    }
)


def starter(kind: str) -> Mapping[str, str]:
    """The texts of a set's files, by file name.

    Arguments:
        kind: one of `KINDS`.

    Raises InputError if there is no such kind.
    """
    if kind not in KINDS:
        raise InputError(f"KIND = {short(kind)}: there is none of this name; allowed: {', '.join(KINDS)}")
    prefix, machine = f"{kind}.", KINDS[kind][1]
    found = {
        path.name.removeprefix(prefix).removesuffix(".txt"): path.read_text(encoding="utf-8")
        for path in sorted(HERE.glob(f"{prefix}*"))
    }
    return found if machine is None else {"machine.toml": machine.read_text(encoding="utf-8"), **found}


def write_starter(kind: str, folder: Path) -> list[Path]:
    """Write a set of files into a folder, which is made if it is missing.

    Arguments:
        kind: one of `KINDS`.
        folder: where the files go.

    Returns the paths of the files.

    Raises InputError if there is no such kind, or if the folder has one of the files: nothing is replaced.
    """
    texts = starter(kind)
    there = [name for name in texts if (folder / name).exists()]
    if there:
        raise InputError(
            f"{folder / there[0]}: is there already, and nothing is replaced; allowed: another folder by --out"
        )
    for name, text in texts.items():
        with whole_file(folder / name) as temporary:
            temporary.write_text(text, encoding="utf-8")
    return [folder / name for name in texts]
