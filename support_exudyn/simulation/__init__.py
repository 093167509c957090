"""From a scenario to its result: settings, runs, errors, checks.

This file imports nothing: `at_start` has to run before anything else is imported.
"""
