"""Sweeps: many runs of a scenario with some of its fields varied, in one store that can be continued.

    from support_exudyn.sweeps import read_sweep, read_table, sweep

    sweep(read_sweep("clearance.toml"))  # into clearance_sweep
    table = read_table("clearance_sweep").to_pandas()  # without: a pyarrow table, which prints all its columns

A run has a key, made of its inputs and of the program; what the store holds under that key is not run again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from user_forces.values.places import for_types, offered

if TYPE_CHECKING:
    from support_exudyn.sweeps.file import read_sweep as read_sweep
    from support_exudyn.sweeps.plan import Plan as Plan
    from support_exudyn.sweeps.plan import Record as Record
    from support_exudyn.sweeps.plan import grid as grid
    from support_exudyn.sweeps.plan import latin_hypercube as latin_hypercube
    from support_exudyn.sweeps.plan import side_by_side as side_by_side
    from support_exudyn.sweeps.run import SweepOutcome as SweepOutcome
    from support_exudyn.sweeps.run import open_run as open_run
    from support_exudyn.sweeps.run import sweep as sweep
    from support_exudyn.sweeps.table import read_table as read_table

# imported when they are asked for: the processes that run have no use for tables
__getattr__, __dir__ = offered(__name__, for_types(__file__))
