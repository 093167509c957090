"""Clearance joints in Exudyn: connector, user function, memory, and steps that end at impacts."""
