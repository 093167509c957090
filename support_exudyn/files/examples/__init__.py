"""Scenario files to begin with: copy one, change it, `python -m support_exudyn run FILE`."""
