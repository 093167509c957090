"""Machines, one per file: closed-form kinematics and their layout as a linkage."""
