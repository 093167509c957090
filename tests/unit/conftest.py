"""How long and how often hypothesis tries in the unit tests."""

from hypothesis import settings

settings.register_profile("unit", parent=settings.default, deadline=None, max_examples=60)
settings.load_profile("unit")
