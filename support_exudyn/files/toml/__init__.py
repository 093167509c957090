"""Values as TOML: fields, units, messages."""
