"""Machines in their two free coordinates: posture in closed form, equations of motion by virtual power.

An acceleration of the compiled formulation for the support and the slider-crank, five times as fast as the
equations of any linkage. It shares with them how steps are chosen, impacts are found and laws are called.
"""

from support_exudyn.formulations.compiled.closed_forms.coverage import covers
from support_exudyn.formulations.compiled.closed_forms.run import run

__all__ = ["covers", "run"]
