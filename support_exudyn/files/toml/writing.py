"""From a value to the table of a file, whole, so that reading gives the same value to the bit."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from support_exudyn.files.toml.shapes import FieldShape, Group, Named, Several, Shape, field_shapes
from user_forces.values.units import Unit
from user_forces.values.value import InputError, Value


def table_of(value: Value, says_type: bool = True) -> dict[str, Any]:
    """The table of a value: all its fields, decimals for numbers with a point, in the usual units.

    says_type: whether the table has its `type`.

    Raises InputError if a class declares a field that files have no form for.
    """
    cls = type(value)
    found: dict[str, Any] = {"type": cls.__name__} if says_type else {}
    for field in field_shapes(cls).values():
        item = getattr(value, field.name)
        if item is None:
            _check_default(cls, field)
            continue
        key = field.name if isinstance(item, (str, bool, Value)) else field.keys[0]
        found[key] = _item(item, field.shape, field.unit)
    return found


def _check_default(cls: type[Value], field: FieldShape) -> None:
    """Raise InputError where None is not what a file means that leaves a field out."""
    info = cls.__pydantic_fields__[field.name]  # type: ignore[attr-defined]
    if not info.is_required() and info.get_default(call_default_factory=True) is not None:
        raise InputError(
            f"{cls.__name__}.{field.name} = None: a file cannot say so, for leaving it out means the default; "
            "allowed in files: classes whose fields are None by default if at all"
        )


def _item(item: Any, shape: Shape, unit: Unit | None) -> Any:
    if isinstance(item, Value):
        groups = [one for one in getattr(shape, "options", (shape,)) if isinstance(one, Group)]
        return table_of(item, not groups or groups[0].says_type or type(item) is not groups[0].bases[0])
    if isinstance(item, Mapping):
        inner = next((one.item for one in _among(shape) if isinstance(one, Named)), shape)
        return {name: _item(one, inner, unit) for name, one in item.items()}
    if isinstance(item, (tuple, list, frozenset)):
        items = sorted(item) if isinstance(item, frozenset) else item
        inner = next((one.item for one in _among(shape) if isinstance(one, Several)), shape)
        return [_item(one, inner, unit) for one in items]
    if isinstance(item, float):
        return Decimal(repr(item)) if unit is None else unit.write(item)
    if isinstance(item, int) and not isinstance(item, bool) and unit is not None:
        return unit.write(float(item))
    return item


def _among(shape: Shape) -> tuple[Shape, ...]:
    return getattr(shape, "options", (shape,))
