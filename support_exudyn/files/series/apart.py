"""Reading in a process of its own, by libraries that end the whole process on some damaged files.

scipy does on MATLAB files of version 5, HDF5 on some without a digest. The process is given no more memory than
is free, and gives its arrays back as bytes: nothing of it is run here.
"""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Numbers
from user_forces.values.value import InputError, cleaned

START = (  # nothing is imported from the working directory
    "import sys; sys.path = [one for one in sys.path if one]; "
    "from support_exudyn.files.series.apart import answer; answer()"
)
LONGEST = 600.0  # seconds, after which reading is given up
TOLD = 300  # letters of what went wrong
Arrays = Iterable[tuple[dict[str, Any], Numbers]]  # what is said of an array, in JSON's words, and the array


def read_apart(function: str, path: Path, kind: str) -> list[tuple[dict[str, Any], Numbers]]:
    """What a function gives for a file, called in another process.

    Arguments:
        function: `module:name`; takes the path, gives `Arrays`.
        path: of the file, which has been looked at: it is a regular one.
        kind: of files, for messages.

    Raises InputError if the function raises, or if its process ends or takes too long.
    """
    command = [sys.executable, "-c", START, function, str(path), str(available() // 2)]
    known = {**os.environ, "PYTHONPATH": os.pathsep.join(one for one in sys.path if one)}
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, env=known, timeout=LONGEST, check=False
        )
    except subprocess.TimeoutExpired:
        raise InputError(f"{path}: reading it took more than {LONGEST:g} s; allowed: a whole {kind}") from None
    first, _, rest = done.stdout.partition(b"\n")
    try:
        told = json.loads(first)
    except ValueError:
        raise InputError(f"{path}: is damaged so that nothing reads it; allowed: a whole {kind}") from None
    if isinstance(told, str):
        raise InputError(f"{path}: is no {kind} that can be read ({cleaned(told)}); allowed: a whole one")
    found, place = [], 0
    for one in told:
        rows, columns = one["shape"]
        end = place + 8 * rows * columns
        found.append((one, np.frombuffer(rest[place:end], dtype=np.float64).reshape(rows, columns)))
        place = end
    return found


def answer() -> None:
    """Call the function that the command line names, and write what it gives, or what is wrong."""
    function, path, memory = sys.argv[1:4]
    _limit(int(memory))
    module, _, name = function.partition(":")
    try:
        arrays = list(getattr(importlib.import_module(module), name)(Path(path)))
        told: Any = [{**said, "shape": values.shape} for said, values in arrays]
    except Exception as error:  # of many libraries, and for people
        arrays, told = [], " ".join(f"{error or type(error).__name__}".split())[:TOLD]
    write = sys.stdout.buffer.write
    write(json.dumps(told).encode() + b"\n")
    for _, values in arrays:
        write(np.ascontiguousarray(values, dtype="<f8").tobytes())


def _limit(memory: int) -> None:
    """Let this process take no more memory [bytes], where the system can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    wanted = memory + 2**31  # with what libraries take of addresses alone
    resource.setrlimit(resource.RLIMIT_AS, (wanted if most < 0 else min(wanted, most), most))
