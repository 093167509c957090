"""Kernels: plain functions of numbers that Python runs and numba compiles.

A kernel is written once, with `if`, `math` and other kernels. Python calls it as it stands; compiled code
calls the same function. Numba is imported with the first function that is compiled, not with the kernels.
"""

from __future__ import annotations

import hashlib
import math
import re
import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from inspect import Parameter, signature
from types import CodeType, FunctionType
from typing import Any, NamedTuple, TypeVar

import numpy as np

from user_forces.values.value import InputError

Function = TypeVar("Function", bound=Callable[..., Any])
KERNELS: list[Callable[..., Any]] = []  # that numba does not know yet, as long as nothing is compiled
MARK = "is_kernel"  # attribute of a function that is a kernel
NUMBERS = (int, float, bool, str, type(None), tuple)
_lock = threading.RLock()
_is_prepared: list[bool] = []  # filled when numba is imported


def kernel(function: Function) -> Function:
    """Decorator: a function of numbers that compiled code may call; Python continues to call it as it is.

    Symbols of machine code follow from qualified names. Functions that differ in their closure alone share
    them, and machine code that processes have kept apart would be mixed up where it is loaded together.
    """
    if not getattr(function, MARK, False):
        setattr(function, MARK, True)
        if isinstance(function, FunctionType) and (function.__closure__ or not _is_ours(function)):
            function.__qualname__ = f"{function.__qualname__}_{name_of(function)}"
        KERNELS.append(function)
        if _is_prepared:
            prepare()
    return function


def _is_ours(function: FunctionType) -> bool:
    return (function.__module__ or "").partition(".")[0] in ("user_forces", "support_exudyn")


def name_of(function: Callable[..., Any]) -> str:
    """A name that differs where the code of the function, or of any function that it reaches, differs."""
    digest = hashlib.sha256()
    _add_code(function, digest, set())
    return f"{function.__name__.partition('_k')[0]}_k{digest.hexdigest()[:20]}"


def _add_code(item: Any, digest: Any, seen: set[int]) -> None:
    """Add to a digest the code of a function and of those that it reaches by closure or global names.

    The code is that in memory, which a file that has changed since need not have.
    """
    if not isinstance(item, FunctionType):
        text = repr(item) if isinstance(item, NUMBERS) else type(item).__name__
        digest.update(f"{text};".encode())
        return
    if id(item) in seen:
        return
    seen.add(id(item))
    digest.update(f"{item.__module__}.{item.__name__};".encode())
    _add_constants(item.__code__, digest)
    for cell in item.__closure__ or ():
        _add_code(cell.cell_contents, digest, seen)
    for name in item.__code__.co_names:
        if name in item.__globals__:
            _add_code(item.__globals__[name], digest, seen)


def _add_constants(code: CodeType, digest: Any) -> None:
    digest.update(code.co_code)
    for item in code.co_consts:
        if isinstance(item, CodeType):
            _add_constants(item, digest)
        else:
            digest.update(f"{item!r};".encode())


@kernel
def limited(x: float, lowest: float, highest: float) -> float:
    """A number that is not outside of two limits, which NaN passes."""
    if x < lowest:
        return lowest
    return highest if x > highest else x


@kernel
def sign(x: float) -> float:
    """The sign of a number, -1, 0 or 1."""
    if x > 0.0:
        return 1.0
    return -1.0 if x < 0.0 else 0.0


@kernel
def smooth_step(x: float) -> float:
    """The cubic STEP from 0 at x = 0 to 1 at x = 1, constant beyond: x^2 (3 - 2 x)."""
    inside = limited(x, 0.0, 1.0)
    return inside * inside * (3.0 - 2.0 * inside)


class Formula(NamedTuple):
    """A function of numbers, and the parameters that it takes last."""

    function: Callable[..., Any]
    parameters: tuple[float, ...] = ()

    def __call__(self, *arguments: float) -> Any:
        """The function's value."""
        return self.function(*arguments, *self.parameters)

    def at_rest(self) -> Formula:
        """The force of a normal law at rest, as a function of the indentation alone."""
        return Formula(_at_rest(self.function), self.parameters)


def formula_of(owner: object, function: Callable[..., Any], variables: int) -> Formula:
    """A function of numbers whose last arguments are named as attributes of its owner.

    Arguments:
        owner: the law or load.
        function: of so many variables, which come first, and of parameters; a last one, `*name`, is a tuple.
        variables: their number.
    """
    given: list[float] = []
    for name, parameter in list(signature(function).parameters.items())[variables:]:
        known = getattr(owner, name)
        given += known if parameter.kind is Parameter.VAR_POSITIONAL else [known]
    return Formula(kernel(function), tuple(map(float, given)))


