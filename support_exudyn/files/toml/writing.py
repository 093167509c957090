"""Values are written as tables of files, whole, so that reading gives the same value to the bit."""

from collections.abc import Collection, Mapping
from decimal import Decimal
from typing import Any

from support_exudyn.files.own_modules import NotImported
from support_exudyn.files.toml.shapes import FieldShape, Shape, field_shapes, inner_shape, options
from user_forces.values.units import Unit
from user_forces.values.value import InputError, Value, short


def table_of(value: Value, says_type: bool = True, endings: Collection[str] = ()) -> dict[str, Any]:
    """The table of a value: all its fields, decimals for numbers with a point, in the usual units.

    says_type: whether the table has its `type`. endings: units that are preferred to the usual ones.

    Raises InputError if a class declares a field that files have no form for, or is not imported.
    """
    if isinstance(value, NotImported):
        value.refuse()
    cls = type(value)
    found: dict[str, Any] = {"type": cls.__name__} if says_type else {}
    for field in field_shapes(cls).values():
        item = getattr(value, field.name)
        if item is None:
            _check_default(cls, field)
            continue
        key = next((one for one in field.keys if field.ending(one) in endings), field.keys[0])
        key = field.name if isinstance(item, (str, bool, Value)) else key
        found[key] = _item(item, field.shape, field.unit, (field.ending(key), *endings))
    return found


def _check_default(cls: type[Value], field: FieldShape) -> None:
    """Raise InputError where None is not what a file means that leaves a field out."""
    if field.default is not None:
        raise InputError(
            f"{cls.__name__}.{field.name} = None: a file cannot say so, for leaving it out means the default; "
            "allowed in files: classes whose fields are None by default if at all"
        )


def _item(item: Any, shape: Shape, unit: Unit | None, endings: tuple[str, ...]) -> Any:
    """An item as a file has it. endings: first that of its key, then those that tables in it prefer."""
    if isinstance(item, Value):
        group = next(one["group"] for one in options(shape) if "group" in one)
        return table_of(item, group.says_type or type(item) is not group.bases[0], endings[1:])
    if isinstance(item, Mapping):
        return {name: _item(one, inner_shape(shape, name), unit, endings) for name, one in item.items()}
    if isinstance(item, (tuple, list, frozenset)):
        items = sorted(item) if isinstance(item, frozenset) else item
        return [_item(one, inner_shape(shape, n), unit, endings) for n, one in enumerate(items)]
    if isinstance(item, float) or (isinstance(item, int) and not isinstance(item, bool) and unit is not None):
        return Decimal(repr(item)) if unit is None else unit.write(float(item), endings[0])
    if not isinstance(item, (str, int)):
        raise InputError(
            f"{short(item)}: is of a type that files have no form for; allowed: numbers, texts, bool, values, "
            "and tuples and mappings of them"
        )
    return item
