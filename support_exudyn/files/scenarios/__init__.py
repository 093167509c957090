"""Scenario files: reading, short forms, drives from tables."""
