"""The source of a law as plain code, for compilers."""
