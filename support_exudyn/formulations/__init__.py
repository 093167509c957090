"""Equations of motion and their integration, see the README."""
