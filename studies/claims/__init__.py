"""How claims are judged on many plausible machines."""
