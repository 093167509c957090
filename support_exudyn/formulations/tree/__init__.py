"""The tree formulation: minimal coordinates in the engine, an explicit method with error control.

It covers linkages that have no closed loop but through clearance pins and columns of oil. Of the settings it
uses `tolerance` alone: the contact laws are always called from Python, which is quicker here than symbolic
functions of the engine.
"""

from support_exudyn.formulations.tree.run import check, run

__all__ = ["check", "run"]
