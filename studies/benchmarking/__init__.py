"""Yardsticks that owe nothing to the engine: hand-written integrators of the same two machines."""
