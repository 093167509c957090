"""The linkage and what belongs to it: bodies, pins, columns, drives, loads."""
