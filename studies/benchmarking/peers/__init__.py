"""Competitors: the same machines as users of Exudyn would write them without this package's solver layer.

They exist to be measured against. Nothing else in the package uses them.
"""
