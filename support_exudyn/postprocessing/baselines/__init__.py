"""Baselines: what runs came out at, kept in files, and what has changed since."""
