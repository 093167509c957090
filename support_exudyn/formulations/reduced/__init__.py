"""The reduced formulation: a machine in its two free coordinates, without the engine.

It is independent of the redundant formulation in everything but the parameters: posture in closed form,
equations of motion by virtual power, an explicit method with error control and located touches. Two ways to run
it: in plain Python with scipy's DOP853 and any law, or compiled (extra [fast]) with the laws K depth^n.
"""

from support_exudyn.formulations.reduced.coverage import check
from support_exudyn.formulations.reduced.run import run

__all__ = ["check", "run"]
