"""A clearance pin in the engine: its connector, force and memory."""
