"""What can be said of a machine before it is run: mobility, closure, dead centres, statics, doubts."""

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

    Raises InputError if it cannot go so far, or if machines of this kind are not covered.
    """
    if isinstance(data.machine, FourBarShield):
        return check_shield(data, data.machine, stroke)
    if isinstance(data.machine, SliderCrank):
        if stroke is not None:
            raise InputError(f"stroke = {stroke} m: a crank turns right round; allowed: none")
        return check_crank(data, data.machine)
    raise InputError(
        f"machine = {type(data.machine).__name__}: not covered; allowed: shield supports and slider-cranks"
    )