def refuse_methods(law: type[object], functions: Mapping[str, str]) -> None:
    """Raise InputError if a law overrides a method that follows from a function of numbers.

    functions: names of such functions, by those of the methods.
    """
    for method, function in functions.items():
        if method in vars(law):
            raise InputError(
                f"class {law.__name__}: {method}: follows from a function of numbers; allowed: a static method "
                f"`{function}` in its place"
            )


@cache
def _at_rest(force: Callable[..., float]) -> Callable[..., float]:
    def elastic(depth: float, *parameters: float) -> float:
        return force(depth, 0.0, 1.0, *parameters)

    return kernel(elastic)


def quadrature(elastic: Formula) -> Formula:
    """The integral of a force over the indentation, by Gauss's rule in its fourth root."""
    return Formula(_quadrature(elastic.function), elastic.parameters)


NODES, WEIGHTS = (tuple(part.tolist()) for part in np.polynomial.legendre.leggauss(24))


@cache
def _quadrature(elastic: Callable[..., float]) -> Callable[..., float]:
    def energy(depth: float, *parameters: float) -> float:
        total = 0.0
        for n in range(len(NODES)):
            share = 0.5 * (NODES[n] + 1.0)
            total += WEIGHTS[n] * share**3 * elastic(depth * share**4, *parameters)
        return 2.0 * depth * total

    return kernel(energy)


def numbers(constants: Sequence[float], first: int, count: int) -> tuple[float, ...]:
    """So many of the constants as a tuple, from a place on; compiled, the count is known beforehand."""
    return tuple(constants[first : first + count])


def prepare() -> Any:
    """Import numba, let it know all kernels, and return it."""
    import numba

    with _lock:
        _teach_numbers()
        _is_prepared.append(True)
        while KERNELS:
            numba.extending.register_jitable(error_model="numpy")(KERNELS.pop())
    return numba


@cache
def _teach_numbers() -> None:
    """Let compiled code take numbers from an array: a tuple whose length is part of its type."""
    import numba
    from numba.np.unsafe.ndarray import to_fixed_tuple

    @numba.extending.overload(numbers)
    def of_array(constants, first, count):  # type: ignore[no-untyped-def] # numba compares signatures
        if not isinstance(count, numba.types.IntegerLiteral):
            return None
        length = count.literal_value

        def taken(constants, first, count):  # type: ignore[no-untyped-def]
            return to_fixed_tuple(constants[first:], length)

        taken.__qualname__ = f"{length}_numbers"  # so that machine code for other lengths has another name
        return taken


def compiled_or_plain(function: Function, arguments: tuple[Any, ...]) -> Function:
    """A function compiled by numba for arguments of these types, for calls from Python.

    Machine code is kept on disk, under a name that follows from the code of all kernels in the closure. A
    function that numba cannot compile comes back as it is, with a warning.
    """
    numba = prepare()
    types, same = tuple(map(numba.typeof, arguments)), copied(function)
    options = {"error_model": "numpy", "nogil": True}
    try:
        try:
            return numba.njit(types, cache=True, **options)(same)  # type: ignore[no-any-return]
        except (RuntimeError, ImportError):  # files may be written nowhere, or kept code has no module now
            return numba.njit(types, **options)(same)  # type: ignore[no-any-return]
    except Exception as error:  # numba evaluates parts of a function itself, which raise errors of any kind
        warnings.warn(f"computed in Python, since numba cannot compile it: {reason(error)}", stacklevel=2)
        return function


CAUSES = ("Unknown", "Use of", "Untyped", "Cannot", "Invalid", "No implementation", "Unsupported", "NameError")


def reason(error: Exception) -> str:
    """Why numba cannot compile a function, in a line without colours: the innermost cause that it names."""
    lines = [re.sub(r"\x1b\[\d+m", "", line).strip(" -") for line in str(error).splitlines()]
    causes = [line for line in lines if line.startswith(CAUSES)]
    return (causes or [line for line in lines if line] or [type(error).__name__])[-1 if causes else 0]


def copied(function: Function) -> Function:
    """The same function under a name of its own, see `name_of`, by which machine code is kept."""
    assert isinstance(function, FunctionType)
    name = name_of(function)
    same = FunctionType(
        function.__code__, function.__globals__, name, function.__defaults__, function.__closure__
    )
    same.__qualname__ = name
    return same  # type: ignore[return-value]


@kernel
def is_finite(x: float) -> bool:
    """Whether a number is neither infinite nor NaN."""
    return -math.inf < x < math.inf
