"""How functions of numbers are compiled by numba: the same numbers in every process, kept on disk."""

import hashlib
import math
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
from filelock import FileLock
from llvmlite import ir
from numba.extending import intrinsic

from support_exudyn.model.hydraulics import elements
from support_exudyn.model.loads.load import ActingLoad
from user_forces import contact
from user_forces.kernel import copied, numbers, prepare, reason

SECONDS = {"compiled": 30}  # that compiling takes
COMPILED = ("scene", "formulations/compiled", "formulations/statistics")  # folders with compiled functions
CONSTANTS_OF = (elements,)  # modules of which compiled functions use constants
UNCOUNTED = {"_nrt": False}  # numba then counts no references to arrays, which takes most of the time else
prepare()  # kernels are known to numba from now on
Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Decorator: compile a function that is called from compiled functions only.

    Divisions by zero give inf or nan, which the integrator looks for. No fast-math: results are the same bit
    for bit from run to run.
    """
    return _inner(function)


def inlined(function: Function) -> Function:
    """Decorator: compile a formula as `compiled` does, and put its code where it is called.

    That makes the right-hand side twice as fast. Of larger functions it would only make compiling slower.
    """
    return _inner(function, forceinline=True)


def once(function: Function) -> Function:
    """Decorator: a function that is called in one place is compiled as part of what calls it.

    Of a function that is compiled by itself, numba also writes the call and all its arguments.
    """
    return numba.njit(error_model="numpy", inline="always", **UNCOUNTED)(function)  # type: ignore[no-any-return]


def _inner(function: Function, **options: Any) -> Function:
    """Not kept on disk, where those that Python calls hold its code; that would take a tenth of the time.

    Without the wrappers for calls from Python and C, which take a third of it.
    """
    options |= {"no_cpython_wrapper": True, "no_cfunc_wrapper": True} | UNCOUNTED
    return numba.njit(error_model="numpy", **options)(function)  # type: ignore[no-any-return]


def entry(function: Function) -> Function:
    """Decorator: compile a function that Python calls, at its first call, or load it from disk.

    Other threads of Python go on meanwhile.
    """
    options = {"nogil": True, "no_cfunc_wrapper": True} | UNCOUNTED  # nothing in C calls it
    try:
        dispatcher: Any = numba.njit(cache=True, error_model="numpy", **options)(function)
        kept = _is_kept_only_while_unchanged(dispatcher)
    except RuntimeError:  # neither beside the program nor in a home may files be written: compiled each time
        kept = False
    if not kept:
        dispatcher = numba.njit(error_model="numpy", **options)(function)
    return dispatcher  # type: ignore[no-any-return]


def source_files() -> list[Path]:
    """The files that compiled code comes from."""
    package = Path(__file__).parents[1]
    files = sorted(file for folder in COMPILED for file in (package / folder).rglob("*.py"))
    kernels = sorted(Path(str(contact.__file__)).parent.glob("*.py"))
    return [*files, *kernels, *(Path(str(module.__file__)) for module in CONSTANTS_OF)]


def _source_stamp() -> tuple[str, int]:
    """What identifies the compiled code: a hash of all files that it comes from, and their length."""
    text = b"".join(file.read_bytes() for file in source_files())
    return hashlib.sha256(text).hexdigest(), len(text)


STAMP = _source_stamp()


def _is_kept_only_while_unchanged(dispatcher: Any) -> bool:
    """Let compiled code on disk be used only as long as no file that it may come from has changed.

    By itself numba looks at the file of the function alone, and would go on using old code of functions that it
    calls from other files. It has no public way to tell it; without this nothing is kept on disk. The stamp
    stands in the version too: that is looked at before anything else of a kept file is read, which may name
    classes that are no longer there.
    """
    kept: Any = getattr(getattr(dispatcher, "_cache", None), "_cache_file", None)
    if not (hasattr(kept, "_source_stamp") and hasattr(kept, "_version")):
        return False
    kept._source_stamp = STAMP
    kept._version = f"{kept._version}, {STAMP[0]}"
    _one_process_at_a_time(dispatcher)
    return True


def _one_process_at_a_time(dispatcher: Any) -> None:
    """Let processes that need a function at the same time wait for the first, and load what it has compiled."""
    kept: Any = dispatcher._cache
    load, save = kept.load_overload, kept.save_overload
    locks: list[FileLock] = []

    def release() -> None:
        while locks:
            locks.pop().release()

    def load_or_wait(signature: Any, target: Any) -> Any:
        found = load(signature, target)
        if found is None:
            locks.extend(_lock(Path(kept.cache_path), dispatcher.__name__))
            found = load(signature, target)
            if found is None:
                _tell(dispatcher.py_func.__module__)
            else:
                release()
        return found

    def save_and_release(signature: Any, made: Any) -> None:
        try:
            save(signature, made)
        finally:
            release()

    kept.load_overload, kept.save_overload = load_or_wait, save_and_release


def _lock(folder: Path, name: str) -> list[FileLock]:
    """A lock on a function that one process has until it releases it; empty where there are no locks."""
    with suppress(OSError, NotImplementedError):  # a folder that is not written to, a disk without locks
        folder.mkdir(parents=True, exist_ok=True)
        lock = FileLock(folder / f"{name}.lock", thread_local=False)
        lock.acquire()
        return [lock]
    return []


@cache
def _tell(module: str) -> None:
    """Tell why nothing moves."""
    said = next((name for name in SECONDS if name in module.split(".")), None)
    if said is not None and sys.stderr is not None:
        what = said.replace("_", " ")
        print(f"compiling ({what}), once on this machine: about {SECONDS[said]} s", file=sys.stderr)


NUMBER = numba.types.float64
NUMBERS = 5  # that a law takes besides constants and out
LAW = NUMBER(*NUMBERS * (NUMBER,), *2 * (numba.types.CPointer(NUMBER),))


def address_of(law: Callable[..., float]) -> int:
    """Address of the machine code of a function, which is what `call_law` takes.

    Arguments:
        law: of five numbers and of two pointers, constants and out, with kernels in its closure.

    Machine code is kept on disk by a name that comes from the code of all kernels; without that it takes half a
    second. Raises UncompiledLawError if numba cannot compile the function.
    """
    return int(_machine_code(law).address)


class UncompiledLawError(TypeError):
    """A law or load that numba cannot compile."""


@cache
def _machine_code(law: Callable[..., float]) -> Any:
    """The compiled law; of processes and threads that need one at the same time, one compiles it."""
    same = copied(law)
    locks = _lock(Path(tempfile.gettempdir()) / "support_exudyn", "laws")
    try:
        try:
            return numba.cfunc(LAW, cache=True, error_model="numpy")(same)
        except (RuntimeError, ImportError):  # files may be written nowhere, or kept code has no module now
            return numba.cfunc(LAW, error_model="numpy")(same)
    except Exception as error:  # numba evaluates parts of a function itself, which raise errors of any kind
        raise UncompiledLawError(f"numba cannot compile it: {reason(error)}") from error
    finally:
        for lock in locks:
            lock.release()


@cache
def contact_law(law: Callable[..., Any], count: int) -> Callable[..., float]:
    """The laws of a contact for `call_law`, from `Contact.law_kernel`, whose constants are so many.

    It gives the normal force [N] that the normal law asks for, and writes the friction force [N], the elastic
    force [N] and the rate of the friction law's state [m/s] into out.
    """

    def contact(
        depth: float, rate: float, slip: float, speed: float, deflection: float, constants: Any, out: Any
    ) -> float:
        results = numba.carray(out, 3)
        try:
            asked, elastic, friction, bends = law(
                depth, rate, slip, speed, deflection, numba.carray(constants, count)
            )
        except Exception:  # else machine code would go on with any number
            asked, elastic, friction, bends = math.nan, math.nan, math.nan, math.nan
        results[0], results[1], results[2] = friction, elastic, bends
        return float(asked)

    return contact


@cache
def joint_friction(
    force: Callable[..., float], of_force: int, rate: Callable[..., float] | None, of_rate: int
) -> Callable[..., float]:
    """A friction law for `call_law`, `depth` being the normal force [N], from its functions of numbers.

    It gives the friction force [N], and writes the rate of a law's state [m/s] into out.
    """
    if rate is None:

        def friction(
            normal: float, _: float, slip: float, __: float, deflection: float, constants: Any, out: Any
        ) -> float:
            return force(slip, normal, *numbers(numba.carray(constants, of_force), 0, of_force))

        return friction

    def friction_with_state(
        normal: float, _: float, slip: float, __: float, deflection: float, constants: Any, out: Any
    ) -> float:
        given = numba.carray(constants, of_force + of_rate)
        results = numba.carray(out, 1)
        results[0] = rate(deflection, slip, *numbers(given, of_force, of_rate))
        return force(slip, normal, deflection, *numbers(given, 0, of_force))

    return friction_with_state


def load_law(load: ActingLoad) -> tuple[Callable[..., float], tuple[float, ...]]:
    """The action of a load for `call_law`, and its constants.

    It takes the first five numbers of the motion, and the others and the values of courses from out.
    """
    action, own = load.formula
    motion = len(load.MOTION._fields)
    extra = max(0, motion - NUMBERS) + len(load.courses)
    return action_law(action, min(motion, NUMBERS), extra, len(own), load.FORCES + 2), own


@cache
def action_law(
    action: Callable[..., tuple[float, ...]], arguments: int, extra: int, count: int, results: int
) -> Callable[..., float]:
    """An action for `call_law`: it gives the first number of the action, and writes those behind it into out.

    Arguments:
        action: of plain numbers.
        arguments: how many of the five numbers it takes first.
        extra: how many it takes then, which stand in out.
        count: of its parameters, which it takes last.
        results: how many of its numbers are written into out.
    """
    room = max(extra, results)

    def law(
        first: float, second: float, third: float, fourth: float, fifth: float, constants: Any, out: Any
    ) -> float:
        others = numba.carray(out, room)
        found: tuple[float, ...] = action(
            *(first, second, third, fourth, fifth)[:arguments],
            *numbers(others, 0, extra),
            *numbers(numba.carray(constants, count), 0, count),
        )
        for i in range(results):
            others[i] = found[1 + i]
        return found[0]

    return law


@intrinsic  # type: ignore[untyped-decorator]
def call_law(
    context: Any,
    address: Any,
    depth: Any,
    rate: Any,
    slip: Any,
    speed: Any,
    deflection: Any,
    constants: Any,
    out: Any,
) -> Any:
    """What the law at an address gives, which is a whole number in a float; for compiled functions.

    The other arguments are those of `contact_law`, constants and out contiguous arrays of floats.
    """

    def build(target: Any, builder: Any, signature: Any, values: Any) -> Any:
        numbers, arrays = values[1:6], zip(signature.args[6:], values[6:], strict=True)
        places = [target.make_array(kind)(target, builder, array).data for kind, array in arrays]
        double = ir.DoubleType()
        law = ir.FunctionType(double, [double] * 5 + [double.as_pointer()] * 2)
        number = builder.fptoui(values[0], ir.IntType(64))
        return builder.call(builder.inttoptr(number, law.as_pointer()), [*numbers, *places])

    return NUMBER(*6 * (NUMBER,), constants, out), build
