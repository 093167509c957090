"""The reduced formulation: a machine in its two free coordinates, without the engine.

It is independent of the redundant formulation in everything but the parameters: posture in closed form,
equations of motion by virtual power, an explicit method with error control and located impacts. All of it is
compiled, the contact laws too, users' own among them.
"""

from support_exudyn.formulations.reduced.coverage import check
from support_exudyn.formulations.reduced.run import run

__all__ = ["check", "run"]
