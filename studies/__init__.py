"""Studies: one question per file, each with scenarios, measures, figures and a main."""

from support_exudyn.simulation import at_start as at_start
