"""What can be said of a machine before it is run: mobility, closure, dead centres, statics, doubts."""

from dataclasses import replace

from support_exudyn.machines.check.any_machine import check_any
from support_exudyn.machines.check.report import CheckReport, CheckTable
from support_exudyn.machines.check.shield import check_shield
from support_exudyn.machines.check.slider_crank import check_crank
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.slider_crank import SliderCrank
from user_forces.values.value import InputError

__all__ = ["CheckReport", "CheckTable", "check_machine"]


def check_machine(data: MachineData, stroke: float | None = None) -> CheckReport:
    """The report of all that can be said of a machine before it is run.

    Arguments:
        data: the machine as its file describes it.
        stroke: by how much its columns extend from the start on [m]; by default as the file says, otherwise
            three tenths of the shortest column.

    Machines of other kinds are looked at by their linkage alone.

    Raises InputError if it cannot go so far.
    """
    data = data if data.kind else replace(data, kind=type(data.machine).__name__)
    if isinstance(data.machine, FourBarShield):
        return check_shield(data, data.machine, stroke)
    if isinstance(data.machine, SliderCrank):
        if stroke is not None:
            raise InputError(f"stroke = {stroke} m: a crank turns right round; allowed: none")
        return check_crank(data, data.machine)
    return check_any(data, stroke)
