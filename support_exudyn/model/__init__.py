"""The linkage and what belongs to it: bodies, pins, linear actuators, drives, loads."""
