"""The functions that laws are written with: numbers, arrays, expressions of the engine."""
