"""Scenes that are drawn from a seed: machines, hydraulic legs, and linkages with far too few records."""
