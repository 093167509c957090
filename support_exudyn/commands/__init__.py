"""The command line, one command a file; `parser` says what a command is.

This file imports nothing: `at_start` has to run before anything else is imported.
"""
