"""The compiled formulation: any planar linkage from arrays, error control, located impacts; without the engine.

Where a machine's posture is known in closed form, and nothing else is asked, these forms take its place: the
same motions, several times as fast.
"""

from support_exudyn.formulations.compiled.coverage import check
from support_exudyn.formulations.compiled.run import run

__all__ = ["check", "run"]
