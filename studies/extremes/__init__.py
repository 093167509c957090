"""Scenes at the extremes, how they are judged, and long runs."""
