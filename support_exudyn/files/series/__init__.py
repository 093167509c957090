"""Readers of quantities over time, one format a file."""
