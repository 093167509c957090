"""Figures of runs, sweeps and machines, in one style."""
