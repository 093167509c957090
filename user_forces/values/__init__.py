"""Checked values and their units."""
