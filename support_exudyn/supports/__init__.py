"""Machine data files (TOML; mm and kg) and their reader."""

from support_exudyn.supports.read import load_support, reference_support, two_body_columns

__all__ = ["load_support", "reference_support", "two_body_columns"]
