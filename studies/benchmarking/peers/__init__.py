"""Competitors: the same machines as users of other programs would write them.

Exudyn without this package's solver layer, MuJoCo and Drake. They exist to be measured against. Nothing else in
the package uses them.
"""
