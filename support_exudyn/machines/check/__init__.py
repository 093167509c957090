"""What can be said of a machine before it is run: mobility, closure, dead centres, statics, doubts."""

from support_exudyn.machines.check.check import check_machine
from support_exudyn.machines.check.report import Report, Sheet

__all__ = ["Report", "Sheet", "check_machine"]
