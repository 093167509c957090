"""Runs at the edge of what the program can do."""
