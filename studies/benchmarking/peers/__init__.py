"""The support as users of others write it: Exudyn without this package's solver, and scipy."""
