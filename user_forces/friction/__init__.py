"""Friction laws, one per file."""
