"""Figures: one style for all, and those that a single run can be looked at by."""
