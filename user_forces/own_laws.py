"""Laws of one's own as functions of numbers.

    @normal_law
    def cubic(depth, rate, impact_velocity, stiffness: float, damping: float = 0.0):
        return stiffness * depth**3 * (1.0 + damping * rate)

    pin_law = cubic(stiffness=1e15)

The function is plain Python, with `if` and `math`; what it calls of one's own has `@kernel` of
`user_forces.kernel`. Its parameters become fields of a class of laws, which has
the function's name in capitals, `Cubic`, in files. A function that numba cannot compile runs on Exudyn.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, TypeVar

from user_forces.friction.law import FrictionLaw
from user_forces.kernel import kernel
from user_forces.normal.law import NormalLaw
from user_forces.values.value import InputError, value

Law = TypeVar("Law", NormalLaw, FrictionLaw)


def normal_law(function: Callable[..., float]) -> type[NormalLaw]:
    """Decorator: the class of normal laws whose force [N] is a function of depth, rate and impact velocity.

    Arguments:
        function: of depth [m] > 0, rate [m/s], impact velocity [m/s], and of parameters, which are numbers. An
            annotation of a parameter is that of the field, `float` by default; a default is the field's.

    The elastic force is the force at no rate, and its energy is integrated numerically.
    """
    return _class_of(function, NormalLaw, ("depth", "rate", "impact_velocity"))  # type: ignore[type-abstract]


def friction_law(function: Callable[..., float]) -> type[FrictionLaw]:
    """Decorator: the class of friction laws whose force [N] is a function of slip and normal force.

    Arguments:
        function: of slip [m/s], normal force [N] >= 0, and of parameters, as of `normal_law`. The force points
            against the slip.
    """
    return _class_of(function, FrictionLaw, ("slip", "normal_force"))  # type: ignore[type-abstract]


def _class_of(function: Callable[..., float], kind: type[Law], variables: tuple[str, ...]) -> type[Law]:
    """The class of laws of a kind whose force is a function of these variables and of parameters."""
    given = list(inspect.signature(function, eval_str=True).parameters.values())
    first = tuple(parameter.name for parameter in given[: len(variables)])
    name = "".join(part.capitalize() for part in function.__name__.split("_"))
    if first != variables:
        raise InputError(
            f"{function.__name__}: the first arguments are {', '.join(first) or 'none'}; "
            f"allowed: {', '.join(variables)}, then parameters"
        )
    members: dict[str, Any] = {
        "__module__": function.__module__ or "__main__",
        "__qualname__": function.__qualname__,  # where the module has the class, so that it can be sent on
        "__doc__": function.__doc__ or f"The law of the function `{function.__name__}`.",
        "__annotations__": {},
        "force": staticmethod(kernel(function)),
    }
    for parameter in given[len(variables) :]:
        plain = parameter.annotation is inspect.Parameter.empty
        members["__annotations__"][parameter.name] = float if plain else parameter.annotation
        if parameter.default is not inspect.Parameter.empty:
            members[parameter.name] = parameter.default
    return value(type(name, (kind,), members))
