"""Rigid bodies with constraints in Exudyn, under generalised alpha."""
