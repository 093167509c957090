"""The compiled formulation: any planar linkage from arrays, error control, located impacts, no engine."""

from support_exudyn.formulations.compiled.coverage import check
from support_exudyn.formulations.compiled.run import run

__all__ = ["check", "run"]
