"""Units of fields: what a number means in the program (SI, radians), and how people write it.

A field of a value says its unit with its type, `clearance: Metres[Positive]`. It takes a plain number in SI, or
a quantity that carries its unit, as pint makes them; data files give it as `clearance_mm = 1.5`, see
`Unit.read`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Context, Decimal
from typing import Annotated, Any, TypeVar

from pydantic import GetCoreSchemaHandler
from pydantic_core import core_schema

from user_forces.values.value import carries_unit

T = TypeVar("T")

PI = Decimal("3.14159265358979323846264338327950288419716939937510")
EXACT = Context(prec=80)  # digits, far more than two numbers are ever told apart by
TELLING = (15, 17, 20)  # digits: mostly the first will do; the last tell any two numbers apart


LEVELS = 4  # of lists in lists, which is more than any field has


@dataclass(frozen=True)
class Unit:
    """The unit of a field, as metadata of its type.

    symbol: in SI, in the words of pint, with "or" between two; empty: whatever SI makes of it.
    endings: by which a file's key may end, each with what one of it is in SI; the first is usual.
    """

    symbol: str
    endings: Mapping[str, Decimal] = field(hash=False)

    @property
    def ending(self) -> str:
        """The usual one."""
        return next(iter(self.endings))

    def read(self, written: Decimal, ending: str) -> float:
        """A number in SI from one written in the unit of this ending, rounded once."""
        return float(EXACT.multiply(written, self.endings[ending]))

    def write(self, number: float, ending: str = "") -> Decimal:
        """A number in SI as it is written in the unit of an ending: `read` gives the same bits back."""
        ending = ending or self.ending
        exact = EXACT.divide(Decimal(number), self.endings[ending])
        rounded = (Context(prec=digits).create_decimal(exact) for digits in TELLING)
        return _plain(next(one for one in rounded if self.read(one, ending) == number))

    def magnitude(self, item: Any, levels: int = LEVELS) -> Any:
        """Plain numbers in SI from a quantity with a unit, or several in a list; anything else as it is.

        levels: of nested lists that are looked into. Raises ValueError if the quantity is not one of this kind.
        """
        if levels and isinstance(item, (list, tuple)):
            return tuple(self.magnitude(one, levels - 1) for one in item)
        if not carries_unit(item):
            return item
        try:
            symbol = next(
                (one for one in self.symbol.split(" or ") if item.is_compatible_with(one)), self.symbol
            )
            converted = item.to(symbol) if symbol else item.to_base_units()
        except Exception:  # pint's own, which need not be installed
            raise ValueError(
                f"Input should be a quantity that can be given in {self.symbol}, is one in {item.units}"
            ) from None
        plain = converted.magnitude
        return tuple(plain.tolist()) if getattr(plain, "ndim", 0) else plain

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> Any:
        """Schema for pydantic: units are taken off before anything else looks at the number."""
        return core_schema.no_info_before_validator_function(self.magnitude, handler(source))


def _plain(number: Decimal) -> Decimal:
    """The number without superfluous zeros; whole numbers as 1.0, so that files keep decimals, and signs."""
    number = number.normalize(EXACT)
    whole = number == number.to_integral_value()
    return number.quantize(Decimal("0.1"), context=EXACT) if whole and number.adjusted() < 16 else number


def _unit(symbol: str, **endings: str | Decimal) -> Unit:
    return Unit(symbol, {ending: Decimal(factor) for ending, factor in endings.items()})


Metres = Annotated[T, _unit("m", mm="1e-3", m="1")]
SquareMetres = Annotated[T, _unit("m**2", mm2="1e-6", m2="1")]
CubicMetres = Annotated[T, _unit("m**3", l="1e-3", m3="1")]
Kilograms = Annotated[T, _unit("kg", kg="1", t="1e3")]
KilogramSquareMetres = Annotated[T, _unit("kg*m**2", kg_m2="1")]
KilogramsPerCubicMetre = Annotated[T, _unit("kg/m**3", kg_per_m3="1")]
Seconds = Annotated[T, _unit("s", s="1", ms="1e-3")]
PerSecond = Annotated[T, _unit("1/s", per_s="1")]
Hertz = Annotated[T, _unit("Hz", Hz="1", kHz="1e3")]
MetresPerSecond = Annotated[T, _unit("m/s", mm_per_s="1e-3", m_per_s="1")]
MetresPerSecondSquared = Annotated[T, _unit("m/s**2", m_per_s2="1")]
CubicMetresPerSecond = Annotated[T, _unit("m**3/s", l_per_min=EXACT.divide(Decimal("1e-3"), 60), m3_per_s="1")]
Radians = Annotated[T, _unit("rad", deg=EXACT.divide(PI, 180), rad="1")]
RadiansPerSecond = Annotated[
    T,
    _unit("rad/s", deg_per_s=EXACT.divide(PI, 180), rad_per_s="1", rpm=EXACT.divide(PI, 30)),
]
# of drives: actuators extend by lengths, cranks turn by angles
LENGTHS, ANGLES = ("mm", "m", "mm_per_s", "m_per_s"), ("deg", "rad", "deg_per_s", "rad_per_s", "rpm")
Travel = Annotated[T, _unit("m or rad", mm="1e-3", m="1", deg=EXACT.divide(PI, 180), rad="1")]
TravelRate = Annotated[
    T,
    _unit(
        "rad/s or m/s",
        deg_per_s=EXACT.divide(PI, 180),
        rad_per_s="1",
        rpm=EXACT.divide(PI, 30),
        mm_per_s="1e-3",
        m_per_s="1",
    ),
]
Newtons = Annotated[T, _unit("N", kN="1e3", N="1", MN="1e6")]
Pascals = Annotated[T, _unit("Pa", MPa="1e6", GPa="1e9", Pa="1")]
NewtonsPerMetre = Annotated[T, _unit("N/m", kN_per_mm="1e6", N_per_m="1")]
NewtonsPerMetreToN = Annotated[T, _unit("", N_per_m_to_n="1")]  # n: the exponent of the law
NewtonSecondsPerMetre = Annotated[T, _unit("N*s/m", kN_s_per_m="1e3", N_s_per_m="1")]
NewtonMetres = Annotated[T, _unit("N*m", N_m="1", kN_m="1e3")]
NewtonMetresPerRadian = Annotated[T, _unit("N*m/rad", N_m_per_rad="1")]
NewtonMetreSecondsPerRadian = Annotated[T, _unit("N*m*s/rad", N_m_s_per_rad="1")]
SecondsPerMetre = Annotated[T, _unit("s/m", s_per_m="1")]
PerMetre = Annotated[T, _unit("1/m", per_m="1")]
