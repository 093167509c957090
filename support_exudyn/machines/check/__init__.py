"""What can be said of a machine before it is run: mobility, closure, dead centres, statics, doubts."""

from typing import TYPE_CHECKING

from user_forces.values.places import offered

if TYPE_CHECKING:
    from support_exudyn.machines.check.machine import check_machine
    from support_exudyn.machines.check.report import CheckReport, CheckTable

__all__ = ["CheckReport", "CheckTable", "check_machine"]

__getattr__, __dir__ = offered(
    __name__, {".machine": ("check_machine",), ".report": ("CheckReport", "CheckTable")}
)
